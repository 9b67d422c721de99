"""Fits the law of mass flow in descent to Castles & Gray (1951, NACA TN 2474, Table I).

The law is g(k) = (v_h/v)^2 at k = V_c/v: a piecewise cubic (Hermite, slopes by Fritsch & Carlson)
through knots at fixed k. Below the first knot and above 0 it is |1 + k|, as in momentum theory. The
values at the knots are fitted: least soft-L1 error of v/v_h, each run divided by its own hover
value, because the rotor model already has what makes this value larger than 1 (tip loss,
non-uniform inflow).

    python fit.py            prints the table for crates/rotor/src/inflow/descent/measured.rs, the
                             errors of this law and of published laws, and how a law fitted to half
                             of the runs does on the other half; draws descent-law.png
"""

import csv
import sys
from pathlib import Path

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np
from scipy.interpolate import CubicHermiteSpline, PchipInterpolator
from scipy.optimize import brentq, least_squares

HERE = Path(__file__).resolve().parent
DATA = HERE / "../../fmu-examples/data/castles-gray-1951-tn2474-tableI-descent-6ft.csv"
KNOTS = np.array([-12.0, -2.4, -1.6, -1.2, -0.95, -0.76, -0.62, -0.48, -0.3, 0.0])
START = np.array([1.0, 0.62, 0.44, 0.34, 0.23, 0.18, 0.30, 0.55])


def measured():
    """Runs by number: arrays of V_d/v_h, and of v/v_h divided by its value in hover."""
    lines = [l for l in DATA.read_text().splitlines() if not l.startswith("#")]
    runs = {}
    for row in csv.DictReader(lines):
        if row["lambda_i_thrust"]:
            pair = (float(row["lambda_z"]), float(row["lambda_i_thrust"]))
            runs.setdefault(int(row["run"]), []).append(pair)
    result = {}
    for run, pairs in runs.items():
        descent, induced = np.array(pairs).T
        result[run] = (descent, induced / induced[descent == 0.0].mean())
    return result


def law(values):
    """g(k) as a piecewise cubic."""
    g = np.concatenate([[-1.0 - KNOTS[0]], values, [1.0]])
    slopes = PchipInterpolator(KNOTS, g).derivative()(KNOTS)
    slopes[0], slopes[-1] = -1.0, 1.0
    return CubicHermiteSpline(KNOTS, g, slopes)


def induced(g, descent):
    """v/v_h at V_d/v_h: the root of v^2 g(-V_d/v) = 1."""
    if descent == 0.0:
        return 1.0

    def surplus(v):
        k = -descent / v
        gain = g(k) if k > KNOTS[0] else -1.0 - k
        return v * v * gain - 1.0

    return brentq(surplus, 1e-3, 10.0)


def errors(predict, runs):
    return np.concatenate([[predict(d) - v for d, v in zip(*run)] for run in runs])


def fit(runs):
    def residual(values):
        g = law(values)
        return errors(lambda d: induced(g, d), runs)

    bounds = (0.05 * np.ones(len(START)), 1.5 * np.ones(len(START)))
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
    return float(np.sqrt(np.mean(np.square(values))))


def main():
    runs = measured()
    values = fit(list(runs.values()))
    g = law(values)
    print("k, g, dg/dk:")
    for k, value, slope in zip(KNOTS, g(KNOTS), g.derivative()(KNOTS)):
        print(f"    ({k}, {value:.4f}, {slope:.4f}),")
    k = np.linspace(KNOTS[0], -1e-3, 8000)
    descent = -k / np.sqrt(g(k))
    if not np.all(np.diff(descent) < 0.0):
        sys.exit("V_d/v_h does not grow with -k: the inflow would not be unique.")

    everything = list(runs.values())
    print("\nRMS error of v/v_h (hover value divided out)")
    for name, predict in [
        ("this law", lambda d: induced(g, d)),
        ("Leishman 2006", leishman),
        ("momentum theory", momentum),
    ]:
        print(f"    {name:16} {rms(errors(predict, everything)):.3f}")
    names = sorted(runs)
    for own in (names[0::2], names[1::2]):
        half = law(fit([runs[n] for n in own]))
        others = [runs[n] for n in names if n not in own]
        seen, unseen = (
            rms(errors(lambda d: induced(half, d), part))
            for part in ([runs[n] for n in own], others)
        )
        print(f"    fitted to runs {own}: {seen:.3f} there, {unseen:.3f} on the others")

    figure, axes = plt.subplots(figsize=(7.2, 4.6), constrained_layout=True)
    for markers, (run, (d, v)) in zip("os^vDP*X<>h", runs.items()):
        axes.plot(d, v, markers, ms=4, mfc="none", color="0.45", label=f"run {run}")
    d = np.linspace(0.0, 3.2, 321)
    axes.plot(d, [induced(g, x) for x in d], "k-", lw=2.0, label="this law")
    axes.plot(d, [leishman(x) for x in d], "k--", lw=1.0, label="Leishman 2006")
    axes.plot(d, [momentum(x) for x in d], "k:", lw=1.2, label="momentum theory")
    axes.set(
        xlabel="rate of descent $V_d/v_h$",
        ylabel="induced velocity $v/v_h$ over its value in hover",
    )
    axes.set(xlim=(0.0, 3.2), ylim=(0.0, 2.8))
    axes.legend(ncols=2, fontsize=7)
    axes.grid(alpha=0.3)
    figure.savefig(HERE / "descent-law.png", dpi=130, metadata={"Software": None})


if __name__ == "__main__":
    main()
