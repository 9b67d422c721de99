"""Forward flight: the PCA-2 autogiro in flight (Wheatley 1934, NACA Report 487, figs. 6 to 8).

It is flown in autorotation: at the measured rotor speed, at the shaft angle at which the mean
torque vanishes. Section data and tip loss are those of the report's own analysis, published before
and not fitted; the rotor definition says what is assumed.
"""

import math
from pathlib import Path

import numpy as np
from scipy.optimize import brentq

import drawing
import errors
import measured
import page
import rotors

FLAPPING = "wheatley-1934-tr487-pca2-flapping-digitised.csv"
SPEED = "wheatley-1934-tr487-pca2-CT-rpm-digitised.csv"
CASE = "PCA-2 autogiro 1934, forward flight"
MODELS = [
    "uniform",
    "annulus",
    "finiteBlades",
    "coleman",
    "drees",
    "payne",
    "whiteBlake",
    "pittPeters",
    "howlett",
    "glauertHighSpeed",
    "pittPetersDynamic",
    "petersHe",
]
# Effect of the assumptions: task and its name on the page.
OTHERS = {
    "tip loss": "pittPetersDynamic with Prandtl's tip loss",
    "section": "pittPetersDynamic with Goettingen 429 computed",
    "drag": "pittPetersDynamic with twice the section drag",
}
# Also flown at the advance ratios at which the shaft angle was read.
ANGLED = ["uniform", "pittPetersDynamic", "petersHe", "drag"]
DRAWN = ["uniform", "annulus", "coleman", "pittPetersDynamic", "petersHe"]
NAMES = {"a0": "coning", "a1": "longitudinal flapping", "b1": "lateral flapping"}
READING = 0.05  # deg, reading accuracy of the flapping in the report's figure
ANGLE_READING = 0.3  # deg, reading accuracy of the rotor's angle of attack, a faired curve

RADIUS = 6.858
DENSITY = 1.0823  # kg/m3, mean of the tests
INERTIA = 452.8  # kg m2, of one blade
COLLECTIVE = 0.0497  # rad
STEPS = 30  # of 3 deg each, one blade passage
OUTPUTS = ("torque", "thrustCoefficient", "coning", "longitudinalFlapping", "lateralFlapping")
SETTLING = 15.0  # s
ENOUGH_THRUST = 0.005  # tolerance of the thrust, relative
# N.m, counts as zero: a thousandth of the torque that drives one part of the disc and brakes the
# other.
NO_TORQUE = 5.0


def points(file, quantity):
    """Pairs (mu, value) of a quantity."""
    kind = "coefficient" if file == FLAPPING else "quantity"
    value = "value_deg" if file == FLAPPING else "value"
    return [(r["mu"], r[value]) for r in measured.rows(file) if r[kind] == quantity]


# The advance ratios of a1 and b1 differ from these by at most 0.004.
RATIOS = [mu for mu, _ in points(FLAPPING, "a0")]


ANGLE_RATIOS = [mu for mu, _ in points(SPEED, "alpha_deg")]
# Without an engine, at the advance ratios at which the rotor speed was measured.
SPEEDS = [f"free at {mu}" for mu, _ in points(SPEED, "N_rpm")]
TASKS = [*MODELS, *OTHERS, *SPEEDS]


def at(quantity, mu):
    """A quantity of the file SPEED at an advance ratio, interpolated linearly."""
    return float(np.interp(mu, *zip(*points(SPEED, quantity))))


def parameters(task, resources, folder):
    chosen = {
        "geometry.file": "pca-2.toml",
        "models.inflow": task if task in MODELS else "pittPetersDynamic",
        "models.tipLoss": "prandtl" if task == "tip loss" else "wheatley",
        "numerics.elements": 20,
        "flapping.enabled": True,
        "flapping.inertia": INERTIA,
        "collective": COLLECTIVE,
        **rotors.air(DENSITY, 288.15),
    }
    if task == "section":
        text = (resources / "rotors" / "pca-2.toml").read_text(encoding="utf-8")
        file = folder / "pca-2-goettingen429.toml"
        file.write_text(
            text.replace("wheatley-1934.polar", "goettingen429.polar"), encoding="utf-8"
        )
        chosen["geometry.file"] = str(file)
    if task == "drag":
        chosen["geometry.file"] = str(twice_the_drag(resources, folder))
    return chosen


def twice_the_drag(resources, folder):
    """The rotor with twice the section drag, in place of the drag of fittings and cables."""
    section = (resources / "airfoils" / "wheatley-1934.polar").read_text(encoding="utf-8")
    polar, file = folder / "drag.polar", folder / "pca-2-drag.toml"
    polar.write_text(section.replace(" 0.01200", " 0.02400"), encoding="utf-8")
    rotor = (resources / "rotors" / "pca-2.toml").read_text(encoding="utf-8")
    file.write_text(rotor.replace("airfoils/wheatley-1934.polar", str(polar)), encoding="utf-8")
    return file


def edgewise(mu, rpm):
    """Edgewise flow, m/s."""
    return mu * rpm * math.pi / 30.0 * RADIUS


def fly(rotor, task, resources):
    with rotors.own_folder() as folder:
        chosen = parameters(task, resources, Path(folder))
        if task in SPEEDS:
            return settle(rotor, chosen, *points(SPEED, "N_rpm")[SPEEDS.index(task)])
        return {
            "flights": sweep(rotor, chosen, RATIOS),
            "angles": sweep(rotor, chosen, ANGLE_RATIOS) if task in ANGLED else [],
            "models": rotor.models(chosen),
        }


def sweep(rotor, chosen, ratios):
    """Autorotations, slowest first: the shaft leans back less the faster the rotor flies."""
    guess, found = 0.42, []
    for mu in ratios:
        found.append(autorotate(rotor, chosen, mu, guess))
        guess = math.radians(found[-1]["angle"])
    return found


def mean_flight(rotor, chosen, mu, alpha):
    """Averages over one blade passage at a shaft angle; the air comes from below the disc."""
    rpm = at("N_rpm", mu)
    along = edgewise(mu, rpm)
    rotor.begin(
        {**chosen, "rpm": rpm, "velocity[1]": along, "velocity[3]": -along * math.tan(alpha)}
    )
    step = 60.0 / rpm / 120.0
    return np.mean([rotor.fly(OUTPUTS, step) for _ in range(STEPS)], axis=0)


def autorotate(rotor, chosen, mu, guess):
    """The flight at which the mean torque vanishes. The air drives the rotor more, the further the
    shaft leans back."""
    flights = {}

    def torque(alpha):
        flights[alpha] = mean_flight(rotor, chosen, mu, alpha)
        value = flights[alpha][0]
        return 0.0 if abs(value) < NO_TORQUE else value

    low, high = guess - 0.06, guess + 0.005
    while torque(low) < 0.0:
        low -= 0.06
    while torque(high) > 0.0:
        high += 0.03
    alpha = brentq(torque, low, high, xtol=1e-6)
    if alpha not in flights:
        torque(alpha)
    _, thrust, *flapping = flights[alpha]
    return {
        "angle": math.degrees(alpha),
        "CT": thrust,
        **dict(zip(NAMES, map(math.degrees, flapping))),
    }


def settle(rotor, chosen, mu, rpm):
    """The speed, rev/min, at which the rotor settles without an engine.

    The edgewise flow is the measured one, and the shaft angle gives the measured thrust.
    """
    wanted = at("CT", mu) * DENSITY * math.pi * (RADIUS**2 * rpm * math.pi / 30.0) ** 2
    along = edgewise(mu, rpm)
    free = {
        **chosen,
        "drive.mode": "torque",
        "drive.inertia": 4.0 * INERTIA,
        "rpm": rpm,
        "velocity[1]": along,
    }
    speeds = {}

    def surplus(alpha):
        rotor.begin({**free, "velocity[3]": -along * math.tan(alpha)})
        rotor.fly(("thrust",), SETTLING)
        last = [rotor.fly(("thrust", "rotorSpeed"), 0.02) for _ in range(20)]
        thrust, speeds[alpha] = np.mean(last, axis=0)
        share = thrust / wanted - 1.0
        return 0.0 if abs(share) < ENOUGH_THRUST else share

    guess = 0.40 - 0.5 * mu
    low, high = guess - 0.03, guess + 0.03
    while surplus(low) > 0.0:
        low -= 0.06
    while surplus(high) < 0.0:
        high += 0.06
    alpha = brentq(surplus, low, high, xtol=1e-6)
    return {"rpm": speeds[alpha], "angle": math.degrees(alpha)}


def report(flown, figures):
    found = page.Report()
    named = {**{m: m for m in MODELS}, **OTHERS}
    for task, name in named.items():
        flights = flown[task]["flights"]
        for key, quantity in NAMES.items():
            values = [v for _, v in points(FLAPPING, key)]
            found.errors.append(
                errors.degrees(CASE, quantity, name, [f[key] for f in flights], values, READING)
            )
    for task in ANGLED:
        own = flown[task]
        values = [v for _, v in points(SPEED, "alpha_deg")]
        angles = [f["angle"] for f in own["angles"]]
        name = named[task]
        found.errors.append(
            errors.degrees(CASE, "shaft angle", name, angles, values, ANGLE_READING)
        )
        thrust = [at("CT", mu) for mu in RATIOS]
        found.errors.append(
            errors.percent(CASE, "CT", name, [f["CT"] for f in own["flights"]], thrust)
        )
    speeds = points(SPEED, "N_rpm")
    turning = [flown[task]["rpm"] for task in SPEEDS]
    found.errors.append(
        errors.percent(CASE, "rotor speed", "pittPetersDynamic", turning, [n for _, n in speeds])
    )
    draw_flapping(flown, figures / "pca-2-flapping.svg")
    draw_autorotation(flown, figures / "pca-2-autorotation.svg")
    later = ["shaft angle", "CT", "rotor speed"]
    found.texts = {
        "pca-2.errors": flapping_table(found.errors, named.values()),
        "pca-2.autorotation": page.error_table(
            sorted(
                (e for e in found.errors if e.quantity in later),
                key=lambda e: later.index(e.quantity),
            )
        ),
        "pca-2.models": flown["pittPetersDynamic"]["models"],
    }
    return found


def flapping_table(rows, names):
    """RMS, mean and worst errors of the three angles, a row for each model."""
    by = {(e.model, e.quantity): e for e in rows}
    cells = []
    for name in names:
        own = [by[name, quantity] for quantity in NAMES.values()]
        cells.append(
            [
                f"`{name}`"
                if " " not in name
                else name.replace("pittPetersDynamic", "`pittPetersDynamic`")
            ]
        )
        cells[-1] += [page.number(e.rms, "deg") for e in own]
        cells[-1] += [page.number(e.mean, "deg", True) for e in own]
        cells[-1] += [page.number(e.worst, "deg", True) for e in own]
    columns = ("coning", "longitudinal", "lateral")
    return page.table(
        ["inflow", *(f"{c}, {what}" for what in ("RMS", "mean", "worst") for c in columns)], cells
    )


def draw_flapping(flown, file):
    figure, axes = drawing.figure(1, 3, height=4.2)
    for axis, (key, name) in zip(axes, NAMES.items()):
        for i, task in enumerate(DRAWN):
            values = [f[key] for f in flown[task]["flights"]]
            axis.plot(RATIOS, values, **drawing.line(i), label=task)
        axis.plot(*zip(*points(FLAPPING, key)), **drawing.points(0), label="measured")
        axis.set(
            xlabel=r"advance ratio $\mu$",
            ylabel=f"{name} {key[0]}$_{key[1]}$, deg",
            xlim=(0, 0.72),
            ylim=(0, None),
        )
    drawing.legend_below(figure, axes[0], 6)
    drawing.save(figure, file)


def draw_autorotation(flown, file):
    figure, axes = drawing.figure(1, 3, height=4.2)
    for i, task in enumerate(ANGLED):
        flights = flown[task]["flights"]
        axes[0].plot(
            RATIOS, [f["angle"] for f in flights], **drawing.line(i), label=OTHERS.get(task, task)
        )
        axes[1].plot(RATIOS, [f["CT"] for f in flights], **drawing.line(i))
    ratios = [mu for mu, _ in points(SPEED, "N_rpm")]
    axes[2].plot(ratios, [flown[task]["rpm"] for task in SPEEDS], **drawing.line(1))
    axes[0].plot(*zip(*points(SPEED, "alpha_deg")), **drawing.points(0), label="measured")
    axes[1].plot(*zip(*points(SPEED, "CT")), **drawing.points(0))
    axes[2].plot(*zip(*points(SPEED, "N_rpm")), **drawing.points(0))
    axes[0].set(ylabel="shaft angle of attack, deg")
    axes[0].axhline(0.0, color="0.5", linewidth=0.8)
    axes[1].set(ylabel="thrust coefficient CT", ylim=(0, None))
    axes[2].set(ylabel="rotor speed without an engine, rev/min", ylim=(0, 170))
    drawing.coefficient_axis(axes[1])
    for axis in axes:
        axis.set(xlabel=r"advance ratio $\mu$", xlim=(0, 0.72))
    drawing.legend_below(figure, axes[0], 3)
    drawing.save(figure, file)
