"""The climbing disc as an SSP, flown in three tools: FMPy, Ecos and libcosim.

The system consists of three FMUs: the rotor, and a body and a PID controller that pythonfmu makes
from body.py and pid.py. SystemStructure.ssd connects them; the .ssv files have their parameters.

    python ssp.py --fmu HelicopterRotor.fmu --out FOLDER

writes climbing-disc.ssp, the heights in each tool (climbing-disc-ssp.csv) and their picture. The
heights differ by some centimetres, because the tools exchange values in different ways: libcosim
before the first step and after each; FMPy and Ecos after each step only, so that inputs are 0 in
their first step.
"""

import ctypes
import shutil
import subprocess
import sys
import tempfile
import zipfile
from importlib.metadata import version
from importlib.util import find_spec
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent))

import numpy as np

from script import command_line, plt, save_plot, write_table

STEP = 0.005  # s
STEPS = 1600
TOOLS = {"fmpy": "fmpy", "ecos": "ecospy", "libcosim": "libcosimpy"}  # name: its package


def make_ssp(fmu, file):
    """Writes the .ssp with all that it needs."""
    with tempfile.TemporaryDirectory() as folder:
        for script in ("body.py", "pid.py"):
            build = [sys.executable, "-m", "pythonfmu", "build", "-d", folder]
            build += ["-f", HERE / script, HERE / "parts.py"]
            subprocess.run(build, check=True, capture_output=True)
        shutil.copy(fmu, Path(folder) / "HelicopterRotor.fmu")
        for parameters in HERE.glob("*.ssv"):
            shutil.copy(parameters, folder)
        file.parent.mkdir(parents=True, exist_ok=True)
        temporary = file.with_suffix(".tmp")
        with zipfile.ZipFile(temporary, "w", zipfile.ZIP_DEFLATED) as archive:
            archive.write(HERE / "SystemStructure.ssd", "SystemStructure.ssd")
            for part in Path(folder).iterdir():
                archive.write(part, f"resources/{part.name}")
        temporary.replace(file)


def with_fmpy(ssp):
    """FMPy ignores the parameters in an .ssp; they can be passed, but not strings."""
    import fmpy.ssp.simulation as simulation
    from fmpy.ssp.ssd import ParameterSet, read_ssv

    set_other = simulation.set_value

    def set_value(component, name, value):
        variable = component.variables[name]
        if variable.type == "String":
            component.fmu.setString([variable.valueReference], [value])
        else:
            set_other(component, name, value)

    simulation.set_value = set_value
    parameters = ParameterSet(name="climb")
    for component in ("rotor", "body", "pid"):
        for parameter in read_ssv(str(ssp), f"resources/{component}.ssv").parameters:
            parameter.name = f"{component}.{parameter.name}"
            parameters.parameters.append(parameter)
    result = simulation.simulate_ssp(
        str(ssp), stop_time=(STEPS - 0.5) * STEP, step_size=STEP, parameter_set=parameters
    )
    # The row of a time has what the components give at the end of the step that begins then.
    return [0.0, *result["body.height"].tolist()]


def with_ecos(ssp):
    try:  # Ecos needs libtbb.so.12, which the package tbb has, if the system has none.
        ctypes.CDLL(str(Path(sys.prefix) / "lib" / "libtbb.so.12"), mode=ctypes.RTLD_GLOBAL)
    except OSError:
        pass
    from ecospy import EcosLib, EcosSimulation

    with EcosSimulation(step_size=STEP, ssp_path=str(ssp)) as simulation:
        if not simulation.init(parameter_set="climb"):
            raise RuntimeError(EcosLib.get_last_error())
        heights = [simulation.get_real("body::height")]
        for _ in range(STEPS):
            simulation.step()
            heights.append(simulation.get_real("body::height"))
        simulation.terminate()
    return heights


def with_libcosim(ssp):
    """libcosim takes the unpacked folder."""
    from libcosimpy.CosimExecution import CosimExecution
    from libcosimpy.CosimObserver import CosimObserver

    with tempfile.TemporaryDirectory() as folder:
        with zipfile.ZipFile(ssp) as archive:
            archive.extractall(folder)
        execution = CosimExecution.from_ssp_file(folder, round(STEP * 1e9))
        body = execution.slave_index_from_instance_name("body")
        found = execution.slave_variables(body)
        height = next(v.reference for v in found if v.name.decode() == "height")
        observer = CosimObserver.create_last_value()
        execution.add_observer(observer)
        heights = [0.0]
        for _ in range(STEPS):
            if not execution.step():
                raise RuntimeError("libcosim did not make the step")
            heights += observer.last_real_values(body, [height])
    return heights


def fly(tool, ssp):
    """The heights at all communication points, in a process of its own, as each tool loads its
    own libraries."""
    command = [sys.executable, __file__, "--tool", tool, str(ssp)]
    done = subprocess.run(command, capture_output=True, text=True)
    if done.returncode != 0:
        raise SystemExit(f"{tool} did not fly the system:\n{done.stdout}{done.stderr}")
    lines = [line.split() for line in done.stdout.splitlines()]
    return [float(words[1]) for words in lines if words[:1] == ["height"]]


def plot(rows, file):
    """The heights, and how they differ from FMPy's."""
    table = {name: np.array([row[name] for row in rows]) for name in rows[0]}
    figure, axes = plt.subplots(2, 1, figsize=(7.5, 6.0), sharex=True, constrained_layout=True)
    for tool, style in zip(TOOLS, ("-", "--", ":")):
        if tool not in table:
            continue
        label = f"{TOOLS[tool]} {version(TOOLS[tool])}"
        axes[0].plot(table["time"], table[tool], style, color="black", label=label)
        axes[1].plot(table["time"], 1e3 * (table[tool] - table["fmpy"]), style, color="black")
    axes[0].set_ylabel("height, m")
    axes[1].set_ylabel("height less that in FMPy, mm")
    axes[1].set_xlabel("time, s")
    axes[0].legend()
    axes[0].set_title("One system, climbing-disc.ssp, in three tools")
    for axis in axes:
        axis.grid(True, color="0.85")
        axis.set_xlim(0.0, STEP * STEPS)
    save_plot(figure, file)


def main():
    if sys.argv[1:2] == ["--tool"]:
        for height in globals()[f"with_{sys.argv[2]}"](sys.argv[3]):
            print("height", repr(float(height)))
        return
    arguments = command_line(__doc__, out="folder for the .ssp, table and plot").parse_args()
    ssp = arguments.out / "climbing-disc.ssp"
    make_ssp(arguments.fmu, ssp)
    columns = {"time": [STEP * i for i in range(STEPS + 1)]}
    for i, (tool, package) in enumerate(TOOLS.items()):
        print(f"progress {i} {len(TOOLS)} {tool}")
        if not find_spec(package):
            print(f"{package} is not installed: there is none for this Python or platform")
            continue
        columns[tool] = fly(tool, ssp)
        heights = ", ".join(f"{columns[tool][round(t / STEP)]:.4f}" for t in (1.0, 2.0, 5.0, 8.0))
        print(f"{package:11s} {version(package):7s} at 1, 2, 5 and 8 s: {heights} m")
    rows = [dict(zip(columns, values)) for values in zip(*columns.values())]
    write_table(rows, arguments.out / "climbing-disc-ssp.csv")
    plot(rows, arguments.out / "climbing-disc-ssp.png")


if __name__ == "__main__":
    main()
