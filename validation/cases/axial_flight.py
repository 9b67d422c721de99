"""The thesis' study of axial flight (Lovaco 2017, figures 17 to 20).

CT and CP from a descent at V_h to a climb at V_h: the disc by eq. (94), blades with uniform inflow,
and the defaults of this project.
"""

import math

import drawing
import page
import rotors

RATIOS = [-1.0 + 0.05 * i for i in range(41)]
SHOWN = [-1.0, -0.5, 0.0, 0.5, 1.0]
SETTINGS = {
    "disc": {**rotors.THESIS_CHOICES},
    "blades, uniform": {
        **rotors.THESIS_CHOICES,
        "models.inflow": "uniform",
        "models.blades": "individual",
        "models.descent": "momentum",
    },
    "defaults": {},
}
CASES = {
    "thesis, 15.3 deg": (15.3, rotors.THESIS_RADIUS, rotors.THESIS_RPM),
    "thesis, 16.9 deg": (16.9, rotors.THESIS_RADIUS, rotors.THESIS_RPM),
    "Knight & Hefner, 4 blades, 8 deg": (
        8.0,
        rotors.KNIGHT_HEFNER_RADIUS,
        rotors.KNIGHT_HEFNER_RPM,
    ),
}
TASKS = [f"{case}; {name}" for case in CASES for name in SETTINGS]
OUTPUTS = ("thrustCoefficient", "powerCoefficient")


def fly(rotor, task, resources):
    case, name = task.split("; ")
    pitch, radius, rpm = CASES[case]
    with rotors.own_folder() as folder:
        own = rotors.of_study(case, resources, folder)
        chosen = {**own, "collective": math.radians(pitch)}
        # V_h is that of the disc in hover, for all lines of a rotor.
        rotor.begin({**chosen, **SETTINGS["disc"]})
        hover = rotors.hover_speed(rotor.fly(OUTPUTS)[0], radius, rpm)
        chosen |= SETTINGS[name]
        rotor.begin(chosen)
        flights = [rotor.fly(OUTPUTS, **{"velocity[3]": ratio * hover}) for ratio in RATIOS]
        return {"flights": flights, "hover": hover, "models": rotor.models(chosen)}


def report(flown, figures):
    found = page.Report()
    cells = []
    for case in CASES:
        for name in SETTINGS:
            flights = flown[f"{case}; {name}"]["flights"]
            for place, quantity in enumerate(("CT", "CP")):
                values = [flights[RATIOS.index(r)][place] for r in SHOWN]
                cells.append([case, name, quantity, *(f"{v:.{(5, 6)[place]}f}" for v in values)])
    header = ["rotor", "flown as", "", *(f"V_c/V_h = {r:g}" for r in SHOWN)]
    draw(flown, figures / "axial-flight.svg")
    found.texts = {
        "axial-flight.table": page.table(header, cells, 3),
        **{
            f"axial-flight.{name.split(',')[0]}": flown[f"thesis, 15.3 deg; {name}"]["models"]
            for name in SETTINGS
        },
    }
    return found


def draw(flown, file):
    lines = [(f"; {name}", name, drawing.line(i)) for i, name in enumerate(SETTINGS)]
    draw_climb(flown, RATIOS, lines, 6.2, file)


def draw_climb(flown, ratios, lines, height, file):
    """CT and CP against the rate of climb, a column for each case. `lines`: end of the part's name,
    label and style."""
    figure, axes = drawing.figure(2, len(CASES), height=height, sharex=True)
    for column, case in enumerate(CASES):
        for place in (0, 1):
            axis = axes[place][column]
            for part, label, style in lines:
                values = [f[place] for f in flown[case + part]["flights"]]
                axis.plot(ratios, values, **style, label=label)
            drawing.coefficient_axis(axis)
            axis.set(xlim=(-1, 1))
            drawing.from_zero(axis)
        axes[0][column].set_title(case.replace("4 blades, ", ""), fontsize=9, pad=16)
        axes[1][column].set_xlabel("rate of climb $V_c/V_h$")
    axes[0][0].set_ylabel("thrust coefficient CT")
    axes[1][0].set_ylabel("power coefficient CP")
    drawing.legend_below(figure, axes[0][0], 3)
    drawing.save(figure, file)
