"""The complete rotor in forward flight: forces by tilt and speed, and pictures of the whole disc.

Collective, rotor speed and tilt are imposed and the hub moves parallel to the ground, as in section
3.3.4 of Lovaco Hernandez (2017), "Verification of a Modelica Helicopter Rotor Model Using Blade
Element Theory", Linkoping University. The blades flap freely; there is no cyclic pitch.

    python complete_model.py --fmu HelicopterRotor.fmu --out FOLDER

prints the forces and writes into FOLDER

    complete-model.csv, .png    forces and power against advance ratio, for each tilt
    disc.csv, .png              angle of attack, Mach and Reynolds number, stalled and reversed flow
"""

import math
from pathlib import Path

import numpy as np

from rotor import Rotor, unpacked
from script import command_line, plt, save_plot, write_table

# The main rotor of the Agusta A109 in Heffley & Mnich (1988), "Minimum-Complexity Helicopter
# Simulation Math Model", NASA CR-177476: radius 18 ft, chord 1.10 ft, 385 rev/min, twist -0.105
# rad, hinges at 0.5 ft, 212 slug ft2 a blade (read where helicopter/a109.py says). Assumed: NACA
# 0012, a cutout of 0.2, and the pitch.
RPM = 385.0
RADIUS = 5.4864  # m
SECTION = "airfoils/naca0012.polar"
PARAMETERS = {
    "geometry.radius": RADIUS,
    "geometry.chord": 0.33528,
    "geometry.twist": -0.105,
    "geometry.rootCutout": 0.2,
    "airfoil.file": SECTION,
    "flapping.enabled": True,
    "flapping.hingeOffset": 0.5 / 18.0,
    "flapping.inertia": 287.43,  # kg.m2
    "models.inflow": "pittPetersDynamic",
}
BLADES = 4
COLLECTIVE = math.radians(11.0)  # at the shaft; 6.5 deg at 0.75 R
TIP_SPEED = RPM * math.pi / 30.0 * RADIUS  # m/s
ADVANCE_RATIOS = np.arange(0.0, 0.351, 0.05)
TILTS = [-4.0, 0.0, 4.0, 8.0]  # deg, positive forward
DISC_TILT = 4.0
REVOLUTION = 60.0 / RPM  # s
PARTS = 10  # of a blade passage, over which the pulsating forces are averaged
POINTS = 120  # of the revolution that is drawn
MEANS = {"forward": "force[1]", "left": "force[2]", "up": "force[3]", "power": "power"}
MEANS |= {"coning": "coning", "a1": "longitudinalFlapping", "b1": "lateralFlapping"}
STATIONS = range(1, 21)
PICTURES = ["angleOfAttack", "mach", "reynolds"]


def set_flight(rotor, tilt, mu):
    rotor.restart(PARAMETERS)
    speed = mu * TIP_SPEED
    controls = {"rpm": RPM, "collective": COLLECTIVE, "tilt": math.radians(tilt)}
    rotor.set(controls | {"velocity[1]": speed})


def sweep(rotor):
    """Rows of means over a blade passage; forces in N, power in W, angles in rad."""
    for tilt in TILTS:
        for mu in ADVANCE_RATIOS:
            set_flight(rotor, tilt, mu)
            total = 0.0
            for _ in range(PARTS):
                rotor.step(REVOLUTION / BLADES / PARTS)
                total = total + np.array(rotor.get(list(MEANS.values())))
            yield {"tilt": tilt, "mu": mu} | dict(zip(MEANS, total / PARTS))


def disc(rotor):
    """Azimuths (rad) of blade 1, radii (r/R), and a table by azimuth and radius for each of
    PICTURES, over one revolution at the highest speed."""
    set_flight(rotor, DISC_TILT, ADVANCE_RATIOS[-1])
    radii = np.array(rotor.get([f"station[{k}].radius" for k in STATIONS]))
    names = ["azimuth"] + [f"station[{k}].{name}" for name in PICTURES for k in STATIONS]
    rows = []
    for _ in range(POINTS):
        rotor.step(REVOLUTION / POINTS)
        rows.append(rotor.get(names))
    rows = np.array(rows)
    parts = np.split(rows[:, 1:], len(PICTURES), axis=1)
    return np.unwrap(rows[:, 0]), radii, dict(zip(PICTURES, parts))


def stall_angles(folder):
    """ln Re and the angle of the first peak of lift (rad), from the FMU's table of the section."""
    reynolds, peaks = [], []
    text = (Path(folder) / "resources" / SECTION).read_text(encoding="utf-8")
    for block in text.split("\nreynolds ")[1:]:
        first, *lines = block.splitlines()
        table = [[float(word) for word in line.partition("#")[0].split()] for line in lines]
        alpha, lift, _ = np.array([row for row in table if row and row[0] >= 0.0]).T
        reynolds.append(math.log(float(first)))
        peaks.append(math.radians(alpha[np.argmax(np.diff(lift) < 0.0)]))
    return reynolds, peaks


def kinds_of_flow(azimuths, radii, fields, stall):
    """2 where the flow comes from behind, 1 where the section is stalled, otherwise 0."""
    alpha = np.abs(fields["angleOfAttack"])
    stalled = alpha > np.interp(np.log(fields["reynolds"]), *stall)
    return np.where(alpha > 0.5 * math.pi, 2, np.where(stalled, 1, 0))


def plot_sweep(rows, file):
    panels = [
        ("forward force, kN", "forward", 1e-3),
        ("upward force, kN", "up", 1e-3),
        ("power, kW", "power", 1e-3),
        ("flapping back $a_1$, deg", "a1", 180.0 / math.pi),
    ]
    figure, axes = plt.subplots(2, 2, figsize=(9.5, 7.0), sharex=True, constrained_layout=True)
    for axis, (label, name, factor) in zip(axes.flat, panels):
        for tilt, style in zip(TILTS, (":", "-", "--", "-.")):
            chosen = [row for row in rows if row["tilt"] == tilt]
            values = [factor * row[name] for row in chosen]
            axis.plot(ADVANCE_RATIOS, values, style, color="black", label=f"{tilt:g} deg")
        axis.set_ylabel(label)
        axis.grid(True, color="0.85")
        axis.set_xlim(0.0, ADVANCE_RATIOS[-1])
    axes[0, 0].legend(title="tilt, forward")
    for axis in axes[1]:
        axis.set_xlabel("advance ratio $V/(\\Omega R)$")
    figure.suptitle("The rotor at a fixed collective of 11 deg, moved parallel to the ground")
    save_plot(figure, file)


def plot_disc(azimuths, radii, fields, flow, file):
    """Four pictures from above, flight upwards, the advancing side on the right."""
    psi = np.append(azimuths, azimuths[0] + 2.0 * math.pi)[:, None]
    x, y = radii * np.sin(psi), -radii * np.cos(psi)
    closed = {name: np.vstack([field, field[:1]]) for name, field in fields.items()}
    kinds = np.vstack([flow, flow[:1]])
    alpha = np.where(kinds == 2, np.nan, np.degrees(closed["angleOfAttack"]))
    figure, axes = plt.subplots(2, 2, figsize=(9.6, 8.6), constrained_layout=True)
    panels = [
        ("angle of attack, deg", alpha, np.arange(-10.0, 18.1, 2.0), "both"),
        ("Mach number", closed["mach"], np.arange(0.0, 0.91, 0.1), "neither"),
        (
            "Reynolds number, million",
            1e-6 * closed["reynolds"],
            np.arange(0.0, 7.1, 1.0),
            "neither",
        ),
    ]
    for axis, (title, field, levels, extend) in zip(axes.flat, panels):
        filled = axis.contourf(x, y, field, levels, cmap="YlGnBu", extend=extend)
        figure.colorbar(filled, ax=axis, shrink=0.8)
        axis.set_title(title)
    colors = ["#dbe9f4", "#c05020", "#404040"]
    last = axes[1, 1]
    last.contourf(x, y, kinds, [-0.5, 0.5, 1.5, 2.5], colors=colors)
    words = ["attached", "stalled", "reversed"]
    handles = [plt.Rectangle((0, 0), 1, 1, color=color) for color in colors]
    last.legend(handles, words, loc="upper left", bbox_to_anchor=(0.95, 0.95), fontsize=9)
    last.set_title("flow at the section")
    turn = np.linspace(0.0, 2.0 * math.pi, 361)
    half = 0.5 * ADVANCE_RATIOS[-1] * math.cos(math.radians(DISC_TILT))
    for axis in axes.flat:
        axis.plot(np.sin(turn), np.cos(turn), color="black", linewidth=1.0)
        axis.plot(
            half * np.sin(turn) - half, half * np.cos(turn), "--", color="black", linewidth=1.0
        )
        axis.set_aspect("equal")
        axis.axis("off")
    mu = ADVANCE_RATIOS[-1]
    figure.suptitle(
        f"The disc from above at $V/(\\Omega R)$ = {mu:.2f} and {DISC_TILT:g} deg of tilt: flight"
        " upwards, advancing side right,\ndashed: the circle of reversed flow"
    )
    save_plot(figure, file)


def main():
    arguments = command_line(__doc__, out="folder for tables and plots").parse_args()
    rows = []
    print("tilt, deg     mu  forward, N      up, N  power, kW  a1, deg  b1, deg")
    with unpacked(arguments.fmu) as folder, Rotor(folder) as rotor:
        for row in sweep(rotor):
            rows.append(row)
            print(f"progress {len(rows)} {len(TILTS) * len(ADVANCE_RATIOS) + 1} sweep")
            print(
                f"{row['tilt']:9.1f} {row['mu']:6.2f} {row['forward']:11.0f} {row['up']:10.0f}"
                f" {1e-3 * row['power']:10.1f} {math.degrees(row['a1']):8.2f}"
                f" {math.degrees(row['b1']):8.2f}"
            )
        azimuths, radii, fields = disc(rotor)
        flow = kinds_of_flow(azimuths, radii, fields, stall_angles(folder))
    points = [
        {"azimuth": math.degrees(psi) % 360.0, "radius": r, "flow": int(flow[i, k])}
        | {name: field[i, k] for name, field in fields.items()}
        for i, psi in enumerate(azimuths)
        for k, r in enumerate(radii)
    ]
    write_table(rows, arguments.out / "complete-model.csv")
    write_table(points, arguments.out / "disc.csv")
    plot_sweep(rows, arguments.out / "complete-model.png")
    plot_disc(azimuths, radii, fields, flow, arguments.out / "disc.png")


if __name__ == "__main__":
    main()
