"""The errors at a glance: for each case those that a user asks for first."""

import drawing
import page

HOVER_1, HOVER_2 = "Knight & Hefner 1937, hover", "Castles & Gray 1951, hover"
HOVER_3 = "Caradonna & Tung 1981, hover"
HOVER_4, PROPELLER = "Harrington 1951, hover", "UIUC, APC 10x7 SF propeller"
DESCENT = "Castles & Gray 1951, descent"
TWISTED = "Castles & Gray 1951, descent, twisted"
FORWARD = "PCA-2 autogiro 1934, forward flight"
INFLOW = "Elliott & Althoff 1988, forward flight"
MEASURED = "the law of descent is fitted to these runs"
# Case, quantity and model as in the errors, the models in the table, the label in the figure.
CHOSEN = [
    (HOVER_1, "CT", "table", "defaults", "Knight & Hefner, hover: CT"),
    (HOVER_1, "CQ", "table", "defaults", "Knight & Hefner, hover: CQ"),
    (HOVER_1, "CQ at the measured CT", "table", "defaults", "the same at the measured CT"),
    (HOVER_2, "CT", "both speeds", "defaults", "Castles & Gray, hover: CT"),
    (HOVER_2, "CQ rise", "both speeds", "defaults", "Castles & Gray, hover: CQ rise"),
    (HOVER_3, "CT", "prandtlGlauert", "defaults", "Caradonna & Tung, hover: CT"),
    (
        HOVER_3,
        "CT",
        "prandtlGlauert with gessowMyers",
        "tip loss `gessowMyers`",
        "the same, gessowMyers",
    ),
    (HOVER_4, "CQ at the measured CT", "table", "defaults", "Harrington, hover: CQ"),
    *(
        (PROPELLER, quantity, "table", "defaults", f"propeller: {quantity}")
        for quantity in ("CT, static", "CP, static", "CT, J up to 0.65", "CP, J up to 0.65")
    ),
    (
        DESCENT,
        "collective",
        "measured (fitted), annulus",
        f"defaults; {MEASURED}",
        "descent: collective",
    ),
    (
        DESCENT,
        "collective",
        "measured (fitted), uniform",
        f"`uniform`; {MEASURED}",
        "the same, uniform",
    ),
    (
        DESCENT,
        "inflow, in deg of collective",
        "measured, fitted to the other half of the runs",
        "law `measured`, fitted to the other half of the runs",
        "the same, law fitted to the other runs",
    ),
    (
        DESCENT,
        "collective",
        "johnson, uniform",
        "`uniform`, descent `johnson`",
        "the same, johnson",
    ),
    (
        DESCENT,
        "collective",
        "momentum, uniform",
        "`uniform`, descent `momentum`",
        "the same, momentum",
    ),
    (TWISTED, "collective", "measured, annulus", "defaults", "descent, twisted: collective"),
    (TWISTED, "collective", "measured, uniform", "`uniform`", "the same, uniform"),
    (
        TWISTED,
        "collective",
        "johnson, uniform",
        "`uniform`, descent `johnson`",
        "the same, johnson",
    ),
    (FORWARD, "coning", "pittPetersDynamic", "`pittPetersDynamic`", "autogiro: coning"),
    (
        FORWARD,
        "longitudinal flapping",
        "pittPetersDynamic",
        "`pittPetersDynamic`",
        "autogiro: longitudinal flapping",
    ),
    (
        FORWARD,
        "lateral flapping",
        "pittPetersDynamic",
        "`pittPetersDynamic`",
        "autogiro: lateral flapping",
    ),
    (FORWARD, "lateral flapping", "annulus", "`annulus`", "the same, annulus"),
    (FORWARD, "shaft angle", "pittPetersDynamic", "`pittPetersDynamic`", "autogiro: shaft angle"),
    (FORWARD, "CT", "pittPetersDynamic", "`pittPetersDynamic`", "autogiro: CT"),
    (FORWARD, "rotor speed", "pittPetersDynamic", "`pittPetersDynamic`", "autogiro: rotor speed"),
    *(
        (INFLOW, f"inflow ratio less its mean, mu {mu}", model, name, short)
        for mu in (0.15, 0.35)
        for model, name, short in [
            ("annulus", "defaults", f"Elliott & Althoff, mu {mu}: inflow"),
            ("uniform", "`uniform`", "the same, uniform"),
        ]
    ),
]


def chosen(rows):
    by = {(e.case, e.quantity, e.model): e for e in rows}
    return [
        (by[case, quantity, model], name, short) for case, quantity, model, name, short in CHOSEN
    ]


def table(rows):
    cells = [
        [e.case, e.quantity, name, *page.statistics(e, with_unit=True)]
        for e, name, _ in chosen(rows)
    ]
    return page.table(["case", "quantity", "models", *page.STATISTICS], cells, 3)


def draw(rows, file):
    """RMS errors as bars; the mean error and the scatter of the measurement are marked on them."""
    units = {"%": "% of the measured value", "deg": "deg", "1": "inflow ratio less its mean"}
    heights = [sum(e.unit == unit for e, _, _ in chosen(rows)) for unit in units]
    figure, panels = drawing.figure(len(units), 1, height=6.8, height_ratios=heights)
    for axis, (unit, label) in zip(panels, units.items()):
        own = [(e, short) for e, _, short in chosen(rows) if e.unit == unit]
        for i, (e, _) in enumerate(own):
            once = i == 0
            axis.barh(
                i,
                e.rms,
                color="0.82",
                edgecolor="black",
                linewidth=0.6,
                label="RMS error" if once else None,
            )
            if unit != "1":  # The mean of the inflow is not compared.
                axis.plot(
                    [abs(e.mean)],
                    [i],
                    "kD",
                    markersize=4,
                    label="mean error, magnitude" if once else None,
                )
            if e.scatter is not None:
                style = {"color": "#b03a2e", "linewidth": 2.0}
                axis.plot(
                    [e.scatter] * 2,
                    [i - 0.4, i + 0.4],
                    **style,
                    label="scatter of the measurement" if once else None,
                )
        axis.set_yticks(range(len(own)), [short for _, short in own])
        axis.invert_yaxis()
        axis.grid(axis="y", visible=False)
        axis.set(xlabel=label, xlim=(0, None))
    drawing.legend_below(figure, panels[0], 3)
    drawing.save(figure, file)
