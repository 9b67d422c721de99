"""Flies the rotor in FMPy with the files of FMI 2.0 and of FMI 3.0, in Co-Simulation and, with CVode,
in Model Exchange, and prints what the test compares: for each flight the number of outputs, and
whether all of them are equal to the last bit. It also checks both files with FMPy, and their XML
files with the schemas that come with FMPy.

In FMI 3.0 arrays have the places of several variables of FMI 2.0.
"""

import sys
import zipfile
from pathlib import Path

import fmpy
import numpy as np
from fmpy import read_model_description, simulate_fmu
from fmpy.validation import validate_fmu
from lxml import etree

two, three = sys.argv[1:]
START = {
    "models.inflow": "12",
    "flapping.enabled": True,
    "drive.mode": "2",
    "drive.inertia": 0.5,
    "collective": 0.15,
    "driveTorque": 6.0,
    "tilt": 0.05,
}
SPEED = [12.0, 1.0, 0.5]
SCALARS = ["thrust", "torque", "rotorSpeed", "coning", "azimuth", "inducedVelocity", "tipMach"]
ARRAYS = {"force": 3, "hubMoment": 3}

for file in (two, three):
    problems = validate_fmu(file)
    print("problems", len(problems), problems)

schemas = Path(fmpy.__file__).parent / "schema"
for file, name, schema in [
    (two, "modelDescription.xml", "fmi2/fmi2ModelDescription.xsd"),
    (three, "modelDescription.xml", "fmi3/fmi3ModelDescription.xsd"),
    (two, "terminalsAndIcons/terminalsAndIcons.xml", "fmi3/fmi3TerminalsAndIcons.xsd"),
    (three, "terminalsAndIcons/terminalsAndIcons.xml", "fmi3/fmi3TerminalsAndIcons.xsd"),
]:
    with zipfile.ZipFile(file) as archive, archive.open(name) as text:
        etree.XMLSchema(etree.parse(schemas / schema)).assertValid(etree.parse(text))
print("schemas", 4)


def values(file, fmi_type, **options):
    """The outputs over time, one row for each number."""
    is_three = file == three
    elements = {f"velocity[{i + 1}]": speed for i, speed in enumerate(SPEED)}
    names = SCALARS + (list(ARRAYS) if is_three else [])
    if not is_three:
        names += [f"{name}[{i + 1}]" for name, count in ARRAYS.items() for i in range(count)]
    start = START | ({"velocity": SPEED} if is_three else elements)
    result = simulate_fmu(file, fmi_type=fmi_type, start_values=start, output=names, **options)
    rows = [np.asarray(result[name]) for name in names]
    return np.column_stack([row.reshape(len(result), -1) for row in rows])


for fmi_type, options in [
    ("CoSimulation", dict(stop_time=2.0, output_interval=0.01)),
    ("ModelExchange", dict(stop_time=0.5, relative_tolerance=1e-6, output_interval=0.01)),
]:
    flights = [values(file, fmi_type, **options) for file in (two, three)]
    moved = np.ptp(flights[0], axis=0)
    print(fmi_type, flights[0].size, (moved > 0.0).sum(), np.array_equal(*flights))

# Steps in FMI 3.0 with events and early return give the same, where no event happens.
flights = [
    values(two, "CoSimulation", stop_time=0.5, output_interval=0.01),
    values(
        three,
        "CoSimulation",
        stop_time=0.5,
        output_interval=0.01,
        use_event_mode=True,
        early_return_allowed=True,
    ),
]
print("events", flights[0].size, (np.ptp(flights[0], axis=0) > 0.0).sum(), np.array_equal(*flights))

description = read_model_description(three)
print("variables", len(description.modelVariables), len(read_model_description(two).modelVariables))
