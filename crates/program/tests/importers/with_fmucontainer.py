"""FMU containers: https://pypi.org/project/fmu-manipulation-toolbox

The rotor is flown inside a container, which FMPy runs.
"""

import json
import shutil
import subprocess
import sys
import tempfile
from contextlib import contextmanager
from pathlib import Path

import with_fmpy
from flight import STEP, main

TOOLS = Path(sys.executable).parent
CONTAINER = "container.fmu"


@contextmanager
def container(fmu, rotors):
    """A container of rotors, each with its start values. The thrust of the last one is `thrust`,
    and that of another NAME is `NAME.thrust`."""
    with tempfile.TemporaryDirectory() as folder:
        names = [f"{rotor}.fmu" for rotor in rotors]
        for name in names:
            shutil.copy(fmu, Path(folder) / name)
        description = {
            "name": CONTAINER,
            "fmu": names,
            "step_size": STEP,
            "auto_input": False,
            "auto_output": False,
            "output": [[name, "thrust", f"thrust.{name[:-4]}"] for name in names],
            "start": [
                [f"{rotor}.fmu", v.name, as_text(v)]
                for rotor, variables in rotors.items()
                for v in variables
            ],
        }
        (Path(folder) / "container.json").write_text(json.dumps(description))
        command = [TOOLS / "fmucontainer", "-container", "container.json", "-fmu-directory", folder]
        made = subprocess.run(command, cwd=folder, capture_output=True, text=True)
        file = Path(folder) / CONTAINER
        if made.returncode != 0 or not file.is_file():
            raise RuntimeError(made.stdout + made.stderr)
        yield str(file)


def as_text(variable):
    if variable.kind == "Boolean":
        return "1" if variable.value else "0"
    return str(variable.value)


def load(fmu, variables):
    """Checks the FMU with fmutool first."""
    command = [TOOLS / "fmutool", "-input", fmu, "-check"]
    output = subprocess.run(command, capture_output=True, text=True, check=True).stdout
    if "ERROR" in output or "compliant with FMI-2.0" not in output:
        raise RuntimeError(output)
    return fly(fmu, variables)


def thrusts(fmu, rotors, simulate=with_fmpy.simulate):
    with container(fmu, rotors) as file:
        return simulate(file, [], outputs=[f"thrust.{rotor}" for rotor in rotors])


def fly(fmu, variables):
    return thrusts(fmu, {"rotor": variables})


def two(fmu, variables):
    return thrusts(fmu, {"first": variables, "second": []})


def again(fmu, variables):
    return fly(fmu, variables) + fly(fmu, variables)


def reset(fmu, variables):
    return thrusts(fmu, {"rotor": variables}, with_fmpy.simulate_twice)


if __name__ == "__main__":
    main({"load": load, "fly": fly, "two": two, "again": again, "reset": reset})
