"""Draws where the instructions of a step go: docs/performance.svg.

    python3 benches/profile.py

Needs valgrind, addr2line (binutils) and matplotlib.
"""

import collections
import json
import pathlib
import re
import subprocess
import sys
import tempfile

import matplotlib

matplotlib.use("svg")
import matplotlib.pyplot as plt  # noqa: E402

ROOT = pathlib.Path(__file__).resolve().parent.parent
FLIGHTS = {
    "hover, annuli": "hover, annuli",
    "azimuth step, 4 flapping blades,\nPitt & Peters": "azimuth step, Pitt & Peters",
}
# A part of the computation, and the functions that belong to it; the innermost function decides.
PARTS = {
    "table look-ups": ["Lookup::value", "Table::"],
    "arc tangent, sine, cosine": ["elementary::atan2", "elementary::sin_cos"],
    "exp, ln, arc cosine": ["elementary::exp", "elementary::ln", "elementary::acos"],
    "compressibility": ["Compressibility::"],
    "section coefficients": ["Airfoil::", "Element", "Section::"],
    "tip loss": ["TipLoss::", "induced_at_blade"],
    "momentum balance": ["annulus::", "closed_form::", "pitt_peters::", "AxialBalance"],
    "flow at sections, sums": ["BladeFlow::", "Sweep", "BladeSums", "Induction::", "AllElements", "section_load"],
    "outputs and states": ["outputs::", "publish", "state_vector::", "computation::"],
    "the C interface": ["fmi2::", "host::"],
}


def binary() -> str:
    """The benchmark's binary, built."""
    command = ["cargo", "bench", "--bench", "times", "--no-run", "--message-format=json"]
    output = subprocess.run(command, cwd=ROOT, check=True, capture_output=True, text=True).stdout
    messages = [json.loads(line) for line in output.splitlines()]
    found = [m["executable"] for m in messages if m.get("target", {}).get("name") == "times"]
    return found[-1]


def counts(program: str, flight: str) -> collections.Counter:
    """Instructions by address, within the steps of a flight."""
    with tempfile.TemporaryDirectory() as folder:
        file = pathlib.Path(folder) / "callgrind.out"
        subprocess.run(
            ["valgrind", "--tool=callgrind", "--dump-instr=yes", f"--callgrind-out-file={file}",
             "--toggle-collect=*Flight*exchange*", program, "--bench", "--test", flight],
            check=True, capture_output=True,
        )
        lines = file.read_text().splitlines()
    by_address: collections.Counter = collections.Counter()
    address, is_call, objects, here = 0, False, {}, ""
    for line in lines:
        if named := re.match(r"c?ob=(\(\d+\)) (.*)", line):
            objects[named[1]] = named[2]
        if line.startswith("ob="):
            here = objects[re.match(r"ob=(\(\d+\))", line)[1]]
        elif line.startswith("calls="):
            is_call = True
        elif cost := re.match(r"(0x[0-9a-f]+|[+-]\d+|\*) \S+ (\d+)$", line):
            if cost[1].startswith("0x"):
                address = int(cost[1], 16)
            elif cost[1] != "*":
                address += int(cost[1])
            if not is_call:
                by_address[address if here == program else None] += int(cost[2])
            is_call = False
    return by_address


def parts(program: str, by_address: collections.Counter) -> dict[str, int]:
    """Instructions by part."""
    addresses = [a for a in by_address if a is not None]
    command = ["addr2line", "-f", "-i", "-C", "-a", "-e", program]
    text = "\n".join(hex(a) for a in addresses)
    output = subprocess.run(command, input=text, check=True, capture_output=True, text=True).stdout
    frames: dict[int, list[str]] = {}
    for line in output.splitlines():
        if line.startswith("0x"):
            names = frames.setdefault(int(line, 16), [])
        else:
            names.append(line)
    sums = dict.fromkeys([*PARTS, "the rest"], 0)
    for address, count in by_address.items():
        names = frames.get(address, [])[0::2]
        of = (part for name in names for part, keys in PARTS.items() if any(k in name for k in keys))
        sums[next(of, "the rest")] += count
    return sums


def main() -> None:
    """Counts and draws."""
    program = binary()
    rows = {}
    for label, flight in FLIGHTS.items():
        rows[label] = parts(program, counts(program, flight))
        total = sum(rows[label].values())
        if not total:
            sys.exit(f"no instruction of '{flight}' was counted")
        print(label.replace("\n", " "), total)
        for part, count in rows[label].items():
            print(f"  {part:28} {count:9,} {count / total:6.1%}")
    figure, axes = plt.subplots(figsize=(9, 2.8), layout="constrained")
    left = dict.fromkeys(rows, 0.0)
    for part, color in zip([*PARTS, "the rest"], plt.get_cmap("tab20").colors):
        shares = [100 * row[part] / sum(row.values()) for row in rows.values()]
        axes.barh(list(rows), shares, left=list(left.values()), color=color, label=part)
        for label, share in zip(rows, shares):
            left[label] += share
    axes.set_xlabel("share of the instructions of a step, %")
    axes.set_xlim(0, 100)
    figure.legend(loc="outside right upper", frameon=False)
    plt.rcParams["svg.hashsalt"] = "profile"
    target = ROOT / "docs" / "performance.svg"
    draft = target.with_suffix(".new")
    figure.savefig(draft, format="svg", metadata={"Date": None})
    draft.replace(target)


if __name__ == "__main__":
    main()
