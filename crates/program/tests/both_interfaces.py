"""Flies one manoeuvre in FMPy through Model Exchange with CVode and through Co-Simulation, with and
without input derivatives, goes back to a saved state, and prints what the test compares. It also
holds the Rotor of the examples to its answers to slips.

In Model Exchange FMPy holds the inputs within each output interval.
"""

import sys
from pathlib import Path

import numpy as np
from fmpy import read_model_description, simulate_fmu

sys.path.insert(0, str(Path(__file__).resolve().parents[3] / "fmu-examples"))

from rotor import Rotor, RotorError, as_numbers

fmu = sys.argv[1]
names = ["thrust", "rotorSpeed", "coning", "azimuth", "collective"]
parameters = {
    "models.inflow": "pittPetersDynamic",
    "flapping.enabled": True,
    "drive.mode": "torque",
    "drive.inertia": 0.5,
}
# Nine inputs: FMPy takes the derivatives of no more.
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
manoeuvre = dict(
    start_values=as_numbers(read_model_description(fmu), parameters),
    input=ramp,
    output=names,
    stop_time=0.4,
)


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

with Rotor(fmu) as rotor:
    rotor.step(0.01)
    saved = rotor.save()
    answers = []
    for _ in range(2):
        rotor.restore(saved)
        rotor.set({"collective": 0.2})
        rotor.step(0.01)
        answers.append(rotor["thrust"])
    print("state", *map(repr, answers))


# What the Rotor answers to a slip.
def refused(action):
    try:
        action()
    except RotorError as error:
        return str(error)
    raise AssertionError("an error was expected")


def expect(words, *parts):
    assert all(part in words for part in parts), words


expect(refused(lambda: Rotor("missing.fmu")), "missing.fmu does not exist")
expect(refused(lambda: Rotor(fmu, {"models.inflow": "glauert"})), "models.inflow", "uniform")
expect(refused(lambda: Rotor(fmu, {"geometry.radius": -1.0})), "geometry.radius")
with Rotor(fmu, interface="ModelExchange") as rotor:
    expect(refused(lambda: rotor.step(0.1)), "CoSimulation")
    expect(refused(lambda: rotor.set_states({"azimut": 0.0})), "azimut")
with Rotor(fmu, {"models.inflow": "uniform"}) as rotor:
    expect(refused(lambda: rotor["thurst"]), "no variable thurst", "thrust")
    assert rotor["models.inflow"] == "uniform" and rotor["flapping.enabled"] is False
    rotor.step(0.1, rates={"collective": 0.5})
    expect(refused(lambda: rotor.set({"geometry.radius": 1.0})), "geometry.radius")
    # Refused parameters leave the rotor as it is.
    before = rotor["collective"]
    rotor.step(0.1)
    assert rotor["collective"] == before > 0.05
