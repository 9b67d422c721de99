"""The measured data in data/; the header of each file names its source and its traps."""

import csv
from pathlib import Path

FOLDER = Path(__file__).resolve().parent / "data"


def rows(file):
    """Rows of a file as dictionaries: numbers as floats, empty cells as None, other text as is."""
    with (FOLDER / file).open(encoding="utf-8") as text:
        return [
            {name: _value(cell) for name, cell in row.items()}
            for row in csv.DictReader(line for line in text if not line.startswith("#"))
        ]


def _value(cell):
    if not cell:
        return None
    try:
        return float(cell)
    except ValueError:
        return cell
