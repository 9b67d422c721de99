"""Flies an experiment to convergence.

In Co-Simulation the FMU holds its inputs during a step, so an importer's results have an error of
the first order in the communication step. Here each step is cut into many parts. Each part holds
the inputs of its middle, which makes the error one of the second order. Outputs belong to the
inputs that were held last, so the last part before they are read holds the inputs of its end.
"""

import numpy as np

from rotor import Rotor, as_numbers


def inputs_at(experiment, time):
    return {name: np.interp(time, *zip(*corners)) for name, corners in experiment.inputs.items()}


def outputs(rotor, experiment):
    """The recorded outputs as numbers."""
    values = dict(zip(experiment.outputs, rotor.get(experiment.outputs)))
    return as_numbers(rotor.description, values).values()


def converged(fmu, experiment, parts):
    """Rows (time, outputs ...) at the experiment's interval, each step cut into `parts`.

    numerics.azimuthStep shrinks with the parts: 0.5 deg at 10 parts, a sixth of the default.
    """
    azimuth_step = np.radians(5.0 / parts)
    with Rotor(fmu, experiment.parameters | {"numerics.azimuthStep": azimuth_step}) as rotor:
        rotor.set(inputs_at(experiment, 0.0))
        rotor.start()
        rows = [[0.0, *outputs(rotor, experiment)]]
        every = round(experiment.interval / experiment.step) * parts
        part = experiment.step / parts
        for i in range(round(experiment.stop / part)):
            is_recorded = (i + 1) % every == 0
            held = i + 1.0 if is_recorded else i + 0.5
            rotor.set(inputs_at(experiment, held * part))
            rotor.step(part)
            if is_recorded:
                rows.append([(i + 1) * part, *outputs(rotor, experiment)])
    return np.array(rows)
