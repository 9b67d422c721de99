"""Flies the FMU in importers, and makes the table of docs/importers.md from what they do.

    python measure.py FMU --environment FOLDER [--all] [--write]

Without --all only the importers are measured that install within a minute, and the rows of the
others are those of the page. With --write the page is replaced; otherwise this ends with an error
if the page is not what was measured. The importers are installed into FOLDER, once.
"""

import argparse
import os
import subprocess
import sys
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from decimal import Decimal
from pathlib import Path

import page
from environment import Environment
from importers import ECOS, FMPY, IMPORTERS, NOTES, NOTES_OF_FMI3, OF_FMI3

NUMBERS = [
    ("Real", "geometry.radius", "0.8"),
    ("Integer", "geometry.numberOfBlades", "3"),
    ("Boolean", "flapping.enabled", "true"),
]
STRING = [("String", "airfoil.file", "naca0012.polar")]
ENUMERATION = [("Enumeration", "models.inflow", "3")]
# From rest, so that the thrust still changes after one second.
TEXT = "models.inflow=pittPetersDynamic;flapping.enabled=true;initialization=rest"
SETTINGS = [("String", "settings", TEXT)]
# SETTINGS, or NUMBERS for an importer that cannot set strings.
VARIED = None


@dataclass
class Check:
    mode: str
    variables: list
    # The flights with which its thrusts are compared: the variables of each, in Co-Simulation.
    expected: list
    # Largest relative difference from them; 0: equal in all digits that the importer keeps.
    tolerance: float = 0.0


# The columns of the table: "yes" if all checks pass.
COLUMNS = {
    "loads": [Check("load", [], [])],
    "CS": [Check("fly", [], [[]])],
    "ME": [Check("exchange", [], [[]]), Check("exchange", VARIED, [VARIED], 1e-4)],
    "numbers": [Check("fly", NUMBERS, [NUMBERS])],
    "strings": [Check("fly", STRING, [STRING])],
    "enumerations": [Check("fly", ENUMERATION, [ENUMERATION])],
    "`settings`": [Check("fly", SETTINGS, [SETTINGS])],
    "two instances": [Check("two", VARIED, [VARIED, []])],
    "second run": [Check("again", VARIED, [VARIED, VARIED])],
    "reset": [Check("reset", VARIED, [VARIED, VARIED])],
    "SSP": [Check("ssp", VARIED, [VARIED])],
}
# Of the file of FMI 3.0.
COLUMNS_OF_FMI3 = {
    title: COLUMNS[title]
    for title in [
        "loads",
        "CS",
        "ME",
        "numbers",
        "strings",
        "enumerations",
        "`settings`",
        "second run",
    ]
}
WORKAROUND = Check("workaround", SETTINGS, [SETTINGS])


@dataclass
class Flight:
    """What an importer did: the thrusts as it wrote them, and what it printed."""

    has_succeeded: bool
    thrusts: list
    output: str


class Measurement:
    def __init__(self, environment, fmu):
        self.environment = environment
        self.fmu = fmu
        self.references = {}
        for variables in ([], NUMBERS, STRING, ENUMERATION, SETTINGS):
            flight = self.fly(FMPY, "fly", variables)
            if not flight.has_succeeded:
                sys.exit(f"FMPy did not fly {variables}:\n{flight.output}")
            self.references[str(variables)] = flight.thrusts[0]
        if len(set(self.references.values())) < len(self.references):
            sys.exit(f"some variables have no effect: {self.references}")

    def fly(self, importer, mode, variables):
        words = [word for variable in variables for word in variable]
        command = [*self.environment.command(importer), self.fmu, mode, *words]
        done = subprocess.run(
            command,
            capture_output=True,
            text=True,
            env=os.environ | self.environment.variables,
            timeout=300,
        )
        lines = [line.split() for line in done.stdout.splitlines() if line.startswith("thrust ")]
        thrusts = [words[1] for words in lines]
        output = done.stdout + done.stderr
        if done.returncode < 0:
            output += f"\nended by signal {-done.returncode}"
        return Flight(done.returncode == 0, thrusts, output)

    def row(self, importer, columns):
        """The row of an importer in a table."""
        row = page.Row(importer)
        for title, checks in columns.items():
            failures = [self.failure(row, check) for check in checks]
            failed = [failure for failure in failures if failure]
            row.cells[title] = "no" if failed else "yes"
            row.outputs[title] = "\n".join(failed)
        if not importer.sets_strings and not self.failure(row, WORKAROUND):
            row.cells["`settings`"] = "yes"
        return row

    def failure(self, row, check):
        """What is printed by a check that fails; empty if it passes."""

        def filled(variables):
            varied = SETTINGS if row.importer.sets_strings else NUMBERS
            return varied if variables is VARIED else variables

        flight = self.fly(row.importer, check.mode, filled(check.variables))
        expected = [self.references[str(filled(variables))] for variables in check.expected]
        pairs = list(zip(flight.thrusts, expected))
        is_complete = flight.has_succeeded and len(flight.thrusts) == len(expected)
        if is_complete and all(is_equal(*pair, check.tolerance) for pair in pairs):
            if check.tolerance == 0.0:
                row.digits += [digits(*pair) for pair in pairs]
            return ""
        return f"{flight.output}\nexpected {expected}"


def check_controller(*measurements):
    """Ecos flies both files with one controller, which holds 80 N."""
    flights = [measurement.fly(ECOS, "controlled", []) for measurement in measurements]
    answers = [flight.thrusts for flight in flights]
    is_held = all(flight.has_succeeded for flight in flights) and answers[0] == answers[1]
    if not is_held or abs(float(answers[0][0]) - 80.0) > 1e-9:
        sys.exit(f"Ecos with a controller: {answers}\n{flights[0].output}{flights[1].output}")


ALL_DIGITS = 17


def digits(text, expected):
    """The number of significant digits of a thrust; ALL_DIGITS if it is the expected one to the
    last bit."""
    if float(text) == float(expected):
        return ALL_DIGITS
    return len(Decimal(text).as_tuple().digits)


def is_equal(text, expected, tolerance):
    """Whether a thrust is the expected one: within a tolerance, or in all of its digits."""
    if tolerance > 0.0:
        return abs(float(text) / float(expected) - 1.0) < tolerance
    count = digits(text, expected)
    return count >= 6 and float(f"{float(expected):.{count - 1}e}") == float(text)


def main():
    parser = argparse.ArgumentParser(description="Flies the FMU in importers.")
    parser.add_argument("fmu")
    parser.add_argument("--environment", required=True)
    parser.add_argument("--all", action="store_true", help="the slow importers, too")
    parser.add_argument("--write", action="store_true", help="replace docs/importers.md")
    arguments = parser.parse_args()

    importers = [
        importer
        for importer in IMPORTERS
        if arguments.all or (importer.is_quick and sys.version_info >= importer.python)
    ]
    environment = Environment(arguments.environment)
    environment.install(importers)
    of_fmi2 = Measurement(environment, arguments.fmu)
    file = Path(arguments.fmu)
    of_fmi3 = Measurement(environment, file.with_name(f"{file.stem}-fmi3{file.suffix}"))
    if of_fmi2.references != of_fmi3.references:
        sys.exit(f"FMI 3.0 differs: {of_fmi2.references} {of_fmi3.references}")
    with ThreadPoolExecutor(2) as pool:
        rows = list(pool.map(lambda importer: of_fmi2.row(importer, COLUMNS), importers))
        both = [importer for importer in OF_FMI3 if importer in importers]
        others = list(pool.map(lambda importer: of_fmi3.row(importer, COLUMNS_OF_FMI3), both))
    if ECOS in importers:
        check_controller(of_fmi2, of_fmi3)
    text = page.text(
        page.Table(IMPORTERS, NOTES, rows, list(COLUMNS), ""),
        page.Table(OF_FMI3, NOTES_OF_FMI3, others, list(COLUMNS_OF_FMI3), " with FMI 3.0"),
    )
    if arguments.write:
        page.write(text)
    else:
        page.check(text)
    print(f"{len(rows)} importers measured")


if __name__ == "__main__":
    main()
