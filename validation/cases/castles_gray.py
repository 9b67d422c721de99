"""Hover: the 6 ft rotor of Castles & Gray (1951, NACA TN 2474, Table V), two runs at each speed."""

import math

import numpy as np

import drawing
import errors
import measured
import page
import rotors

FILE = "castles-gray-1951-tn2474-tableV-hover-6ft.csv"
CASE = "Castles & Gray 1951, hover"
SPEEDS = (1200, 1600)
TASKS = [str(rpm) for rpm in SPEEDS]
COMPARED_FROM, STALL = 4.0, 11.0  # deg; at 12 deg the blades stall
PITCHES = [0.5 * i for i in range(26)]
OUTPUTS = ("thrustCoefficient", "torqueCoefficient")
QUANTITIES = (("CT", "CT"), ("CQ rise", "DeltaCQ"))


def runs(rpm):
    """Runs at a rotor speed, by number: their rows that have a pitch."""
    found = {}
    for row in measured.rows(FILE):
        if row["rpm"] == rpm and row["theta_075R_deg"] is not None:
            found.setdefault(int(row["run"]), []).append(row)
    return found


def is_compared(row):
    return COMPARED_FROM <= row["theta_075R_deg"] < STALL


def fly(rotor, task, _resources):
    parameters = {**rotors.CASTLES_GRAY, "rpm": float(task)}
    rotor.begin(parameters)

    def at(pitch):
        thrust, torque = rotor.fly(OUTPUTS, collective=math.radians(pitch))
        return thrust, torque - drag

    drag = 0.0
    drag = at(0.0)[1]  # untwisted symmetric blades: no thrust at zero pitch
    return {
        "line": [at(pitch) for pitch in PITCHES],
        "points": {
            n: [at(r["theta_075R_deg"]) for r in rows] for n, rows in runs(int(task)).items()
        },
        "models": rotor.models(parameters),
    }


def report(flown, figures):
    found = page.Report()
    pairs = {}
    for rpm in SPEEDS:
        for number, rows in runs(rpm).items():
            for row, computed in zip(rows, flown[str(rpm)]["points"][number]):
                for place, (_, column) in enumerate(QUANTITIES):
                    if is_compared(row) and row[column] is not None:
                        pairs.setdefault((rpm, place), []).append((computed[place], row[column]))
    for place, (quantity, column) in enumerate(QUANTITIES):
        for chosen in (SPEEDS, *((rpm,) for rpm in SPEEDS)):
            computed, values = zip(*(p for rpm in chosen for p in pairs[rpm, place]))
            name = "both speeds" if len(chosen) > 1 else f"{chosen[0]} rpm"
            spread = errors.rms(np.concatenate([scatter(rpm, column) for rpm in chosen]))
            found.errors.append(errors.percent(CASE, quantity, name, computed, values, spread))
    draw(flown, figures / "castles-gray-hover.svg")
    found.texts = {
        "castles-gray.errors": page.error_table(found.errors),
        "castles-gray.models": flown["1200"]["models"],
    }
    return found


def scatter(rpm, column):
    """Scatter of a single measurement, %, from the logarithms of the two runs."""
    logarithms = [
        [
            (r["theta_075R_deg"], math.log(r[column]))
            for r in rows
            if is_compared(r) and r[column] is not None
        ]
        for rows in runs(rpm).values()
    ]
    return 100.0 * errors.spread(logarithms)


def draw(flown, file):
    figure, axes = drawing.figure(2, 2, height=6.4, sharex=True)
    for column, rpm in enumerate(SPEEDS):
        for place, (label, name) in enumerate(
            (("thrust coefficient CT", "CT"), ("rise of torque coefficient CQ", "DeltaCQ"))
        ):
            axis = axes[place][column]
            line = [values[place] for values in flown[str(rpm)]["line"]]
            axis.plot(PITCHES, line, **drawing.line(0), label="computed")
            for i, (number, rows) in enumerate(runs(rpm).items()):
                usable = [r for r in rows if r[name] is not None]
                style = drawing.points(i) | {"linestyle": ":", "linewidth": 0.7}
                values = [r["theta_075R_deg"] for r in usable], [r[name] for r in usable]
                axis.plot(*values, **style, label=f"measured, run {number}")
            axis.set(ylabel=label, xlim=(0, 12.5), ylim=(0, None))
            drawing.coefficient_axis(axis)
        axes[0][column].set_title(f"{rpm} rpm")
        axes[0][column].legend(loc="upper left")
        axes[1][column].set_xlabel("blade pitch at 0.75 R, deg")
    drawing.save(figure, file)
