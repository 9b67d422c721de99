"""Draws a rotor that turns, flaps and moves as a result file says: a GIF, or a page to play with.

    python animate.py RESULT.csv --out rotor.gif

The file is that of any tool: columns named like the FMU's variables, in its units. It needs `time`
and `azimuth`; `coning`, `longitudinalFlapping`, `lateralFlapping`, `tilt` and `lateralTilt` are
drawn if they are there, and the position of the hub from the columns `x`, `y` and `height`, m. With
--out rotor.html it makes a page on which the pictures can be stopped and stepped through.
"""

import argparse
import csv
from pathlib import Path

import matplotlib
import numpy as np

matplotlib.use("Agg")
import matplotlib.pyplot as plt
from matplotlib.animation import FuncAnimation, PillowWriter

ANGLES = ["azimuth", "coning", "longitudinalFlapping", "lateralFlapping", "tilt", "lateralTilt"]
POSITION = ["x", "y", "height"]
FRAMES = 15  # a second
TRAIL = 40  # frames for which the paths of the tips stay


class Flight:
    """The columns of a result file, at any time."""

    def __init__(self, file):
        with open(file, encoding="utf-8", newline="") as text:
            rows = list(csv.DictReader(text))
        missing = {"time", "azimuth"} - set(rows[0] if rows else [])
        if missing:
            raise SystemExit(f"{file} has no column {', '.join(sorted(missing))}")
        self.columns = {
            name: np.array([float(row[name]) for row in rows])
            for name in ["time", *ANGLES, *POSITION]
            if name in rows[0]
        }
        self.times = self.columns["time"]

    def at(self, time, name):
        column = self.columns.get(name)
        return 0.0 if column is None else np.interp(time, self.times, column)


def points(flight, time, azimuth, radius, enlarged):
    """Points at a radius (m) and an azimuth, in the ground frame, one a row."""
    flap = flight.at(time, "coning") - flight.at(time, "longitudinalFlapping") * np.cos(azimuth)
    flap = enlarged * (flap - flight.at(time, "lateralFlapping") * np.sin(azimuth))
    x, y = -radius * np.cos(flap) * np.cos(azimuth), -radius * np.cos(flap) * np.sin(azimuth)
    tilt, lateral = flight.at(time, "tilt"), flight.at(time, "lateralTilt")
    z = radius * np.sin(flap)
    y, z = y * np.cos(lateral) - z * np.sin(lateral), y * np.sin(lateral) + z * np.cos(lateral)
    x, z = x * np.cos(tilt) + z * np.sin(tilt), -x * np.sin(tilt) + z * np.cos(tilt)
    hub = [flight.at(time, name) for name in POSITION]
    return np.stack(np.broadcast_arrays(x + hub[0], y + hub[1], z + hub[2]), axis=-1)


def animation(flight, times, radius, count, turning, flapping):
    """A picture for each time."""
    figure = plt.figure(figsize=(4.4, 4.8))
    axis = figure.add_axes((-0.05, -0.02, 1.02, 0.98), projection="3d")
    hubs = np.array([[flight.at(t, name) for name in POSITION] for t in times])
    low, high = hubs.min(axis=0) - 1.1 * radius, hubs.max(axis=0) + 1.1 * radius
    low[2], high[2] = hubs[:, 2].min() - 0.3 * radius, hubs[:, 2].max() + 0.5 * radius
    axis.set(xlim=(low[0], high[0]), ylim=(low[1], high[1]), zlim=(low[2], high[2]))
    axis.set_box_aspect(high - low)
    axis.view_init(20.0, -60.0)
    axis.set(xticks=[], yticks=[], zlabel="height, m")

    (circle,) = axis.plot([], [], [], color="0.6", linewidth=1.0)
    blades = [axis.plot([], [], [], color="black", linewidth=3.0)[0] for _ in range(count)]
    trails = [axis.plot([], [], [], color="#2b5c8a", linewidth=0.8)[0] for _ in range(count)]
    words = figure.text(0.5, 0.965, "", ha="center", va="top", fontsize=9)
    spaced = 2.0 * np.pi / count * np.arange(count)
    span = np.linspace(0.1, 1.0, 2) * radius

    def draw(frame):
        time = times[frame]
        turned = turning * flight.at(time, "azimuth") + spaced
        for blade, azimuth in zip(blades, turned):
            blade.set_data_3d(*points(flight, time, azimuth, span, flapping).T)
        rim = points(flight, time, np.linspace(0, 2 * np.pi, 73), radius, flapping)
        circle.set_data_3d(*rim.T)
        past = np.linspace(times[max(0, frame - TRAIL)], time, 8 * min(frame, TRAIL) + 1)
        azimuths = turning * flight.at(past, "azimuth")
        for trail, offset in zip(trails, spaced):
            path = points(flight, past, azimuths + offset, radius, flapping)
            trail.set_data_3d(*path.T)
        words.set_text(
            f"{time:.1f} s; turning drawn {1.0 / turning:g} times slower,"
            f" flapping {flapping:g} times larger"
        )

    interval = 1000.0 / FRAMES
    return FuncAnimation(figure, draw, frames=len(times), interval=interval, repeat=True)


class Gif(PillowWriter):
    """A GIF with few colours, in a file of any name."""

    def finish(self):
        first, *others = [frame.quantize(32) for frame in self._frames]
        options = {"save_all": True, "append_images": others, "loop": 0, "optimize": True}
        first.save(self.outfile, format="GIF", duration=int(1000 / self.fps), **options)


def write(film, file):
    """The file appears whole or not at all."""
    file.parent.mkdir(parents=True, exist_ok=True)
    temporary = file.with_suffix(".tmp")
    if file.suffix == ".html":
        temporary.write_text(film.to_jshtml(fps=FRAMES), encoding="utf-8")
    else:
        film.save(temporary, writer=Gif(fps=FRAMES), dpi=90)
    temporary.replace(file)


def make(result, out, radius=0.762, blades=4, turning=0.05, flapping=5.0, stop=None):
    """Draws a result file, as the options of the command line say."""
    flight = Flight(result)
    stop = min(stop or flight.times[-1], flight.times[-1])
    times = np.arange(flight.times[0], stop, 1.0 / FRAMES)
    write(animation(flight, times, radius, blades, turning, flapping), out)
    print(f"{out}: {len(times)} pictures, {out.stat().st_size / 1e6:.2f} MB")


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("result", type=Path, help="the result file, comma-separated")
    parser.add_argument("--out", type=Path, required=True, help="the .gif or .html to write")
    parser.add_argument("--radius", type=float, default=0.762, help="of the rotor, m [0.762]")
    parser.add_argument("--blades", type=int, default=4, help="their number [4]")
    parser.add_argument(
        "--turning", type=float, default=0.05, help="part of the speed drawn [0.05]"
    )
    parser.add_argument(
        "--flapping", type=float, default=5.0, help="factor of the angles drawn [5]"
    )
    parser.add_argument("--stop", type=float, help="time at which it ends, s")
    arguments = parser.parse_args()
    make(**vars(arguments))


if __name__ == "__main__":
    main()
