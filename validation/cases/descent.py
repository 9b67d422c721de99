"""Vertical descent at fixed thrust: Castles & Gray (1951, NACA TN 2474), the rotor without twist
(Table I), to which the law of descent is fitted, and the one with 12 deg of washout (Table III).

The thrust is fixed as in the tests: a root search finds the collective at which the FMU has the
measured CT.
"""

import math
import sys
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from scipy.optimize import brentq

import drawing
import errors
import measured
import page
import rotors

from . import castles_gray

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
OUTPUTS = ("thrustCoefficient", "torqueCoefficient", "inducedVelocity")
LOWEST, HIGHEST = -12.0, 25.0  # deg of collective


@dataclass(frozen=True)
class Tested:
    """A rotor in the tests: the name of its case, its measurements and parameters, what the law
    `measured` is called there, CT and speed of the lines, and their rates of descent."""

    case: str
    file: str
    parameters: dict
    measured: str
    lines: tuple
    descents: list

    def rows(self):
        return [
            r
            for r in measured.rows(self.file)
            if r["lambda_z"] is not None and r["theta_075R_deg"] is not None
        ]


TESTED = {
    "untwisted": Tested(
        "Castles & Gray 1951, descent",
        "castles-gray-1951-tn2474-tableI-descent-6ft.csv",
        rotors.CASTLES_GRAY,
        "measured (fitted)",
        ((0.002, 1200.0), (0.004, 1200.0), (0.005, 1600.0)),
        [i / 20 for i in range(53)],
    ),
    "twisted": Tested(
        "Castles & Gray 1951, descent, twisted",
        "castles-gray-1951-tn2474-tableIII-descent-6ft-twist12-runs-65-67.csv",
        rotors.CASTLES_GRAY_TWISTED,
        "measured",
        ((0.002, 1200.0), (0.005, 1200.0)),
        [i / 20 for i in range(65)],
    ),
}
TASKS = [f"{law} {inflow} {name}" for name in TESTED for law, inflow in LAWS] + ["law"]
OTHERS = "**the other runs**"
TWISTED_RUNS = "**the twisted rotor**"
# Relative error of the thrust. Where no collective gives the thrust, the search ends at a jump.
JUMP = 0.01


def fly(rotor, task, _resources):
    if task == "law":
        return halves()
    law, inflow, name = task.split()
    tested = TESTED[name]
    parameters = {**tested.parameters, "models.descent": law, "models.inflow": inflow}

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
        """CQ without thrust in still air."""
        if rpm not in drags:
            at = lambda pitch: rotor.fly(
                OUTPUTS, collective=math.radians(pitch), rpm=rpm, **{"velocity[3]": 0.0}
            )
            pitch = brentq(lambda pitch: at(pitch)[0], -3.0, 3.0, xtol=1e-4)
            drags[rpm] = at(pitch)[1]
        return drags[rpm]

    drags = {}
    rotor.begin(parameters)
    return {
        "points": [trimmed(r["CT"], r["rpm"], r["lambda_z"]) for r in tested.rows()],
        "lines": [[trimmed(ct, rpm, d) for d in tested.descents] for ct, rpm in tested.lines],
        "models": rotor.models(parameters),
    }


def halves():
    """The law of descent fitted to half of the runs, and its errors on either half and on the
    twisted rotor, as those of v/v_h, each run divided by its own hover value, and as the equivalent
    ones in deg of collective."""
    sys.path.insert(0, str(LAW_FOLDER))
    import fit

    runs = fit.measured()
    twisted = list(fit.measured(fit.TWISTED).values())
    names = sorted(runs)

    def judged(g, chosen):
        found = fit.errors(g, chosen)
        worth = fit.collective(found, chosen)
        return np.concatenate(found).tolist(), np.concatenate(worth).tolist()

    rows = []
    for own in (names, names[0::2], names[1::2]):
        g = fit.law(fit.fit([runs[n] for n in own]))
        others = [runs[n] for n in names if n not in own]
        said = f"runs {', '.join(map(str, own))}" if others else "all runs"
        rows.append((said, "the same", *judged(g, [runs[n] for n in own])))
        if others:
            rows.append((said, OTHERS, *judged(g, others)))
        rows.append((said, TWISTED_RUNS, *judged(g, twisted)))
    return rows


def report(flown, figures):
    found = page.Report()
    for name, tested in TESTED.items():
        found.errors += errors_of(tested, {law: flown[f"{' '.join(law)} {name}"] for law in LAWS})
    draw(flown, figures)
    halves_table = [
        [own, on, f"{errors.rms(velocity):.2f}", f"{errors.rms(angle):.2f}"]
        for own, on, velocity, angle in flown["law"]
    ]
    untwisted = TESTED["untwisted"]
    unseen = np.concatenate([angle for _, on, _, angle in flown["law"] if on == OTHERS])
    turns = scatter(untwisted.rows(), lambda r: r["theta_075R_deg"])
    quantity = "inflow, in deg of collective"
    found.errors.append(
        errors.degrees(untwisted.case, quantity, HELD_OUT, unseen, 0.0 * unseen, turns)
    )
    found.texts = {
        "descent.hover-torque": hover_torques(untwisted.rows()),
        "descent.models": flown["measured uniform untwisted"]["models"],
        "descent.halves": page.table(
            ["fitted to", "judged on", "RMS of v/v_h", "equivalent collective, deg RMS"],
            halves_table,
            2,
        ),
    }
    for name, tested in TESTED.items():
        own = [e for e in found.errors if e.case == tested.case and e.model != HELD_OUT]
        jumps = {
            ", ".join(law): sum(not p[3] for p in flown[f"{' '.join(law)} {name}"]["points"])
            for law in LAWS
        }
        found.texts[f"descent.errors-{name}"] = page.error_table(own)
        found.texts[f"descent.jumps-{name}"] = (
            ", ".join(f"{count} with `{law}`" for law, count in jumps.items() if count) or "none"
        )
    return found


def errors_of(tested, flown):
    """The errors of a rotor with each law: collective, torque and induced velocity."""
    found = []
    data = tested.rows()
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
    for (law, inflow), own in flown.items():
        points = own["points"]
        name = f"{tested.measured if law == 'measured' else law}, {inflow}"
        found += [
            errors.degrees(
                tested.case,
                "collective",
                name,
                [p[0] for p in points],
                [r["theta_075R_deg"] for r in data],
                scatter(data, lambda r: r["theta_075R_deg"]),
            ),
            errors.percent_of(
                hover_torque,
                tested.case,
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
                tested.case,
                "induced velocity",
                name,
                [points[i][2] for i in with_inflow],
                [data[i]["lambda_i_thrust"] for i in with_inflow],
                scatter(
                    [data[i] for i in with_inflow], lambda r: 100.0 * math.log(r["lambda_i_thrust"])
                ),
            ),
        ]
    found.sort(key=lambda e: ("collective", "torque rise", "induced velocity").index(e.quantity))
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
    """Scatter of a single measurement, from the differences between runs at the same CT; None where
    there is one run at each CT."""
    found = []
    for ct in sorted({r["CT"] for r in data}):
        runs = {}
        for r in data:
            if r["CT"] == ct:
                runs.setdefault(r["run"], []).append((r["lambda_z"], quantity(r)))
        found.append(errors.spread(list(runs.values())))
    found = np.concatenate(found)
    return errors.rms(found) if found.size else None


def draw(flown, figures):
    for column, place, stem, label in (
        ("theta_075R_deg", 0, "collective", "collective at 0.75 R, deg"),
        ("DeltaCQ", 1, "torque", "rise of torque coefficient CQ"),
    ):
        for name, suffix in (("untwisted", ""), ("twisted", "-twisted")):
            tested = TESTED[name]
            file = figures / f"descent-{stem}{suffix}.svg"
            draw_rotor(flown, name, tested, (column, place, label), file)

    figure, axes = drawing.figure(1, 2, height=4.4, sharey=True)
    for axis, (name, tested), line in zip(axes, TESTED.items(), (1, 0)):
        panel(axis, flown, name, line, 2)
        for i, ct in enumerate(sorted({ct for ct, _ in tested.lines})):
            own = [
                r for r in tested.rows() if r["CT"] == ct and r["lambda_i_thrust"] is not None
            ]
            values = [r["lambda_z"] for r in own], [r["lambda_i_thrust"] for r in own]
            style = drawing.points(i) | {"markersize": 3.5}
            axis.plot(*values, **style, label=f"measured, CT = {ct}")
        axis.set(xlabel="rate of descent $V_d/v_h$", xlim=(0, tested.descents[-1]), ylim=(0, 3.5))
        axis.set_title(f"{name}; lines at CT = {tested.lines[line][0]}")
        axis.legend(fontsize="x-small")
    axes[0].set_ylabel("induced velocity $v/v_h$")
    drawing.save(figure, figures / "descent-inflow.svg")


def draw_rotor(flown, name, tested, quantity, file):
    column, place, label = quantity
    figure, axes = drawing.figure(1, len(tested.lines), height=4.0, sharex=True)
    for axis, (ct, _), i in zip(axes, tested.lines, range(len(tested.lines))):
        panel(axis, flown, name, i, place)
        own = [r for r in tested.rows() if r["CT"] == ct and r[column] is not None]
        axis.plot(
            [r["lambda_z"] for r in own],
            [r[column] for r in own],
            **thin_points(),
            label="measured",
        )
        axis.set_title(f"CT = {ct}")
        axis.set(xlabel="rate of descent $V_d/v_h$", xlim=(0, tested.descents[-1]))
        if place == 1:
            drawing.coefficient_axis(axis)
    axes[0].set_ylabel(label)
    drawing.legend_below(figure, axes[0], 3)
    drawing.save(figure, file)


def thin_points():
    return drawing.points(0) | {"markersize": 3.5, "markeredgewidth": 0.7}


def panel(axis, flown, name, line, place):
    descents = TESTED[name].descents
    for i, task in enumerate(DRAWN):
        lines = flown[f"{task} {name}"]["lines"]
        values = [p[place] if p[3] else math.nan for p in lines[line]]
        # Momentum theory jumps to the windmill brake state at 2 v_h.
        cut = descents.index(2.0) + 1 if task.startswith("momentum") else len(descents)
        axis.plot(
            descents[:cut], values[:cut], **drawing.line(i), label="law " + task.replace(" ", ", ")
        )
        axis.plot(descents[cut:], values[cut:], **drawing.line(i))
