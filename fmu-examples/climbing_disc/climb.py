"""A disc with the rotor climbs to a height and holds it: the FMU, a mass and a PID controller.

This is the computer-controlled model of section 3.3.3 in Lovaco Hernandez (2017), "Verification of
a Modelica Helicopter Rotor Model Using Blade Element Theory", Linkoping University. A sensor of the
height feeds a PID controller, which moves the collective.

    python climb.py --fmu HelicopterRotor.fmu --out FOLDER

prints how the disc arrives and writes into FOLDER

    climbing-disc.csv, .png    the climb against time
    tip-path.png               the path of a blade tip
    climbing-disc.gif, .html   the turning rotor, which animate.py draws from the table
"""

import math
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent))

import animate
from parts import GRAVITY, Body, Pid
from rotor import Rotor
from script import command_line, plt, save_plot, write_table

# The FMU's default rotor with flapping blades, whose mean inflow takes some time to build up.
RADIUS = 0.762  # m
RPM = 960.0
PARAMETERS = {"models.inflow": "pittPetersDynamic", "flapping.enabled": True}
HOVER_PITCH = math.radians(8.0)
HEIGHT = 2.5  # m
STEP = 0.005  # s
STOP = 8.0  # s

# One degree of collective changes the acceleration by about 1.6 m/s2. With 0.05 rad/m the disc
# moves like a mass on a spring with 2.1 rad/s, which the derivative damps.
CONTROLLER = {
    "gain": 0.05,  # rad/m
    "integral_time": 2.5,  # s
    "derivative_time": 0.6,  # s
    "weight": 0.6,
    "low": math.radians(2.0),
    "high": math.radians(14.0),
}


def fly(rotor):
    """Rows of the table, one for each communication point."""
    rotor.set({"rpm": RPM, "collective": HOVER_PITCH})
    # The disc weighs what the rotor carries at HOVER_PITCH, as in the thesis.
    body = Body(rotor["force[3]"] / GRAVITY)
    pid = Pid(**CONTROLLER, trim=HOVER_PITCH)
    while True:
        thrust = rotor["force[3]"]
        yield {
            "time": rotor.time,
            "height": body.height,
            "climb": body.climb,
            "collective": pid.output,
            "thrust": thrust,
            "azimuth": rotor["azimuth"],
            "coning": rotor["coning"],
            "longitudinalFlapping": rotor["longitudinalFlapping"],
            "lateralFlapping": rotor["lateralFlapping"],
        }
        if rotor.time > STOP - 0.5 * STEP:
            return
        pid.step(HEIGHT, body.height, STEP)
        rotor.set({"collective": pid.output, "velocity[3]": body.climb})
        rotor.step(STEP)
        body.step(0.5 * (thrust + rotor["force[3]"]), STEP)


def arrival(rows):
    """Overshoot (part of the height), and the time from which the disc stays within 2 % of it."""
    overshoot = max(row["height"] for row in rows) / HEIGHT - 1.0
    outside = [row["time"] for row in rows if abs(row["height"] / HEIGHT - 1.0) > 0.02]
    return overshoot, max(outside) + STEP


def plot_climb(rows, file):
    panels = [
        ("height, m", [row["height"] for row in rows]),
        ("climb, m/s", [row["climb"] for row in rows]),
        ("collective, deg", [math.degrees(row["collective"]) for row in rows]),
        ("thrust / weight", [row["thrust"] / rows[0]["thrust"] for row in rows]),
    ]
    times = [row["time"] for row in rows]
    figure, axes = plt.subplots(4, 1, figsize=(7.5, 7.5), sharex=True, constrained_layout=True)
    for axis, (label, values) in zip(axes, panels):
        axis.plot(times, values, color="black", linewidth=1.6)
        axis.set_ylabel(label)
        axis.grid(True, color="0.85")
        axis.set_xlim(0.0, times[-1])
    overshoot, settled = arrival(rows)
    axes[0].axhspan(0.98 * HEIGHT, 1.02 * HEIGHT, color="#b5cde8", linewidth=0.0)
    axes[0].axvline(settled, color="black", linestyle=":")
    words = f"overshoot {100.0 * overshoot:.1f} %;\nwithin 2 % after {settled:.1f} s"
    axes[0].text(settled + 0.1, 0.3, words)
    axes[-1].set_xlabel("time, s")
    figure.suptitle("A disc climbs to 2.5 m: HelicopterRotor.fmu, a mass and a PID controller")
    save_plot(figure, file)


def plot_tip_path(rows, file):
    """The path of the tip of blade 1 in space, and the disc at the end."""
    figure = plt.figure(figsize=(5.0, 6.6))
    axis = figure.add_axes((-0.06, -0.02, 1.02, 1.1), projection="3d")
    tips = [tip(row, row["azimuth"]) for row in points_between(rows, 6)]
    axis.plot(*zip(*tips), color="#2b5c8a", linewidth=0.7)
    circle = [tip(rows[-1], math.radians(psi)) for psi in range(0, 361, 5)]
    axis.plot(*zip(*circle), color="black", linewidth=1.5)
    for psi in (0.0, 0.5 * math.pi):
        ends = [tip(rows[-1], rows[-1]["azimuth"] + psi + half) for half in (0.0, math.pi)]
        axis.plot(*zip(*ends), color="black", linewidth=1.5)
    axis.set_box_aspect((1.0, 1.0, 1.6))
    axis.set_xlabel("x (forward), m")
    axis.set_ylabel("y (left), m")
    axis.set_zlabel("height, m")
    axis.view_init(18.0, -60.0)
    axis.set(xticks=[-0.5, 0.0, 0.5], yticks=[-0.5, 0.0, 0.5])
    figure.suptitle("Path of the tip of blade 1, and the rotor at its height", fontsize=11)
    save_plot(figure, file)


def points_between(rows, number):
    """The rows with `number` points interpolated in each interval of time."""
    for row, after in zip(rows, rows[1:]):
        for i in range(number):
            yield {name: row[name] + i / number * (after[name] - row[name]) for name in row}


def tip(row, azimuth):
    """Where the blade at an azimuth ends, m. The azimuth 0 is over the tail."""
    flap = row["coning"] - row["longitudinalFlapping"] * math.cos(azimuth)
    flap -= row["lateralFlapping"] * math.sin(azimuth)
    reach = RADIUS * math.cos(flap)
    height = row["height"] + RADIUS * math.sin(flap)
    return -reach * math.cos(azimuth), -reach * math.sin(azimuth), height


def main():
    arguments = command_line(__doc__, out="folder for table and pictures").parse_args()
    rows = []
    print("time, s  height, m  climb, m/s  collective, deg  thrust, N")
    with Rotor(arguments.fmu, PARAMETERS) as rotor:
        for row in fly(rotor):
            if len(rows) % 100 == 0:
                print(
                    f"{row['time']:7.1f} {row['height']:10.3f} {row['climb']:11.3f}"
                    f" {math.degrees(row['collective']):16.2f} {row['thrust']:10.2f}"
                )
            rows.append(row)
    overshoot, settled = arrival(rows)
    print(f"Overshoot {100.0 * overshoot:.1f} %; within 2 % after {settled:.2f} s")
    table = arguments.out / "climbing-disc.csv"
    write_table(rows, table)
    plot_climb(rows, arguments.out / "climbing-disc.png")
    plot_tip_path(rows, arguments.out / "tip-path.png")
    for suffix in (".gif", ".html"):
        animate.make(table, table.with_suffix(suffix), RADIUS, stop=4.0)


if __name__ == "__main__":
    main()
