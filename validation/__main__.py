"""Flies every measured case with the packaged FMU in FMPy, and writes the validation page.

    python validation --fmu HelicopterRotor.fmu --out FOLDER

writes validation.md, its figures in validation/, summary.md (the part in the README), errors.csv
and element-times.csv into FOLDER. While it flies it prints lines `progress DONE TOTAL NAME`.
"""

import csv
import dataclasses
import sys
from pathlib import Path

# The rotor and the measured data are those of the examples.
sys.path.insert(0, str(Path(__file__).resolve().parent.parent / "fmu-examples"))

import flights
import page
import summary
from cases import CASES, elements
from rotor import RotorError
from script import command_line


def main():
    parser = command_line(__doc__, out="folder to write into", out_required=True)
    arguments = parser.parse_args()
    try:
        flown = flights.fly_all(arguments.fmu)
    except RotorError as error:
        sys.exit(str(error))
    write(flown, arguments.out)


def write(flown, folder):
    figures = folder / "validation"
    figures.mkdir(parents=True, exist_ok=True)
    reports = {case: module.report(flown[case], figures) for case, module in CASES.items()}
    rows = [e for report in reports.values() for e in report.errors]
    texts = {name: text for report in reports.values() for name, text in report.texts.items()}
    short = summary.table(rows)
    summary.draw(rows, figures / "summary.svg")
    texts["summary"] = short
    (folder / "validation.md").write_text(page.fill(texts), encoding="utf-8")
    (folder / "summary.md").write_text(short + "\n", encoding="utf-8")
    names = [field.name for field in dataclasses.fields(rows[0])]
    write_csv(folder / "errors.csv", names, [dataclasses.astuple(e) for e in rows])
    timed = elements.times(flown["elements"])
    write_csv(folder / "element-times.csv", ["flight", "elements", "seconds per solve"], timed)


def write_csv(file, names, rows):
    with file.open("w", newline="", encoding="utf-8") as out:
        writer = csv.writer(out)
        writer.writerow(names)
        writer.writerows(rows)


if __name__ == "__main__":
    main()
