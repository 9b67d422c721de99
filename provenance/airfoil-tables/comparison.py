"""Compare naca0012.polar and naca0015.polar with assessed measurements.

Prints a Markdown table and draws comparison.png.
"""

import argparse
import sys

import matplotlib
import numpy as np

import make_slopes
import make_tables as tables

matplotlib.use("Agg")
from matplotlib import pyplot as plt  # noqa: E402

SECTIONS = {"naca0012": "NACA 0012", "naca0015": "NACA 0015"}
QUANTITIES = {
    "slope_per_rad": "lift slope, 1/rad",
    "cd0": "drag coefficient at zero lift",
    "cl_max": "largest lift coefficient",
    "stall_deg": "stall angle, deg",
}
# source: name in the figure, marker; filled: the table is made from it
SOURCES = {
    "knight-hefner": ("Knight & Hefner 1937", "D", True),
    "ladson": ("Ladson 1988, fixed transition", "o", True),
    "gregory-oreilly": ("Gregory & O'Reilly 1970, fixed", "s", True),
    "abbott-doenhoff": ("Abbott & von Doenhoff 1959, free", "^", False),
    "jacobs-sherman": ("Jacobs & Sherman 1937, turbulent tunnel", "v", True),
    "sheldahl-klimas-moment": ("Sheldahl & Klimas 1981, moment break", "P", False),
    "sheldahl-klimas": ("Sheldahl & Klimas 1981, partly computed (used: 700,000)", "x", False),
}


def quantities(alpha, cl, cd):
    """The quantities of QUANTITIES of a polar from 0 deg upwards."""
    peak = int(np.argmax(np.diff(cl) <= 0))
    return {
        "slope_per_rad": tables.lift_slope(alpha, cl),
        "cd0": cd[0],
        "cl_max": cl[peak],
        "stall_deg": alpha[peak],
    }


def shipped(section):
    """Reynolds numbers of a shipped polar and its quantities there."""
    _, blocks = make_slopes.read_polar(tables.OUTPUT / f"{section}.polar")
    columns = []
    for _, rows in blocks:
        alpha, cl, cd = rows[(rows[:, 0] >= 0) & (rows[:, 0] <= 30)].T
        columns.append(quantities(alpha, cl, cd))
    reynolds = np.array([reynolds for reynolds, _ in blocks])
    return reynolds, {name: np.array([c[name] for c in columns]) for name in QUANTITIES}


def uncorrected(section, reynolds):
    """The quantities that NeuralFoil computes."""
    columns = [
        quantities(tables.FINE_DEG, *tables.computed_polar(re, section)[:2]) for re in reynolds
    ]
    return {name: np.array([c[name] for c in columns]) for name in QUANTITIES}


def points():
    """Points: source, section, Reynolds number and quantities at Mach 0; NaN where not given."""
    knot_cl, knot_cd = tables.fit_measured()[:2]
    own = quantities(tables.KNOTS, knot_cl, knot_cd)
    found = [("knight-hefner", "naca0015", tables.MEASURED_REYNOLDS, own)]
    for row in tables.assessed_rows(""):
        numbers = {name: float(row[name] or "nan") for name in QUANTITIES}
        numbers["slope_per_rad"] *= np.sqrt(1 - float(row["mach"] or 0) ** 2)
        source = max((s for s in SOURCES if row["source"].startswith(s)), key=len)
        found.append((source, row["section"], float(row["reynolds"]), numbers))
    return found


def compare():
    """Print the points that are measured alone beside the tables, and draw all of them."""
    print("| section | Re | source | quantity | measured | table | difference | uncorrected |")
    print("|---|---:|---|---|---:|---:|---:|---:|")
    curves = {section: shipped(section) for section in SECTIONS}
    for source, section, reynolds, numbers in points():
        if source == "sheldahl-klimas":
            continue
        block = tables.corrected_block(reynolds, section)
        ours = quantities(block.alpha, block.cl, block.cd)
        raw = uncorrected(section, [reynolds])
        for name, title in QUANTITIES.items():
            if np.isnan(numbers[name]):
                continue
            digits = {"cd0": 4, "stall_deg": 1}.get(name, 2)
            print(
                f"| {SECTIONS[section]} | {reynolds:,.0f} | {SOURCES[source][0]} | {title} "
                f"| {numbers[name]:.{digits}f} | {ours[name]:.{digits}f} "
                f"| {ours[name] / numbers[name] - 1:+.0%} | {raw[name][0]:.{digits}f} |"
            )
    draw(curves)


def draw(curves):
    """Each quantity against the Reynolds number, for both sections."""
    figure, axes = plt.subplots(
        len(QUANTITIES), len(SECTIONS), figsize=(11, 13), sharex=True, sharey="row",
        layout="constrained",
    )  # fmt: skip
    for column, section in enumerate(SECTIONS):
        reynolds, table = curves[section]
        raw = uncorrected(section, reynolds)
        for row, (name, title) in enumerate(QUANTITIES.items()):
            axis = axes[row, column]
            axis.plot(reynolds, raw[name], ":", color="0.4", label="NeuralFoil, not corrected")
            axis.plot(reynolds, table[name], "k.-", linewidth=1.6, label="shipped table")
            if name == "slope_per_rad":
                fit = reynolds >= tables.MEASURED_REYNOLDS
                axis.plot(
                    reynolds[fit], tables.mccroskey_slope(reynolds[fit]), "--", color="tab:red",
                    linewidth=3, alpha=0.5, label="McCroskey 1987, fit for NACA 0012",
                )  # fmt: skip
            axis.grid(color="0.85", linewidth=0.6)
            axis.set_xscale("log")
            if column == 0:
                axis.set_ylabel(title)
        axes[0, column].set_title(SECTIONS[section])
        axes[-1, column].set_xlabel("Reynolds number")
    drawn = set()
    for source, section, reynolds, numbers in points():
        title, marker, used = SOURCES[source]
        color = f"C{list(SOURCES).index(source)}"
        for row, name in enumerate(QUANTITIES):
            axes[row, list(SECTIONS).index(section)].plot(
                reynolds, numbers[name], marker, color=color, markersize=7, linestyle="none",
                markerfacecolor=color if used else "white",
                label="_" if source in drawn else title,
            )  # fmt: skip
            drawn.add(source)
    axes[0, 0].set_ylim(5, 7)
    axes[1, 0].set_ylim(0, 0.024)
    axes[2, 0].set_ylim(0.4, 2)
    axes[3, 0].set_ylim(4, 22)
    handles, labels = [], []
    for axis in axes.flat:
        for handle, name in zip(*axis.get_legend_handles_labels(), strict=True):
            if name not in labels:
                handles.append(handle)
                labels.append(name)
    figure.legend(handles, labels, loc="outside lower center", ncols=2, fontsize=9)
    figure.suptitle(
        "The tables against measurements at Mach 0 (filled: used in the correction)", fontsize=11
    )
    figure.savefig(tables.HERE / "comparison.png", dpi=110)


def main():
    """Read the command line and compare."""
    argparse.ArgumentParser(description=__doc__).parse_args()
    try:
        compare()
    except (tables.TableError, OSError) as error:
        sys.exit(f"The tables were not compared: {error}")


if __name__ == "__main__":
    main()
