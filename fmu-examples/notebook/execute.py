"""Executes the notebook rotor.ipynb without a browser.

    python execute.py --fmu HelicopterRotor.fmu --out FOLDER

writes rotor.ipynb with its results, and its pictures notebook-1.png ..., into FOLDER. To work in it
yourself, open it in Jupyter or an editor.
"""

import base64
import os
import sys
import tempfile
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent))

import nbformat
from nbclient import NotebookClient
from traitlets.config import Config

from script import command_line


def write(file, content):
    """The file appears whole or not at all."""
    file.parent.mkdir(parents=True, exist_ok=True)
    temporary = file.with_suffix(".tmp")
    temporary.write_bytes(content)
    temporary.replace(file)


def main():
    arguments = command_line(__doc__, out="folder for the executed notebook").parse_args()
    os.environ["ROTOR_FMU"] = str(arguments.fmu.resolve())
    # The kernel of this environment, whatever others are installed for the user.
    os.environ["JUPYTER_PREFER_ENV_PATH"] = "1"
    notebook = nbformat.read(HERE / "rotor.ipynb", as_version=4)
    count = sum(cell.cell_type == "code" for cell in notebook.cells)
    done = []

    def show(cell, cell_index, **_):
        if cell.cell_type == "code":
            done.append(cell_index)
            print(f"progress {len(done)} {count} cell {cell_index + 1}")

    place = {"metadata": {"path": str(HERE)}}
    with tempfile.TemporaryDirectory() as folder:
        # Over sockets in a folder that other users cannot read, not over the machine's network.
        sockets = {"transport": "ipc", "ip": str(Path(folder) / "kernel")}
        config = Config({"KernelManager": sockets})
        client = NotebookClient(notebook, config=config, timeout=300, resources=place)
        client.record_timing = False
        client.on_cell_complete = show
        client.execute()

    pictures = 0
    for cell in notebook.cells:
        for output in cell.get("outputs", []):
            if output.output_type == "stream":
                print(output.text.rstrip())
            picture = output.get("data", {}).get("image/png")
            if picture:
                pictures += 1
                write(arguments.out / f"notebook-{pictures}.png", base64.b64decode(picture))
    write(arguments.out / "rotor.ipynb", nbformat.writes(notebook).encode())


if __name__ == "__main__":
    main()
