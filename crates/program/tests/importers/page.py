"""The page docs/importers.md: its table, and the notes on what an importer cannot do."""

import difflib
import os
import sys
from dataclasses import dataclass, field
from pathlib import Path

from environment import versions
from importers import NO_FUNCTION, Importer

PAGE = Path(__file__).resolve().parents[4] / "docs" / "importers.md"
TEXT = Path(__file__).resolve().parent / "page.md"
MARKS = ["<!-- table and notes -->", "<!-- table and notes of FMI 3.0 -->"]
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


@dataclass
class Table:
    importers: list
    # By importer and column.
    notes: dict
    # The rows that were measured. Others are those of the page.
    rows: list
    columns: list
    # Behind the names of the importers.
    suffix: str

    def text(self):
        by_name = {row.importer.name: row for row in self.rows}
        numbers = self.number_notes()
        lines = [
            table_line(["importer", "version", *self.columns, "thrust"]),
            table_line(["---"] * (len(self.columns) + 3)),
        ]
        for importer in self.importers:
            row = by_name.get(importer.name)
            name = importer.name + self.suffix
            lines.append(self.line(row, name, numbers) if row else published(name))
        lines.append("")
        lines += [f"{numbers[note]}. {note}" for note in numbers]
        return "\n".join(lines)

    def number_notes(self):
        """Notes by importer, each text once."""
        numbers = {}
        for importer in self.importers:
            for (name, _), note in self.notes.items():
                if name == importer.name:
                    numbers.setdefault(note.text, len(numbers) + 1)
        return numbers

    def line(self, row, name, numbers):
        cells = [self.cell(row, column, numbers) for column in self.columns]
        version = versions()[row.importer.package]
        return table_line([name, version, *cells, row.thrust])

    def cell(self, row, column, numbers):
        note = self.notes.get((row.importer.name, column))
        output = row.outputs[column]
        if NO_FUNCTION in output and not note:
            return "-"
        place = f"{row.importer.name}{self.suffix}, {column}"
        if bool(note) != bool(output):
            what = (
                f"it has a note, but nothing failed: {note}"
                if note
                else f"no note says why:\n{output}"
            )
            sys.exit(f"{place}: {what}")
        if note and note.evidence not in output:
            sys.exit(
                f"{place}: the note is about {note.evidence!r}, but this was printed:\n{output}"
            )
        return f"{row.cells[column]} ({numbers[note.text]})" if note else row.cells[column]


def text(*tables):
    """The page with these tables."""
    page = TEXT.read_text()
    for mark, table in zip(MARKS, tables, strict=True):
        page = page.replace(mark, table.text())
    return page


def table_line(cells):
    return "| " + " | ".join(cells) + " |"


def published(name):
    """The line of an importer in the page."""
    start = f"| {name} |"
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
