"""Flies the rotor with flapping blades in level flight from hover to an advance ratio of 0.35.

At each speed collective and shaft tilt are trimmed so that the rotor carries the same weight and
overcomes the drag of a fuselage, with three inflow models. There is no cyclic pitch: the tip path
flaps back freely from the hub plane, and the forward tilt of the shaft makes up for it.

    python forward_flight.py --fmu HelicopterRotor.fmu --out FOLDER

prints the trim and writes into FOLDER

    forward-flight.csv, .png     forces, power and flapping against advance ratio
    angle-of-attack.csv, .png    angle of attack over the whole disc at the highest advance ratio
"""

import math

import numpy as np

from rotor import Rotor, unpacked
from script import command_line, plt, save_plot, write_table

# The FMU's default rotor at sea level: untwisted blades, hinged on the shaft axis.
RPM = 960.0
RADIUS = 0.762  # m
CHORD = 0.0508  # m
CUTOUT = 1.0 / 6.0
DENSITY = 1.225  # kg/m3
TIP_SPEED = RPM * math.pi / 30.0 * RADIUS  # m/s

# From a Lock number rho a c R^4/I of 8, which is usual for helicopters.
INERTIA = DENSITY * 2.0 * math.pi * CHORD * RADIUS**4 / 8.0  # kg m2

WEIGHT = 60.0  # N; the rotor hovers with it at 7.5 to 8 degrees of collective
DRAG_AREA = 0.01 * math.pi * RADIUS**2  # m2, 1 % of the disc area: a clean helicopter

ADVANCE_RATIOS = [0.0, 0.025, 0.05, 0.075, 0.1, 0.15, 0.2, 0.25, 0.3, 0.35]
# Inflow model: marker and line, and the number of revolutions in which the rotor settles after a
# change. (Flapping decays by exp(-pi/8 * Lock number) per revolution, dynamic inflow more slowly.)
MODELS = {"uniform": ("o", "", 2), "pittPetersDynamic": ("", "-", 6), "petersHe": ("", ":", 6)}
DISC_MODEL = "pittPetersDynamic"
TOLERANCE = 5e-4 * WEIGHT  # N, of the trim

REVOLUTION = 60.0 / RPM  # s
# Outputs that are averaged over one revolution; the trimmed forces come first.
MEANS = {
    "forward": "force[1]",
    "up": "force[3]",
    "hub_forward": "hubForce[1]",
    "thrust": "thrust",
    "power": "power",
    "coning": "coning",
    "a1": "longitudinalFlapping",
    "b1": "lateralFlapping",
}
MEAN_POINTS = 36  # points of a revolution over which the pulsating loads are averaged
# rad; averages differ by 0.1 % from those with the default of 3 degrees.
AZIMUTH_STEP = 2.0 * math.pi / MEAN_POINTS
DISC_POINTS = 120  # points of the revolution that is drawn
STATIONS = range(1, 21)
PARAMETERS = {
    "flapping.enabled": True,
    "flapping.inertia": INERTIA,
    "numerics.azimuthStep": AZIMUTH_STEP,
}


def revolution(rotor, names, points):
    """Named variables (columns) at `points` evenly spaced points of the next revolution (rows)."""
    rows = []
    for _ in range(points):
        rotor.step(REVOLUTION / points)
        rows.append(rotor.get(names))
    return np.array(rows)


class Flight:
    """A rotor whose collective and tilt are trimmed, speed by speed; each trim helps the next."""

    def __init__(self, rotor, settling):
        self.rotor = rotor
        self.settling = settling
        self.controls = np.array([8.0, 0.0])  # collective and tilt, deg
        self.slope = None  # derivatives of the forces by the controls, N/deg
        self.before = []  # the last two speeds with their controls
        self.means = {}  # averages over the last revolution

    def excess(self, controls, speed):
        """Mean force in excess of what level flight needs, forward and up, N."""
        collective, tilt = map(math.radians, controls)
        self.rotor.set({"collective": collective, "tilt": tilt, "velocity[1]": speed})
        for _ in range(self.settling):
            self.rotor.step(REVOLUTION)
        points = revolution(self.rotor, MEANS.values(), MEAN_POINTS)
        self.means = dict(zip(MEANS, points.mean(axis=0).tolist()))
        return np.array([self.means["forward"] - drag(speed), self.means["up"] - WEIGHT])

    def trim(self, speed):
        """Finds collective and tilt by Broyden's method (1965), starting from the extrapolation of
        the last two trims."""
        if len(self.before) == 2:
            (speed_1, controls_1), (speed_2, controls_2) = self.before
            rise = (controls_2 - controls_1) / (speed_2 - speed_1)
            self.controls = controls_2 + rise * (speed - speed_2)
        excess = self.excess(self.controls, speed)
        if self.slope is None:
            columns = [self.excess(self.controls + d, speed) - excess for d in np.eye(2)]
            self.slope = np.array(columns).T
        for _ in range(30):
            if np.abs(excess).max() < TOLERANCE:
                self.before = [*self.before[-1:], (speed, self.controls)]
                return
            change = np.linalg.solve(self.slope, -excess)
            self.controls = self.controls + change
            excess = self.excess(self.controls, speed)
            self.slope += np.outer(excess, change) / (change @ change)
        raise RuntimeError(f"no level flight found at {speed:.1f} m/s")


def drag(speed):
    """Drag of the fuselage, N."""
    return 0.5 * DENSITY * speed**2 * DRAG_AREA


def fly(flight, model):
    """Rows of the table, one for each advance ratio: averages over one revolution, forces in N,
    angles in deg."""
    for mu in ADVANCE_RATIOS:
        speed = mu * TIP_SPEED
        flight.trim(speed)
        means = flight.means
        thrust, backward, a1 = means["thrust"], -means["hub_forward"], means["a1"]
        yield {
            "model": model,
            "mu": mu,
            "collective": flight.controls[0],
            "tilt": flight.controls[1],
            "thrust": thrust,
            "H": backward,
            # The same force along the tip-path plane, which leans back by a1.
            "H_tip_path": backward * math.cos(a1) - thrust * math.sin(a1),
            "power": means["power"],
            "parasite_power": drag(speed) * speed,
            "coning": math.degrees(means["coning"]),
            "a1": math.degrees(a1),
            "b1": math.degrees(means["b1"]),
        }


def disc(rotor):
    """The advance ratio, and azimuths (deg), radii (r/R) and angles of attack (deg, a row for each
    azimuth) of blade 1 over one revolution."""
    names = ["advanceRatio"] + [f"station[{k}].radius" for k in STATIONS]
    mu, *radii = revolution(rotor, names, 1)[0]
    names = ["azimuth"] + [f"station[{k}].angleOfAttack" for k in STATIONS]
    points = revolution(rotor, names, DISC_POINTS)
    # The azimuth grows from revolution to revolution.
    azimuths = np.degrees(points[:, 0]) % 360.0
    order = np.argsort(azimuths)
    return mu, azimuths[order], np.array(radii), np.degrees(points[order, 1:])


def plot_sweep(rows, file):
    """Controls, loads and flapping against advance ratio, a line for each inflow model."""
    # Column of the table, colour, factor, and the label and its position where there are several.
    panels = {
        "controls, deg": [
            ("collective", "black", 1.0, ("collective", 0.01, 8.3)),
            ("tilt", "0.5", 1.0, ("shaft tilt", 0.2, 3.3)),
        ],
        "forces, N": [
            ("thrust", "black", 0.1, ("thrust / 10", 0.01, 6.15)),
            ("H", "black", 1.0, ("H-force in the\nplane of the hub", 0.06, 2.9)),
            ("H_tip_path", "0.5", 1.0, ("in the tip-path plane", 0.16, 0.75)),
        ],
        "power, W": [
            ("power", "black", 1.0, ("of the rotor", 0.05, 400.0)),
            ("parasite_power", "0.5", 1.0, ("drag times speed", 0.1, 105.0)),
        ],
        "coning $a_0$, deg": [("coning", "black", 1.0, None)],
        "longitudinal flapping $a_1$ (back), deg": [("a1", "black", 1.0, None)],
        "lateral flapping $b_1$ (right), deg": [("b1", "black", 1.0, None)],
    }
    figure, axes = plt.subplots(2, 3, figsize=(10.5, 6.4), constrained_layout=True, sharex=True)
    for axis, (label, curves) in zip(axes.flat, panels.items()):
        for name, color, factor, text in curves:
            for model, (marker, line, _) in MODELS.items():
                chosen = [row for row in rows if row["model"] == model]
                axis.plot(
                    [row["mu"] for row in chosen],
                    [factor * row[name] for row in chosen],
                    marker=marker,
                    linestyle=line,
                    color=color,
                    markerfacecolor="white",
                    markersize=5.0,
                )
            if text is not None:
                words, x, y = text
                axis.text(x, y, words, color=color)
        axis.set_ylabel(label)
        axis.set_xlim(0.0, 0.37)
        low, high = axis.get_ylim()
        axis.set_ylim(min(low, 0.0), 1.1 * high)
        axis.grid(True, color="0.85")
    for axis in axes[1]:
        axis.set_xlabel("advance ratio $V/(\\Omega R)$")
    lines = axes[1, 0].get_lines()
    figure.legend(
        lines, MODELS, loc="outside upper center", ncols=3, frameon=False, title="Inflow model"
    )
    save_plot(figure, file)


def plot_disc(mu, azimuths, radii, alpha, file):
    """Angle of attack over the disc from above; `mu` is the edgewise flow over the tip speed."""
    # The first azimuth closes the revolution. Angles beyond 90 deg are continued below -180 deg,
    # so that contours do not cross a jump.
    psi = np.radians(np.append(azimuths, azimuths[0] + 360.0))[:, None]
    alpha = np.vstack([alpha, alpha[:1]])
    alpha = np.where(alpha > 90.0, alpha - 360.0, alpha)
    x, y = radii * np.sin(psi), -radii * np.cos(psi)

    figure, axis = plt.subplots(figsize=(7.2, 5.9), constrained_layout=True)
    levels = np.arange(-8.0, 12.1, 2.0)
    shades = plt.get_cmap("YlGnBu")(np.linspace(0.0, 0.75, len(levels)))
    filled = axis.contourf(x, y, alpha, levels, colors=shades, extend="min")
    lines = axis.contour(x, y, alpha, levels[4:], colors="black", linewidths=0.7, linestyles="-")
    axis.clabel(lines, fmt="%g", fontsize=9)
    axis.contourf(x, y, alpha, [-270.0, -90.0], colors="white", hatches=["////"])
    figure.colorbar(filled, ax=axis, shrink=0.75, label="angle of attack, deg")

    turn = np.linspace(0.0, 2.0 * math.pi, 361)
    for radius in (1.0, CUTOUT):
        axis.plot(radius * np.sin(turn), radius * np.cos(turn), color="black", linewidth=1.2)
    half = mu / 2.0
    axis.plot(half * np.sin(turn) - half, half * np.cos(turn), "--", color="black", linewidth=2.0)
    axis.annotate(
        "flow from behind (hatched);\ncircle of diameter $\\mu R$ (dashed)",
        (-0.8 * mu, -0.3 * mu),
        (-1.4, -1.2),
        arrowprops={"arrowstyle": "-"},
    )
    axis.text(0.0, -1.05, "tail, $\\psi = 0$", ha="center", va="top")
    axis.text(1.05, 0.0, "90°\nadvancing", va="center")
    axis.text(0.0, 1.05, "180°", ha="center", va="bottom")
    axis.text(-1.05, 0.0, "270°\nretreating", ha="right", va="center")
    arrow = {"arrowstyle": "-|>", "facecolor": "black"}
    axis.annotate("flight", (-1.15, 1.15), (-1.15, 0.75), ha="center", arrowprops=arrow)
    ends = [(1.1 * math.sin(angle), -1.1 * math.cos(angle)) for angle in (0.6, 1.1)]
    axis.annotate("", *reversed(ends), arrowprops=arrow | {"connectionstyle": "arc3,rad=0.15"})
    axis.text(0.95, -0.85, "turning\nsense")
    speed = f"$V/(\\Omega R)$ = {ADVANCE_RATIOS[-1]:g} (along the disc $\\mu$ = {mu:.2f})"
    axis.set_title(f"Angle of attack from above at {speed}")
    axis.set_xlim(-1.45, 1.45)
    axis.set_ylim(-1.22, 1.2)
    axis.set_aspect("equal")
    axis.axis("off")
    save_plot(figure, file)


def main():
    arguments = command_line(__doc__, out="folder for tables and plots").parse_args()
    rows = []
    print("inflow                mu  collective   tilt  H-force   power  coning     a1     b1")
    print("                               deg     deg        N       W     deg    deg    deg")
    with unpacked(arguments.fmu) as folder:
        for model, (_, _, settling) in MODELS.items():
            with Rotor(folder, PARAMETERS | {"models.inflow": model}) as rotor:
                rotor.set({"rpm": RPM})
                for row in fly(Flight(rotor, settling), model):
                    rows.append(row)
                    print(
                        f"{model:17s} {row['mu']:6.3f} {row['collective']:11.2f} {row['tilt']:6.2f}"
                        f" {row['H']:8.2f} {row['power']:7.1f} {row['coning']:7.2f}"
                        f" {row['a1']:6.2f} {row['b1']:6.2f}",
                        flush=True,
                    )
                if model == DISC_MODEL:
                    picture = disc(rotor)
    write_table(rows, arguments.out / "forward-flight.csv")
    mu, azimuths, radii, alpha = picture
    points = [
        {"azimuth": psi, "radius": r, "angle_of_attack": alpha[i, k]}
        for i, psi in enumerate(azimuths)
        for k, r in enumerate(radii)
    ]
    write_table(points, arguments.out / "angle-of-attack.csv")
    plot_sweep(rows, arguments.out / "forward-flight.png")
    plot_disc(mu, azimuths, radii, alpha, arguments.out / "angle-of-attack.png")
    for name in ("forward-flight", "angle-of-attack"):
        print(f"Table and plot: {arguments.out / name}.csv, {name}.png")


if __name__ == "__main__":
    main()
