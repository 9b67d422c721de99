"""Errors of a model against a measurement."""

from dataclasses import dataclass

import numpy as np


@dataclass(frozen=True)
class Errors:
    """Errors of one quantity with one model over the points of a case.

    `unit` is "%" (of each measured value), "% of ...", "deg", or "1" for ratios. `scatter` is that of the
    measurement in the same unit, None where it is not known.
    """

    case: str
    quantity: str
    model: str
    unit: str
    points: int
    mean: float
    mean_absolute: float
    rms: float
    worst: float
    scatter: float | None = None


def percent(case, quantity, model, computed, measured, scatter=None):
    """Errors in % of the measured values, which must not be 0."""
    differences = 100.0 * (np.asarray(computed) / np.asarray(measured) - 1.0)
    return _of(case, quantity, model, "%", differences, scatter)


def percent_of(reference, case, quantity, model, computed, measured, of, scatter=None):
    """Errors in % of a reference value, for quantities that pass through 0; `of` names it."""
    differences = 100.0 * (np.asarray(computed) - np.asarray(measured)) / np.asarray(reference)
    return _of(case, quantity, model, f"% of {of}", differences, scatter)


def degrees(case, quantity, model, computed, measured, scatter=None):
    """Errors of angles in deg."""
    return _of(case, quantity, model, "deg", np.asarray(computed) - np.asarray(measured), scatter)


def ratio(case, quantity, model, computed, measured, scatter=None):
    """Errors of ratios without a unit, not in per cent."""
    return _of(case, quantity, model, "1", np.asarray(computed) - np.asarray(measured), scatter)


def _of(case, quantity, model, unit, differences, scatter):
    if differences.size == 0 or not np.all(np.isfinite(differences)):
        raise ValueError(f"{case}, {quantity}, {model}: there are no errors, or one is not finite")
    return Errors(
        case,
        quantity,
        model,
        unit,
        int(differences.size),
        float(differences.mean()),
        float(np.abs(differences).mean()),
        rms(differences),
        float(differences[np.argmax(np.abs(differences))]),
        scatter,
    )


def rms(values):
    return float(np.sqrt(np.mean(np.square(values))))


def spread(runs):
    """Deviations of a single measurement from the mean of many, from the differences between runs:
    their RMS is that of the differences over the square root of 2. `runs` are lists of (x, value);
    the other runs are interpolated linearly at each x."""
    differences = []
    for run in runs:
        for other in runs:
            if other is run:
                continue
            x, values = np.array(sorted(other)).T
            differences += [v - np.interp(at, x, values) for at, v in run if x[0] <= at <= x[-1]]
    return np.array(differences) / np.sqrt(2.0)
