"""Flies the hovering rotors of Knight & Hefner (1937) in FMPy, beside their measurements.

Knight, M. & Hefner, R. A. (1937), "Static Thrust Analysis of the Lifting Airscrew", NACA TN 626:
rotors of three and four untwisted NACA 0015 blades, thrust and torque against pitch. The section
data are the authors' own, measured at the Reynolds number of the blade tip; the rotor definitions
name naca0015-knight-hefner-reynolds.polar, which adapts the drag to the Reynolds numbers inboard.
No parameter is fitted.

    python knight_hefner.py --fmu HelicopterRotor.fmu --out FOLDER

prints the table, and writes knight-hefner.csv and knight-hefner.png into FOLDER.
"""

import math

import measured
from rotor import Rotor
from script import command_line, plt, save_plot, write_table

MEASURED = "knight-hefner-1937-tn626-hover.csv"

# The report gives 960 rpm and a tip Reynolds number of 242,000: air of 30 degrees Celsius at
# sea-level pressure, with which the output tipReynolds is 243,000.
AIR = {"air.atmosphere": "userDefined", "air.density": 1.164, "air.temperature": 303.15}
RPM = 960.0

COMPARED_FROM = 4.0  # deg; below it the measured thrust is too small for differences in per cent


def measured_rows():
    """Measured points as dictionaries: blades, theta (deg), CT, CQ (US convention)."""
    return [
        {
            "blades": int(row["blades"]),
            "theta": row["theta_deg"],
            "CT": row["CT_rotor"],
            "CQ": row["CQ_rotor"],
        }
        for row in measured.rows(MEASURED)
    ]


def fly(rotor, blades, pitch):
    """CT and CQ of the rotor with `blades` blades at a pitch in degrees, in the steady start."""
    rotor.restart({"geometry.file": f"knight-hefner-{blades}.toml", **AIR})
    rotor.set({"rpm": RPM, "collective": math.radians(pitch)})
    return rotor.get(["thrustCoefficient", "torqueCoefficient"])


def percent(computed, measured):
    """Difference in % of the measured value, or nan where that is zero."""
    return 100.0 * (computed / measured - 1.0) if measured else float("nan")


def table(rotor):
    """The measured rows with the computed values added; prints each row."""
    rows = measured_rows()
    print("Knight & Hefner (1937), hover, computed with the authors' own section data")
    print(" blades  pitch |   CT FMU  CT measured   diff |     CQ FMU  CQ measured   diff")
    print("           deg |                          % |                             %")
    for row in rows:
        ct, cq = fly(rotor, row["blades"], row["theta"])
        row.update(CT_fmu=ct, CQ_fmu=cq)
        row.update(dCT=percent(ct, row["CT"]), dCQ=percent(cq, row["CQ"]))
        d_ct = f"{row['dCT']:+6.1f}" if row["CT"] else "     -"
        print(
            f"  {row['blades']:5d}  {row['theta']:5.1f} | {ct:8.5f}  {row['CT']:11.5f} {d_ct} |"
            f" {cq:10.6f}  {row['CQ']:11.6f} {row['dCQ']:+6.1f}",
            flush=True,
        )
    return rows


def summary(rows):
    """Mean and worst magnitude of the differences in CT and CQ, %, over the compared points."""
    compared = [row for row in rows if row["theta"] >= COMPARED_FROM]
    result = {}
    for name in ("dCT", "dCQ"):
        magnitudes = [abs(row[name]) for row in compared]
        result[name] = (sum(magnitudes) / len(magnitudes), max(magnitudes))
    return result


def plot(rows, rotor, file):
    """Measured points and computed lines: CT and CQ against pitch."""
    figure, axes = plt.subplots(1, 2, figsize=(10, 4.6), constrained_layout=True)
    styles = {3: ("o", "-", "white"), 4: ("s", "--", "black")}
    pitches = [0.5 * i for i in range(25)]
    for blades, (marker, line, fill) in styles.items():
        computed = [fly(rotor, blades, pitch) for pitch in pitches]
        own = [row for row in rows if row["blades"] == blades]
        for axis, name, values in zip(axes, ("CT", "CQ"), zip(*computed)):
            axis.plot(pitches, values, line, color="black", label=f"{blades} blades, computed")
            axis.plot(
                [row["theta"] for row in own],
                [row[name] for row in own],
                marker,
                color="black",
                markerfacecolor=fill,
                label=f"{blades} blades, measured",
            )
    for axis, label in zip(axes, ("thrust coefficient CT", "torque coefficient CQ")):
        axis.set_xlabel("blade pitch, deg")
        axis.set_ylabel(label)
        axis.set_xlim(0, 12.5)
        axis.set_ylim(bottom=0)
        axis.ticklabel_format(axis="y", style="sci", scilimits=(0, 0), useMathText=True)
        axis.grid(True, color="0.85")
    axes[0].legend(frameon=False)
    figure.suptitle(
        "Hover: HelicopterRotor.fmu and the rotors of Knight & Hefner (1937), NACA TN 626"
    )
    save_plot(figure, file)


def main():
    arguments = command_line(__doc__, out="folder for table and plot").parse_args()
    table_file = arguments.out / "knight-hefner.csv"
    plot_file = arguments.out / "knight-hefner.png"
    with Rotor(arguments.fmu) as rotor:
        rows = table(rotor)
        plot(rows, rotor, plot_file)
    for name, (mean, worst) in summary(rows).items():
        print(
            f"mean |{name}| {mean:.1f} %, worst {worst:.1f} %"
            f" (pitch {COMPARED_FROM:g} deg and above)"
        )
    write_table(rows, table_file)
    print(f"FMU:   {arguments.fmu}")
    print(f"Table: {table_file}")
    print(f"Plot:  {plot_file}")


if __name__ == "__main__":
    main()
