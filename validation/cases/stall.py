"""The thesis' study of stalled stations (Lovaco 2017, section 4.2): the last stalled and the first
attached blade element in hover, counted from the root, and the collective at which stall begins.
"""

import math

import drawing
import page
import rotors

ELEMENTS = 120
SETTINGS = {
    "slopesByReynolds, annulusClosedForm": {**rotors.THESIS_CHOICES},
    "slopesByReynolds, annulus": {**rotors.THESIS_CHOICES, "models.inflow": "annulus"},
    "table, annulus": {"models.inflow": "annulus"},
}
# Root cutout, radius.
CASES = {
    "thesis": (0.1, rotors.THESIS_RADIUS),
    "Knight & Hefner, 4 blades": (1.0 / 6.0, rotors.KNIGHT_HEFNER_RADIUS),
}
TASKS = [f"{case}; {setting}" for case in CASES for setting in SETTINGS]
STATIONS = range(1, 21)
SWEEP = [10.0 + 0.25 * i for i in range(81)]
OUTPUTS = ("stalledRadius", "stalledFraction")


def fly(rotor, task, resources):
    case, setting = task.split("; ")
    with rotors.own_folder() as folder:
        own = rotors.of_study(case, resources, folder)
        chosen = {**own, **SETTINGS[setting], "numerics.elements": ELEMENTS}
        rotor.begin(chosen)
        stations = lambda name, pitch: rotor.fly(
            [f"station[{i}].{name}" for i in STATIONS], collective=math.radians(pitch)
        )
        stalled = lambda pitch: rotor.fly(OUTPUTS, collective=math.radians(pitch))
        pitches = rotors.THESIS_PITCHES
        return {
            "radius": stations("radius", pitches[0]),
            "angles": {p: [math.degrees(a) for a in stations("angleOfAttack", p)] for p in pitches},
            "stalled": {p: stalled(p) for p in pitches},
            "sweep": [stalled(p) for p in SWEEP],
            "models": rotor.models(chosen),
        }


def report(flown, figures):
    found = page.Report()
    cells = []
    for case, (cutout, radius) in CASES.items():
        width = (1.0 - cutout) / ELEMENTS
        in_metres = lambda r, radius=radius: f"{r:.3f} ({r * radius:.3f} m)"
        for setting in SETTINGS:
            own = flown[f"{case}; {setting}"]
            cell = [case, f"`{setting}`"]
            for pitch in rotors.THESIS_PITCHES:
                last, fraction = own["stalled"][pitch]
                first = last + width if last > 0.0 else cutout + 0.5 * width
                cell.append(in_metres(last) if last > 0.0 else "none")
                cell.append(in_metres(first) if first < 1.0 else "none")
                cell.append(f"{100.0 * fraction:.0f} %")
            onset = next(
                ((p, last) for p, (last, _) in zip(SWEEP, own["sweep"]) if last > 0.0), None
            )
            cell.append(
                f"{onset[0]:.2f} deg, at r/R {onset[1]:.2f}"
                if onset
                else f"above {SWEEP[-1]:g} deg"
            )
            cells.append(cell)
    of_pitch = [
        f"{what} at {pitch} deg"
        for pitch in rotors.THESIS_PITCHES
        for what in ("last stalled", "first attached", "span stalled")
    ]
    header = ["rotor", "lift, inflow", *of_pitch, "stall begins"]
    draw(flown, figures / "stall.svg")
    found.texts = {
        "stall.table": page.table(header, cells, 2),
        "stall.models": flown[TASKS[0]]["models"],
    }
    return found


def draw(flown, file):
    figure, (by_radius, by_pitch) = drawing.figure(1, 2, height=4.6)
    for j, case in enumerate(CASES):
        own = flown[f"{case}; slopesByReynolds, annulus"]
        for i, pitch in enumerate(rotors.THESIS_PITCHES):
            style = drawing.line(i) | {"marker": ("", "o")[j], "markersize": 3}
            by_radius.plot(
                own["radius"], own["angles"][pitch], **style, label=f"{case}, {pitch} deg"
            )
        for i, setting in enumerate(SETTINGS):
            values = [100.0 * fraction for _, fraction in flown[f"{case}; {setting}"]["sweep"]]
            style = drawing.line(i) | {"marker": ("", "o")[j], "markersize": 3, "markevery": 5}
            by_pitch.plot(SWEEP, values, **style, label=f"{case}, {setting}")
    for pitch in rotors.THESIS_PITCHES:
        by_pitch.axvline(pitch, color="0.6", linewidth=0.8)
    by_radius.set(xlabel="radius r/R", ylabel="angle of attack, deg", xlim=(0, 1), ylim=(0, None))
    by_pitch.set(
        xlabel="collective, deg",
        ylabel="share of the span that is stalled, %",
        xlim=(10, 30),
        ylim=(-2, 102),
    )
    for axis in (by_radius, by_pitch):
        axis.legend(loc="upper center", bbox_to_anchor=(0.5, -0.15), frameon=False, fontsize=7.5)
    drawing.save(figure, file)
