"""Hover: rotor 1 of Harrington (1951, NACA TN 2318), a full-scale rotor, torque against thrust.

The report's figure has no pitch, so that torque is compared at the measured thrust.
"""

import math

import numpy as np

import drawing
import errors
import measured
import page
import rotors

FILE = "harrington-1951-tn2318-rotor1-single-digitised.csv"
CASE = "Harrington 1951, hover"
TASKS = ["hover"]
PITCHES = [-0.5 + 0.25 * i for i in range(51)]
OUTPUTS = ("thrustCoefficient", "torqueCoefficient")
CONFIGURATIONS = ("single_lower", "single_upper")
# Below it the thrust is less than a fifth of the largest, and the torque nearly that of the section drag.
COMPARED_FROM = 0.0007
# How closely CQ and CT can be read off the printed plot, as the table of the points says.
READING_CQ = 0.000002
READING_CT = 0.00003
PARAMETERS = {"geometry.file": "harrington-1.toml", **rotors.air(1.225, 288.15)}


def fly(rotor, _task, _resources):
    rotor.begin(PARAMETERS)
    line = [rotor.fly(OUTPUTS, collective=math.radians(pitch)) for pitch in PITCHES]
    return {"line": line, "models": rotor.models(PARAMETERS)}


def report(flown, figures):
    found = page.Report()
    line = flown["hover"]["line"]
    rows = [r for r in measured.rows(FILE) if r["CT"] >= COMPARED_FROM]
    thrusts, torques = zip(*line)
    computed = np.interp([r["CT"] for r in rows], thrusts, torques)
    values = [r["CQ"] for r in rows]
    # An error of reading CT moves the computed CQ along the line.
    slopes = np.interp([r["CT"] for r in rows], thrusts, np.gradient(torques, thrusts))
    scatter = errors.rms(
        [
            100.0 * math.hypot(READING_CQ, slope * READING_CT) / value
            for slope, value in zip(slopes, values)
        ]
    )
    found.errors.append(
        errors.percent(CASE, "CQ at the measured CT", "table", computed, values, scatter)
    )
    draw(line, figures / "harrington.svg")
    found.texts = {
        "harrington.errors": page.error_table(found.errors),
        "harrington.models": flown["hover"]["models"],
        "harrington.idle": f"{min(torques):.6f}",
    }
    return found


def draw(line, file):
    figure, axis = drawing.figure(1, 1, width=5.6, height=3.9)
    thrusts, torques = zip(*line)
    axis.plot(torques, thrusts, **drawing.line(0), label="computed")
    for i, name in enumerate(CONFIGURATIONS):
        own = [(r["CQ"], r["CT"]) for r in measured.rows(FILE) if r["config"] == name]
        label = f"measured, {name.removeprefix('single_')} rotor alone"
        axis.plot(*zip(*own), **drawing.points(i), label=label)
    axis.set(
        xlabel="torque coefficient CQ",
        ylabel="thrust coefficient CT",
        xlim=(0, 0.00026),
        ylim=(0, 0.004),
    )
    drawing.coefficient_axis(axis)
    axis.ticklabel_format(axis="x", style="sci", scilimits=(0, 0), useMathText=True)
    axis.legend(loc="lower right")
    drawing.save(figure, file)
