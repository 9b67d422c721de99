"""Flies one manoeuvre in FMPy through Model Exchange with CVode, through Co-Simulation, with and without input
derivatives, and goes back to a serialized state; prints what the test compares.

FMPy holds the inputs within each output interval in Model Exchange, too.
"""

import sys

import numpy as np
from fmpy import extract, instantiate_fmu, read_model_description, simulate_fmu

fmu = sys.argv[1]
names = ["thrust", "rotorSpeed", "coning", "azimuth", "collective"]
# Dynamic inflow of Pitt & Peters, flapping blades, driven by a torque.
start = {
    "models.inflow": "12",
    "flapping.enabled": True,
    "drive.mode": "2",
    "drive.inertia": 0.5,
}
# Nine inputs, as FMPy has room for the derivatives of nine.
inputs = {
    "collective": (0.14, 0.2),
    "cyclicLongitudinal": (0.0, 0.02),
    "cyclicLateral": (0.0, 0.02),
    "tilt": (0.06, 0.0),
    "lateralTilt": (0.0, 0.05),
    "velocity[1]": (15.0, 10.0),
    "velocity[2]": (0.0, 1.0),
    "velocity[3]": (0.0, 2.0),
    "driveTorque": (6.0, 12.0),
}
ramp = np.array(
    list(zip((0.0, 0.4), *inputs.values())),
    dtype=[("time", float)] + [(name, float) for name in inputs],
)
manoeuvre = dict(start_values=start, input=ramp, output=names, stop_time=0.4)


def co_simulation(interval, with_derivatives):
    return simulate_fmu(
        fmu,
        fmi_type="CoSimulation",
        output_interval=interval,
        set_input_derivatives=with_derivatives,
        **manoeuvre,
    )


flown = {
    "ModelExchange": simulate_fmu(
        fmu,
        fmi_type="ModelExchange",
        relative_tolerance=1e-8,
        output_interval=0.01,
        **manoeuvre,
    ),
    "held": co_simulation(0.01, False),
    "moving": co_simulation(0.01, True),
    "shortSteps": co_simulation(0.0002, False),
}
for kind, result in flown.items():
    print(kind, *(repr(float(result[name][-1])) for name in names))

description = read_model_description(fmu)
instance = instantiate_fmu(extract(fmu), description, "CoSimulation")
instance.setupExperiment()
instance.enterInitializationMode()
instance.exitInitializationMode()
instance.doStep(0.0, 0.01)
[thrust] = [v.valueReference for v in description.modelVariables if v.name == "thrust"]
state = instance.getFMUState()
stored = instance.serializeFMUstate(state)
instance.freeFMUState(state)
answers = []
for _ in range(2):
    state = instance.deSerializeFMUstate(stored)
    instance.setFMUState(state)
    instance.freeFMUState(state)
    instance.setReal([0], [0.2])
    instance.doStep(0.01, 0.01)
    answers += instance.getReal([thrust])
print("state", *map(repr, answers))
instance.terminate()
instance.freeInstance()
