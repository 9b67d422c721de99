"""A propeller: APC 10x7 SF, measured by UIUC, static and against the advance ratio J."""

import drawing
import errors
import measured
import page
import rotors

STATIC = "uiuc-apcsf-10x7-static.csv"
ADVANCE = ("uiuc-apcsf-10x7-advance-6006rpm.csv", "uiuc-apcsf-10x7-advance-6014rpm.csv")
CASE = "UIUC, APC 10x7 SF propeller"
DIAMETER = 0.254
TASKS = ["static", *ADVANCE]
# The J of the line, and up to where differences in per cent mean something: CT is 0 at J = 0.87.
JS = [0.025 * i for i in range(40)]
COMPARED_TO = 0.65
OUTPUTS = ("propellerThrustCoefficient", "propellerPowerCoefficient", "propellerEfficiency")
# Neither the pressure nor the temperature of the tests is in the files: sea level.
PARAMETERS = {"geometry.file": "apc-10x7sf.toml", **rotors.air(1.225, 288.15)}
QUANTITIES = (("CT", "CT"), ("CP", "CP"))


def speed(file):
    """rev/min of a file, which is in its name."""
    return float(file.rsplit("-", 1)[1].removesuffix("rpm.csv"))


def fly(rotor, task, _resources):
    rotor.begin({**PARAMETERS, "rpm": 6000.0})
    if task == "static":
        rows = measured.rows(STATIC)
        points = [rotor.fly(OUTPUTS, rpm=row["rpm"]) for row in rows]
        return {"points": points, "models": rotor.models(PARAMETERS)}
    rpm = speed(task)

    def at(advance):
        velocity = advance * rpm / 60.0 * DIAMETER
        return rotor.fly(OUTPUTS, rpm=rpm, **{"velocity[3]": velocity})

    return {
        "line": [at(j) for j in JS],
        "points": [at(row["J"]) for row in measured.rows(task)],
    }


def report(flown, figures):
    found = page.Report()
    for place, (quantity, column) in enumerate(QUANTITIES):
        pairs = [
            (computed[place], row[column])
            for computed, row in zip(flown["static"]["points"], measured.rows(STATIC))
        ]
        found.errors.append(errors.percent(CASE, f"{quantity}, static", "table", *zip(*pairs)))
        pairs = [
            (computed[place], row[column])
            for file in ADVANCE
            for computed, row in zip(flown[file]["points"], measured.rows(file))
            if row["J"] <= COMPARED_TO
        ]
        name = f"{quantity}, J up to {COMPARED_TO}"
        found.errors.append(errors.percent(CASE, name, "table", *zip(*pairs)))
    draw(flown, figures / "propeller.svg")
    found.texts = {
        "propeller.errors": page.error_table(found.errors),
        "propeller.models": flown["static"]["models"],
    }
    return found


def draw(flown, file):
    figure, axes = drawing.figure(1, 3, height=3.6)
    names = ("CT", "CP", "eta")
    labels = ("thrust coefficient CT", "power coefficient CP", "efficiency")
    for place, (axis, name, label) in enumerate(zip(axes, names, labels)):
        line = [values[place] for values in flown[ADVANCE[0]]["line"]]
        axis.plot(JS, line, **drawing.line(0), label="computed, 6006 rpm")
        for i, source in enumerate(ADVANCE):
            rows = [r for r in measured.rows(source) if r[name] >= 0.0]
            values = [r["J"] for r in rows], [r[name] for r in rows]
            axis.plot(*values, **drawing.points(i), label=f"measured, {speed(source):.0f} rpm")
        axis.set(xlabel="advance ratio J", ylabel=label, xlim=(0, 1), ylim=(0, None))
    drawing.legend_below(figure, axes[0], 3)
    drawing.save(figure, file)
