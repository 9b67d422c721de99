"""A helicopter of two instances of the FMU: trim, power, stability, and a response to the stick.

The main and the tail rotor are the same FMU, on a rigid body with six degrees of freedom and a
table of fuselage drag and tail surfaces (a109.py).

    python fly.py --fmu HelicopterRotor.fmu --out FOLDER

trims level flight from hover to 60 m/s and writes into FOLDER

    trim.csv, .png           controls, attitude and power against speed
    derivatives.csv          stability derivatives: accelerations by velocity, rates and attitude
    eigenvalues.csv, .png    of the motion with them
    response.csv, .png       a step of the stick, by the rotors and by the linear model
"""

import math
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent))

import numpy as np
from scipy.linalg import expm

import a109
import pictures
from model import CONTROLS, PASSAGE, WEIGHT, Helicopter, cross, differences, kinematics, level
from rotor import Rotor, unpacked
from script import command_line, write_table

SPEEDS = np.arange(0.0, 61.0, 5.0)  # m/s
STATES = ["forward", "left", "up", "rollRate", "pitchRate", "yawRate", "pitch", "roll"]
STEPPED = 30.0  # m/s, at which the stick is moved
STEP = np.radians([0.0, 0.5, 0.0, 0.0])  # of the controls
STOP = 4.0  # s
DEGREE = 180.0 / math.pi


def trim(helicopter, speed, guess):
    """Controls and attitude of level flight by Newton's method, with what was measured there."""
    x, residuals = guess, []
    scale = WEIGHT * np.array([1.0] * 3 + [a109.MAIN_ROTOR["geometry.radius"]] * 3)
    while True:
        velocity_weight = level(x[4:], speed)
        motion = np.concatenate([velocity_weight[:3], np.zeros(3)])
        helicopter.begin(motion, x[:4])
        jacobian = helicopter.derivatives(motion, helicopter.main["inducedVelocity"])
        rotors, power, tail_power, induced = helicopter.mean()
        excess = rotors + np.concatenate(a109.airframe(motion[:3], motion[3:], induced))
        excess[:3] += velocity_weight[3:]
        residuals.append(np.abs(excess / scale).max())
        if residuals[-1] < 1e-9:
            return x, motion, jacobian, residuals, (power, tail_power, induced)
        if len(residuals) > 30:
            raise RuntimeError(f"no trim at {speed} m/s: {residuals}")
        turned = differences(lambda a: level(a, speed), x[4:], 1e-5)
        attitude = jacobian[:, :3] @ turned[:3]
        attitude[:3] += turned[3:]
        x = x - np.linalg.solve(np.hstack([jacobian[:, 6:], attitude]), excess)


def linear_model(motion, jacobian, attitude, speed):
    """A and B of (velocity, rates, pitch, roll), of a body whose rotors are always in their steady
    state."""
    mass = np.block([[a109.MASS * np.eye(3), np.zeros((3, 3))], [np.zeros((3, 3)), a109.INERTIA]])
    forces = jacobian[:, :6].copy()
    forces[:3, 3:] += a109.MASS * cross(motion[:3])  # -m rates x velocity
    weight = np.zeros((6, 2))
    weight[:3] = differences(lambda a: level(a, speed), attitude, 1e-5)[3:]
    a = np.zeros((8, 8))
    a[:6] = np.linalg.solve(mass, np.hstack([forces, weight]))
    a[6:, 3:6] = kinematics(attitude)
    b = np.zeros((8, 4))
    b[:6] = np.linalg.solve(mass, jacobian[:, 6:])
    return a, b


def respond(helicopter, trimmed, step, stop, parts=30):
    """Rows of time and state after a step of the controls, and at the beginning."""
    x, motion = trimmed
    state = np.concatenate([motion, x[4:]])
    helicopter.begin(motion, x[:4])
    controls = x[:4] + step
    duration = 4.0 * PASSAGE / parts
    inverse = np.linalg.inv(a109.INERTIA)
    rows = [np.append(0.0, state)]
    loads, induced = helicopter.now()
    while rows[-1][0] < stop:
        helicopter.move(state[:6], controls)
        for rotor in (helicopter.main, helicopter.tail):
            rotor.step(duration)
        before = loads
        loads, induced = helicopter.now()

        def rates(state, rotors):
            velocity, omega = state[:3], state[3:6]
            total = rotors + np.concatenate(a109.airframe(velocity, omega, induced))
            total[:3] += level(state[6:], 0.0)[3:]
            turn = inverse @ (total[3:] - np.cross(omega, a109.INERTIA @ omega))
            move = total[:3] / a109.MASS - np.cross(omega, velocity)
            return np.concatenate([move, turn, kinematics(state[6:]) @ omega])

        # Heun's method, with the loads at both ends of the step.
        first = rates(state, before)
        second = rates(state + duration * first, loads)
        state = state + 0.5 * duration * (first + second)
        rows.append(np.append(rows[-1][0] + duration, state))
    return np.array(rows)


def response_table(flown, a, b):
    """Changes in deg, deg/s and m/s from the first row, and those of x' = a x + b."""
    times = flown[:, 0]
    # One step of the exact solution, repeated.
    duration = times[1] - times[0]
    n = len(b)
    block = np.zeros((n + 1, n + 1))
    block[:n, :n], block[:n, n] = a, b
    step = expm(block * duration)
    linear = [np.append(np.zeros(n), 1.0)]
    for _ in times[1:]:
        linear.append(step @ linear[-1])
    scale = {"forward": (0, 1.0), "rollRate": (3, DEGREE), "pitchRate": (4, DEGREE)}
    scale |= {"pitch": (6, DEGREE), "roll": (7, DEGREE)}
    rows = []
    for time, state, line in zip(times, flown[:, 1:] - flown[0, 1:], linear):
        rows.append(
            {"time": time}
            | {name: factor * state[i] for name, (i, factor) in scale.items()}
            | {f"linear:{name}": factor * line[i] for name, (i, factor) in scale.items()}
        )
    return rows


def print_modes(modes):
    for speed in (0.0, 30.0, 60.0):
        chosen = [m for m in modes if m["speed"] == speed and m["imaginary"] >= 0.0]
        words = [f"{m['real']:.2f} +- {m['imaginary']:.2f} i" for m in chosen]
        print(f"eigenvalues at {speed:.0f} m/s, 1/s: {', '.join(words)}")


def main():
    arguments = command_line(__doc__, out="folder for tables and pictures").parse_args()
    guess = np.array([0.25, 0.0, 0.0, 0.2, 0.0, 0.0])
    table, modes, lines = [], [], {}
    print("speed collective longitudinal  lateral   tail   pitch    roll   power  residual steps")
    print("  m/s        deg          deg      deg    deg     deg     deg      kW")
    with (
        unpacked(arguments.fmu) as fmu,
        Rotor(fmu, a109.MAIN_ROTOR) as main_rotor,
        Rotor(fmu, a109.TAIL_ROTOR) as tail_rotor,
    ):
        helicopter = Helicopter(main_rotor, tail_rotor)
        for i, speed in enumerate(SPEEDS):
            print(f"progress {i} {len(SPEEDS) + 1} trim at {speed:.0f} m/s")
            x, motion, jacobian, residuals, (power, tail, induced) = trim(helicopter, speed, guess)
            guess = x
            degrees = np.degrees(x)
            names = [*CONTROLS, "tailCollective", "pitch", "roll"]
            table.append(
                {"speed": speed}
                | dict(zip(names, degrees))
                | {"mainPower": power, "tailPower": tail, "inducedVelocity": induced}
                | {"residual": residuals[-1], "steps": len(residuals) - 1}
            )
            a, b = linear_model(motion, jacobian, x[4:], speed)
            for value in sorted(np.linalg.eigvals(a), key=lambda v: (v.real, v.imag)):
                modes.append({"speed": speed, "real": value.real, "imaginary": value.imag})
            lines[speed] = (x, motion, a, b)
            print(
                f"{speed:5.0f} {degrees[0]:10.2f} {degrees[1]:12.2f} {degrees[2]:8.2f}"
                f" {degrees[3]:6.2f} {degrees[4]:7.2f} {degrees[5]:7.2f}"
                f" {1e-3 * (power + tail):7.1f} {residuals[-1]:9.1e} {len(residuals) - 1:5d}"
            )
        print(f"progress {len(SPEEDS)} {len(SPEEDS) + 1} response")
        x, motion, a, b = lines[STEPPED]
        flown = respond(helicopter, (x, motion), STEP, STOP)
    print_modes(modes)
    changes = response_table(flown, a, b @ STEP)
    out = arguments.out
    write_table(table, out / "trim.csv")
    write_table(modes, out / "eigenvalues.csv")
    write_table(changes, out / "response.csv")
    rates = [
        {"row": row, "speed": speed} | dict(zip(STATES, a[STATES.index(row)]))
        for speed, (_, _, a, _) in lines.items()
        for row in STATES[:6]
    ]
    write_table(rates, out / "derivatives.csv")
    pictures.trim(table, out / "trim.png")
    pictures.eigenvalues(modes, out / "eigenvalues.png")
    words = f"Longitudinal cyclic raised by {math.degrees(STEP[1]):g} deg at {STEPPED:g} m/s"
    pictures.response(changes, words, out / "response.png")


if __name__ == "__main__":
    main()
