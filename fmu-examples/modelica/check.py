"""Checks the Modelica package: its syntax, the FMU's names in it, its frames, and its test model.

    python check.py --fmu HelicopterRotor.fmu --out FOLDER

prints what was checked by what. If the environment variable MODELICAPATH names a folder that has
the Modelica Standard Library in it (the folders Modelica and ModelicaServices, and Complex.mo), the
systems are also compiled, and the one without the FMU is flown, beside the FMU in FMPy. FOLDER gets

    HelicopterRotor_me_FMU.mo, HelicopterRotor.mo    what tools make of the FMU, without its inside
    modelica.csv, .png                               the climb, if there is the Modelica library
"""

import importlib
import importlib.metadata
import math
import os
import re
import sys
import tempfile
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path[:0] = [str(HERE.parent), str(HERE.parent / "climbing_disc")]

import numpy as np
import pymoca.parser
import rumoca
from rotor import Rotor
from scipy.spatial.transform import Rotation
from script import command_line, plt, save_plot, write_table

# The same climb with the FMU, in Python; a script of another example.
climb = importlib.import_module("climb")
PACKAGE = HERE / "RotorSystems"
TRIM = {"collective": 0.14, "rpm": 960.0}  # of the stand-in
CONNECTOR = {
    "input": "Modelica.Blocks.Interfaces.RealInput",
    "output": "Modelica.Blocks.Interfaces.RealOutput",
}
# The reserved words of the Modelica Language Specification 3.6, section 2.3.3.
KEYWORDS = set(
    "algorithm and annotation block break class connect connector constant constrainedby der discrete"
    " each else elseif elsewhen encapsulated end enumeration equation expandable extends external false"
    " final flow for function if import impure in initial inner input loop model not operator or outer"
    " output package parameter partial protected public pure record redeclare replaceable return stream"
    " then true type when while within".split()
)


def underscored(name):
    """A name as OpenModelica imports it: makeStringFMISafe in its runtime/FMIImpl.c."""
    return re.sub(r"[.\[\] ,()]", "_", name)


def check_syntax():
    for file in sorted(PACKAGE.glob("*.mo")):
        text = file.read_text(encoding="utf-8")
        found = rumoca.validate_source(text, filename=file.name)
        assert not found, f"{file.name}: {found[0]}"
        assert pymoca.parser.parse(text) is not None, f"pymoca cannot parse {file.name}"


def check_names(variables):
    """All names of the FMU stay different names, which Modelica allows."""
    names = [underscored(name) for name in variables]
    assert len(set(names)) == len(names), "two variables have the same name after import"
    for name in [*names, *(part for name in variables for part in re.split(r"[.\[\]()]", name))]:
        assert name == "" or name.isdigit() or re.fullmatch(r"[A-Za-z_]\w*", name), name
    for name in variables:
        words = set(re.split(r"[.\[\]()]", name)) - {"der"}
        assert not words & KEYWORDS, f"{name} has a keyword of Modelica in it"


def interfaces(variables):
    """What tools make of the FMU: its connectors, with zeros for the results. Two models, with
    underscores and with arrays, by the name of their class."""
    reals = [v for v in variables.values() if v.type == "Real" and v.causality in CONNECTOR]
    flat = {underscored(v.name): (v.causality, 0) for v in reals}
    arrays = {}
    for variable in reals:
        base, _, index = variable.name.partition("[")
        arrays[base] = (variable.causality, int(index.rstrip("]") or 0))  # the last index counts
    return {
        "HelicopterRotor_me_FMU": model("HelicopterRotor_me_FMU", flat),
        "HelicopterRotor": model("HelicopterRotor", arrays),
    }


def model(name, connectors):
    lines = [f"model {name}", '  parameter String settings="";']
    equations = []
    for connector, (causality, size) in connectors.items():
        lines.append(f"  {CONNECTOR[causality]} {connector}{f'[{size}]' if size else ''};")
        if causality == "output":
            equations.append(f"  {connector} = {f'zeros({size})' if size else '0'};")
    return "\n".join([*lines, "equation", *equations, f"end {name};", ""])


def check_frames():
    """The block Attitude, compiled by Rumoca, against SciPy, in ten random attitudes."""
    source = (PACKAGE / "Attitude.mo").read_text(encoding="utf-8").split(";", 1)[1]
    random = np.random.default_rng(1)
    worst = 0.0
    for _ in range(10):
        heading, tilt, lateral = random.uniform(-1.4, 1.4, 3) * [2.2, 1.0, 2.2]
        vectors = random.uniform(-5.0, 5.0, (3, 3))
        axes = Rotation.from_euler("ZYX", [heading, tilt, lateral]).as_matrix()
        given = {"T": axes.T, "worldVelocity": vectors[0]}
        given |= {"worldAngularVelocity": vectors[1], "worldWind": vectors[2]}
        equations = "".join(f"a.{name} = {modelica(value)}; " for name, value in given.items())
        text = f"{source}\nmodel M Attitude a; equation {equations} end M;"
        result = rumoca.Session().loads(text, model="M").simulate(t=(0.0, 1.0), dt=1.0)
        names = ["heading", "tilt", "lateralTilt"]
        turned = Rotation.from_euler("Z", heading).inv().apply(vectors)
        expected = dict(zip(names, [heading, tilt, lateral]))
        for kind, vector in zip(("velocity", "angularVelocity", "wind"), turned):
            expected |= {f"{kind}[{i + 1}]": vector[i] for i in range(3)}
        errors = [abs(result[f"a.{name}"][-1] - value) for name, value in expected.items()]
        worst = max(worst, *errors)
    assert worst < 1e-9, worst
    return worst


def modelica(value):
    if np.ndim(value) == 0:
        return repr(float(value))
    return "{" + ", ".join(modelica(entry) for entry in value) + "}"


def check_stand_in(rotor):
    """The stand-in's numbers are the FMU's thrust and its derivatives in hover."""
    rotor.set(TRIM)
    derivatives = rotor.jacobian(["hubForce[3]"], ["collective", "velocity[3]"])[0]
    values = dict(zip(["thrust", "byCollective", "byClimb"], [rotor["hubForce[3]"], *derivatives]))
    text = (PACKAGE / "Imported.mo").read_text(encoding="utf-8")
    for name, value in values.items():
        written = float(re.search(rf"constant Real {name}=(\S+) ", text).group(1))
        assert abs(written / value - 1.0) < 1e-4, f"{name} = {written}, but the FMU has {value}"


def compile_all(library, made):
    """Compiles the systems with Rumoca, and flies that without the FMU. Rows of the table."""
    with tempfile.TemporaryDirectory() as folder:
        root = Path(folder)
        for name in ("Modelica", "ModelicaServices", "Complex.mo"):
            (root / name).symlink_to(Path(library).resolve() / name)
        (root / "RotorSystems").symlink_to(PACKAGE)
        session = rumoca.Session(roots=[str(root)])
        for name in ("Climb", "ClimbStructured", "ClimbWithoutFmu"):
            text = f"{''.join(made.values())}model M extends RotorSystems.Examples.{name}; end M;"
            compiled = session.loads(text, model="M")
            structure = compiled.structure()
            assert structure.is_balanced and structure.is_matched, structure
            print(f"Rumoca compiles {name}: {structure.n_equations} equations and unknowns")
        result = compiled.simulate(t=(0.0, climb.STOP), dt=0.02)
    # The stop time may be there twice.
    times = np.arange(0.0, climb.STOP + 1e-9, 0.02)
    heights = np.interp(times, result.time, result["guide.s"])
    return [{"time": t, "height": h} for t, h in zip(times, heights)]


def plot(rows, flown, file):
    figure, axis = plt.subplots(figsize=(7.5, 3.6), constrained_layout=True)
    axis.axhline(climb.HEIGHT, color="0.7")
    axis.plot(
        [r["time"] for r in flown],
        [r["height"] for r in flown],
        color="black",
        label="FMU and Python, in FMPy",
    )
    label = "Modelica with the stand-in, in Rumoca"
    axis.plot(
        [r["time"] for r in rows], [r["height"] for r in rows], "--", color="#d9480f", label=label
    )
    axis.set(xlabel="time, s", ylabel="height, m", xlim=(0.0, climb.STOP), ylim=(0.0, None))
    axis.grid(True, color="0.9")
    axis.legend()
    figure.suptitle("A disc climbs to 2.5 m: the Modelica test model beside the FMU")
    save_plot(figure, file)


def main():
    arguments = command_line(__doc__, out="folder for the results").parse_args()
    versions = {name: importlib.metadata.version(name) for name in ("rumoca", "pymoca")}
    check_syntax()
    print(f"Rumoca {versions['rumoca']} and Pymoca {versions['pymoca']} parse the package.")
    with Rotor(arguments.fmu) as rotor:
        check_names(rotor.variables)
        print(
            f"{len(rotor.variables)} names of the FMU stay different, and are allowed, in Modelica."
        )
        made = interfaces(rotor.variables)
        check_stand_in(rotor)
        print("The stand-in has the FMU's thrust and derivatives in hover.")
    arguments.out.mkdir(parents=True, exist_ok=True)
    for name, text in made.items():
        (arguments.out / f"{name}.mo").write_text(text, encoding="utf-8")
    print(f"The frames agree with SciPy; the largest error is {check_frames():.1e}.")
    # Taken away, as Rumoca would look there instead of in the folder that has this package, too.
    library = os.environ.pop("MODELICAPATH", None)
    if not library:
        print("Not compiled: set MODELICAPATH to a folder with the Modelica Standard Library.")
        return
    rows = compile_all(library, made)
    with Rotor(arguments.fmu, climb.PARAMETERS) as rotor:
        flown = list(climb.fly(rotor))
    write_table(rows, arguments.out / "modelica.csv")
    plot(rows, flown, arguments.out / "modelica.png")
    highest = max(row["height"] for row in rows)
    overshoot = 100.0 * (highest / climb.HEIGHT - 1.0)
    print(
        f"Without the FMU it overshoots by {overshoot:.1f} % and ends at {rows[-1]['height']:.3f} m."
    )


if __name__ == "__main__":
    main()
