"""A quadrotor of four instances of the FMU: motors, a hover controller, and a step in position.

Each rotor is driven by a torque (drive.mode = torque): a motor controller turns speed commands into
limited torques. The controller moves the quadrotor 3 m forward and turns it by 90 deg at once.
While it turns, two rotors are faster than the other two, so that their gyroscopic moments do not
cancel: pitching makes it roll. The flight is repeated with blades without inertia against that.

    python quadrotor.py --fmu HelicopterRotor.fmu --out FOLDER

prints both flights and writes quadrotor.csv and quadrotor.png into FOLDER.
"""

import math
import sys
import time
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent))

import numpy as np
from scipy.spatial.transform import Rotation

from rotor import Rotor, unpacked
from script import command_line, plt, save_plot, write_table

# All numbers of this quadrotor are assumed: a size that students build.
MASS, GRAVITY = 1.0, 9.81  # kg, m/s2
INERTIA = np.array([0.010, 0.010, 0.018])  # kg.m2, without the rotors' spin
ARM = 0.16  # m, forward and to the left
PLACES = ARM * np.array([[1, 1, 0], [1, -1, 0], [-1, -1, 0], [-1, 1, 0]], float)
SPIN = np.array([1.0, -1.0, 1.0, -1.0])  # counter-clockwise: 1
DRAG = 0.05  # N per m/s of airspeed
DRIVE_INERTIA = 1.2e-4  # kg.m2, of propeller and motor
BLADE_INERTIA = 4.8e-5  # kg.m2, of one of the two blades
ROTOR = {
    "geometry.numberOfBlades": 2,
    "geometry.radius": 0.127,  # m
    "geometry.chord": 0.024,  # m
    "geometry.twist": math.radians(-8.0),
    "geometry.pitchReferenceRadius": 0.75,
    "airfoil.file": "airfoils/naca0012.polar",
    # The inflow is a state, so that no equation is solved in a step: thirty times as fast as
    # uniform inflow averaged over the disc.
    "models.inflow": "pittPetersDynamic",
    "models.blades": "individual",
    "numerics.azimuthStep": 0.2,  # rad
    "drive.mode": "torque",
    "drive.inertia": DRIVE_INERTIA,
    "flapping.inertia": BLADE_INERTIA,
    "numerics.elements": 15,
}
PITCH = math.radians(11.0)
MOST_TORQUE = 0.15  # N.m
MOTOR_GAIN = 2.0e-3  # N.m/(rad/s): a speed error of 50 rad/s takes 0.1 N.m
STEP, STOP = 0.002, 5.0  # s
LOADS = [f"{kind}[{i}]" for kind in ("force", "moment") for i in (1, 2, 3)]
MOTION = [f"{kind}[{i}]" for kind in ("velocity", "angularVelocity") for i in (1, 2, 3)]
NAMES = [*LOADS, "rotorSpeed", "torque"]


def hover(rotor):
    """The speed (rad/s) at which a rotor carries a quarter of the weight, and its torque."""
    speed = 500.0
    for _ in range(20):
        rotor.set({"rpm": speed * 30.0 / math.pi})
        thrust, torque = rotor.get(["thrust", "torque"])
        ratio = 4.0 * thrust / (MASS * GRAVITY)
        if abs(ratio - 1.0) < 1e-12:
            return speed, torque
        speed /= math.sqrt(ratio)
    raise RuntimeError("no speed found at which the rotors carry the weight")


class Controller:
    """From the wanted position (m) and heading (rad) to speeds of the rotors: position, attitude
    and rates in a cascade, each a few times faster than the one before."""

    def __init__(self, speed, torque):
        self.speed = speed
        thrust = MASS * GRAVITY / 4.0
        # Lift and torque grow with the square of the speed; columns: rotors.
        lift, drag = thrust / speed**2, torque / speed**2
        rows = [lift * np.ones(4), lift * PLACES[:, 1], -lift * PLACES[:, 0], -drag * SPIN]
        self.mixer = np.linalg.inv(rows)

    def speeds(self, wanted, heading, place, velocity, turned, rates):
        pull = 4.0 * (wanted - place) - 3.2 * velocity
        pull = MASS * (np.clip(pull, -5.0, 5.0) + [0.0, 0.0, GRAVITY])
        # The attitude in which the rotors pull in this direction, and the nose in that of heading.
        up = pull / np.linalg.norm(pull)
        left = np.cross(up, [math.cos(heading), math.sin(heading), 0.0])
        left /= np.linalg.norm(left)
        goal = Rotation.from_matrix(np.array([np.cross(left, up), left, up]).T)
        error = (turned.inv() * goal).as_rotvec()
        turn = INERTIA * (np.array([14.0, 14.0, 4.0]) * (np.array([7.0, 7.0, 2.5]) * error - rates))
        lift = pull @ turned.as_matrix()[:, 2]
        squares = self.mixer @ [lift, *np.clip(turn, -0.6, 0.6)]
        return np.sqrt(np.clip(squares, (0.3 * self.speed) ** 2, (1.6 * self.speed) ** 2))


def fly(rotors, speed, torque):
    """Rows of the flight, which begins in hover."""
    controller = Controller(speed, torque)
    place, velocity, rates = np.zeros(3), np.zeros(3), np.zeros(3)
    turned = Rotation.identity()
    given = np.full(4, torque)
    values = np.array([rotor.get(NAMES) for rotor in rotors])
    for i in range(round(STOP / STEP) + 1):
        now = i * STEP
        speeds = values[:, 6] * math.pi / 30.0
        heading, pitch, roll = turned.as_euler("ZYX")
        yield {
            "time": now,
            **dict(zip(("x", "y", "z"), place)),
            **dict(zip(("roll", "pitch", "heading"), np.degrees([roll, pitch, heading]))),
            **{f"rpm{k + 1}": rpm for k, rpm in enumerate(values[:, 6])},
            "yawMomentum": INERTIA[2] * rates[2] + DRIVE_INERTIA * SPIN @ speeds,
            # Of the air on the rotors, about the z axis of the body.
            "airTorque": np.cross(PLACES, values[:, :3])[:, 2].sum() - SPIN @ values[:, 7],
            "rollRate": rates[0],
            "pitchRate": rates[1],
            "yawRate": rates[2],
        }
        is_stepped = now >= 0.5
        wanted, turn = np.array([3.0 * is_stepped, 0.0, 0.0]), math.radians(90.0) * is_stepped
        commands = controller.speeds(wanted, turn, place, velocity, turned, rates)
        given = torque * (speeds / speed) ** 2 + MOTOR_GAIN * (commands - speeds)
        given = np.clip(given, 0.0, MOST_TORQUE)
        # The body's frame is what the FMU calls the ground frame, so that shafts do not tilt in it.
        air = turned.inv().apply(velocity)
        for rotor, arm, drive in zip(rotors, PLACES, given):
            motion = [*(air + np.cross(rates, arm)), *rates]
            rotor.set(dict(zip(MOTION, motion)) | {"driveTorque": drive})
            rotor.step(STEP)
        values = np.array([rotor.get(NAMES) for rotor in rotors])
        force = values[:, :3].sum(axis=0) - DRAG * air
        moment = (values[:, 3:6] + np.cross(PLACES, values[:, :3])).sum(axis=0)
        # Semi-implicit Euler.
        velocity = velocity + STEP * (turned.apply(force) / MASS - [0.0, 0.0, GRAVITY])
        place = place + STEP * velocity
        rates = rates + STEP * (moment - np.cross(rates, INERTIA * rates)) / INERTIA
        turned = turned * Rotation.from_rotvec(STEP * rates)


def flight(fmu, blade_inertia):
    """The rows of a flight and the time that it took, s."""
    parameters = ROTOR | {"flapping.inertia": blade_inertia}
    directions = ["counterClockwise" if spin > 0.0 else "clockwise" for spin in SPIN]
    rotors = [Rotor(fmu, parameters | {"geometry.rotation": way}) for way in directions]
    try:
        for rotor in rotors:
            rotor.set({"collective": PITCH})
            speed, torque = hover(rotor)
            rotor.set({"driveTorque": torque})
            rotor.start()
        began = time.perf_counter()
        rows = list(fly(rotors, speed, torque))
        return rows, time.perf_counter() - began
    finally:
        for rotor in rotors:
            rotor.close()


def plot(flights, file):
    figure, axes = plt.subplots(4, 1, figsize=(7.5, 9.0), sharex=True, constrained_layout=True)
    (words, rows), (other, without) = flights.items()
    times = [row["time"] for row in rows]
    for axis, name in zip(axes, ("x", "roll")):
        axis.plot(times, [row[name] for row in rows], color="black", label=words)
        axis.plot(times, [row[name] for row in without], "--", color="#c05020", label=other)
    for name, style in (("roll", "-"), ("pitch", "--"), ("heading", ":")):
        change = [row[name] - before[name] for row, before in zip(rows, without)]
        axes[2].plot(times, change, style, color="black", label=name)
    for k, side in enumerate(("front left", "front right", "rear right", "rear left")):
        color = "#2b5c8a" if SPIN[k] > 0 else "#c05020"
        label = f"{side}, {'counter-' if SPIN[k] > 0 else ''}clockwise"
        values = [row[f"rpm{k + 1}"] for row in rows]
        axes[3].plot(times, values, "-" if k < 2 else "--", color=color, label=label)
    labels = ("forward, m", "roll, deg\n(right down)", "with gyroscopic\nmoments less without, deg")
    for axis, label in zip(axes, (*labels, "rotors, rev/min")):
        axis.set_ylabel(label)
        axis.grid(True, color="0.85")
    axes[0].legend(loc="lower right")
    axes[2].legend(loc="upper right", ncols=3)
    axes[3].legend(fontsize=8, ncols=2, loc="upper right")
    axes[3].set_xlabel("time, s")
    axes[3].set_xlim(0.0, STOP)
    axes[0].set_title("Four HelicopterRotor.fmu fly 3 m forward while they turn by 90 deg")
    save_plot(figure, file)


def main():
    arguments = command_line(__doc__, out="folder for table and plot").parse_args()
    flights, table = {}, []
    with unpacked(arguments.fmu) as fmu:
        for i, (words, inertia) in enumerate(
            {"with gyroscopic moments": BLADE_INERTIA, "without": 1e-12}.items()
        ):
            print(f"progress {i} 2 flight {words}")
            rows, seconds = flight(fmu, inertia)
            flights[words] = rows
            table += [{"gyroscopic": int(i == 0)} | row for row in rows]
            roll = max(abs(row["roll"]) for row in rows)
            print(
                f"{words:23s}: at the end x {rows[-1]['x']:.3f} m, heading"
                f" {rows[-1]['heading']:.2f} deg; largest roll {roll:.2f} deg;"
                f" {seconds / STOP:.2f} s of computing for each second of flight"
            )
    write_table(table, arguments.out / "quadrotor.csv")
    plot(flights, arguments.out / "quadrotor.png")


if __name__ == "__main__":
    main()
