"""Fits the law of mass flow in descent to Castles & Gray (1951, NACA TN 2474, Table I) and judges it
on their twisted rotor (Table III), to which no number of it is fitted.

The law is g(k) = (v_h/v)^2 at k = V_c/v. For a stretch s = 1 it is a piecewise cubic (Hermite,
slopes by Fritsch & Carlson) through knots at fixed k. Below the first knot and above 0 it is
|1 + k|, as in momentum theory. The stretch moves the rate of descent V_d/v_h = -k/sqrt(g) by the
factor w(k) = 1 + (s - 1) b(k), that is g by 1/w^2; b is 0 before the peak of the induced velocity, 1
at BUMP[1] and 0 again far beyond. s = 0.75 over the mean radius of the thrust, which `stretch`
estimates from the rate of descent.

The values at the knots are fitted to Table I: least soft-L1 error of v/v_h, each run divided by its
own hover value, because the rotor model already has what makes this value larger than 1 (tip loss,
non-uniform inflow).

    python fit.py            prints the table for crates/rotor/src/inflow/descent/measured.rs, the
                             errors of this law and of published laws on both rotors, and how a law
                             fitted to half of the runs does on the other half; draws
                             descent-law.png
"""

import csv
import math
import sys
from dataclasses import dataclass
from pathlib import Path

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np
from scipy.interpolate import CubicHermiteSpline, PchipInterpolator
from scipy.optimize import least_squares

HERE = Path(__file__).resolve().parent
DATA = HERE / "../../fmu-examples/data"
UNTWISTED = "castles-gray-1951-tn2474-tableI-descent-6ft.csv"
TWISTED = "castles-gray-1951-tn2474-tableIII-descent-6ft-twist12-runs-65-67.csv"
TWIST = {UNTWISTED: 0.0, TWISTED: math.radians(-12.0)}  # from the axis to the tip
# The blades of both rotors: three of this chord (m), from the cutout (r/R) to the radius (m).
CHORD, CUTOUT, RADIUS = 0.048006, 6.09 / 36.0, 0.9144

KNOTS = np.array([-12.0, -2.6, -1.8, -1.3, -0.95, -0.72, -0.64, -0.56, -0.48, -0.3, 0.0])
START = np.array([1.1, 0.67, 0.45, 0.30, 0.19, 0.162, 0.235, 0.34, 0.52])
# Where -k enters the bump b, where b is 1, and where it ends.
BUMP = (0.56, 0.64, 4.0)
# V_d/v_h at which the induced velocity drops, for s = 1.
DROP = 1.75
LIFT_SLOPE = 6.0  # per rad
RADII = (0.6, 0.85)  # limits of the mean radius of the thrust over R
PASSES = 6
FADING = 0.02  # V_d/(Omega R) below which s fades to 1
# Where V_d/v_h is tabulated, and its least slope over -k.
K = np.concatenate([np.linspace(1e-3, 1.0, 2000), np.geomspace(1.0005, 14.0, 2000)])
LEAST_SLOPE = 0.1


@dataclass
class Run:
    """A measured run: V_d/v_h, v/v_h divided by its value in hover, s, and v_h/(Omega R)."""

    descent: np.ndarray
    induced: np.ndarray
    stretch: np.ndarray
    hover: float


def stretch(descent, twist):
    """s at a rate of descent over the tip speed.

    The thrust is taken to be that at which the induced velocity drops at this rate of descent: v_h =
    V_d/(DROP s) = nu Omega R, CT = 2 nu^2, at a net inflow of nu/2. Linear lift gives the mean
    radius of the thrust, r0 + (LIFT_SLOPE/4)(n/nu + m/nu^2), with m and n from chord and twist."""
    if descent == 0.0:
        return 1.0
    count = 400
    x = CUTOUT + (1.0 - CUTOUT) * (np.arange(count) + 0.5) / count
    area = 3.0 * CHORD / (math.pi * RADIUS) * (1.0 - CUTOUT) / count
    c1, c2, c3 = (area * np.sum(x**power) for power in (1, 2, 3))
    r0 = c3 / c2
    n = 0.5 * (c1 * r0 - c2)
    m = area * np.sum(twist * x * x * x * (x - r0))
    s = 1.0
    for _ in range(PASSES):
        y = DROP * s / descent
        s = 0.75 / np.clip(r0 + 0.25 * LIFT_SLOPE * (n * y + m * y * y), *RADII)
    fading = min(1.0, descent / FADING)
    return float(1.0 + (s - 1.0) * fading * fading * (3.0 - 2.0 * fading))


def measured(file=UNTWISTED):
    """The runs of a file by number."""
    lines = [l for l in (DATA / file).read_text().splitlines() if not l.startswith("#")]
    rows = {}
    for row in csv.DictReader(lines):
        if row["lambda_i_thrust"]:
            rows.setdefault(int(row["run"]), []).append(row)
    runs = {}
    for number, own in rows.items():
        # Not V_over_OmegaR: that column is a row off in run 34.
        descent, induced = (
            np.array([float(r[name]) for r in own]) for name in ("lambda_z", "lambda_i_thrust")
        )
        hover = math.sqrt(0.5 * float(own[0]["CT"]))
        stretches = [stretch(d * hover, TWIST[file]) for d in descent]
        induced = induced / induced[descent == 0.0].mean()
        runs[number] = Run(descent, induced, np.array(stretches), hover)
    return runs


def law(values):
    """g(k) as a piecewise cubic, for s = 1."""
    g = np.concatenate([[-1.0 - KNOTS[0]], values, [1.0]])
    slopes = PchipInterpolator(KNOTS, g).derivative()(KNOTS)
    slopes[0], slopes[-1] = -1.0, 1.0
    return CubicHermiteSpline(KNOTS, g, slopes)


def bump(k):
    """b at -k = `k` > 0."""
    smooth = lambda t: t * t * (3.0 - 2.0 * t)
    begin, top, end = BUMP
    rising = smooth(np.clip((k - begin) / (top - begin), 0.0, 1.0))
    falling = smooth(np.clip(np.log(k / top) / math.log(end / top), 0.0, 1.0))
    return np.where(k < top, rising, 1.0 - falling)


def rates(g):
    """V_d/v_h at K for s = 1."""
    gain = np.where(K < -KNOTS[0], g(np.maximum(-K, KNOTS[0])), K - 1.0)
    return K / np.sqrt(gain)


def stretched(rates_at_k, s):
    return rates_at_k * (1.0 + (s - 1.0) * bump(K))


def induced(rates_at_k, descent, s):
    """v/v_h at V_d/v_h."""
    if descent == 0.0:
        return 1.0
    return descent / np.interp(descent, stretched(rates_at_k, s), K)


def least_slope(rates_at_k):
    """The least slope of V_d/v_h over -k at the limits of s: the inflow is unique where it is > 0.
    It is linear in s, so that the limits are enough."""
    limits = [0.75 / r for r in RADII]
    return min(float(np.min(np.diff(stretched(rates_at_k, s)) / np.diff(K))) for s in limits)


def errors(g, runs):
    """Errors of v/v_h, one array for each run."""
    z = rates(g)
    return [
        np.array([induced(z, d, s) for d, s in zip(run.descent, run.stretch)]) - run.induced
        for run in runs
    ]


def collective(found, runs):
    """Errors of v/v_h as the equivalent ones in deg of collective: 3/2 of the change in inflow
    ratio, from CT = sigma a/2 (theta_0.75/3 - lambda/2), which holds with linear twist, too."""
    return [1.5 * math.degrees(run.hover) * e for e, run in zip(found, runs)]


def fit(runs):
    def residual(values):
        g = law(values)
        lacking = max(0.0, LEAST_SLOPE - least_slope(rates(g)))
        return np.concatenate([*errors(g, runs), [10.0 * lacking]])

    bounds = (0.05 * np.ones(len(START)), 2.0 * np.ones(len(START)))
    return least_squares(
        residual, START, loss="soft_l1", f_scale=0.1, bounds=bounds, diff_step=1e-4
    ).x


def momentum(descent):
    if descent >= 2.0:
        return descent / 2.0 - np.sqrt(descent**2 / 4.0 - 1.0)
    return descent / 2.0 + np.sqrt(descent**2 / 4.0 + 1.0)


def leishman(descent):
    """Leishman 2006, section 2.13: a quartic through measurements, to V_d/v_h = 2."""
    if descent > 2.0:
        return momentum(descent)
    x = -descent
    return 1.0 - 1.125 * x - 1.372 * x**2 - 1.718 * x**3 - 0.655 * x**4


def rms(values):
    return float(np.sqrt(np.mean(np.square(np.concatenate(values)))))


def main():
    tables = {
        "untwisted": list(measured(UNTWISTED).values()),
        "twisted": list(measured(TWISTED).values()),
    }
    g = law(fit(tables["untwisted"]))
    print("k, g, dg/dk:")
    for k, value, slope in zip(KNOTS, g(KNOTS), g.derivative()(KNOTS)):
        print(f"    ({k}, {value:.4f}, {slope:.4f}),")
    print("V_d/v_h there:", ", ".join(f"{-k / math.sqrt(g(k)):.2f}" for k in KNOTS))
    least = least_slope(rates(g))
    print(f"least slope of V_d/v_h over -k: {least:.3f}")
    if least <= 0.0:
        sys.exit("V_d/v_h does not grow with -k: the inflow would not be unique.")

    def of(predict):
        return lambda runs: [np.array([predict(d) for d in r.descent]) - r.induced for r in runs]

    def without_stretch(runs):
        return errors(g, [Run(r.descent, r.induced, 0.0 * r.stretch + 1.0, r.hover) for r in runs])

    print("\nRMS error of v/v_h (hover value divided out), and the same in deg of collective")
    for rotor, runs in tables.items():
        for name, predict in [
            ("this law", lambda runs: errors(g, runs)),
            ("the same with s = 1", without_stretch),
            ("Leishman 2006", of(leishman)),
            ("momentum theory", of(momentum)),
        ]:
            found = predict(runs)
            print(f"    {rotor:10} {name:20} {rms(found):.3f} {rms(collective(found, runs)):.2f}")
    for number, run in measured(TWISTED).items():
        found = errors(g, [run])
        print(f"    run {number}: {rms(found):.3f} {rms(collective(found, [run])):.2f}")
    runs = measured(UNTWISTED)
    names = sorted(runs)
    for own in (names[0::2], names[1::2]):
        half = law(fit([runs[n] for n in own]))
        others = [runs[n] for n in names if n not in own]
        seen, unseen, twisted = (
            rms(errors(half, part)) for part in ([runs[n] for n in own], others, tables["twisted"])
        )
        print(
            f"    fitted to runs {own}: {seen:.3f} there, {unseen:.3f} on the others, "
            f"{twisted:.3f} on the twisted rotor, least slope {least_slope(rates(half)):.3f}"
        )
    best_stretches(g)
    draw(g)


def best_stretches(g):
    """The constant s with which the law fits each run best, and that of the run's own thrust."""
    print("\ns that fits a run best, and 0.75 over the mean radius of the run's thrust")
    candidates = np.linspace(0.8, 1.5, 141)
    for file in (UNTWISTED, TWISTED):
        for number, run in measured(file).items():
            constant = lambda s: Run(run.descent, run.induced, 0.0 * run.descent + s, run.hover)
            best = min(candidates, key=lambda s: rms(errors(g, [constant(s)])))
            own = 1.0
            for _ in range(60):
                own = stretch(DROP * own * run.hover, TWIST[file])
            print(f"    run {number}: {best:.2f}, {own:.2f}")


def draw(g):
    figure, panels = plt.subplots(
        1, 2, figsize=(9.6, 4.6), sharex=True, sharey=True, constrained_layout=True
    )
    z = rates(g)
    d = np.linspace(0.0, 3.2, 321)
    for axis, file, title in zip(panels, (UNTWISTED, TWISTED), ("untwisted", "12 deg of washout")):
        for markers, (number, run) in zip("os^vDP*X<>h", measured(file).items()):
            axis.plot(
                run.descent, run.induced, markers, ms=4, mfc="none", color="0.45",
                label=f"run {number}",
            )
        for style, ct in (("k-", 0.005), ("k-.", 0.002)):
            speed = math.sqrt(0.5 * ct)
            own = [induced(z, x, stretch(x * speed, TWIST[file])) for x in d]
            axis.plot(d, own, style, lw=1.8, label=f"this law, CT = {ct}")
        axis.plot(d, [leishman(x) for x in d], "k--", lw=0.8, label="Leishman 2006")
        axis.plot(d, [momentum(x) for x in d], "k:", lw=1.2, label="momentum theory")
        axis.set(xlabel="rate of descent $V_d/v_h$", title=title)
        axis.set(xlim=(0.0, 3.2), ylim=(0.0, 4.4))
        axis.legend(ncols=2, fontsize=7, loc="upper right")
        axis.grid(alpha=0.3)
    panels[0].set_ylabel("induced velocity $v/v_h$ over its value in hover")
    figure.savefig(HERE / "descent-law.png", dpi=130, metadata={"Software": None})


if __name__ == "__main__":
    main()
