"""Hover: the two short blades of Caradonna & Tung (1981, NASA TM-81232).

Thrust against tip Mach number, and lift along the radius.
"""

import math

import numpy as np

import drawing
import errors
import measured
import page
import rotors

THRUST = "caradonna-tung-1981-tm81232-CT.csv"
LIFT = "caradonna-tung-1981-tm81232-Cl.csv"
CASE = "Caradonna & Tung 1981, hover"
RADIUS = 1.143
RULES = ("none", "prandtlGlauert", "karmanTsien", "laitone")
# Not a rule of compressibility: no lift at the tip, with prandtlGlauert.
NO_TIP = "prandtlGlauert with gessowMyers"
TASKS = [*RULES, NO_TIP]
PITCHES = (5, 8)
# rev/min; the CT of this point is read from a misprint in the report: drawn, but not compared.
MISPRINT = 2268.0
MACHS = [0.40 + 0.02 * i for i in range(26)]
RPM = 1250.0
STATIONS = range(1, 21)


def parameters(task, pitch, rpm, mach):
    """The temperature of the air follows from the tip Mach number: a^2 = gamma R T."""
    temperature = (rpm * math.pi / 30.0 * RADIUS / mach) ** 2 / (1.4 * 287.053)
    return {
        "geometry.file": "caradonna-tung.toml",
        "flapping.precone": math.radians(0.5),
        "models.compressibility": "prandtlGlauert" if task == NO_TIP else task,
        "models.tipLoss": "gessowMyers" if task == NO_TIP else "prandtl",
        "collective": math.radians(pitch),
        "rpm": rpm,
        **rotors.air(1.225, temperature),
    }


def fly(rotor, task, _resources):
    def thrust(pitch, rpm, mach):
        rotor.begin(parameters(task, pitch, rpm, mach))
        return rotor.fly(("thrustCoefficient",))[0]

    # Along the lines the rotor speed gives the Mach number, in air of 16 degrees Celsius as in the
    # tests.
    sound = math.sqrt(1.4 * 287.053 * 289.0)
    speed = lambda mach: mach * sound / RADIUS * 30.0 / math.pi
    found = {
        "lines": {str(p): [thrust(p, speed(m), m) for m in MACHS] for p in PITCHES},
        "points": [
            thrust(r["collective_deg"], r["rpm"], r["M_tip"]) for r in measured.rows(THRUST)
        ],
    }
    case = measured.rows(LIFT)[0]
    chosen = parameters(task, case["collective_deg"], case["rpm"], case["M_tip"])
    rotor.begin(chosen)
    stations = lambda name: rotor.fly([f"station[{i}].{name}" for i in STATIONS])
    found["radius"], found["lift"] = stations("radius"), stations("liftCoefficient")
    found["models"] = rotor.models(chosen)
    return found


def report(flown, figures):
    found = page.Report()
    rows = measured.rows(THRUST)
    for task in TASKS:
        pairs = [(c, r["CT"]) for c, r in zip(flown[task]["points"], rows) if r["rpm"] != MISPRINT]
        found.errors.append(errors.percent(CASE, "CT", task, *zip(*pairs)))
    lift = measured.rows(LIFT)
    radius, values = [r["r_over_R"] for r in lift], [r["Cl"] for r in lift]
    for task in TASKS:
        there = np.interp(radius, flown[task]["radius"], flown[task]["lift"])
        found.errors.append(errors.percent(CASE, "section lift", task, there, values))
    draw(flown, rows, figures / "caradonna-tung.svg")
    found.texts = {
        "caradonna-tung.errors": page.error_table(found.errors),
        "caradonna-tung.models": flown["prandtlGlauert"]["models"],
    }
    return found


def draw(flown, rows, file):
    figure, (by_mach, by_radius) = drawing.figure(1, 2, height=4.1)
    for i, task in enumerate(TASKS):
        for pitch in PITCHES:
            line = flown[task]["lines"][str(pitch)]
            by_mach.plot(
                MACHS, line, **drawing.line(i), label=task if pitch == PITCHES[0] else None
            )
        by_radius.plot(flown[task]["radius"], flown[task]["lift"], **drawing.line(i))
    for i, pitch in enumerate(PITCHES):
        own = [(r["M_tip"], r["CT"]) for r in rows if r["collective_deg"] == pitch]
        by_mach.plot(*zip(*own), **drawing.points(i), label=f"measured, {pitch} deg")
        for mach, thrust in [
            (r["M_tip"], r["CT"])
            for r in rows
            if r["rpm"] == MISPRINT and r["collective_deg"] == pitch
        ]:
            by_mach.annotate(
                "misprint", (mach, thrust), xytext=(0, -13), textcoords="offset points", ha="center"
            )
        top = flown["none"]["lines"][str(pitch)][0]
        by_mach.annotate(
            f"{pitch} deg", (MACHS[0], top), xytext=(2, -11), textcoords="offset points"
        )
    lift = measured.rows(LIFT)
    by_radius.plot([r["r_over_R"] for r in lift], [r["Cl"] for r in lift], **drawing.points(1))
    by_mach.set(
        xlabel="tip Mach number", ylabel="thrust coefficient CT", ylim=(0, None), xlim=(0.38, 0.92)
    )
    drawing.coefficient_axis(by_mach)
    by_radius.set(
        xlabel="radius r/R", ylabel="section lift coefficient", ylim=(0, None), xlim=(0.15, 1)
    )
    by_radius.set_title("8 deg, tip Mach number 0.439", fontsize=9)
    drawing.legend_below(figure, by_mach, 3)
    drawing.save(figure, file)
