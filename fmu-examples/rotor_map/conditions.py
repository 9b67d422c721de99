"""The conditions of the map, and how a process computes a block of them."""

import functools
import itertools
import math

import numpy as np

from rotor import Rotor

# The FMU's default rotor, averaged over the disc.
PARAMETERS = {"models.blades": "disc", "numerics.elements": 12}
AXES = {
    "rpm": np.linspace(600.0, 1140.0, 10),  # rev/min
    "climb": np.linspace(-2.0, 7.5, 20),  # m/s
    "speed": np.linspace(0.0, 24.0, 25),  # m/s, edgewise
    "collective": np.linspace(0.0, 14.25, 20),  # deg
}
LOADS = {
    "thrust": ("thrust", "N"),
    "torque": ("torque", "N m"),
    "hForce": ("hubForce[1]", "N"),
    "rollMoment": ("hubMoment[1]", "N m"),
    "pitchMoment": ("hubMoment[2]", "N m"),
}
BLOCK = tuple(len(AXES[name]) for name in ("speed", "collective"))
BLOCKS = list(itertools.product(range(len(AXES["rpm"])), range(len(AXES["climb"]))))
CONDITIONS = len(BLOCKS) * math.prod(BLOCK)


@functools.cache
def rotor_of_this_process(fmu):
    return Rotor(fmu)


def compute(fmu, block):
    """The block, one rotor speed and climb, and its loads: an array by load, speed and collective.
    The rotor begins anew, so that a block does not depend on what its process did before."""
    rotor = rotor_of_this_process(fmu)
    rotor.restart(PARAMETERS)
    rotor.set({"rpm": AXES["rpm"][block[0]], "velocity[3]": AXES["climb"][block[1]]})
    names = [name for name, _ in LOADS.values()]
    loads = np.empty((len(LOADS), *BLOCK))
    for i, speed in enumerate(AXES["speed"]):
        rotor.set({"velocity[1]": speed})
        for k, collective in enumerate(AXES["collective"]):
            rotor.set({"collective": math.radians(collective)})
            loads[:, i, k] = rotor.get(names)
    return block, loads
