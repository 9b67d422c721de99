"""The cases, one file each, in the order of the page.

Each has
    TASKS                        names of its parts, each of which any process can fly
    fly(rotor, task, resources)  the result of a part, as plain lists and numbers
    report(flown, figures)       its texts and errors (page.Report) from {task: result}; draws its
                                 figures
"""

from . import (
    autogiro,
    axial_flight,
    caradonna_tung,
    castles_gray,
    descent,
    elements,
    forward_inflow,
    harrington,
    knight_hefner,
    lift_slopes,
    propeller,
    stall,
)

CASES = {
    module.__name__.rsplit(".", 1)[-1]: module
    for module in (
        knight_hefner,
        castles_gray,
        caradonna_tung,
        harrington,
        propeller,
        descent,
        autogiro,
        forward_inflow,
        elements,
        axial_flight,
        lift_slopes,
        stall,
    )
}
