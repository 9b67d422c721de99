"""Checks an importer against the reference experiments that travel in the FMU.

    python check_reference.py --fmu HelicopterRotor.fmu

flies them in FMPy, only with what is in the FMU: parameters, inputs and communication step. With
`--interface ModelExchange` CVode integrates the states of the FMU.

    python check_reference.py --fmu HelicopterRotor.fmu --results FOLDER

compares the results of another importer: FOLDER/<experiment>.csv with a column "time" and one for
each output. In both cases the largest deviation of each output is printed, in % of the largest
magnitude in its reference; a deviation above the tolerance is an error.
"""

import csv
import sys
import xml.etree.ElementTree as ET
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from fmpy import read_model_description, simulate_fmu

from rotor import as_numbers, unpacked
from script import command_line

FOLDER = "extra/org.fmi-standard.fmi-ls-ref"
TOLERANCE = 1.0  # %
SOLVER_TOLERANCE = 1e-6  # relative, of CVode; its errors are far below TOLERANCE
SAME_TIME = 1e-6  # s


@dataclass
class Experiment:
    name: str
    stop: float
    step: float
    parameters: dict
    inputs: dict
    reference: dict


def columns(path):
    """The columns of a CSV file by name."""
    with open(path, newline="") as file:
        names, *rows = csv.reader(file)
    return dict(zip(names, np.array(rows, dtype=float).T))


def parameters(path):
    """Names and values (as text) of a parameter set (SSV)."""
    space = "{http://ssp-standard.org/SSP1/SystemStructureParameterValues}"
    found = ET.parse(path).iter(f"{space}Parameter")
    return {parameter.get("name"): parameter[0].get("value") for parameter in found}


def experiments(content):
    """The experiments that the manifest of the layered standard names."""
    folder = Path(content) / FOLDER
    for related in ET.parse(folder / "fmi-ls-manifest.xml").iter("Related"):
        if related.get("role").split("/")[0] != "experiment":
            continue
        file = folder / related.get("source")
        for element in ET.parse(file).iter("Experiment"):
            source = {child.tag: file.parent / child.get("source") for child in element}
            yield Experiment(
                name=element.get("name"),
                stop=float(element.get("stopTime")),
                step=float(element.get("stepSize")),
                parameters=parameters(source["Parameters"]) if "Parameters" in source else {},
                inputs=columns(source["Stimuli"]),
                reference=columns(source["References"]),
            )


def fly(folder, description, experiment, interface):
    """The columns that FMPy computes, at each communication point."""
    # Inputs that the experiment does not name keep their start values.
    count = len(experiment.inputs["time"])
    others = {
        v.name: np.full(count, float(v.start))
        for v in description.modelVariables
        if v.causality == "input" and v.name not in experiment.inputs
    }
    inputs = experiment.inputs | others
    result = simulate_fmu(
        folder,
        fmi_type=interface,
        relative_tolerance=SOLVER_TOLERANCE if interface == "ModelExchange" else None,
        model_description=description,
        stop_time=experiment.stop,
        # In Model Exchange FMPy holds the inputs within each interval, and CVode may step beyond
        # its end with them: short intervals keep this error small.
        output_interval=experiment.step / (4 if interface == "ModelExchange" else 1),
        start_values=as_numbers(description, experiment.parameters),
        input=np.rec.fromarrays(list(inputs.values()), names=list(inputs)),
        output=[name for name in experiment.reference if name != "time"],
    )
    return {name: np.asarray(result[name], dtype=float) for name in result.dtype.names}


def deviations(result, reference):
    """For each output its largest deviation, in % of its largest magnitude, and the time of it."""
    times = reference["time"]
    if "time" not in result:
        raise ValueError('there is no column "time"')
    rows = np.abs(result["time"][:, None] - times).argmin(axis=0)
    missing = times[np.abs(result["time"][rows] - times) > SAME_TIME]
    if missing.size:
        raise ValueError(f"there is no row at {missing[0]:g} s; record at each communication point")
    for name, expected in reference.items():
        if name == "time":
            continue
        if name not in result:
            raise ValueError(f'there is no column "{name}"')
        deviation = 100.0 * np.abs(result[name][rows] - expected) / np.abs(expected).max()
        worst = int(np.nan_to_num(deviation, nan=np.inf).argmax())
        yield name, deviation[worst], times[worst]


def main():
    parser = command_line(__doc__)
    parser.add_argument(
        "--results", type=Path, help="folder with <experiment>.csv of another importer"
    )
    parser.add_argument(
        "--interface",
        choices=["CoSimulation", "ModelExchange"],
        default="CoSimulation",
        help="through which FMPy flies [default: %(default)s]",
    )
    parser.add_argument(
        "--tolerance",
        type=float,
        default=TOLERANCE,
        help="largest deviation, %% [default: %(default)s]",
    )
    arguments = parser.parse_args()

    failed = []
    with unpacked(arguments.fmu) as folder:
        description = read_model_description(folder)
        print("experiment    output                  deviation, %   at, s")
        for experiment in experiments(folder):
            try:
                if arguments.results:
                    result = columns(arguments.results / f"{experiment.name}.csv")
                else:
                    result = fly(folder, description, experiment, arguments.interface)
                for output, deviation, time in deviations(result, experiment.reference):
                    print(f"{experiment.name:12}  {output:22}  {deviation:12.4f}  {time:6.3f}")
                    if not deviation <= arguments.tolerance:
                        failed.append(
                            f"{experiment.name}: {output} is off by {deviation:.3g} % at {time:g} s"
                        )
            except (OSError, ValueError) as error:
                failed.append(f"{experiment.name}: {error}")
    if failed:
        sys.exit(f"Not within {arguments.tolerance:g} %:\n" + "\n".join(failed))
    print(f"All within {arguments.tolerance:g} %.")


if __name__ == "__main__":
    main()
