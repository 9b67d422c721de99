"""What every importer is asked to fly, and how it is told and answers.

    python with_IMPORTER.py FMU MODE [TYPE NAME VALUE ...]

flies hover for one second in steps of 1 ms, after setting variables: TYPE is that of FMI. It prints
one line for each flight, "thrust" and the thrust at the end in newtons with all the digits that the
importer keeps. MODE is one of MODES. If the importer cannot do that, the script ends with an error.
"""

import sys

STEP = 1e-3
STEPS = 1000
MODES = {
    "load": "loaded, checked if the importer checks FMUs, and flown; it answers nothing",
    "fly": "once, in Co-Simulation",
    "exchange": "once, in Model Exchange",
    "two": "with two instances at once, the second with all values at their defaults",
    "again": "twice, each time with an instance of its own, one after the other",
    "reset": "twice with one instance, which is reset and set up again in between",
    "ssp": "once, as the only component of a system in an .ssp file",
    "controlled": "for five seconds, with a controller; it answers thrust and collective pitch",
    "workaround": "once, after changing what keeps the importer from setting strings",
}
AS_PYTHON = {
    "Real": float,
    "Integer": int,
    "Enumeration": int,
    "Boolean": lambda text: text == "true",
    "String": str,
}


class Impossible(Exception):
    """The importer has no function for this."""


class Variable:
    def __init__(self, kind, name, text):
        self.kind, self.name = kind, name
        self.value = AS_PYTHON[kind](text)


def arguments():
    """FMU, mode and variables from the command line."""
    fmu, mode, *rest = sys.argv[1:]
    variables = [Variable(*rest[i : i + 3]) for i in range(0, len(rest), 3)]
    return fmu, mode, variables


def answer(thrust):
    """Prints a thrust, a number or as the importer wrote it."""
    print("thrust", thrust if isinstance(thrust, str) else repr(float(thrust)), flush=True)


def main(modes):
    """Runs a function from `modes`, which takes the FMU and the variables and returns a list of
    thrusts."""
    fmu, mode, variables = arguments()
    if mode == "load":
        modes.get(mode, modes["fly"])(fmu, variables)
        return
    if mode not in modes:
        raise Impossible(f"no function to fly {MODES[mode]}")
    for thrust in modes[mode](fmu, variables):
        answer(thrust)
