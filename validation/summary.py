"""The errors at a glance: of each case those that a user asks for first."""

import drawing
import page

HOVER_1, HOVER_2 = "Knight & Hefner 1937, hover", "Castles & Gray 1951, hover"
HOVER_3 = "Caradonna & Tung 1981, hover"
DESCENT = "Castles & Gray 1951, descent"
FORWARD = "PCA-2 autogiro 1934, forward flight"
# Case, quantity and model as in the errors, and the models' names here.
CHOSEN = [
    (HOVER_1, "CT", "table", "defaults"),
    (HOVER_1, "CQ", "table", "defaults"),
    (HOVER_2, "CT", "both speeds", "defaults"),
    (HOVER_2, "CQ rise", "both speeds", "defaults"),
    (HOVER_3, "CT", "prandtlGlauert", "defaults"),
    (DESCENT, "collective", "measured (fitted), annulus", "defaults; the law of descent is fitted to these runs"),
    (DESCENT, "collective", "measured (fitted), uniform", "`uniform`; the law of descent is fitted to these runs"),
    (DESCENT, "collective", "johnson, uniform", "`uniform`, descent `johnson`"),
    (DESCENT, "collective", "momentum, uniform", "`uniform`, descent `momentum`"),
    (FORWARD, "coning", "pittPetersDynamic", "`pittPetersDynamic`"),
    (FORWARD, "longitudinal flapping", "pittPetersDynamic", "`pittPetersDynamic`"),
    (FORWARD, "lateral flapping", "pittPetersDynamic", "`pittPetersDynamic`"),
    (FORWARD, "lateral flapping", "annulus", "`annulus`"),
    (FORWARD, "shaft angle", "pittPetersDynamic", "`pittPetersDynamic`"),
    (FORWARD, "CT", "pittPetersDynamic", "`pittPetersDynamic`"),
    (FORWARD, "rotor speed", "pittPetersDynamic", "`pittPetersDynamic`"),
]


def chosen(rows):
    by = {(e.case, e.quantity, e.model): e for e in rows}
    return [(by[key], name) for *key, name in CHOSEN for key in [tuple(key)]]


def table(rows):
    cells = []
    for e, name in chosen(rows):
        said = lambda value, signed=False: f"{page.number(value, e.unit, signed)} {e.unit}"
        scatter = said(e.scatter) if e.scatter is not None else "-"
        means = said(e.mean, True), said(e.mean_absolute), said(e.rms), said(e.worst, True)
        cells.append([e.case, e.quantity, name, e.points, *means, scatter])
    header = ["case", "quantity", "models", "points", "mean", "mean of magnitudes", "RMS", "worst", "scatter"]
    return page.table(header, cells, 3)


def draw(rows, file):
    """RMS errors as bars, the mean as a mark on them, and beside them the scatter of the measurement."""
    figure, panels = drawing.figure(2, 1, width=8.2, height=5.6, height_ratios=[7, 9])
    for axis, unit, label in zip(panels, ("%", "deg"), ("% of the measured value", "deg")):
        own = [(e, name) for e, name in chosen(rows) if e.unit == unit]
        for i, (e, name) in enumerate(own):
            once = i == 0
            axis.barh(i, e.rms, color="0.82", edgecolor="black", linewidth=0.6, label="RMS error" if once else None)
            axis.plot([abs(e.mean)], [i], "kD", markersize=4, label="mean error, magnitude" if once else None)
            if e.scatter is not None:
                style = {"color": "#b03a2e", "linewidth": 2.0}
                axis.plot([e.scatter] * 2, [i - 0.4, i + 0.4], **style, label="scatter of the measurement" if once else None)
        plain = lambda name: name.split(";")[0].replace("`", "")
        axis.set_yticks(range(len(own)), [f"{e.case}: {e.quantity}, {plain(name)}" for e, name in own])
        axis.invert_yaxis()
        axis.grid(axis="y", visible=False)
        axis.set(xlabel=label, xlim=(0, None))
    drawing.legend_below(figure, panels[0], 3)
    drawing.save(figure, file)
