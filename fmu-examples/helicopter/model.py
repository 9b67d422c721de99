"""A helicopter of two rotors on a rigid body: loads, their derivatives, and how the body moves."""

import math

import numpy as np

import a109

LOADS = [f"{kind}[{i}]" for kind in ("force", "moment") for i in (1, 2, 3)]
MOTION = [f"{kind}[{i}]" for kind in ("velocity", "angularVelocity") for i in (1, 2, 3)]
CONTROLS = ["collective", "cyclicLongitudinal", "cyclicLateral"]
PASSAGE = 2.0 * math.pi / 4 / (a109.RPM * math.pi / 30.0)  # s, of a blade of the main rotor
PARTS = 10  # of a passage, over which the pulsating loads are averaged
WEIGHT = a109.MASS * a109.GRAVITY


def cross(r):
    """The matrix of r x ..."""
    return np.array([[0.0, -r[2], r[1]], [r[2], 0.0, -r[0]], [-r[1], r[0], 0.0]])


class Helicopter:
    """Loads and their derivatives. `motion`: velocity and rates in body axes, m/s and rad/s.
    `controls`: collective, longitudinal and lateral cyclic, collective of the tail rotor, rad."""

    def __init__(self, main, tail):
        self.main, self.tail = main, tail

    def begin(self, motion, controls):
        """Both rotors in the steady state with this motion. What the FMU calls the ground frame is
        the body's here, so that shafts do not move in it."""
        self.main.restart(a109.MAIN_ROTOR)
        self.tail.restart(a109.TAIL_ROTOR)
        self.main.set({"rpm": a109.RPM, "tilt": a109.SHAFT})
        self.tail.set({"rpm": a109.TAIL_RPM, "lateralTilt": 0.5 * math.pi})
        self.move(motion, controls)

    def move(self, motion, controls):
        velocity, rates = motion[:3], motion[3:]
        main = np.concatenate([velocity + np.cross(rates, a109.HUB), rates])
        self.main.set(dict(zip(MOTION + CONTROLS, [*main, *controls[:3]])))
        tail = np.concatenate([velocity + np.cross(rates, a109.TAIL_HUB), rates])
        self.tail.set(dict(zip([*MOTION, "collective"], [*tail, controls[3]])))

    def mean(self):
        """Means over the next passage of a blade: loads of both rotors, their power, and the
        induced velocity of the main rotor."""
        names = [*LOADS, "power", "inducedVelocity"]
        total = 0.0
        for _ in range(PARTS):
            self.main.step(PASSAGE / PARTS)
            total = total + np.array(self.main.get(names))
        main, tail = total / PARTS, np.array(self.tail.get(names))
        return self.about_centre(main[:6], tail[:6]), main[6], tail[6], main[7]

    def now(self):
        main, tail = (np.array(rotor.get(LOADS)) for rotor in (self.main, self.tail))
        return self.about_centre(main, tail), self.main["inducedVelocity"]

    def about_centre(self, main, tail):
        """Forces and moments of both rotors about the centre of gravity; also of derivatives."""
        torque = np.zeros_like(tail[3:])
        torque[1] = tail[4]  # The tail rotor's shaft is the y axis.
        moment = main[3:] + cross(a109.HUB) @ main[:3] + torque + cross(a109.TAIL_HUB) @ tail[:3]
        return np.concatenate([main[:3] + tail[:3], moment])

    def derivatives(self, motion, induced):
        """Of the loads (rows) by the motion and the controls, in the state after `begin`."""
        rows = [*LOADS, "inducedVelocity"]
        main = self.main.jacobian(rows, MOTION + CONTROLS)
        tail = self.tail.jacobian(LOADS, [*MOTION, "collective"])
        for matrix, hub in ((main, a109.HUB), (tail, a109.TAIL_HUB)):
            # Rates also move the hub: velocity + rates x hub.
            matrix[:, 3:6] -= matrix[:, :3] @ cross(hub)
        none = np.zeros((6, 1))
        rotors = self.about_centre(np.hstack([main[:6], none]), np.zeros((6, 10)))
        part = self.about_centre(np.zeros((6, 7)), tail)
        rotors[:, :6] += part[:, :6]
        rotors[:, 9] += part[:, 6]

        def air(x):
            return np.concatenate(a109.airframe(x[:3], x[3:6], x[6]))

        body = differences(air, np.append(motion, induced), 1e-4)
        rotors[:, :6] += body[:, :6]
        rotors[:, :9] += np.outer(body[:, 6], main[6])
        return rotors


def differences(function, x, step):
    """Central differences of the airframe's functions, which are quadratic."""
    steps = step * np.eye(len(x))
    return np.array([(function(x + d) - function(x - d)) / (2.0 * step) for d in steps]).T


def to_body(attitude):
    """The matrix from axes that point along the flight and up to body axes. `attitude`: pitch,
    positive nose down, then roll, positive right down."""
    p, r = attitude
    pitch = np.array([[math.cos(p), 0, math.sin(p)], [0, 1, 0], [-math.sin(p), 0, math.cos(p)]])
    roll = np.array([[1, 0, 0], [0, math.cos(r), -math.sin(r)], [0, math.sin(r), math.cos(r)]])
    return (pitch @ roll).T


def level(attitude, speed):
    """Velocity and weight in body axes."""
    body = to_body(attitude)
    return np.concatenate([body @ [speed, 0.0, 0.0], body @ [0.0, 0.0, -WEIGHT]])


def kinematics(attitude):
    """Rates of pitch and roll from the rates about body axes."""
    p, r = attitude
    return np.array(
        [
            [0.0, math.cos(r), -math.sin(r)],
            [1.0, math.sin(r) * math.tan(p), math.cos(r) * math.tan(p)],
        ]
    )
