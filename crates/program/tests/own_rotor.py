"""Checks the two files of one rotor, that of FMI 2.0 and that of FMI 3.0, with FMPy, and flies both.

    python own_rotor.py FMU FMU_OF_FMI3

Prints the problems that FMPy finds in each file, and for each interface the number of outputs over
time, how many of them change, whether both files give the same to the last bit, and the last thrust.
"""

import sys

import numpy as np
from fmpy import read_model_description, simulate_fmu
from fmpy.validation import validate_fmu

OUTPUTS = ["thrust", "torque", "coning", "longitudinalFlapping", "rotorSpeed", "tipReynolds"]
FORWARD = 12.0  # m/s


def fly(file, fmi_type):
    is_three = read_model_description(file).fmiVersion.startswith("3")
    start = {"velocity": [FORWARD, 0.0, 0.0]} if is_three else {"velocity[1]": FORWARD}
    result = simulate_fmu(
        file,
        fmi_type=fmi_type,
        start_values=start,
        output=OUTPUTS,
        stop_time=0.2,
        output_interval=0.01,
        relative_tolerance=1e-6,
    )
    return np.column_stack([result[name] for name in OUTPUTS])


files = sys.argv[1:]
for file in files:
    problems = validate_fmu(file)
    print("problems", len(problems), problems)
for fmi_type in ("CoSimulation", "ModelExchange"):
    two, three = (fly(file, fmi_type) for file in files)
    moving = (np.ptp(two, axis=0) > 0.0).sum()
    print(fmi_type, two.size, moving, np.array_equal(two, three), two[-1, 0])
