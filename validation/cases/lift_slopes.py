"""The thesis' study of lift slopes in axial flight (Lovaco 2017, figures 27 to 30).

Its lines A and B, 2 pi and the table, each with and without compressibility.
"""

import math

import drawing
import page
import rotors

from . import axial_flight

RATIOS = [-1.0 + 0.1 * i for i in range(21)]
LIFTS = ("slopesByReynolds", "twoPi", "table")
RULES = ("none", "karmanTsien")
CASES = axial_flight.CASES
TASKS = [f"{case}; {lift}; {rule}" for case in CASES for lift in LIFTS for rule in RULES]
OUTPUTS = ("thrustCoefficient", "powerCoefficient")


def fly(rotor, task, resources):
    case, lift, rule = task.split("; ")
    pitch, radius, rpm = CASES[case]
    with rotors.own_folder() as folder:
        own = rotors.of_study(case, resources, folder)
        chosen = {
            **own,
            "collective": math.radians(pitch),
            "models.compressibility": rule,
            "models.tipLoss": "prandtl",
            "models.inflow": "annulus",
        }
        rotor.begin({**chosen, "models.lift": "slopesByReynolds", "models.compressibility": "none"})
        hover = rotors.hover_speed(rotor.fly(OUTPUTS)[0], radius, rpm)
        chosen["models.lift"] = lift
        rotor.begin(chosen)
        flights = [rotor.fly(OUTPUTS, **{"velocity[3]": ratio * hover}) for ratio in RATIOS]
        return {"flights": flights, "models": rotor.models(chosen)}


def report(flown, figures):
    found = page.Report()
    cells = []
    for case in CASES:
        for lift in LIFTS:
            hover = [
                flown[f"{case}; {lift}; {rule}"]["flights"][RATIOS.index(0.0)] for rule in RULES
            ]
            cell = [case, f"`{lift}`"]
            for place in (0, 1):
                plain, corrected = hover[0][place], hover[1][place]
                cell += [
                    f"{plain:.{5 + place}f}",
                    f"{corrected:.{5 + place}f}",
                    page.number(100.0 * (corrected / plain - 1.0), "%", True),
                ]
            cells.append(cell)
    header = [
        "rotor",
        "lift",
        "CT `none`",
        "CT `karmanTsien`",
        "%",
        "CP `none`",
        "CP `karmanTsien`",
        "%",
    ]
    draw(flown, figures / "lift-slopes.svg")
    found.texts = {
        "lift-slopes.table": page.table(header, cells, 2),
        "lift-slopes.models": flown[TASKS[0]]["models"],
    }
    return found


def draw(flown, file):
    lines = []
    for i, lift in enumerate(LIFTS):
        for rule, marker in zip(RULES, ("", "x")):
            style = {"linewidth": 1.1, "marker": marker, "markersize": 4, "markevery": 2}
            label = f"{lift}, compressibility {rule}"
            lines.append((f"; {lift}; {rule}", label, drawing.line(i) | style))
    axial_flight.draw_climb(flown, RATIOS, lines, 6.4, file)
