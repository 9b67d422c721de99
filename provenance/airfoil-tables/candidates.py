"""Compare candidate methods for the NACA 0015 with the measurements at Re 242,000.

Prints a Markdown table and draws candidates.png.
"""

import argparse
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

import matplotlib
import numpy as np

import make_tables as tables

matplotlib.use("Agg")
from matplotlib import pyplot as plt  # noqa: E402

# method, n_crit, trip position in chords (1: free transition)
CANDIDATES = [
    ("NeuralFoil", 9, 1.0), ("NeuralFoil", 4, 1.0), ("NeuralFoil", 2, 1.0), ("NeuralFoil", 1, 1.0),
    ("NeuralFoil", 9, 0.05), ("NeuralFoil", 4, 0.05),
    ("XFOIL", 9, 1.0), ("XFOIL", 4, 1.0), ("XFOIL", 1, 1.0), ("XFOIL", 9, 0.05), ("XFOIL", 4, 0.05),
]  # fmt: skip
ALPHA = np.arange(0, 16.01, 0.5)
DRAWN = {
    ("NeuralFoil", 9, 1.0): ":", ("NeuralFoil", 4, 1.0): "-.", ("NeuralFoil", 1, 1.0): "-",
    ("NeuralFoil", 9, 0.05): "--",
}  # fmt: skip


def xfoil_polar(n_crit, x_trip):
    """alpha (deg), cl and cd by XFOIL with 200 panels, at the points of ALPHA that converge."""
    if shutil.which("xfoil") is None:
        raise tables.TableError("The candidates need the program xfoil, and it is not on the PATH.")
    commands = (
        f"PLOP\nG F\n\nNACA 0015\nPPAR\nN 200\n\n\nOPER\nVISC {tables.MEASURED_REYNOLDS}\n"
        f"VPAR\nN {n_crit}\nXTR {x_trip} {x_trip}\n\nITER 200\nPACC\npolar.txt\n\n"
        f"ASEQ {ALPHA[0]} {ALPHA[-1]} {ALPHA[1] - ALPHA[0]}\nPACC\n\nQUIT\n"
    )
    with tempfile.TemporaryDirectory() as folder:
        subprocess.run(
            ["xfoil"], input=commands, text=True, cwd=folder, capture_output=True, timeout=120
        )
        path = Path(folder) / "polar.txt"
        data = np.loadtxt(path, skiprows=12, usecols=(0, 1, 2)) if path.exists() else np.empty(0)
    if data.size == 0:
        raise tables.TableError(
            "XFOIL gave no result; README.md says what Debian's build of it needs."
        )
    return data.T


def candidate_polar(method, n_crit, x_trip):
    """alpha (deg), cl, cd of one candidate."""
    if method == "XFOIL":
        return xfoil_polar(n_crit, x_trip)
    cl, cd, _ = tables.neuralfoil_polar(ALPHA, tables.MEASURED_REYNOLDS, n_crit, x_trip)
    return ALPHA, cl, cd


def slope_range(method, n_crit, x_trip):
    """Smallest and largest lift slope (1/rad) over all Reynolds numbers of the tables."""
    if method == "XFOIL":
        return "-"
    slopes = [
        tables.lift_slope(ALPHA, tables.neuralfoil_polar(ALPHA, reynolds, n_crit, x_trip)[0])
        for reynolds in tables.REYNOLDS
    ]
    return f"{min(slopes):.2f} to {max(slopes):.2f}"


def label(method, n_crit, x_trip):
    """Name of a candidate in the table and the figure."""
    return f"{method}, n_crit {n_crit}, " + (
        "free" if x_trip == 1 else f"tripped at {x_trip * 100:.0f} %"
    )


def compare():
    """Compute each candidate, print its distances and draw the figure."""
    print(
        "| candidate | points | mean dcl | max dcl | mean dcd | max dcd | mean dcl to 8 deg "
        "| mean dcd to 8 deg | cd at 0 | slope, 1/rad | slope, Re 2e4 to 1e7 |"
    )
    print("|---|" + "---:|" * 10)
    polars = {}
    for candidate in CANDIDATES:
        tables.progress(label(*candidate))
        alpha, cl, cd = polars[candidate] = candidate_polar(*candidate)
        whole, low = alpha <= tables.KNOTS[-1], alpha <= tables.BELOW_STALL_DEG
        far = tables.distance(alpha[whole], cl[whole], cd[whole])
        near = tables.distance(alpha[low], cl[low], cd[low])
        print(
            f"| {label(*candidate)} | {whole.sum()} | {far['mean_dcl']:.4f} | {far['max_dcl']:.4f} "
            f"| {far['mean_dcd']:.5f} | {far['max_dcd']:.5f} | {near['mean_dcl']:.4f} "
            f"| {near['mean_dcd']:.5f} | {cd[0]:.5f} "
            f"| {tables.lift_slope(alpha, cl):.2f} | {slope_range(*candidate)} |"
        )
    draw(polars)


def draw(polars):
    """Lift and drag against alpha: measured points, the fit and the NeuralFoil candidates."""
    position, alpha, cl, cd = tables.measured_points()
    knot_cl, knot_cd = tables.fit_measured()[:2]
    figure, axes = plt.subplots(1, 2, figsize=(11, 5), layout="constrained")
    for axis, points, knots, column in ((axes[0], cl, knot_cl, 1), (axes[1], cd, knot_cd, 2)):
        for candidate, style in DRAWN.items():
            polar = polars[candidate]
            chosen = candidate == ("NeuralFoil", tables.N_CRIT, 1.0)
            axis.plot(
                polar[0], polar[column], style, color="black" if chosen else "0.4",
                linewidth=1.2, label=label(*candidate) + (" (chosen)" if chosen else ""),
            )  # fmt: skip
        axis.plot(tables.KNOTS, knots, "k-", linewidth=2.4, label="fit to the measurements")
        for name, marker in (("A", "o"), ("B", "s")):
            here = position == name
            axis.plot(
                alpha[here], points[here], marker, color="black", markerfacecolor="white",
                markersize=5, label=f"measured, position {name}",
            )  # fmt: skip
        axis.set_xlabel("angle of attack, deg")
        axis.set_xlim(0, ALPHA[-1])
        axis.set_ylim(bottom=0)
        axis.grid(color="0.85", linewidth=0.6)
    axes[0].set_ylabel("lift coefficient cl")
    axes[1].set_ylabel("drag coefficient cd")
    axes[1].legend(loc="upper left", fontsize=9)
    figure.suptitle(
        "NACA 0015 at Re 242,000 (measured: Knight & Hefner 1937, folded by symmetry)", fontsize=11
    )
    figure.savefig(tables.HERE / "candidates.png", dpi=130)


def main():
    """Read the command line and compare."""
    argparse.ArgumentParser(description=__doc__).parse_args()
    try:
        compare()
    except (tables.TableError, OSError) as error:
        sys.exit(f"The candidates were not compared: {error}")


if __name__ == "__main__":
    main()
