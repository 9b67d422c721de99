"""The errors at a glance: the one or two of each case that a user asks for first."""

import page

# Case, quantity, model: a row each; and why the model is off where it is.
CHOSEN = [
    ("Knight & Hefner 1937, hover", "CT", "table"),
    ("Knight & Hefner 1937, hover", "CQ", "table"),
    ("Castles & Gray 1951, hover", "CT", "both speeds"),
    ("Castles & Gray 1951, hover", "CQ rise", "both speeds"),
    ("Caradonna & Tung 1981, hover", "CT", "prandtlGlauert"),
    ("Castles & Gray 1951, descent", "collective", "measured (fitted), uniform"),
    ("Castles & Gray 1951, descent", "collective", "johnson, uniform"),
    ("PCA-2 autogiro (Wheatley 1934), forward flight", "coning", "pittPetersDynamic"),
    ("PCA-2 autogiro (Wheatley 1934), forward flight", "longitudinal flapping", "pittPetersDynamic"),
    ("PCA-2 autogiro (Wheatley 1934), forward flight", "lateral flapping", "pittPetersDynamic"),
    ("PCA-2 autogiro (Wheatley 1934), forward flight", "rotor speed", "pittPetersDynamic"),
]


def table(rows):
    by = {(e.case, e.quantity, e.model): e for e in rows}
    cells = []
    for key in CHOSEN:
        e = by[key]
        of = lambda value, signed=False: f"{page.number(value, e.unit, signed)} {e.unit}"
        cells.append(
            [e.case, e.quantity, f"`{e.model}`", e.points, of(e.mean, True), of(e.mean_absolute), of(e.rms), of(e.worst, True), of(e.scatter) if e.scatter is not None else "-"]
        )
    header = ["case", "quantity", "model", "points", "mean", "mean of magnitudes", "RMS", "worst", "scatter of the measurement"]
    return page.table(header, cells, 3)
