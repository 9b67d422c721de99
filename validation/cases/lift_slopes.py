"""The thesis' study of lift slopes (Lovaco 2017, figures 27 to 30): its lines A and B, 2 pi and the table, each with and
without compressibility, in axial flight."""

import math
from pathlib import Path

import drawing
import page
import rotors

RATIOS = [-1.0 + 0.1 * i for i in range(21)]
LIFTS = ("slopesByReynolds", "twoPi", "table")
RULES = ("none", "karmanTsien")
CASES = {
    "thesis, 15.3 deg": (15.3, rotors.THESIS_RADIUS, rotors.THESIS_RPM),
    "thesis, 16.9 deg": (16.9, rotors.THESIS_RADIUS, rotors.THESIS_RPM),
    "Knight & Hefner, 4 blades, 8 deg": (
        8.0,
        rotors.KNIGHT_HEFNER_RADIUS,
        rotors.KNIGHT_HEFNER_RPM,
    ),
}
TASKS = [f"{case}; {lift}; {rule}" for case in CASES for lift in LIFTS for rule in RULES]
OUTPUTS = ("thrustCoefficient", "powerCoefficient")


def fly(rotor, task, resources):
    case, lift, rule = task.split("; ")
    pitch, radius, rpm = CASES[case]
    with rotors.own_folder() as folder:
        own = (
            rotors.THESIS
            if case.startswith("thesis")
            else rotors.knight_hefner_slopes(4, resources, Path(folder))
        )
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
    figure, axes = drawing.figure(2, len(CASES), height=6.4, sharex=True)
    for column, case in enumerate(CASES):
        for place in (0, 1):
            axis = axes[place][column]
            for i, lift in enumerate(LIFTS):
                for rule, marker in zip(RULES, ("", "x")):
                    values = [f[place] for f in flown[f"{case}; {lift}; {rule}"]["flights"]]
                    style = drawing.line(i) | {
                        "linewidth": 1.1,
                        "marker": marker,
                        "markersize": 4,
                        "markevery": 2,
                    }
                    axis.plot(RATIOS, values, **style, label=f"{lift}, compressibility {rule}")
            drawing.coefficient_axis(axis)
            axis.set(xlim=(-1, 1))
            drawing.from_zero(axis)
        axes[0][column].set_title(case.replace("4 blades, ", ""), fontsize=9, pad=16)
        axes[1][column].set_xlabel("rate of climb $V_c/V_h$")
    axes[0][0].set_ylabel("thrust coefficient CT")
    axes[1][0].set_ylabel("power coefficient CP")
    drawing.legend_below(figure, axes[0][0], 3)
    drawing.save(figure, file)
