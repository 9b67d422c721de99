#!/usr/bin/env python3
"""Make the airfoil tables (.polar files); README.md describes format and methods.

Angles are in degrees, coefficients are per unit span and chord, Reynolds numbers refer to the chord
(for the circle: to the diameter). A section is computed for 0 <= alpha <= 180 deg and mirrored on
output: cl odd, cd even. A section that is not symmetric is computed twice, upright and upside down.
"""

import argparse
import csv
import os
import sys
from dataclasses import dataclass
from functools import cache
from importlib.metadata import version
from pathlib import Path

import numpy as np

HERE = Path(__file__).resolve().parent
OUTPUT = HERE.parents[1] / "modelDescription" / "resources" / "airfoils"
MEASURED_CSV = HERE / "airfoil-naca0015-knight-hefner-1937-Re242000.csv"
ASSESSED_CSV = HERE / "assessed-measurements.csv"

MEASURED_REYNOLDS = 242_000
KNOTS = np.array([0.0, 2, 4, 6, 7, 8, 9, 10, 11, 12])
FIT_LIMIT_DEG = 12.7
BELOW_STALL_DEG = 8

REYNOLDS = [2e4, 4e4, 7e4, 1e5, 1.5e5, 2.42e5, 4e5, 7e5, 1e6, 2e6, 3e6, 5e6, 1e7]
SCALED_REYNOLDS = [4e4, 7e4, 1e5, 1.5e5, 2.42e5, 4e5, 7e5, 1e6]
PROPELLER_REYNOLDS = [2e4, 3e4, 5e4, 7e4, 1e5]
GOETTINGEN_REYNOLDS = [1e5, 2e5, 5e5, 1e6, 2e6, 3e6, 4e6, 6e6]
MODEL_SIZE = "xlarge"
N_CRIT = 1.0
STEP_DEG = 0.5
PAST_STALL_DEG = 3.0
LOWEST_CONFIDENCE = 0.85
FINE_DEG = np.arange(301) / 10

# From this Reynolds number on the computed drag at zero lift agrees with NACA Rep. 586.
AGREED_DRAG_REYNOLDS = 3.54e6

ASPECT_RATIO = 50
CD_MAX = 1.11 + 0.018 * ASPECT_RATIO
REVERSED_LIFT = 0.7

WHEATLEY_SLOPE = 5.85
WHEATLEY_DRAG = 0.0120

# Circular cylinder: Reynolds number on the diameter and drag coefficient.
CIRCLE = [
    (1e2, 1.40), (1e3, 1.00), (3e3, 0.95), (1e4, 1.10), (3e4, 1.20), (1e5, 1.20), (2e5, 1.15),
    (4e5, 0.30), (1e6, 0.35), (3.5e6, 0.70),
]  # fmt: skip


POST_STALL = f"""
Post-stall method: Viterna & Corrigan (1982), "Fixed pitch rotor performance of large
horizontal axis wind turbines", NASA CP-2230, from the match angle to 90 deg, with
CDmax = 1.11 + 0.018 AR, AR = {ASPECT_RATIO}, so CDmax = {CD_MAX:.2f} (two-dimensional flat plate).
From 90 deg to 180 deg - match as in NREL's AirfoilPrep and CCBlade: drag mirrored about
90 deg, lift mirrored and times -{REVERSED_LIFT}; from there lift linear to 0 at 180 deg.
Drag is held at or above the drag at zero lift. No data stand behind these ranges.
""".strip()

MATCH = f"""
Match angle: {PAST_STALL_DEG:.0f} deg beyond the first maximum of the computed cl, then corrected like the
stall angle; NeuralFoil's own confidence is at least {LOWEST_CONFIDENCE} up to there.
""".strip()


class TableError(Exception):
    """The reason why a table cannot be made."""


@dataclass
class Block:
    """Section coefficients at one Reynolds number for alpha (deg) from 0 to 180."""

    reynolds: float
    alpha: np.ndarray
    cl: np.ndarray
    cd: np.ndarray
    match: float | None = None  # deg, where the post-stall method begins
    upside_down: "Block | None" = None  # for negative angles; None: mirrored


def measured_points():
    """Knight & Hefner, NACA TN 626 (1937), Tables V and VI: position, |alpha| (deg), cl, cd."""
    with MEASURED_CSV.open(encoding="utf-8") as file:
        rows = list(csv.DictReader(line for line in file if not line.startswith("#")))
    alpha = np.array([float(row["alpha_inf_deg"]) for row in rows])
    cl = np.sign(alpha) * np.array([float(row["CL"]) for row in rows])
    cd = np.array([float(row["CD0"]) for row in rows])
    return np.array([row["position"] for row in rows]), np.abs(alpha), cl, cd


def fit_measured():
    """Least-squares piecewise-linear curve through the measured points.

    Returns cl and cd at KNOTS, and for each point |alpha| (deg) and the residuals of cl and cd.
    A point beyond the last knot counts at that knot.
    """
    _, alpha, cl, cd = measured_points()
    used = alpha <= FIT_LIMIT_DEG
    alpha, cl, cd = alpha[used], cl[used], cd[used]
    hats = np.array([np.interp(alpha, KNOTS, unit) for unit in np.eye(len(KNOTS))]).T
    knot_cl = np.append(0.0, np.linalg.lstsq(hats[:, 1:], cl, rcond=None)[0])
    knot_cd = np.linalg.lstsq(hats, cd, rcond=None)[0]
    return knot_cl, knot_cd, alpha, hats @ knot_cl - cl, hats @ knot_cd - cd


def rms(values):
    return np.sqrt(np.mean(values**2))


def viterna_cl(alpha, match, cl_match):
    """Lift by Viterna & Corrigan, NASA CP-2230 (1982), for match <= alpha <= 90 (deg)."""
    alpha, match = np.radians(alpha), np.radians(match)
    a2 = (cl_match - CD_MAX * np.sin(match) * np.cos(match)) * np.sin(match) / np.cos(match) ** 2
    return CD_MAX / 2 * np.sin(2 * alpha) + a2 * np.cos(alpha) ** 2 / np.sin(alpha)


def viterna_cd(alpha, match, cd_match):
    """Drag by Viterna & Corrigan, NASA CP-2230 (1982), for alpha <= 90 (deg)."""
    alpha, match = np.radians(alpha), np.radians(match)
    b2 = (cd_match - CD_MAX * np.sin(match) ** 2) / np.cos(match)
    return CD_MAX * np.sin(alpha) ** 2 + b2 * np.cos(alpha)


def extend(reynolds, alpha, cl, cd):
    """Carry cl, cd given from 0 to the match angle alpha[-1] (deg) on to 180 deg.

    Beyond 90 deg as in NREL's AirfoilPrep and CCBlade: drag is mirrored about 90 deg, lift is
    mirrored and multiplied by -0.7 up to 180 - match, and goes linearly to zero from there to 180.
    Drag is at least the drag at zero lift.
    """
    match = alpha[-1]
    fine = np.arange(np.floor(match) + 1, 30)
    beyond = np.unique(np.concatenate([fine, np.arange(30.0, 181, 5), [180 - match]]))
    folded = np.minimum(beyond, 180 - beyond)
    cl_far = viterna_cl(np.maximum(folded, match), match, cl[-1])
    cl_far[beyond > 90] *= -REVERSED_LIFT
    run = beyond > 180 - match
    cl_far[run] = -REVERSED_LIFT * cl[-1] * folded[run] / match
    cd_far = np.maximum(viterna_cd(folded, match, cd[-1]), cd[0])
    return Block(
        reynolds,
        np.concatenate([alpha, beyond]),
        np.concatenate([cl, cl_far]),
        np.concatenate([cd, cd_far]),
        match,
    )


def neuralfoil_polar(alpha, reynolds, n_crit, x_trip=1.0, airfoil="naca0015"):
    """cl, cd and confidence of a named airfoil by NeuralFoil at Mach 0; x_trip in chords."""
    import aerosandbox
    import neuralfoil

    result = neuralfoil.get_aero_from_airfoil(
        aerosandbox.Airfoil(airfoil),
        alpha=alpha,
        Re=reynolds,
        n_crit=n_crit,
        xtr_upper=x_trip,
        xtr_lower=x_trip,
        model_size=MODEL_SIZE,
    )
    return result["CL"], result["CD"], result["analysis_confidence"]


@cache
def computed_polar(reynolds, airfoil):
    """cl, cd and confidence of a symmetric airfoil by NeuralFoil at FINE_DEG, and its first peak.

    The peak is the index of the first maximum of cl.
    """
    cl, cd, confidence = neuralfoil_polar(FINE_DEG, reynolds, N_CRIT, airfoil=airfoil)
    cl[0] = 0.0
    return cl, cd, confidence, int(np.argmax(np.diff(cl) <= 0))


def assessed_rows(source):
    """Rows of the assessed measurements whose source begins with the given text."""
    with ASSESSED_CSV.open(encoding="utf-8") as file:
        rows = list(csv.DictReader(line for line in file if not line.startswith("#")))
    return [row for row in rows if row["source"].startswith(source)]


def mccroskey_slope(reynolds):
    """Lift slope (1/rad) of NACA 0012 at Mach 0: McCroskey, NASA TM 100019 (1987), Fig. 3."""
    return np.degrees(0.1025 + 0.00485 * np.log10(reynolds / 1e6))


def target_slope(reynolds, airfoil):
    """Lift slope (1/rad) of a corrected table.

    McCroskey's fit; below the Reynolds number of the measured NACA 0015 the computed slope times
    the ratio there, because no assessed measurement supports the fit at lower ones.
    """
    edge = max(reynolds, MEASURED_REYNOLDS)
    here, there = (lift_slope(FINE_DEG, computed_polar(re, airfoil)[0]) for re in (reynolds, edge))
    return mccroskey_slope(edge) * here / there


@dataclass
class Correction:
    """Assessed over computed values at a Reynolds number."""

    largest_lift: float
    stall_angle: float
    drag: float


@cache
def stall_anchors():
    """Reynolds numbers, and there assessed over computed cl max and stall angle."""
    knot_cl = fit_measured()[0]
    measured = int(np.argmax(knot_cl))
    anchors = [("naca0015", MEASURED_REYNOLDS, knot_cl[measured], KNOTS[measured])]
    for source, reynolds in (("sheldahl-klimas", 7e5), ("gregory-oreilly", 3e6), ("ladson", 6e6)):
        rows = [
            row
            for row in assessed_rows(source)
            if float(row["reynolds"]) == reynolds and row["cl_max"]
        ]
        cl, stall = (
            np.mean([float(row[name]) for row in rows]) for name in ("cl_max", "stall_deg")
        )
        anchors.append((rows[0]["section"], reynolds, cl, stall))
    ratios = []
    for airfoil, reynolds, largest, stall in anchors:
        cl, _, _, peak = computed_polar(reynolds, airfoil)
        ratios.append((reynolds, largest / cl[peak], stall / FINE_DEG[peak]))
    return np.array(ratios).T


def correction(reynolds):
    """The ratios at a Reynolds number: linear in ln Re between the anchors, constant beyond."""
    anchors, largest_lift, stall_angle = stall_anchors()
    drag = fit_measured()[1][0] / computed_polar(MEASURED_REYNOLDS, "naca0015")[1][0]
    edges = np.log([MEASURED_REYNOLDS, AGREED_DRAG_REYNOLDS])
    position = np.log(reynolds)
    return Correction(
        np.interp(position, np.log(anchors), largest_lift),
        np.interp(position, np.log(anchors), stall_angle),
        np.interp(position, edges, [drag, 1.0]),
    )


def corrected_block(reynolds, airfoil):
    """A symmetric section by NeuralFoil, taken to assessed slope, stall and drag at zero lift.

    Near zero lift cl is multiplied by the ratio of the slopes. Towards stall this factor and the
    angle of attack go over to the ratios of cl max and of stall angle, with the weight
    x^3 (4 - 3 x), x the computed angle over the computed stall angle; beyond stall the weight is 1.
    cd belongs to the same point of the polar, so that it rises earlier with the stall.
    """
    cl, cd, confidence, peak = computed_polar(reynolds, airfoil)
    ratio = correction(reynolds)
    x = np.minimum(FINE_DEG / FINE_DEG[peak], 1.0)
    weight = x**3 * (4 - 3 * x)
    angle = FINE_DEG * (1 + (ratio.stall_angle - 1) * weight)
    if np.any(np.diff(angle) <= 0):
        raise TableError(f"At Re {reynolds:.0f} the corrected angles do not increase.")
    alpha = np.arange(0, 30 + STEP_DEG, STEP_DEG)
    target = target_slope(reynolds, airfoil)
    slope = target / lift_slope(FINE_DEG, cl)
    for _ in range(20):  # the weight changes the slope over +-4 deg a little
        lift = np.interp(alpha, angle, cl * (slope + (ratio.largest_lift - slope) * weight))
        slope *= target / lift_slope(alpha, lift)
    beyond = int(np.argmax(FINE_DEG >= FINE_DEG[peak] + PAST_STALL_DEG))
    last = int(np.argmax(alpha > angle[beyond])) - 1
    check_confidence(reynolds, alpha[last], confidence[: beyond + 1])
    drag = ratio.drag * np.interp(alpha, angle, cd)
    return extend(reynolds, alpha[: last + 1], lift[: last + 1], drag[: last + 1])


def check_confidence(reynolds, match, confidence):
    """Refuse a polar of which NeuralFoil itself is not confident up to the match angle (deg)."""
    if confidence.min() < LOWEST_CONFIDENCE:
        raise TableError(
            f"At Re {reynolds:.0f} NeuralFoil's confidence falls below {LOWEST_CONFIDENCE} "
            f"before the match angle of {match} deg."
        )


def carried_on(reynolds, alpha, cl, cd, confidence):
    """A polar to PAST_STALL_DEG beyond the first maximum of cl, then post-stall."""
    stall = int(np.argmax(np.diff(cl) <= 0))
    last = stall + round(PAST_STALL_DEG / STEP_DEG)
    check_confidence(reynolds, alpha[last], confidence[: last + 1])
    return extend(reynolds, alpha[: last + 1], cl[: last + 1], cd[: last + 1])


def cambered_block(reynolds, airfoil):
    """A section by NeuralFoil, each side of 0 deg with its own stall and match angle."""
    half = np.arange(0, 30 + STEP_DEG, STEP_DEG)
    alpha = np.concatenate([-half[:0:-1], half])
    cl, cd, confidence = neuralfoil_polar(alpha, reynolds, N_CRIT, airfoil=airfoil)
    zero = len(half) - 1
    block = carried_on(reynolds, half, cl[zero:], cd[zero:], confidence[zero:])
    block.upside_down = carried_on(
        reynolds, half, -cl[zero::-1], cd[zero::-1], confidence[zero::-1]
    )
    # The two sides meet at 180 deg, with the larger drag.
    block.cd[-1] = block.upside_down.cd[-1] = max(block.cd[-1], block.upside_down.cd[-1])
    return block


def distance(alpha, cl, cd):
    """Distance of a candidate, given at alpha (deg), from the fit to the measurements.

    Returns a dict of mean and largest |dcl| and |dcd|.
    """
    knot_cl, knot_cd = fit_measured()[:2]
    dcl = np.abs(cl - np.interp(alpha, KNOTS, knot_cl))
    dcd = np.abs(cd - np.interp(alpha, KNOTS, knot_cd))
    return {
        "mean_dcl": dcl.mean(),
        "max_dcl": dcl.max(),
        "mean_dcd": dcd.mean(),
        "max_dcd": dcd.max(),
    }


def lift_slope(alpha, cl):
    """Lift slope (1/rad) over +-4 deg by least squares through the origin."""
    near = alpha <= 4
    return np.degrees((alpha[near] @ cl[near]) / (alpha[near] @ alpha[near]))


def check_block(block):
    """Refuse a block that breaks the format or is not physical."""
    where = f"The block at Re {block.reynolds:.0f}"
    if block.alpha[0] != 0 or block.alpha[-1] != 180 or np.any(np.diff(block.alpha) <= 0):
        raise TableError(f"{where} does not rise strictly from 0 to 180 deg.")
    if np.any(np.round(block.cd, 5) <= 0):
        raise TableError(f"{where} has drag that is not positive.")
    if block.cl[-1] != 0:
        raise TableError(f"{where} has lift at 180 deg.")
    other = block.upside_down
    if other is None:
        if block.cl[0] != 0:
            raise TableError(f"{where} has lift at 0 deg although the section is symmetric.")
        return
    if other.alpha[0] != 0 or other.alpha[-1] != 180 or np.any(np.diff(other.alpha) <= 0):
        raise TableError(f"{where} does not rise strictly from -180 to 0 deg.")
    if np.any(np.round(other.cd, 5) <= 0):
        raise TableError(f"{where} has drag that is not positive.")
    if other.cl[0] != -block.cl[0] or other.cd[0] != block.cd[0]:
        raise TableError(f"{where} has two values at 0 deg.")
    if other.cl[-1] != 0 or other.cd[-1] != block.cd[-1]:
        raise TableError(f"{where} has other values at -180 than at 180 deg.")


def rows_of(block):
    """Rows of a block: alpha, cl, cd."""
    return list(zip(block.alpha, np.round(block.cl, 4), block.cd, strict=True))


def render(name, header, blocks):
    """Text of a .polar file."""
    lines = [f"# {line}".rstrip() for line in header.strip().splitlines()]
    lines += ["polar 1", f"name {name}"]
    for block in blocks:
        check_block(block)
        lines += ["", f"reynolds {block.reynolds:.0f}"]
        below = block.upside_down or block
        if block.match is not None:
            text = f"# post-stall method beyond {block.match:.1f} deg"
            lines += [text if below is block else f"{text} and below {-below.match:.1f} deg"]
        lines += ["# alpha_deg      cl       cd"]
        for sign, half in ((-1, rows_of(below)[:0:-1]), (1, rows_of(block))):
            # adding 0.0 turns a negative zero into zero
            lines += [f"{sign * a:11.1f} {sign * cl + 0.0:8.4f} {cd:8.5f}" for a, cl, cd in half]
    return "\n".join(lines) + "\n"


def knight_hefner_file():
    """naca0015-knight-hefner.polar"""
    cl, cd, alpha, residual_cl, residual_cd = fit_measured()
    below = alpha <= BELOW_STALL_DEG
    scatter = f"cl {rms(residual_cl):.4f}, cd {rms(residual_cd):.5f}"
    scatter_below = f"cl {rms(residual_cl[below]):.4f}, cd {rms(residual_cd[below]):.5f}"
    header = f"""
NACA 0015, measured. Made by provenance/airfoil-tables/make_tables.py; do not edit.
Source: Knight, M. & Hefner, R. A. (1937), "Static Thrust Analysis of the Lifting
Airscrew", NACA TN 626, Tables V and VI: airfoil 6 by 72 inch, Re {MEASURED_REYNOLDS:,},
reduced to infinite aspect ratio by the authors.
Method: positions A and B pooled, reflected by symmetry, least-squares piecewise-linear curve
on the knots {", ".join(f"{k:.0f}" for k in KNOTS)} deg over the {len(alpha)} points with
|alpha| <= {FIT_LIMIT_DEG} deg (a point beyond the last knot counts at that knot).
No value is adjusted by hand. Rms residual: {scatter};
over the {below.sum()} points with |alpha| <= {BELOW_STALL_DEG} deg: {scatter_below}.
Match angle: {KNOTS[-1]:.0f} deg, the last knot.
{POST_STALL}
"""
    block = extend(MEASURED_REYNOLDS, KNOTS, cl, cd)
    return render("NACA 0015, Knight & Hefner 1937, Re 242,000", header, [block])


def scaled_block(reynolds):
    """The measured polar with its drag scaled to another Reynolds number by computed ratios."""
    cl, cd = fit_measured()[:2]
    _, there, confidence = neuralfoil_polar(KNOTS, reynolds, N_CRIT)
    _, here, _ = neuralfoil_polar(KNOTS, MEASURED_REYNOLDS, N_CRIT)
    if confidence.min() < LOWEST_CONFIDENCE:
        raise TableError(
            f"At Re {reynolds:.0f} NeuralFoil's confidence falls below {LOWEST_CONFIDENCE} "
            f"between 0 and {KNOTS[-1]:.0f} deg."
        )
    # Drag in excess of that at the peak of lift is pressure drag in stall, and is not scaled.
    peak = int(np.argmax(cl))
    ratio = (there / here)[np.minimum(np.arange(len(KNOTS)), peak)]
    return extend(reynolds, KNOTS, cl, cd + np.minimum(cd, cd[peak]) * (ratio - 1))


def scaled_file():
    """naca0015-knight-hefner-reynolds.polar"""
    blocks = []
    for reynolds in SCALED_REYNOLDS:
        progress(f"  Re {reynolds:.0f}")
        blocks.append(scaled_block(reynolds))
    low, high = blocks[0], blocks[-1]
    header = f"""
NACA 0015, measured at Re {MEASURED_REYNOLDS:,}, its drag taken to other Reynolds numbers by computed
ratios. Made by provenance/airfoil-tables/make_tables.py; do not edit.
Measured: naca0015-knight-hefner.polar, which says how. Its block at Re {MEASURED_REYNOLDS:,} is here as it is there.
Method: up to {KNOTS[-1]:.0f} deg, at each knot of the measured polar, its cd times the ratio of those that
NeuralFoil {version("neuralfoil")} (P. Sharpe) computes at the other Reynolds number and at {MEASURED_REYNOLDS:,}, with the
settings of naca0015.polar: model size {MODEL_SIZE}, Mach 0, free transition with n_crit {N_CRIT:.0f}.
Beyond the measured peak of cl, at {KNOTS[np.argmax(low.cl[: len(KNOTS)])]:.0f} deg, only as much drag as there is at the peak is scaled,
with the ratio there; the rest is pressure drag of the stall. NeuralFoil's own confidence is at
least {LOWEST_CONFIDENCE} at the knots. No value is adjusted by hand.
Drag at 0 deg: {low.cd[0]:.4f} at Re {low.reynolds:,.0f} to {high.cd[0]:.4f} at Re {high.reynolds:,.0f}.
Lift is the measured one at all Reynolds numbers, also its peak: provenance/airfoil-tables/README.md says why.
Match angle: {KNOTS[-1]:.0f} deg, the last knot.
{POST_STALL}
"""
    return render("NACA 0015, Knight & Hefner 1937, drag by Reynolds number", header, blocks)


def corrected_method():
    """Header lines on how a corrected table is made."""
    low, high = correction(MEASURED_REYNOLDS), correction(6e6)
    return f"""
Method: NeuralFoil {version("neuralfoil")} (P. Sharpe), model size {MODEL_SIZE}, Mach 0,
free transition with n_crit {N_CRIT:.0f} (free-stream turbulence about 2 % by Mack's relation),
computed for alpha >= 0, corrected and mirrored. The uncorrected lift is 5 to 8 % too steep, and
its largest value too high. provenance/airfoil-tables/README.md says which measurements could be read, and
compares this table with them:
- lift slope: McCroskey (1987), NASA TM 100019, fit to measurements of NACA 0012,
  0.1025 + 0.00485 log10(Re/1e6) per deg at Mach 0, from Re {MEASURED_REYNOLDS:,} up;
  below, the computed slope times the ratio at {MEASURED_REYNOLDS:,};
- largest lift and its angle: times {low.largest_lift:.2f} and {low.stall_angle:.2f} up to Re {MEASURED_REYNOLDS:,} (NACA 0015, Knight &
  Hefner 1937), by way of Sheldahl & Klimas (1981) at 700,000 and Gregory & O'Reilly (1970) at
  3,000,000 to {high.largest_lift:.2f} and {high.stall_angle:.2f} from 6,000,000 up (NACA 0012, Ladson 1988), linear in ln Re;
- drag: times {low.drag:.2f} up to Re {MEASURED_REYNOLDS:,} (Knight & Hefner), rising to 1 at {AGREED_DRAG_REYNOLDS:,.0f}, where it is
  that of a turbulent tunnel (Jacobs & Sherman 1937): at Re 6,000,000 between that with free
  transition in smooth flow and that with fixed.
The ratios of one section stand for both. The format has no Mach number; the rules for
compressibility act on this table.
""".strip("\n")


def corrected_numbers(block):
    """A header line on lift slope, drag and largest lift of a block."""
    peak = int(np.argmax(np.diff(block.cl) <= 0))
    return (
        f"Re {block.reynolds:,.0f}: lift slope over +-4 deg {lift_slope(block.alpha, block.cl):.2f} "
        f"per rad, cd {block.cd[0]:.5f} at 0 deg,\nfirst peak of cl {block.cl[peak]:.2f} "
        f"at {block.alpha[peak]:.1f} deg."
    )


def corrected_blocks(airfoil):
    """The blocks of a corrected table."""
    blocks = []
    for reynolds in REYNOLDS:
        progress(f"  Re {reynolds:.0f}")
        blocks.append(corrected_block(reynolds, airfoil))
    return blocks


def naca0015_file():
    """naca0015.polar"""
    blocks = corrected_blocks("naca0015")
    block = blocks[REYNOLDS.index(MEASURED_REYNOLDS)]
    compared = block.alpha <= KNOTS[-1]
    far = distance(block.alpha[compared], block.cl[compared], block.cd[compared])
    numbers = "\n".join(corrected_numbers(blocks[REYNOLDS.index(re)]) for re in (2.42e5, 1e6, 5e6))
    header = f"""
NACA 0015, computed and corrected to measurements. Made by provenance/airfoil-tables/make_tables.py; do not
edit.
{corrected_method()}
Distance from naca0015-knight-hefner.polar at Re {MEASURED_REYNOLDS:,}, 0 to 12 deg:
|dcl| mean {far["mean_dcl"]:.4f}, max {far["max_dcl"]:.4f};
|dcd| mean {far["mean_dcd"]:.5f}, max {far["max_dcd"]:.5f}.
{numbers}
{MATCH}
{POST_STALL}
"""
    return render("NACA 0015, NeuralFoil, corrected", header, blocks)


def naca0012_file():
    """naca0012.polar"""
    blocks = corrected_blocks("naca0012")
    numbers = "\n".join(corrected_numbers(blocks[REYNOLDS.index(re)]) for re in (1e6, 2e6, 5e6))
    header = f"""
NACA 0012, computed and corrected to measurements. Made by provenance/airfoil-tables/make_tables.py; do not
edit.
{corrected_method()}
{numbers}
{MATCH}
{POST_STALL}
"""
    return render("NACA 0012, NeuralFoil, corrected", header, blocks)


def cambered_numbers(block):
    """A sentence on lift slope, zero lift, drag and largest lift of a block."""
    other = block.upside_down
    alpha = np.concatenate([-other.alpha[:0:-1], block.alpha])
    cl = np.concatenate([-other.cl[:0:-1], block.cl])
    near = np.abs(alpha) <= 4
    slope, offset = np.polyfit(alpha[near], cl[near], 1)
    peaks = [float(b.cl[b.alpha == b.match - PAST_STALL_DEG][0]) for b in (block, other)]
    return (
        f"Re {block.reynolds:,.0f}: lift slope over +-4 deg {np.degrees(slope):.2f} per rad, "
        f"zero lift at {-offset / slope:.2f} deg,\ncd {block.cd[0]:.5f} at 0 deg, "
        f"first peaks of cl {peaks[0]:.2f} and {-peaks[1]:.2f}."
    )


def goettingen_file():
    """goettingen429.polar"""
    blocks = []
    for reynolds in GOETTINGEN_REYNOLDS:
        progress(f"  Re {reynolds:.0f}")
        blocks.append(cambered_block(reynolds, "goe429"))
    numbers = [cambered_numbers(blocks[GOETTINGEN_REYNOLDS.index(re)]) for re in (2e6, 4e6)]
    header = f"""
Goettingen 429, computed and not corrected; no measured table of this section was found. Made by
provenance/airfoil-tables/make_tables.py; do not edit.
The lift is too steep and its largest value too high: the same method gives the NACA 0012 and 0015
slopes that are 5 to 8 % above the measured ones, and a largest lift 6 to 32 % above. Their
corrections are not applied here, because the trailing edge of this section is almost a cusp.
Coordinates: GOE 429 of the UIUC airfoil database (33 points, four decimals) as in AeroSandbox
{version("aerosandbox")}: 11.4 % thick, meant to be symmetric; its camber of 0.2 % is kept.
Method: NeuralFoil {version("neuralfoil")} (P. Sharpe), model size {MODEL_SIZE}, Mach 0,
free transition with n_crit {N_CRIT:.0f} (free-stream turbulence about 2 % by Mack's relation),
computed for positive and negative angles. n_crit is assumed: it is that of naca0015.polar; the
reasons are in provenance/airfoil-tables/README.md.
{numbers[0]}
{numbers[1]}
For comparison, assumed by Wheatley (1934), NACA Rep. 487, p. 13: lift slope 5.85 per rad ("a good
average for most airfoils", p. 12), mean drag coefficient 0.0120, one and a half times the least.
Match angles: {PAST_STALL_DEG:.0f} deg beyond the first maximum of cl on either side;
NeuralFoil's own confidence is at least {LOWEST_CONFIDENCE} up to there.
{POST_STALL}
"""
    return render("Goettingen 429, NeuralFoil", header, blocks)


def naca4412_file():
    """naca4412.polar"""
    blocks = []
    for reynolds in PROPELLER_REYNOLDS:
        progress(f"  Re {reynolds:.0f}")
        blocks.append(cambered_block(reynolds, "naca4412"))
    numbers = [cambered_numbers(blocks[PROPELLER_REYNOLDS.index(re)]) for re in (5e4, 1e5)]
    header = f"""
NACA 4412 at the Reynolds numbers of model propellers, computed and not corrected: no measured table
was read. Made by provenance/airfoil-tables/make_tables.py; do not edit.
The same method gives the NACA 0012 and 0015 lift slopes that are 5 to 8 % above the measured ones,
and a largest lift 6 to 32 % above.
Method: NeuralFoil {version("neuralfoil")} (P. Sharpe), model size {MODEL_SIZE}, Mach 0,
free transition with n_crit {N_CRIT:.0f} (free-stream turbulence about 2 % by Mack's relation),
computed for positive and negative angles. n_crit is assumed: it is that of naca0015.polar.
{numbers[0]}
{numbers[1]}
Match angles: {PAST_STALL_DEG:.0f} deg beyond the first maximum of cl on either side;
NeuralFoil's own confidence is at least {LOWEST_CONFIDENCE} up to there; at Re 150,000 it is not, so the
table ends at 100,000.
{POST_STALL}
"""
    return render("NACA 4412, NeuralFoil", header, blocks)


def wheatley_file():
    """wheatley-1934.polar"""
    header = """
The blade section of Wheatley's analysis of autogiro rotors. Made by provenance/airfoil-tables/make_tables.py; do
not edit.
Source: Wheatley, J. B. (1934), NACA Report 487: lift in proportion to the angle of attack with the
slope 5.85 per rad, "a good average for most airfoils" (pp. 12 and 13), the same at 180 deg as at 0
(p. 6), mean drag coefficient 0.0120, which is 1.5 times the smallest of Goettingen 429 (p. 13).
Ours: cl = 5.85/2 sin(2 alpha), which has these slopes and no stall; drag is the same at all angles.
For rotors whose blades hardly stall; the Reynolds number is without meaning.
"""
    alpha = np.arange(0.0, 181.0, 1.0)
    cl = 0.5 * WHEATLEY_SLOPE * np.sin(2.0 * np.radians(alpha))
    cl[-1] = 0.0  # without rounding
    blocks = [Block(2e6, alpha, cl, np.full(len(alpha), WHEATLEY_DRAG))]
    return render("linear section of NACA Report 487", header, blocks)


def circle_file():
    """circle.polar"""
    header = """
Circular cylinder, for blade roots. Made by provenance/airfoil-tables/make_tables.py; do not edit.
Reynolds number on the diameter, drag coefficient on the frontal area, smooth surface, no lift.
Source: Wieselsberger, C. (1921), Physikalische Zeitschrift 22, 321-328, as plotted in
Schlichting, Boundary-Layer Theory, and Hoerner, Fluid-Dynamic Drag (1965); above Re 8e5
Roshko, A. (1961), Journal of Fluid Mechanics 10, 345-356.
Approximate: round values of the published curves, about +-10 % outside the drag crisis. Between
Re 2e5 and 1e6 drag depends on roughness and turbulence and may differ by a factor of two.
"""
    ends = np.array([0.0, 180.0])
    blocks = [Block(re, ends, np.zeros(2), np.full(2, cd)) for re, cd in CIRCLE]
    return render("circular cylinder", header, blocks)


FILES = {
    "naca0015-knight-hefner.polar": knight_hefner_file,
    "naca0015-knight-hefner-reynolds.polar": scaled_file,
    "naca0015.polar": naca0015_file,
    "naca0012.polar": naca0012_file,
    "goettingen429.polar": goettingen_file,
    "naca4412.polar": naca4412_file,
    "wheatley-1934.polar": wheatley_file,
    "circle.polar": circle_file,
}


def progress(text):
    """Show progress on the error stream."""
    print(text, file=sys.stderr, flush=True)


def write_files():
    """Write each table under a temporary name and rename it."""
    OUTPUT.mkdir(parents=True, exist_ok=True)
    for name, make in FILES.items():
        progress(name)
        temporary = OUTPUT / (name + ".tmp")
        temporary.write_bytes(make().encode("utf-8"))
        os.replace(temporary, OUTPUT / name)
    progress(f"Written to {OUTPUT}.")


def check_files():
    """Make each table anew and compare it with the file in the repository."""
    stale = []
    for name, make in FILES.items():
        progress(name)
        path = OUTPUT / name
        if not path.exists() or path.read_bytes() != make().encode("utf-8"):
            stale.append(name)
    if stale:
        sys.exit(f"These tables are missing, or the script makes others: {', '.join(stale)}.")
    progress("All tables agree.")


def main():
    parser = argparse.ArgumentParser(description="Make the airfoil tables of the rotor model.")
    parser.add_argument(
        "--check",
        action="store_true",
        help="make the tables anew, compare them with the files in the repository, write nothing",
    )
    arguments = parser.parse_args()
    try:
        if arguments.check:
            check_files()
        else:
            write_files()
    except (TableError, OSError) as error:
        sys.exit(f"The airfoil tables were not made: {error}")


if __name__ == "__main__":
    main()
