"""Makes the reference files: flies each experiment to convergence and writes it for importers.

`cargo run --release -- reference` runs it.

    python make.py --fmu HelicopterRotor.fmu --out FOLDER

writes into FOLDER, the source tree or an empty folder,

    modelDescription/extra/org.fmi-standard.fmi-ls-ref/   the files that travel in the FMU
    reference-flights/cross-check/                        the first one for the FMI cross-check
"""

import sys
import xml.etree.ElementTree as ET
from pathlib import Path

import numpy as np

# The rotor is that of the examples.
sys.path.insert(0, str(Path(__file__).resolve().parent.parent / "fmu-examples"))

from experiments import EXPERIMENTS, HOVER
from fly import converged, inputs_at
from script import command_line

LAYERED_STANDARD = Path("modelDescription/extra/org.fmi-standard.fmi-ls-ref")
CROSS_CHECK = Path("reference-flights/cross-check")

# Both are relative to the largest magnitude of each output. Importers are compared at TOLERANCE;
# halving the steps of the converged run must change far less.
TOLERANCE = 0.01
CONVERGED = TOLERANCE / 200.0
PARTS = 10

MANIFEST = "http://fmi-standard.org/fmi-ls-manifest"
SSV = "http://ssp-standard.org/SSP1/SystemStructureParameterValues"


def write(path, text):
    """The file appears whole or not at all."""
    path.parent.mkdir(parents=True, exist_ok=True)
    temporary = path.with_name(f".{path.name}.tmp")
    temporary.write_text(text, encoding="utf-8", newline="\n")
    temporary.replace(path)


def reference(fmu, experiment):
    """Rows (time, outputs ...) of the finer of two runs, which must agree."""
    coarse, fine = (converged(fmu, experiment, parts) for parts in (PARTS, 2 * PARTS))
    largest = np.abs(fine).max(axis=0)
    change = (np.abs(fine - coarse).max(axis=0) / largest)[1:]
    worst = int(change.argmax())
    name = experiment.outputs[worst]
    print(f"{experiment.name}: {len(fine)} rows, converged to {change[worst]:.0e} ({name})")
    if not change[worst] <= CONVERGED:
        sys.exit(
            f"{experiment.name}: {name} changes by {change[worst]:.1e} of its largest magnitude"
            f" when the steps are halved, more than {CONVERGED:.0e};"
            " raise PARTS in reference-flights/make.py"
        )
    # Seven digits of the largest magnitude; smaller digits are rounding.
    digits = 6 - np.floor(np.log10(largest)).astype(int)
    return np.array([[round(value, int(d)) for value, d in zip(row, digits)] for row in fine]) + 0.0


def csv(names, rows):
    """By the rules of the cross-check: names in quotes, a comma between fields, time first."""
    lines = [",".join(f'"{name}"' for name in ("time", *names))]
    lines += [",".join(f"{value:.9g}" for value in row) for row in rows]
    return "\n".join(lines) + "\n"


def stimuli(experiment):
    """A row at each communication point, so that interpolating between rows and holding them give
    the same inputs."""
    times = [
        round(i * experiment.step, 9) for i in range(round(experiment.stop / experiment.step) + 1)
    ]
    rows = [[time, *inputs_at(experiment, time).values()] for time in times]
    return csv(experiment.inputs, rows)


def xml(root):
    ET.indent(root, "  ")
    return '<?xml version="1.0" encoding="UTF-8"?>\n' + ET.tostring(root, encoding="unicode") + "\n"


def parameter_set(experiment):
    """SSV 1.0 without units: values are in the units of the FMU's variables."""
    ET.register_namespace("ssv", SSV)
    root = ET.Element(f"{{{SSV}}}ParameterSet", version="1.0", name=experiment.name)
    parameters = ET.SubElement(root, f"{{{SSV}}}Parameters")
    for name, value in experiment.parameters.items():
        parameter = ET.SubElement(parameters, f"{{{SSV}}}Parameter", name=name)
        if isinstance(value, bool):
            kind, text = "Boolean", str(value).lower()
        elif isinstance(value, float):
            kind, text = "Real", f"{value:.9g}"
        else:
            kind, text = ("String" if name.endswith(".file") else "Enumeration"), value
        ET.SubElement(parameter, f"{{{SSV}}}{kind}", value=text)
    return xml(root)


def experiments_file():
    """The experiments in the Modelica Association's harmonized specification.

    The attribute `tolerance` is left out: beside startTime, stopTime and stepSize it reads as the
    tolerance of a solver, which the one of the comparison is not.
    """
    root = ET.Element(
        "Experiments",
        name="Reference experiments",
        description=f"Outputs agree within {TOLERANCE:.0%} of the largest magnitude of each",
    )
    for experiment in EXPERIMENTS:
        element = ET.SubElement(
            root,
            "Experiment",
            name=experiment.name,
            description=experiment.description,
            startTime="0",
            stopTime=f"{experiment.stop:g}",
            stepSize=f"{experiment.step:g}",
        )
        if experiment.parameters:
            ET.SubElement(element, "Parameters", source=f"{experiment.name}.ssv")
        ET.SubElement(element, "Stimuli", source=f"{experiment.name}_in.csv")
        ET.SubElement(element, "References", source=f"{experiment.name}_ref.csv")
    return xml(root)


def manifest():
    ET.register_namespace("fmi-ls", MANIFEST)
    root = ET.Element("fmiReferences")
    root.set(f"{{{MANIFEST}}}fmi-ls-name", "org.fmi-standard.fmi-ls-ref")
    root.set(f"{{{MANIFEST}}}fmi-ls-version", "1.0.0-alpha.1")
    root.set(
        f"{{{MANIFEST}}}fmi-ls-description",
        "Layered Standard providing information on related files included in an FMU.",
    )

    def related(kind, source, role, description):
        ET.SubElement(root, "Related", type=kind, source=source, role=role, description=description)

    related(
        "application/x-ma-hs-experiments",
        "experiments.exp",
        "experiment/smoke-test",
        "Reference experiments: parameters, inputs and expected outputs",
    )
    for experiment in EXPERIMENTS:
        name = experiment.name
        if experiment.parameters:
            related(
                "application/x-ssp-parameter-set",
                f"{name}.ssv",
                "parameter",
                f"Parameters of the experiment {name}",
            )
        related("text/csv", f"{name}_in.csv", "other", f"Inputs of the experiment {name}")
        related(
            "text/csv", f"{name}_ref.csv", "result", f"Expected outputs of the experiment {name}"
        )
    related(
        "text/html",
        "../../documentation/fmi-ls-ref.html",
        "document",
        "What the experiments are and how to compare",
    )
    return xml(root)


def options(experiment):
    return (
        f"StartTime, 0.0\nStopTime, {experiment.stop}\nStepSize, {experiment.step}\n"
        f"RelTol, {TOLERANCE}\n"
        f"OutputIntervalLength, {experiment.interval}\n"
    )


def main():
    parser = command_line(__doc__, out="the source tree", out_required=True)
    arguments = parser.parse_args()

    # All experiments are flown before the first file is written.
    references = {e.name: csv(e.outputs, reference(arguments.fmu, e)) for e in EXPERIMENTS}
    inside = arguments.out / LAYERED_STANDARD
    write(inside / "fmi-ls-manifest.xml", manifest())
    write(inside / "experiments.exp", experiments_file())
    for experiment in EXPERIMENTS:
        if experiment.parameters:
            write(inside / f"{experiment.name}.ssv", parameter_set(experiment))
        write(inside / f"{experiment.name}_in.csv", stimuli(experiment))
        write(inside / f"{experiment.name}_ref.csv", references[experiment.name])
    # The cross-check has no parameters, so only the experiment with defaults can be in its form.
    beside = arguments.out / CROSS_CHECK
    write(beside / "HelicopterRotor_in.csv", stimuli(HOVER))
    write(beside / "HelicopterRotor_ref.csv", references[HOVER.name])
    write(beside / "HelicopterRotor_ref.opt", options(HOVER))


if __name__ == "__main__":
    main()
