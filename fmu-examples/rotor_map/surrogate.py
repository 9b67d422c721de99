"""Makes a surrogate of the rotor from its map, a cubic spline, and says how wrong it is.

    python surrogate.py --fmu HelicopterRotor.fmu --out FOLDER

takes map.zarr from FOLDER, or from the folder rotor-map beside it, and compares the thrust and the
torque of the surrogate with those of the FMU in conditions between the points of the map. It writes
surrogate.npz (knots and coefficients), surrogate.csv and surrogate.png into FOLDER.
"""

import math
import sys
import time
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent))

import numpy as np
import xarray as xr
from scipy.interpolate import NdBSpline, make_interp_spline

from conditions import AXES, PARAMETERS
from rotor import Rotor
from script import command_line, plt, save_plot, write_table

POINTS = 1000
OUTPUTS = ("thrust", "torque")


def spline(axes, values):
    """A cubic spline through the values on a grid, axis by axis."""
    knots, coefficients = [], values
    for i, points in enumerate(axes):
        along = make_interp_spline(points, coefficients, k=3, axis=i)
        knots.append(along.t)
        coefficients = np.moveaxis(along.c, 0, i) if along.c.shape != values.shape else along.c
    return NdBSpline(tuple(knots), coefficients, 3)


def plot(rows, file):
    figure, axes = plt.subplots(1, 2, figsize=(9.5, 4.4), constrained_layout=True)
    for axis, name, unit in zip(axes, OUTPUTS, ("N", "N m")):
        exact = np.array([row[name] for row in rows])
        error = np.array([row[f"surrogate:{name}"] for row in rows]) - exact
        stalled = np.array([row["stalledFraction"] for row in rows]) > 0.0
        for chosen, color, label in (
            (~stalled, "#2b5c8a", "attached"),
            (stalled, "#c05020", "stall"),
        ):
            axis.plot(exact[chosen], error[chosen], ".", color=color, markersize=4, label=label)
        axis.set_xlabel(f"{name} of the FMU, {unit}")
        axis.set_ylabel(f"surrogate less FMU, {unit}")
        axis.grid(True, color="0.85")
    axes[0].legend(title="flow at the blades")
    figure.suptitle(f"A cubic surrogate of the map in {len(rows)} conditions between its points")
    save_plot(figure, file)


def main():
    arguments = command_line(__doc__, out="folder of the map, and for the surrogate").parse_args()
    folders = (arguments.out, arguments.out.parent / "rotor-map")
    stores = [folder / "map.zarr" for folder in folders if (folder / "map.zarr").exists()]
    if not stores:
        sys.exit(f"there is no map.zarr in {arguments.out}; make it with rotor_map.py")
    data = xr.open_zarr(stores[0], consolidated=False)
    splines = {name: spline(list(AXES.values()), data[name].values) for name in OUTPUTS}

    # Two cells from the edges, where a spline is less accurate, the descent included.
    generator = np.random.default_rng(1)
    low = np.array([values[2] for values in AXES.values()])
    high = np.array([values[-3] for values in AXES.values()])
    points = low + (high - low) * generator.random((POINTS, len(AXES)))

    with Rotor(arguments.fmu, PARAMETERS) as rotor:
        began = time.perf_counter()
        exact = []
        for rpm, climb, speed, collective in points:
            inputs = {"rpm": rpm, "velocity[3]": climb, "velocity[1]": speed}
            rotor.set(inputs | {"collective": math.radians(collective)})
            exact.append(rotor.get([*OUTPUTS, "stalledFraction"]))
        of_fmu = (time.perf_counter() - began) / POINTS
    exact = np.array(exact)
    began = time.perf_counter()
    found = np.array([splines[name](points) for name in OUTPUTS]).T
    of_surrogate = (time.perf_counter() - began) / POINTS

    rows = []
    for point, values, guess in zip(points, exact, found):
        row = dict(zip(AXES, point)) | dict(zip([*OUTPUTS, "stalledFraction"], values))
        rows.append(row | {f"surrogate:{name}": g for name, g in zip(OUTPUTS, guess)})
    for i, name in enumerate(OUTPUTS):
        error, largest = found[:, i] - exact[:, i], np.abs(exact[:, i]).max()
        print(
            f"{name}: RMS error {100.0 * np.sqrt(np.mean(error**2)) / largest:.3f} %, largest"
            f" {100.0 * np.abs(error).max() / largest:.2f} %, of the largest {name}"
        )
    print(
        f"FMU {1e6 * of_fmu:.0f} us a condition; surrogate {1e6 * of_surrogate:.1f} us, all at once"
    )
    saved = {f"{n}:coefficients": s.c for n, s in splines.items()}
    saved |= {f"knots:{n}": t for n, t in zip(AXES, splines["thrust"].t)}
    np.savez(arguments.out / "surrogate.npz", **saved)
    write_table(rows, arguments.out / "surrogate.csv")
    plot(rows, arguments.out / "surrogate.png")


if __name__ == "__main__":
    main()
