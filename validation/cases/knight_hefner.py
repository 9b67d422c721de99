"""Hover: the rotors of Knight & Hefner (1937, NACA TN 626)."""

import math
from pathlib import Path

import numpy as np
from scipy.interpolate import PchipInterpolator

import drawing
import errors
import measured
import page
import rotors

FILE = "knight-hefner-1937-tn626-hover.csv"
CASE = "Knight & Hefner 1937, hover"
BLADES = (3, 4)
LIFTS = ("table", "twoPi", "slopesByReynolds")
TASKS = [f"{lift} {blades}" for lift in LIFTS for blades in BLADES]
COMPARED_FROM = 4.0  # deg; below, the measured thrust is too small for differences in per cent
PITCHES = [0.5 * i for i in range(31)]
OUTPUTS = ("thrustCoefficient", "torqueCoefficient")
SETTING = 0.05  # deg, accuracy to which the blades were set, by the report


def points(blades):
    """Rows (pitch in deg, CT, CQ) of a rotor."""
    rows = [row for row in measured.rows(FILE) if row["blades"] == blades]
    return [(row["theta_deg"], row["CT_rotor"], row["CQ_rotor"]) for row in rows]


def fly(rotor, task, resources):
    lift, blades = task.split()
    with rotors.own_folder() as folder:
        if lift == "slopesByReynolds":
            parameters = rotors.knight_hefner_slopes(blades, resources, Path(folder))
        else:
            parameters = rotors.knight_hefner(blades)
        parameters["models.lift"] = lift
        rotor.begin(parameters)
        at = lambda pitch: rotor.fly(OUTPUTS, collective=math.radians(pitch))
        return {
            "line": [at(pitch) for pitch in PITCHES],
            "points": [at(pitch) for pitch, _, _ in points(int(blades))],
            "models": rotor.models(parameters),
        }


def report(flown, figures):
    found = page.Report()
    compared = {blades: [p for p in points(blades) if p[0] >= COMPARED_FROM] for blades in BLADES}
    everything = [p for blades in BLADES for p in compared[blades]]
    for lift in LIFTS:
        computed = []
        for blades in BLADES:
            flights = flown[f"{lift} {blades}"]["points"]
            computed += [c for c, p in zip(flights, points(blades)) if p[0] >= COMPARED_FROM]
        for place, quantity in enumerate(("CT", "CQ")):
            pairs = [c[place] for c in computed], [p[1 + place] for p in everything]
            found.errors.append(
                errors.percent(CASE, quantity, lift, *pairs, scatter=setting(compared, place))
            )
        at_thrust = [
            torque_at(flown[f"{lift} {blades}"]["line"], p[1])
            for blades in BLADES
            for p in compared[blades]
        ]
        found.errors.append(
            errors.percent(
                CASE, "CQ at the measured CT", lift, at_thrust, [p[2] for p in everything]
            )
        )
    draw(flown, figures / "knight-hefner.svg")
    found.texts = {
        "knight-hefner.errors": page.error_table(found.errors),
        "knight-hefner.models": flown["table 3"]["models"],
        "knight-hefner.low": low_pitch(flown),
    }
    return found


def torque_at(line, thrust):
    """CQ at a CT on a computed line, which is (CT, CQ) by rising pitch."""
    thrusts, torques = np.array(line).T
    if not thrusts[0] <= thrust <= thrusts[-1]:
        raise ValueError(
            f"Knight & Hefner: no computed pitch up to {PITCHES[-1]:g} deg has CT = {thrust:g}"
        )
    return float(PchipInterpolator(thrusts, torques)(thrust))


def setting(compared, place):
    """RMS effect, %, of the blade angle's accuracy, from a parabola through the points."""
    shares = []
    for rows in compared.values():
        pitch, values = np.array([(p[0], p[1 + place]) for p in rows]).T
        slope = np.polyval(np.polyder(np.polyfit(pitch, values, 2)), pitch)
        shares += list(100.0 * slope * SETTING / values)
    return errors.rms(shares)


def low_pitch(flown):
    """The points at low pitch, which are not in the errors, with the default lift."""
    rows = []
    for blades in BLADES:
        for (pitch, ct, cq), (own_ct, own_cq) in zip(
            points(blades), flown[f"table {blades}"]["points"]
        ):
            if pitch >= COMPARED_FROM:
                continue
            of = lambda own, said: (
                page.number(100.0 * (own / said - 1.0), "%", True) if said else "-"
            )
            rows.append(
                [
                    blades,
                    f"{pitch:g}",
                    f"{ct:.5f}",
                    f"{own_ct:.5f}",
                    of(own_ct, ct),
                    f"{cq:.6f}",
                    f"{own_cq:.6f}",
                    of(own_cq, cq),
                ]
            )
    header = ["blades", "pitch, deg", "CT measured", "CT", "%", "CQ measured", "CQ", "%"]
    return page.table(header, rows, 0)


def draw(flown, file):
    figure, axes = drawing.figure(2, 2, height=6.4, sharex=True)
    for column, blades in enumerate(BLADES):
        for row, (name, label) in enumerate((("CT", "thrust"), ("CQ", "torque"))):
            axis = axes[row][column]
            for i, lift in enumerate(LIFTS):
                line = [values[row] for values in flown[f"{lift} {blades}"]["line"]]
                axis.plot(PITCHES, line, **drawing.line(i), label=f"lift {lift}")
            pitch, values = zip(*[(p[0], p[1 + row]) for p in points(blades)])
            axis.plot(pitch, values, **drawing.points(0), label="measured")
            axis.set(ylabel=f"{label} coefficient {name}", ylim=(0, None), xlim=(0, 12.5))
            drawing.coefficient_axis(axis)
        axes[0][column].set_title(f"{blades} blades")
        axes[1][column].set_xlabel("blade pitch, deg")
    axes[0][0].legend(loc="upper left")
    drawing.save(figure, file)
