"""The pictures of fly.py."""

import math

import numpy as np

from script import plt, save_plot

KNOT = 0.514444  # m/s
HORSEPOWER = 0.745700  # kW


def column(rows, name):
    return np.array([row[name] for row in rows])


def trim(rows, file):
    speed = column(rows, "speed")
    figure, axes = plt.subplots(2, 2, figsize=(9.5, 7.0), sharex=True, constrained_layout=True)
    panels = [
        ("collective, deg", {"collective": "main rotor", "tailCollective": "tail rotor"}),
        ("cyclic pitch, deg", {"cyclicLongitudinal": "longitudinal", "cyclicLateral": "lateral"}),
        ("attitude, deg", {"pitch": "pitch, nose down", "roll": "roll, right side down"}),
    ]
    for axis, (label, curves) in zip(axes.flat, panels):
        for (name, words), style in zip(curves.items(), ("-", "--")):
            axis.plot(speed, column(rows, name), style, color="black", label=words)
        axis.set_ylabel(label)
        axis.legend()
    power = axes[1, 1]
    main, tail = 1e-3 * column(rows, "mainPower"), 1e-3 * column(rows, "tailPower")
    power.plot(speed, main + tail, color="black", linewidth=2.0, label="both rotors")
    power.plot(speed, main, "--", color="black", label="main rotor")
    power.plot(speed, tail, ":", color="black", label="tail rotor")
    best = speed[np.argmin(main + tail)]
    power.axvline(best, color="0.6", linewidth=0.8)
    power.text(best + 1.0, 110.0, f"least at {best:.0f} m/s,\n{best / KNOT:.0f} kt", color="0.3")
    # Of the A109A: "Agusta A109", Business Jet Traveler (bjtonline.com).
    installed = 2.0 * 420.0 * HORSEPOWER
    power.axhline(installed, color="0.6", linewidth=0.8)
    power.text(0.5, installed - 8.0, "two engines of 420 hp", color="0.3", va="top")
    power.set_ylabel("power, kW")
    power.set_ylim(0.0, 680.0)
    power.legend(loc="center right", bbox_to_anchor=(1.0, 0.72))
    for axis in axes.flat:
        axis.grid(True, color="0.85")
        axis.set_xlim(0.0, speed[-1])
    for axis in axes[1]:
        axis.set_xlabel("speed, m/s")
    figure.suptitle("Level flight of a helicopter of two HelicopterRotor.fmu")
    save_plot(figure, file)


def eigenvalues(rows, file):
    """Those with an imaginary part of at least 0, coloured by speed."""
    figure, axis = plt.subplots(figsize=(7.5, 6.0), constrained_layout=True)
    rows = [row for row in rows if row["imaginary"] >= 0.0]
    x, y, speed = (column(rows, name) for name in ("real", "imaginary", "speed"))
    shown = axis.scatter(x, y, c=speed, cmap="viridis", s=26, zorder=3)
    figure.colorbar(shown, label="speed, m/s")
    axis.axvline(0.0, color="black", linewidth=1.0)
    notes = [
        ("phugoid\nin hover", 0.0, (0.33, 0.5), (0.05, 0.75)),
        ("Dutch roll", 45.0, (-0.53, 2.62), (-0.35, 2.75)),
        ("pitching", 45.0, (-1.03, 1.55), (-1.6, 1.65)),
        ("rolling", 0.0, (-2.79, 0.0), (-2.9, 0.25)),
    ]
    for words, near, (real, imaginary), place in notes:
        chosen = [row for row in rows if row["speed"] == near]
        row = min(chosen, key=lambda r: math.hypot(r["real"] - real, r["imaginary"] - imaginary))
        arrow = {"arrowstyle": "-", "color": "0.4"}
        point = (row["real"], row["imaginary"])
        axis.annotate(words, point, place, arrowprops=arrow, color="0.2")
    axis.grid(True, color="0.85")
    axis.set_xlabel("real part (growth), 1/s")
    axis.set_ylabel("imaginary part (frequency), rad/s")
    axis.set_title("Eigenvalues of the body's motion in level flight")
    save_plot(figure, file)


def response(rows, words, file):
    """Changes after a step of the stick: rotors that flap, and the linear model."""
    time = column(rows, "time")
    panels = [
        ("pitch rate,\nnose down, deg/s", "pitchRate"),
        ("roll rate,\nright down, deg/s", "rollRate"),
        ("pitch, deg", "pitch"),
        ("forward speed, m/s", "forward"),
    ]
    figure, axes = plt.subplots(4, 1, figsize=(7.5, 7.8), sharex=True, constrained_layout=True)
    for axis, (label, name) in zip(axes, panels):
        axis.plot(time, column(rows, name), color="black", label="two FMUs, blades flap")
        linear = column(rows, f"linear:{name}")
        axis.plot(time, linear, "--", color="#c05020", label="stability derivatives")
        axis.set_ylabel(label)
        axis.grid(True, color="0.85")
    axes[0].legend()
    axes[0].set_title(words)
    axes[-1].set_xlim(0.0, time[-1])
    axes[-1].set_xlabel("time, s")
    save_plot(figure, file)
