"""Counts the instructions of each row in benches/instructions.rs, in the widest lanes and in those that every processor has.

    python3 benches/instructions.py            compares with benches/instructions.csv: fails if a row costs over 5 % more
    python3 benches/instructions.py --record   writes benches/instructions.csv and the table in docs/performance.md

Needs valgrind, and gungraun-runner on the path (cargo install gungraun-runner).
"""

import argparse
import csv
import json
import os
import pathlib
import shutil
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent
RECORD = ROOT / "benches" / "instructions.csv"
PAGE = ROOT / "docs" / "performance.md"
BEGIN, END = "<!-- instructions -->\n", "<!-- end of instructions -->\n"
TOLERANCE = 1.05

# What each row is, in the order of the table. The collective moves at each step.
ROWS = {
    "hover_step annulus": "hover, annuli, 40 elements: set 3, step, get 6",
    "hover_step closed_form": "the same by the closed form",
    "evaluation pitt_peters": "one evaluation of 4 x 40 elements, flapping, Pitt & Peters",
    "azimuth_step pitt_peters": "azimuth step, 4 flapping blades x 40 elements, Pitt & Peters",
    "azimuth_step peters_he": "the same with Peters & He's wake",
    "azimuth_step uniform": "the same in uniform static inflow",
    "azimuth_step annulus": "the same in annuli",
    "azimuth_step finite_blades": "the same by momentum theory blade by blade",
    "azimuth_step prandtl_thrust": "with Pitt & Peters, and tip loss by Prandtl's thrust formula",
    "descent_step annulus_measured": "descent at 4 m/s, annuli, measured mass flow",
    "descent_step annulus_johnson": "the same by Johnson's vortex ring model",
    "start default": "start in hover, annuli",
    "start twelve_layers": "the same with polars for 12 Reynolds numbers",
    "start flapping_pitt_peters": "periodic start, flapping, Pitt & Peters",
    "start flapping_uniform": "the same in uniform static inflow",
    "derivative hover": "one directional derivative in hover, annuli",
    "derivative pitt_peters": "the same at the periodic start",
    "hover_step four_elements": "hover by the closed form, 4 elements: mostly the fixed part",
    "set_3_and_get_6 annulus": "set 3 and get 6 alone",
    "hover_step elements_10": "hover, annuli, 10 elements",
    "hover_step elements_100": "the same with 100 elements",
    "hover_step elements_1000": "the same with 1,000 elements",
    "azimuth_step elements_10": "azimuth step, 4 flapping blades x 10 elements, Pitt & Peters",
    "azimuth_step elements_1000": "the same with 1,000 elements",
    "azimuth_step blades_2": "azimuth step, 2 flapping blades x 40 elements, Pitt & Peters",
    "azimuth_step blades_8": "the same with 8 blades",
}


def counted(portable: bool) -> dict[str, int]:
    """The instructions of each row."""
    home = ROOT / "target" / "gungraun"
    shutil.rmtree(home, ignore_errors=True)
    lanes = ["--features", "portable"] if portable else []
    command = ["cargo", "bench", "--bench", "instructions", *lanes, "--", "--save-summary=json"]
    environment = os.environ | {"GUNGRAUN_HOME": str(home)}
    subprocess.run(command, cwd=ROOT, env=environment, check=True, stdout=subprocess.DEVNULL)
    counts = {}
    for file in home.rglob("summary.json"):
        summary = json.loads(file.read_text())
        (profile,) = summary["profiles"]
        count = profile["data"]["total"]["metrics"]["Ir"]["values"]["new"]
        counts[f"{summary['function_name']} {summary['id']}"] = count
    missing = ROWS.keys() - counts.keys()
    if missing:
        sys.exit(f"benches/instructions.rs gave no count for: {', '.join(sorted(missing))}")
    return counts


def table(counts: dict[str, tuple[int, int]]) -> str:
    """The counts as a table."""
    lines = ["| | widest lanes | every processor |", "|---|---:|---:|"]
    lines += [f"| {text} | {counts[row][0]:,} | {counts[row][1]:,} |" for row, text in ROWS.items()]
    return "\n".join(lines) + "\n"


def replace(file: pathlib.Path, text: str) -> None:
    """Writes a file, to a temporary name first."""
    draft = file.with_name(file.name + ".new")
    draft.write_text(text)
    draft.replace(file)


def record(counts: dict[str, tuple[int, int]]) -> None:
    """Keeps the counts."""
    lines = ["row,widest,portable"] + [f"{row},{a},{b}" for row, (a, b) in counts.items()]
    replace(RECORD, "\n".join(lines) + "\n")
    before, rest = PAGE.read_text().split(BEGIN)
    replace(PAGE, before + BEGIN + "\n" + table(counts) + "\n" + END + rest.split(END)[1])


def compare(counts: dict[str, dict[str, int]]) -> None:
    """Fails if a row costs more than recorded. `counts` by lanes and by row."""
    known = {line["row"]: line for line in csv.DictReader(RECORD.read_text().splitlines())}
    slower = []
    for lanes, of_rows in counts.items():
        for row, count in of_rows.items():
            limit = int(known[row][lanes])
            print(f"{row:34} {lanes:9} {count:12,} {count / limit:7.3f} of the recorded count")
            if count > TOLERANCE * limit:
                slower.append(f"{row} ({lanes}): {count:,} instead of {limit:,}")
    if slower:
        sys.exit("These rows cost over 5 % more instructions than recorded:\n" + "\n".join(slower))


def main() -> None:
    """Counts, and records or compares."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--record", action="store_true", help="keep the counts as the recorded ones")
    asked = parser.parse_args()
    has_avx2 = "avx2" in pathlib.Path("/proc/cpuinfo").read_text()
    if not has_avx2:
        print("This processor has no AVX2: the counts of the widest lanes cannot be taken.", file=sys.stderr)
        if asked.record:
            sys.exit(1)
    counts = {"widest": counted(portable=False)} if has_avx2 else {}
    counts["portable"] = counted(portable=True)
    if asked.record:
        record({row: (counts["widest"][row], counts["portable"][row]) for row in ROWS})
    else:
        compare(counts)


if __name__ == "__main__":
    main()
