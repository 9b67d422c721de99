"""The page docs/importers.md: its table, and the notes on what an importer cannot do."""

import difflib
import os
import sys
from dataclasses import dataclass, field
from pathlib import Path

from environment import versions
from importers import IMPORTERS, NO_FUNCTION, NOTES, Importer

PAGE = Path(__file__).resolve().parents[4] / "docs" / "importers.md"
TEXT = Path(__file__).resolve().parent / "page.md"
MARK = "<!-- table and notes -->"
ALL_DIGITS = 17
REMEDY = (
    "run crates/program/tests/importers/measure.py with --all --write, and look at what changed"
)


@dataclass
class Row:
    importer: Importer
    # "yes" or "no" by column.
    cells: dict = field(default_factory=dict)
    # What the failing runs printed, by column.
    outputs: dict = field(default_factory=dict)
    # The digits of the thrusts that are those of FMPy.
    digits: list = field(default_factory=list)

    @property
    def thrust(self):
        if not self.digits:
            return "-"
        fewest = min(self.digits)
        return "equal" if fewest >= ALL_DIGITS else f"equal, {fewest} digits"


def text(rows, columns):
    """The page with these rows. Rows of importers that were not measured are those of the page."""
    by_name = {row.importer.name: row for row in rows}
    numbers = number_notes()
    lines = [
        table_line(["importer", "version", *columns, "thrust"]),
        table_line(["---"] * (len(columns) + 3)),
    ]
    for importer in IMPORTERS:
        row = by_name.get(importer.name)
        lines.append(line(row, columns, numbers) if row else published(importer))
    lines.append("")
    lines += [f"{numbers[note]}. {note}" for note in numbers]
    return TEXT.read_text().replace(MARK, "\n".join(lines))


def number_notes():
    """Notes by importer, each text once."""
    numbers = {}
    for importer in IMPORTERS:
        for (name, _), note in NOTES.items():
            if name == importer.name:
                numbers.setdefault(note.text, len(numbers) + 1)
    return numbers


def line(row, columns, numbers):
    cells = [cell(row, column, numbers) for column in columns]
    name, version = row.importer.name, versions()[row.importer.package]
    return table_line([name, version, *cells, row.thrust])


def cell(row, column, numbers):
    note = NOTES.get((row.importer.name, column))
    output = row.outputs[column]
    if NO_FUNCTION in output and not note:
        return "-"
    place = f"{row.importer.name}, {column}"
    if bool(note) != bool(output):
        what = (
            f"it has a note, but nothing failed: {note}" if note else f"no note says why:\n{output}"
        )
        sys.exit(f"{place}: {what}")
    if note and note.evidence not in output:
        sys.exit(f"{place}: the note is about {note.evidence!r}, but this was printed:\n{output}")
    return f"{row.cells[column]} ({numbers[note.text]})" if note else row.cells[column]


def table_line(cells):
    return "| " + " | ".join(cells) + " |"


def published(importer):
    """The line of an importer in the page."""
    start = f"| {importer.name} |"
    lines = PAGE.read_text().splitlines() if PAGE.is_file() else []
    return next((line for line in lines if line.startswith(start)), f"{start} not measured |")


def write(page):
    temporary = PAGE.with_suffix(".tmp")
    temporary.write_text(page)
    os.replace(temporary, PAGE)


def check(page):
    present = PAGE.read_text() if PAGE.is_file() else ""
    if present != page:
        lines = difflib.unified_diff(
            present.splitlines(), page.splitlines(), "docs/importers.md", "measured", lineterm=""
        )
        sys.exit("\n".join([*lines, f"docs/importers.md is not what was measured; {REMEDY}"]))
