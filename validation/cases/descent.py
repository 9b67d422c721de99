"""Vertical descent at fixed thrust: Castles & Gray (1951, NACA TN 2474, Table I).

The thrust is fixed as in the tests: a root search finds the collective at which the FMU has the
measured CT.
"""

import math
import sys
from pathlib import Path

import numpy as np
from scipy.optimize import brentq

import drawing
import errors
import measured
import page
import rotors

from . import castles_gray

FILE = "castles-gray-1951-tn2474-tableI-descent-6ft.csv"
CASE = "Castles & Gray 1951, descent"
LAW_FOLDER = Path(__file__).resolve().parents[2] / "provenance" / "descent-law"
LAWS = [
    ("momentum", "uniform"),
    ("measured", "uniform"),
    ("measured", "annulus"),
    ("measured", "finiteBlades"),
    ("johnson", "uniform"),
]
HELD_OUT = "measured, fitted to the other half of the runs"
DRAWN = ["momentum uniform", "measured uniform", "johnson uniform", "measured annulus"]
TASKS = [" ".join(law) for law in LAWS] + ["law"]
OUTPUTS = ("thrustCoefficient", "torqueCoefficient", "inducedVelocity")
LOWEST, HIGHEST = -12.0, 25.0  # deg of collective
# CT and speed of the lines.
LINES = ((0.002, 1200.0), (0.004, 1200.0), (0.005, 1600.0))
DESCENTS = [i / 20 for i in range(53)]
OTHERS = "**the other runs**"
# Relative error of the thrust. Where no collective gives the thrust, the search ends at a jump.
JUMP = 0.01


def rows():
    return [
        r
        for r in measured.rows(FILE)
        if r["lambda_z"] is not None and r["theta_075R_deg"] is not None
    ]


def fly(rotor, task, _resources):
    if task == "law":
        return halves()
    law, inflow = task.split()
    parameters = {**rotors.CASTLES_GRAY, "models.descent": law, "models.inflow": inflow}

    def trimmed(thrust, rpm, ratio):
        """Collective (deg), rise of CQ, v/v_h, and whether some collective gives this thrust, at CT
        and V_d/v_h."""
        speed = rotors.hover_speed(thrust, rotors.CASTLES_GRAY_RADIUS, rpm)
        at = lambda pitch: rotor.fly(
            OUTPUTS, collective=math.radians(pitch), rpm=rpm, **{"velocity[3]": -ratio * speed}
        )
        surplus = lambda pitch: at(pitch)[0] - thrust
        # The lowest collective with this thrust. Higher ones are beyond stall or, in momentum
        # theory beyond 2 v_h, on another branch than the windmill brake state.
        high = next(p for p in np.arange(LOWEST, HIGHEST) if surplus(p) > 0.0)
        pitch = brentq(surplus, high - 1.0, high, xtol=1e-4)
        own, torque, induced = at(pitch)
        return pitch, torque - drag(rpm), induced / speed, abs(own / thrust - 1.0) < JUMP

    def drag(rpm):
        if rpm not in drags:
            still = {"collective": 0.0, "rpm": rpm, "velocity[3]": 0.0}
            drags[rpm] = rotor.fly(OUTPUTS, **still)[1]
        return drags[rpm]

    drags = {}
    rotor.begin(parameters)
    return {
        "points": [trimmed(r["CT"], r["rpm"], r["lambda_z"]) for r in rows()],
        "lines": [[trimmed(ct, rpm, d) for d in DESCENTS] for ct, rpm in LINES],
        "models": rotor.models(parameters),
    }


def halves():
    """The law of descent fitted to half of the runs, and its errors on either half.

    Errors are those of v/v_h, each run divided by its own hover value, and the equivalent ones in
    deg of collective at the thrust of the run: 3/2 of the change in inflow ratio, from
    CT = sigma a/2 (theta_0.75/3 - lambda/2).
    """
    sys.path.insert(0, str(LAW_FOLDER))
    import fit

    runs = fit.measured()
    thrust = {int(r["run"]): r["CT"] for r in measured.rows(FILE)}
    names = sorted(runs)

    def judged(g, chosen):
        parts = [fit.errors(lambda d: fit.induced(g, d), [runs[n]]) for n in chosen]
        worth = [
            1.5 * math.degrees(1.0) * math.sqrt(0.5 * thrust[n]) * p for n, p in zip(chosen, parts)
        ]
        return np.concatenate(parts).tolist(), np.concatenate(worth).tolist()

    found = [("all runs", "the same", *judged(fit.law(fit.fit([runs[n] for n in names])), names))]
    for own in (names[0::2], names[1::2]):
        g = fit.law(fit.fit([runs[n] for n in own]))
        others = [n for n in names if n not in own]
        said = f"runs {', '.join(map(str, own))}"
        found.append((said, "the same", *judged(g, own)))
        found.append((said, OTHERS, *judged(g, others)))
    return found


def report(flown, figures):
    found = page.Report()
    data = rows()
    with_torque = [i for i, r in enumerate(data) if r["DeltaCQ"] is not None]
    with_inflow = [i for i, r in enumerate(data) if r["lambda_i_thrust"] is not None]
    hover = {
        ct: np.mean(
            [
                r["DeltaCQ"]
                for r in data
                if r["CT"] == ct and r["lambda_z"] == 0 and r["DeltaCQ"] is not None
            ]
        )
        for ct in {r["CT"] for r in data}
    }
    hover_torque = [hover[data[i]["CT"]] for i in with_torque]
    for law, inflow in LAWS:
        points = flown[f"{law} {inflow}"]["points"]
        name = f"{law} (fitted), {inflow}" if law == "measured" else f"{law}, {inflow}"
        found.errors += [
            errors.degrees(
                CASE,
                "collective",
                name,
                [p[0] for p in points],
                [r["theta_075R_deg"] for r in data],
                scatter(data, lambda r: r["theta_075R_deg"]),
            ),
            errors.percent_of(
                hover_torque,
                CASE,
                "torque rise",
                name,
                [points[i][1] for i in with_torque],
                [data[i]["DeltaCQ"] for i in with_torque],
                "hover",
                scatter(
                    [data[i] for i in with_torque], lambda r: 100.0 * r["DeltaCQ"] / hover[r["CT"]]
                ),
            ),
            errors.percent(
                CASE,
                "induced velocity",
                name,
                [points[i][2] for i in with_inflow],
                [data[i]["lambda_i_thrust"] for i in with_inflow],
                scatter(
                    [data[i] for i in with_inflow], lambda r: 100.0 * math.log(r["lambda_i_thrust"])
                ),
            ),
        ]
    found.errors.sort(
        key=lambda e: ("collective", "torque rise", "induced velocity").index(e.quantity)
    )
    draw(flown, data, figures)
    halves_table = [
        [own, on, f"{errors.rms(velocity):.2f}", f"{errors.rms(angle):.2f}"]
        for own, on, velocity, angle in flown["law"]
    ]
    unseen = np.concatenate([angle for _, on, _, angle in flown["law"] if on == OTHERS])
    turns = scatter(data, lambda r: r["theta_075R_deg"])
    found.errors.append(
        errors.degrees(CASE, "inflow, in deg of collective", HELD_OUT, unseen, 0.0 * unseen, turns)
    )
    jumps = {
        f"{law}, {inflow}": sum(not p[3] for p in flown[f"{law} {inflow}"]["points"])
        for law, inflow in LAWS
    }
    found.texts = {
        "descent.errors": page.error_table([e for e in found.errors if e.model != HELD_OUT]),
        "descent.hover-torque": hover_torques(data),
        "descent.models": flown["measured uniform"]["models"],
        "descent.halves": page.table(
            ["fitted to", "judged on", "RMS of v/v_h", "equivalent collective, deg RMS"],
            halves_table,
            2,
        ),
        "descent.jumps": ", ".join(
            f"{count} with `{name}`" for name, count in jumps.items() if count
        )
        or "none",
    }
    return found


def hover_torques(data):
    """The rise of torque in hover at CT = 0.004: measured in Table I, interpolated in Table V."""
    of_runs = [
        r["DeltaCQ"]
        for r in data
        if r["CT"] == 0.004 and r["lambda_z"] == 0.0 and r["DeltaCQ"] is not None
    ]
    there = []
    for rpm in castles_gray.SPEEDS:
        for rows_of_run in castles_gray.runs(rpm).values():
            own = [(r["CT"], r["DeltaCQ"]) for r in rows_of_run if r["DeltaCQ"] is not None]
            there.append(float(np.interp(0.004, *zip(*own))))
    between = lambda values: f"{min(values):.6f} to {max(values):.6f}"
    return f"{between(there)} in Table V and {between(of_runs)} in Table I"


def scatter(data, quantity):
    """Scatter of a single measurement, from the differences between runs at the same CT."""
    found = []
    for ct in sorted({r["CT"] for r in data}):
        runs = {}
        for r in data:
            if r["CT"] == ct:
                runs.setdefault(r["run"], []).append((r["lambda_z"], quantity(r)))
        found.append(errors.spread(list(runs.values())))
    return errors.rms(np.concatenate(found))


def draw(flown, data, figures):
    for name, place, column, label in (
        ("collective", 0, "theta_075R_deg", "collective at 0.75 R, deg"),
        ("torque", 1, "DeltaCQ", "rise of torque coefficient CQ"),
    ):
        figure, axes = drawing.figure(1, len(LINES), height=4.0, sharex=True)
        for axis, (ct, _), i in zip(axes, LINES, range(len(LINES))):
            panel(axis, flown, i, place)
            own = [r for r in data if r["CT"] == ct and r[column] is not None]
            axis.plot(
                [r["lambda_z"] for r in own],
                [r[column] for r in own],
                **thin_points(),
                label="measured",
            )
            axis.set_title(f"CT = {ct}")
            axis.set(xlabel="rate of descent $V_d/v_h$", xlim=(0, 2.6))
            if place == 1:
                drawing.coefficient_axis(axis)
        axes[0].set_ylabel(label)
        drawing.legend_below(figure, axes[0], 3)
        drawing.save(figure, figures / f"descent-{name}.svg")

    figure, axis = drawing.figure(1, 1, width=6.4, height=4.2)
    panel(axis, flown, 1, 2)
    for i, (ct, _) in enumerate(LINES):
        own = [r for r in data if r["CT"] == ct and r["lambda_i_thrust"] is not None]
        values = [r["lambda_z"] for r in own], [r["lambda_i_thrust"] for r in own]
        axis.plot(*values, **drawing.points(i) | {"markersize": 3.5}, label=f"measured, CT = {ct}")
    axis.set(
        xlabel="rate of descent $V_d/v_h$",
        ylabel="induced velocity $v/v_h$",
        xlim=(0, 2.6),
        ylim=(0, 2.9),
    )
    axis.legend(ncols=2)
    drawing.save(figure, figures / "descent-inflow.svg")


def thin_points():
    return drawing.points(0) | {"markersize": 3.5, "markeredgewidth": 0.7}


def panel(axis, flown, line, place):
    for i, task in enumerate(DRAWN):
        values = [p[place] if p[3] else math.nan for p in flown[task]["lines"][line]]
        # Momentum theory jumps to the windmill brake state at 2 v_h.
        cut = DESCENTS.index(2.0) + 1 if task.startswith("momentum") else len(DESCENTS)
        axis.plot(
            DESCENTS[:cut], values[:cut], **drawing.line(i), label="law " + task.replace(" ", ", ")
        )
        axis.plot(DESCENTS[cut:], values[cut:], **drawing.line(i))
