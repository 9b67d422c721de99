"""Forward flight: the inflow over the disc of a model helicopter (Elliott, Althoff & Sailey 1988,
NASA TM 100541 to 100543).

The rotor is trimmed to the thrust of the tests without hub moments. The shaft angles, the tip speed
and this trim are ASSUMED. What is compared is the inflow less its mean over the points.
"""

import math

import numpy as np
from scipy.optimize import fsolve

import drawing
import errors
import measured
import page
from rotor import RotorError

CASE = "Elliott & Althoff 1988, forward flight"
# Advance ratio: file, and shaft angle in deg, negative forward.
TESTS = {
    0.15: ("elliott-althoff-1988-inflow-mu-015.csv", -3.0),
    0.35: ("elliott-althoff-1988-inflow-mu-035.csv", -5.7),
}
MODELS = [
    "annulus",
    "uniform",
    "finiteBlades",
    "coleman",
    "drees",
    "payne",
    "whiteBlake",
    "pittPeters",
    "howlett",
    "glauertHighSpeed",
    "petersHe",
]
# Effect of the assumptions and of parts of the models: name on the page, inflow, and what differs.
BARE = {"models.tipLoss": "none"}
OTHERS = {
    "annulus with the shaft upright": ("annulus", {"tilt": 0.0}),
    "annulus without cyclic pitch": ("annulus", {"cyclic": False}),
    "annulus with 10 % more thrust": ("annulus", {"thrust": 1.1}),
    "annulus without tip loss": ("annulus", BARE),
    "pittPeters without tip loss": ("pittPeters", BARE),
    "petersHe without tip loss": ("petersHe", BARE),
    "petersHe of order 1 without tip loss": ("petersHe", {**BARE, "numerics.inflowOrder": 1}),
    "petersHe of order 2 without tip loss": ("petersHe", {**BARE, "numerics.inflowOrder": 2}),
    "petersHe of order 6 without tip loss": ("petersHe", {**BARE, "numerics.inflowOrder": 6}),
    "petersHe without tip loss, 2 blades": ("petersHe", {**BARE, "blades": 2}),
    "petersHe without tip loss, 16 blades": ("petersHe", {**BARE, "blades": 16}),
}
DRAWN = ["annulus", "uniform", "pittPeters", "petersHe"]
FIT = "linear fit to the measured points"
TASKS = [*MODELS, *OTHERS]

RADIUS = 0.861
CUTOUT = 0.24
TIP_SPEED = 190.0  # m/s
THRUST_COEFFICIENT = 0.0064
AZIMUTH_STEP = 30  # deg
STATIONS = range(1, 21)
TRIM = ("thrustCoefficient", "hubMoment[1]", "hubMoment[2]")
CONTROLS = ("collective", "cyclicLongitudinal", "cyclicLateral")


def points(mu):
    """Azimuth in deg, r/R and inflow ratio, positive down, of the points over the blades. The file
    has upward inflow positive, and repeats the azimuth 0 as 360."""
    rows = [(r["psi_deg"], r["r_over_R"], -r["inflow_ratio"]) for r in measured.rows(TESTS[mu][0])]
    return np.array([row for row in rows if row[0] < 360.0 and CUTOUT <= row[1] <= 1.0])


def parameters(inflow, mu, changes):
    tilt = changes.get("tilt", math.radians(-TESTS[mu][1]))
    blades = changes.get("blades", 4)
    return {
        "geometry.radius": RADIUS,
        "geometry.numberOfBlades": blades,
        "geometry.chord": 0.066 * 4 / blades,
        "geometry.twist": math.radians(-8.0),
        "geometry.pitchReferenceRadius": 0.75,
        "geometry.rootCutout": CUTOUT,
        "airfoil.file": "airfoils/naca0012.polar",
        "rpm": TIP_SPEED / RADIUS * 30.0 / math.pi,
        "models.inflow": inflow,
        "velocity[1]": mu * TIP_SPEED / math.cos(tilt),
        "tilt": tilt,
        **{name: value for name, value in changes.items() if "." in name},
    }


def fly(rotor, task, _resources):
    inflow, changes = OTHERS.get(task, (task, {}))
    return {str(mu): inflow_over_disc(rotor, inflow, mu, changes) for mu in TESTS}


def inflow_over_disc(rotor, inflow, mu, changes):
    """The inflow ratio along blade 1 at azimuths AZIMUTH_STEP apart: {azimuth: [values]}."""
    chosen = parameters(inflow, mu, changes)
    wanted = THRUST_COEFFICIENT * changes.get("thrust", 1.0)
    controls = trimmed(rotor, chosen, wanted, changes.get("cyclic", True))
    rotor.begin({**chosen, **controls, "models.blades": "individual"})
    step = math.radians(AZIMUTH_STEP) / (TIP_SPEED / RADIUS)
    velocities = [f"station[{i}].inducedVelocity" for i in STATIONS]
    found = {}
    while len(found) < 360 // AZIMUTH_STEP:
        rotor.fly((), step)
        psi = round(math.degrees(rotor["azimuth"])) % 360
        found[psi] = [v / TIP_SPEED for v in rotor.get(velocities)]
    radii = rotor.get([f"station[{i}].radius" for i in STATIONS])
    return {"radii": radii, "inflow": found, "models": rotor.models(chosen)}


def trimmed(rotor, chosen, wanted, cyclic):
    """The controls with the wanted thrust coefficient and, with cyclic pitch, without hub moments."""
    count = 3 if cyclic else 1

    def off(controls):
        rotor.restart({**chosen, "models.blades": "disc", **dict(zip(CONTROLS, controls))})
        thrust, *moments = rotor.get(TRIM)
        return [1e3 * (thrust - wanted), *moments][:count]

    controls, _, ended, why = fsolve(off, [0.15, 0.05, 0.0][:count], full_output=True)
    if ended != 1:
        raise RotorError(f"no trim: {why}")
    return dict(zip(CONTROLS, controls))


def at_points(flight, mu):
    """The computed inflow at the measured points."""
    return [np.interp(r, flight["radii"], flight["inflow"][psi]) for psi, r, _ in points(mu)]


def linear_fit(mu):
    """The inflow at the measured points that the best v0 + r (vc cos psi + vs sin psi) has."""
    psi, r, inflow = points(mu).T
    terms = np.stack([np.ones_like(r), r * np.cos(np.radians(psi)), r * np.sin(np.radians(psi))], 1)
    return terms @ np.linalg.lstsq(terms, inflow, rcond=None)[0]


def report(flown, figures):
    found = page.Report()
    means = {}
    for mu in TESTS:
        inflow = points(mu)[:, 2]
        computed = {task: at_points(flown[task][str(mu)], mu) for task in TASKS}
        computed[FIT] = linear_fit(mu)
        for name, values in computed.items():
            means[name, mu] = np.mean(values) - inflow.mean()
            shapes = values - np.mean(values), inflow - inflow.mean()
            found.errors.append(errors.ratio(CASE, quantity(mu), name, *shapes))
    draw(flown, figures / "forward-inflow.svg")
    found.texts = {
        "forward-inflow.errors": shape_table(found.errors, means, [*MODELS, FIT, *OTHERS]),
        "forward-inflow.models": flown["annulus"]["0.15"]["models"],
    }
    return found


def quantity(mu):
    return f"inflow ratio less its mean, mu {mu}"


def shape_table(rows, means, names):
    by = {(e.model, e.quantity): e for e in rows}
    cells = []
    for name in names:
        own = [by[name, quantity(mu)] for mu in TESTS]
        inflow, *rest = name.split(" ", 1)
        cells.append([name if name == FIT else " ".join([f"`{inflow}`", *rest])])
        cells[-1] += [page.number(e.rms, e.unit) for e in own]
        cells[-1] += [page.number(e.worst, e.unit, True) for e in own]
        cells[-1] += [page.number(means[name, mu], "1", True) for mu in TESTS]
    columns = [f"mu {mu}, {what}" for what in ("RMS", "worst", "mean") for mu in TESTS]
    return page.table(["inflow", *columns], cells)


# The two ends of a diameter: azimuths in deg, and names.
DIAMETERS = {
    "front (-1) to rear (+1), r/R": (180, 0),
    "retreating (-1) to advancing (+1) side, r/R": (270, 90),
}


def draw(flown, file):
    figure, rows = drawing.figure(2, 2, height=6.4, sharex=True, sharey="row")
    for mu, axes in zip(TESTS, rows):
        for axis, ends in zip(axes, DIAMETERS.values()):
            for i, task in enumerate(DRAWN):
                flight = flown[task][str(mu)]
                mean = np.mean(at_points(flight, mu))
                first, last = (np.array(flight["inflow"][psi]) - mean for psi in ends)
                radii = np.array(flight["radii"])
                axis.plot(
                    [*-radii[::-1], np.nan, *radii],
                    [*first[::-1], np.nan, *last],
                    **drawing.line(i),
                    label=task,
                )
            draw_measured(axis, mu, ends)
            axis.set_title(f"advance ratio {mu}", fontsize=9)
            axis.set(xlim=(-1.05, 1.05), xticks=[-1.0, -0.5, 0.0, 0.5, 1.0])
        axes[0].set_ylabel("inflow ratio less its mean, positive down")
    for axis, name in zip(rows[-1], DIAMETERS):
        axis.set_xlabel(name)
    drawing.legend_below(figure, rows[0][0], 5)
    drawing.save(figure, file)


def draw_measured(axis, mu, ends):
    measured_points = points(mu)
    mean = measured_points[:, 2].mean()
    own = [
        (r if psi == ends[1] else -r, inflow - mean)
        for psi, r, inflow in measured_points
        if psi in ends
    ]
    axis.plot(*zip(*own), **drawing.points(0), label="measured")
