"""How the figures look and how they are written: equal numbers give equal bytes.

Measured values are markers, computed ones lines. Markers and dashes, not only colours, tell them
apart.
"""

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt

plt.rcParams.update(
    {
        "svg.hashsalt": "HelicopterRotor",
        "svg.fonttype": "path",
        "font.size": 9.0,
        "axes.grid": True,
        "grid.color": "0.88",
        "axes.axisbelow": True,
        "legend.fontsize": 8.0,
        "legend.framealpha": 0.9,
        "lines.linewidth": 1.4,
        "lines.markersize": 4.5,
    }
)

# Dark enough to be read when printed in black and white.
INK = ["black", "#1f4e9c", "#b03a2e", "#1e7145", "#7d3c98", "#8a6d00"]
DASHES = ["-", "--", "-.", ":", (0, (6, 1.5, 1, 1.5, 1, 1.5)), (0, (2, 1))]
MARKERS = ["o", "s", "^", "D", "v", "P", "X", "<", ">", "h", "*"]


def line(i):
    """Style of the i-th computed line."""
    return {"color": INK[i % len(INK)], "linestyle": DASHES[i % len(DASHES)]}


def points(i):
    """Style of the i-th set of measured points."""
    return {
        "color": "black",
        "marker": MARKERS[i % len(MARKERS)],
        "markerfacecolor": "white",
        "linestyle": "none",
        "zorder": 3,
        "clip_on": False,
    }


def figure(rows, columns, width=8.2, height=3.6, **options):
    made = plt.subplots(rows, columns, figsize=(width, height), layout="constrained", **options)
    made[0].get_layout_engine().set(w_pad=0.08, h_pad=0.06)
    return made


def coefficient_axis(axis):
    """Small coefficients, with their power of ten at the end of the axis."""
    axis.ticklabel_format(axis="y", style="sci", scilimits=(0, 0), useMathText=True)


def from_zero(axis):
    """The vertical axis from 0 to slightly above the highest line."""
    highest = max(max(line.get_ydata()) for line in axis.get_lines())
    axis.set_ylim(0.0, 1.08 * highest)


def legend_below(figure, axis, columns):
    """One legend for all panels, below them."""
    handles, labels = axis.get_legend_handles_labels()
    figure.legend(handles, labels, loc="outside lower center", ncols=columns, frameon=False)


def save(figure, file):
    figure.savefig(file, format="svg", metadata={"Date": None, "Creator": None})
    plt.close(figure)
