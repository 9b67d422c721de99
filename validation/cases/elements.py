"""The thesis' study of the number of blade elements (Lovaco 2017, section 4.1.1), in hover.

Times differ from run to run, so they are not on the page: they are written beside the errors.
"""

import math
import time

import drawing
import page
import rotors

COUNTS = [*range(10, 121, 10), 150, 200, 300, 400, 500, 700, 1000]
SHOWN = [10, 20, 30, 40, 60, 80, 100, 120, 200, 500, 1000]
INFLOWS = ("annulusClosedForm", "annulus")
CASES = {
    "thesis, 15.3 deg": 15.3,
    "thesis, 16.9 deg": 16.9,
    "Knight & Hefner, 3 blades, 8 deg": 8.0,
    "Knight & Hefner, 4 blades, 8 deg": 8.0,
}
TASKS = [f"{case}; {inflow}" for case in CASES for inflow in INFLOWS]
OUTPUTS = ("thrustCoefficient", "powerCoefficient")
SOLVES = 200


def fly(rotor, task, resources):
    case, inflow = task.split("; ")
    with rotors.own_folder() as folder:
        own = rotors.of_study(case, resources, folder)
        chosen = {
            **own,
            **rotors.THESIS_CHOICES,
            "models.inflow": inflow,
            "collective": math.radians(CASES[case]),
        }
        values, times = [], []
        for count in COUNTS:
            rotor.begin({**chosen, "numerics.elements": count})
            values.append(rotor.fly(OUTPUTS))
            begin = time.perf_counter()
            for i in range(SOLVES):
                # The pitch alternates, because unchanged inputs need no solution.
                rotor.fly((), collective=math.radians(CASES[case]) + 1e-4 * (i % 2))
            times.append((time.perf_counter() - begin) / SOLVES)
        return {"values": values, "times": times, "models": rotor.models(chosen)}


def settled(values, digits=3):
    """The smallest count from which all values are within half a unit of this digit of the last."""
    unit = 10.0 ** (math.floor(math.log10(abs(values[-1]))) + 1 - digits)
    away = [i for i, v in enumerate(values) if abs(v - values[-1]) > 0.5 * unit]
    return COUNTS[max(away, default=-1) + 1]


def report(flown, figures):
    found = page.Report()
    cells = []
    for case in CASES:
        for inflow in INFLOWS:
            thrust, power = zip(*flown[f"{case}; {inflow}"]["values"])
            for name, values in (("CT", thrust), ("CP", power)):
                own = [f"{values[COUNTS.index(n)]:.4e}" for n in SHOWN]
                cells.append([case, f"`{inflow}`", name, *own, settled(values)])
    header = ["rotor", "inflow", "", *map(str, SHOWN), "three digits stand from"]
    draw(flown, figures / "elements.svg")
    found.texts = {
        "elements.table": page.table(header, cells, 3),
        "elements.models": flown[TASKS[0]]["models"],
    }
    return found


def times(flown):
    """Time per solve through FMPy, s: rows of (case and inflow, number of elements, time)."""
    return [(task, n, t) for task in TASKS for n, t in zip(COUNTS, flown[task]["times"])]


def draw(flown, file):
    figure, axes = drawing.figure(1, 2, height=4.4, sharex=True)
    for axis, place, name in zip(axes, (0, 1), ("CT", "CP")):
        for i, case in enumerate(CASES):
            for inflow, marker in zip(INFLOWS, ("", "o")):
                values = [v[place] for v in flown[f"{case}; {inflow}"]["values"]]
                away = [100.0 * abs(v / values[-1] - 1.0) for v in values[:-1]]
                style = drawing.line(i) | {"marker": marker, "markersize": 3, "linewidth": 1.1}
                axis.plot(COUNTS[:-1], away, **style, label=f"{case}, {inflow}")
        axis.set(xscale="log", yscale="log", xlabel="blade elements")
        axis.set_ylabel(f"difference of {name} from that of {COUNTS[-1]} elements, %")
        axis.set_xticks(
            [10, 20, 40, 80, 120, 300, 700], labels=["10", "20", "40", "80", "120", "300", "700"]
        )
        axis.minorticks_off()
    drawing.legend_below(figure, axes[0], 2)
    drawing.save(figure, file)
