"""The reference experiments: parameters, inputs and recorded outputs.

Values are in the units of the FMU; `deg` converts angles from degrees. Inputs are continuous and
piecewise linear: (time, value) at their corners, constant before the first and after the last.
Inputs that are not named keep their start values.
"""

from dataclasses import dataclass, field
from math import radians as deg


@dataclass(frozen=True)
class Experiment:
    name: str
    description: str
    stop: float  # s
    # Communication step, s. The times of all corners are multiples of it, so that no corner lies
    # within a step.
    step: float
    interval: float  # s between recorded rows, a multiple of the step
    inputs: dict
    outputs: tuple
    parameters: dict = field(default_factory=dict)


HOVER = Experiment(
    name="hover",
    description="Hover: the collective is raised from 4 to 10 deg and lowered to 8 deg; "
    "all parameters at their defaults",
    stop=1.0,
    step=0.004,
    interval=0.04,
    inputs={"collective": [(0.1, deg(4.0)), (0.7, deg(10.0)), (0.76, deg(10.0)), (1.0, deg(8.0))]},
    outputs=(
        "thrust",
        "torque",
        "power",
        "thrustCoefficient",
        "figureOfMerit",
        "inducedVelocity",
    ),
)

FORWARD = Experiment(
    name="forward",
    description="Entry into forward flight: four flapping blades in a dynamic wake, "
    "speed, shaft tilt and cyclic pitch vary",
    stop=1.0,
    step=0.004,
    interval=0.04,
    parameters={
        "models.inflow": "pittPetersDynamic",
        "flapping.enabled": True,
        "flapping.hingeOffset": 0.04,
        "flapping.inertia": 0.03,
    },
    inputs={
        "cyclicLongitudinal": [(0.1, 0.0), (0.7, deg(2.0)), (1.0, deg(1.5))],
        "cyclicLateral": [(0.2, 0.0), (0.8, deg(-1.0))],
        "tilt": [(0.1, 0.0), (0.9, deg(5.0))],
        "velocity[1]": [(0.1, 0.0), (0.9, 15.0)],
    },
    outputs=(
        "thrust",
        "torque",
        "hubForce[1]",
        "hubMoment[1]",
        "hubMoment[2]",
        "inducedVelocity",
        "advanceRatio",
        "coning",
        "longitudinalFlapping",
        "lateralFlapping",
    ),
)

DESCENT = Experiment(
    name="descent",
    description="From climb into vertical descent through the vortex ring into the turbulent wake; "
    "the rotor of NACA TN 2474",
    stop=2.8,
    step=0.008,
    interval=0.08,
    parameters={
        "geometry.file": "rotors/castles-gray-6ft.toml",
        "models.inflow": "uniform",
        "models.descent": "measured",
    },
    inputs={
        "collective": [(0.4, deg(5.0)), (2.4, deg(4.0))],
        "rpm": [(0.0, 1200.0)],
        "velocity[3]": [(0.08, 2.0), (2.72, -9.0)],
    },
    outputs=(
        "thrust",
        "torque",
        "power",
        "inducedVelocity",
        "flowState",
    ),
)

AUTOROTATION = Experiment(
    name="autorotation",
    description="Engine failure in hover and vertical autorotation: "
    "a torque turns the rotor, and goes to zero",
    stop=4.0,
    step=0.0125,
    interval=0.1,
    parameters={
        "models.inflow": "pittPetersDynamic",
        "drive.mode": "torque",
        "drive.inertia": 0.25,
    },
    inputs={
        "collective": [(0.4, deg(8.0)), (2.6, deg(3.0))],
        "velocity[3]": [(0.2, 0.0), (3.6, -9.0)],
        # Begins near the torque that the rotor absorbs in hover.
        "driveTorque": [(0.1, 4.23), (0.5, 0.0)],
    },
    outputs=(
        "thrust",
        "torque",
        "power",
        "inducedVelocity",
        "rotorSpeed",
        "tipMach",
    ),
)

EXPERIMENTS = (HOVER, FORWARD, DESCENT, AUTOROTATION)
