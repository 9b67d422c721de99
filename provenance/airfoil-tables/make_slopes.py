#!/usr/bin/env python3
"""Make lift slopes, stall angles and drag polynomials (Modelica CombiTable) from a polar.

README.md describes format and method. Such laws hold only for symmetric sections, so the polar is
read from 0 deg upwards.
"""

import argparse
import os
import sys
from pathlib import Path

import numpy as np

FOLDER = Path(__file__).resolve().parents[2] / "modelDescription" / "resources" / "airfoils"

# Output file and the polar from which it is made.
FILES = {"naca0015.txt": "naca0015.polar"}

# Beyond the Reynolds numbers of the polar its nearest block holds.
LOWEST_REYNOLDS = 2e3
HIGHEST_REYNOLDS = 1e9

EDGE_DEG = 3.0
LATEST_STALL_DEG = 30.0
DEGREE = 4
LARGEST_DRAG_ERROR = 0.08
SYMMETRY = 1e-9


class SlopeError(Exception):
    """A polar that such laws do not describe; the message says why."""


def read_polar(path):
    """Name and blocks of a .polar file: Reynolds number and rows of alpha (deg), cl, cd."""
    name, blocks = "", []
    for line in path.read_text(encoding="utf-8").splitlines():
        words = line.split("#")[0].split()
        if not words or words[0] == "polar":
            continue
        if words[0] == "name":
            name = " ".join(words[1:])
        elif words[0] == "reynolds":
            blocks.append((float(words[1]), []))
        else:
            blocks[-1][1].append([float(word) for word in words[:3]])
    return name, [(reynolds, np.array(rows)) for reynolds, rows in blocks]


def laws(reynolds, rows):
    """Slopes A and C (1/rad), stall angle (rad), drag coefficients d0, d1, ... (alpha in rad).

    A: the chord from 0 to 3 deg. C: from the end of A to stall, by least squares at the polar's
    rows. Stall: the first peak of lift. Drag: least squares of the relative error at the polar's
    rows from 0 to stall. Also returns the largest error of lift along A and C, and the largest
    relative error of drag.
    """
    where = f"The block at Re {reynolds:.0f}"
    if np.abs(rows[:, 1] + rows[::-1, 1]).max() > SYMMETRY:
        raise SlopeError(f"{where} is not symmetric; slopes through the origin do not describe it.")
    alpha, cl, cd = rows[(rows[:, 0] >= 0) & (rows[:, 0] <= LATEST_STALL_DEG)].T
    stall = int(np.argmax(np.diff(cl) <= 0))
    if stall == 0 or alpha[stall] <= EDGE_DEG:
        raise SlopeError(f"{where} has no peak of lift from {EDGE_DEG} to {LATEST_STALL_DEG} deg.")
    at_edge = np.interp(EDGE_DEG, alpha, cl)
    slope_a = at_edge / np.radians(EDGE_DEG)
    attached = slice(int(np.searchsorted(alpha, EDGE_DEG)), stall + 1)
    above, more = np.radians(alpha[attached] - EDGE_DEG), cl[attached] - at_edge
    slope_c = (above @ more) / (above @ above)
    angles, drag = np.radians(alpha[: stall + 1]), cd[: stall + 1]
    powers = np.vander(angles, DEGREE + 1, increasing=True)
    coefficients = np.linalg.lstsq(powers / drag[:, None], np.ones(len(drag)), rcond=None)[0]
    error = np.abs(powers @ coefficients / drag - 1).max()
    if error > LARGEST_DRAG_ERROR:
        raise SlopeError(f"{where}: the drag polynomial has an error of {error:.0%}.")
    lines = np.where(alpha <= EDGE_DEG, slope_a * np.radians(alpha), 0.0)
    lines[attached] = at_edge + slope_c * above
    lift_error = np.abs(lines - cl)[: stall + 1].max()
    return (slope_a, slope_c, np.radians(alpha[stall]), *coefficients), lift_error, error


def row(reynolds, numbers):
    """A line of the table."""
    slope_a, slope_c, stall, *drag = numbers
    start = f"{reynolds:10.0f} {slope_a:8.4f} {slope_c:8.4f} {stall:8.5f}"
    return start + "".join(f" {coefficient:11.6f}" for coefficient in drag)


def render(polar):
    """Text of a CombiTable file."""
    name, blocks = read_polar(FOLDER / polar)
    fits = [(reynolds, *laws(reynolds, rows)) for reynolds, rows in blocks]
    first, last = fits[0], fits[-1]
    rows = [row(reynolds, numbers) for reynolds, numbers, *_ in fits]
    rows.insert(0, row(LOWEST_REYNOLDS, first[1]))
    rows.append(row(HIGHEST_REYNOLDS, last[1]))
    table = polar.removesuffix(".polar")
    lift_error = max(fit[2] for fit in fits)
    error = max(fit[3] for fit in fits)
    titles = f"{'Re':>10} {'A':>8} {'C':>8} {'stall':>8}"
    titles += "".join(f" {f'd{i}':>11}" for i in range(DEGREE + 1))
    return "\n".join(
        [
            "#1",
            f"# {name}: lift slopes, stall angles and drag polynomials. Made by",
            f"# provenance/airfoil-tables/make_slopes.py from {polar}; do not edit.",
            "# For symmetric use: cl odd, cd even.",
            "# Layout after Lovaco Hernandez (2017), LIU-IEI-TEK-A--17/02958-SE, sections 3.5.1 to",
            "# 3.5.3, whose own numbers were not at hand: none of them is in this file.",
            "# Column 1: Reynolds number. 2: slope A, 1/rad, the chord of cl from 0 to 3 deg. 3: slope",
            "# C, 1/rad, from the end of A to stall by least squares; cl along A and C is at most",
            f"# {lift_error:.2f} off. 4: stall angle, rad, the first peak of cl. From 5 on: drag",
            "# cd = d0 + d1 a + d2 a^2 + ..., a = |alpha| in rad, from 0 to stall; least squares of the",
            f"# relative error, which is {100 * error:.1f} % at most.",
            f"# The first row repeats the laws of Re {first[0]:.0f} at {LOWEST_REYNOLDS:.0f}, the last",
            f"# those of Re {last[0]:.0f} at {HIGHEST_REYNOLDS:.0f}: the polar has no Reynolds numbers",
            "# beyond, and the nearest holds.",
            f"double {table}({len(rows)}, {DEGREE + 5})",
            f"#{titles[1:]}",
            *rows,
            "",
        ]
    )


def main():
    parser = argparse.ArgumentParser(description="Make lift slopes and drag polynomials.")
    parser.add_argument(
        "--check",
        action="store_true",
        help="make the files anew, compare them with those in the repository, write nothing",
    )
    check = parser.parse_args().check
    try:
        for name, polar in FILES.items():
            path, content = FOLDER / name, render(polar).encode("utf-8")
            if not check:
                temporary = FOLDER / (name + ".tmp")
                temporary.write_bytes(content)
                os.replace(temporary, path)
            elif not path.exists() or path.read_bytes() != content:
                sys.exit(f"{name} is missing or differs from what the script makes.")
    except (SlopeError, OSError) as error:
        sys.exit(f"The files were not made: {error}")
    print("All files agree." if check else f"Written to {FOLDER}.", file=sys.stderr)


if __name__ == "__main__":
    main()
