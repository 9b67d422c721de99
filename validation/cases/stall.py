"""The thesis' study of stalled stations (Lovaco 2017, section 4.2): the last stalled and the first attached blade element
in hover."""

import math
from pathlib import Path

import numpy as np

import drawing
import page
import rotors

ELEMENTS = 120
LIFTS = {
    "thesisSlope, annulusClosedForm": {**rotors.THESIS_CHOICES},
    "thesisSlope, annulus": {**rotors.THESIS_CHOICES, "model.inflow": "annulus"},
    "table, annulus": {"model.inflow": "annulus"},
}
CASES = {
    "thesis, 15.3 deg": (15.3, rotors.THESIS_RADIUS, 0.1),
    "thesis, 16.9 deg": (16.9, rotors.THESIS_RADIUS, 0.1),
    "Knight & Hefner, 4 blades, 12 deg": (12.0, rotors.KNIGHT_HEFNER_RADIUS, 1.0 / 6.0),
    "Knight & Hefner, 4 blades, 16.9 deg": (16.9, rotors.KNIGHT_HEFNER_RADIUS, 1.0 / 6.0),
}
TASKS = [f"{case}; {lift}" for case in CASES for lift in LIFTS]
STATIONS = range(1, 21)


def fly(rotor, task, resources):
    case, lift = task.split("; ")
    pitch, _, _ = CASES[case]
    with rotors.own_folder() as folder:
        own = rotors.THESIS if case.startswith("thesis") else rotors.knight_hefner_slopes(4, resources, Path(folder))
        chosen = {**own, **LIFTS[lift], "collective": math.radians(pitch), "numerics.elements": ELEMENTS}
        rotor.start(chosen)
        along = lambda name: rotor.fly([f"station[{i}].{name}" for i in STATIONS])
        return {
            "stalled": rotor.fly(("stalledRadius", "stalledFraction")),
            "radius": along("radius"),
            "angle": [math.degrees(a) for a in along("angleOfAttack")],
            "reynolds": along("reynolds"),
            "models": rotor.models(chosen),
        }


def report(flown, figures):
    found = page.Report()
    cells = []
    for case, (_, radius, cutout) in CASES.items():
        width = (1.0 - cutout) / ELEMENTS
        for lift in LIFTS:
            own = flown[f"{case}; {lift}"]
            last, fraction = own["stalled"]
            cell = [case, *(f"`{part}`" for part in lift.split(", "))]
            if last > 0.0:
                first = last + width
                cell += [f"{last:.3f}", f"{last * radius:.3f}"]
                cell += [f"{first:.3f}", f"{first * radius:.3f}"] if first < 1.0 else ["-", "-"]
            else:
                cell += ["none", "-", f"{cutout + 0.5 * width:.3f}", f"{(cutout + 0.5 * width) * radius:.3f}"]
            cells.append([*cell, f"{100.0 * fraction:.0f} %"])
    header = ["rotor", "lift", "inflow", "last stalled, r/R", "m", "first attached, r/R", "m", "span stalled"]
    draw(flown, figures / "stall.svg")
    found.texts = {
        "stall.table": page.table(header, cells, 3),
        "stall.models": flown[TASKS[0]]["models"],
    }
    return found


def draw(flown, file):
    figure, axes = drawing.figure(1, 2, height=3.9, sharey=True)
    for axis, pair in zip(axes, (list(CASES)[:2], list(CASES)[2:])):
        for i, case in enumerate(pair):
            for lift, marker in (("thesisSlope, annulus", ""), ("table, annulus", ".")):
                own = flown[f"{case}; {lift}"]
                style = drawing.line(i) | {"marker": marker}
                axis.plot(own["radius"], own["angle"], **style, label=f"{case.split(', ')[-1]}, {lift.split(',')[0]}")
                last = own["stalled"][0]
                if last > 0.0:
                    height = float(np.interp(last, own["radius"], own["angle"]))
                    axis.plot([last], [height], **drawing.points(1) | {"markersize": 6})
        axis.plot([], [], **drawing.points(1), label="last stalled element")
        axis.set(xlabel="radius r/R", xlim=(0, 1), title=pair[0].rsplit(",", 1)[0])
        axis.legend()
    axes[0].set_ylabel("angle of attack, deg")
    drawing.save(figure, file)
