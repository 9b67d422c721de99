"""Flies a light helicopter from hover through an engine failure to a landing in autorotation.

The rotor is the FMU, turned by a torque instead of at an imposed speed (drive.mode = torque). This
script adds an engine with a governor, a point mass that moves up and down, and a pilot. Vertical
descent is the hardest case: there is no forward speed to trade for rotor speed in a flare, so the
energy in the rotor alone cushions the landing.

    python engine_off.py --fmu HelicopterRotor.fmu --out FOLDER

prints the flight and writes engine-off.csv and engine-off.png into FOLDER.
"""

import math

from rotor import Rotor
from script import command_line, plt, save_plot, write_table

# A light helicopter with two heavy blades, like those of the 1950s, at sea level.
GRAVITY = 9.81  # m/s2
DENSITY = 1.225  # kg/m3
MASS = 1200.0  # kg
RADIUS = 5.6  # m; with the mass, a disc loading of 120 N/m2
CHORD = 0.28  # m; a solidity of 0.032
BLADES = 2
RPM = 340.0  # a tip speed of 199 m/s; CT/sigma is 0.08, about half that at stall
# Blades with weights in their tips: a Lock number rho a c R^4/I of 5, where I is the inertia of one
# blade about its root. The rotor then stores 0.5 MJ, enough for four seconds of hover power.
INERTIA = BLADES * DENSITY * 2.0 * math.pi * CHORD * RADIUS**4 / 5.0  # kg m2
PARAMETERS = {
    "geometry.numberOfBlades": BLADES,
    "geometry.radius": RADIUS,
    "geometry.rootCutout": 0.15,
    "geometry.chord": CHORD,
    # Stall limits the thrust in the landing, so the section data must reach the Reynolds number of
    # these blades, 3 million.
    "airfoil.file": "airfoils/naca0015.polar",
    "air.atmosphere": "userDefined",
    "air.density": DENSITY,
    # Inflow takes some tenths of a second to build up, so a quick pull gives more thrust at first.
    "models.inflow": "pittPetersDynamic",
    "models.descent": "measured",
    "models.groundEffect": "cheesemanBennett",
    "drive.mode": "torque",
    "drive.inertia": INERTIA,
}

WEIGHT = MASS * GRAVITY  # N
SPEED = RPM * math.pi / 30.0  # rad/s
HOVER_INFLOW = math.sqrt(WEIGHT / (2.0 * DENSITY * math.pi * RADIUS**2))  # v_h, m/s

# Helicopters autorotate vertically at 1.7 to 1.9 v_h (Leishman 2006).
TEXTBOOK = 1.85 * HOVER_INFLOW  # m/s, drawn beside the flight

# The governor of the engine is a PI controller on rotor speed, limited to torques from zero to the
# engine's maximum. It answers an error of 1 % in rotor speed with a tenth of the hover torque, and
# removes the error within about a second.
MOST_TORQUE = 5000.0  # N m, 180 kW
PROPORTIONAL = 1000.0  # N m/(rad/s)
INTEGRAL = 1000.0  # N m/rad

# The flight.
STEP = 0.01  # s; the touch-down is 2 % faster with a fifth of it
FAILURE = 3.0  # s
REACTION = 1.0  # s before the pilot reacts, as usual in certification
START_HEIGHT = 250.0  # m, of the hub; enough for a steady autorotation
GROUND_HEIGHT = 3.0  # m, of the hub when the skids touch

# The pilot's collective.
LOWEST_PITCH, HIGHEST_PITCH = 0.0, 16.0  # deg, the stops
LOWERING = 8.0  # deg/s, at most
PULLING = 12.0  # deg/s, at most
# In autorotation more pitch slows the rotor: a PI controller on rotor speed moves the pitch.
PITCH_PER_SPEED = 1.0  # deg/(rad/s)
PITCH_PER_ANGLE = 0.3  # deg/rad
# The landing: a constant deceleration down to the touch-down speed. A weaker one outlasts the
# energy of the rotor, and a stronger one begins too late for the pitch to follow: the skids touch
# at 2.4 m/s with 4.5 m/s2 and at 3.2 m/s with 7 m/s2. The pilot aims at TOUCH_DOWN and lands
# faster, because the pitch reaches its stop.
DECELERATION = 5.5  # m/s2
TOUCH_DOWN = 1.0  # m/s
# Pitch rate for missing acceleration; 1 deg of pitch changes it by about 1 m/s2.
PITCH_RATE_PER_ACCELERATION = 6.0  # (deg/s)/(m/s2)
CATCHING = 0.3  # s, the time constant in which an error of the sink rate is corrected


def hover_pitch(rotor):
    """The collective (deg) of hover, by the secant method, in Initialization Mode."""

    def excess(pitch):
        rotor.set({"collective": math.radians(pitch)})
        return rotor["thrust"] - WEIGHT

    before, pitch = 6.0, 10.0
    surplus_before, surplus = excess(before), excess(pitch)
    for _ in range(20):
        if abs(surplus) < 1e-6 * WEIGHT:
            return pitch
        slope = (surplus - surplus_before) / (pitch - before)
        before, surplus_before = pitch, surplus
        pitch -= surplus / slope
        surplus = excess(pitch)
    raise RuntimeError("no collective found at which the rotor carries the weight")


def limited(value, low, high):
    return min(max(value, low), high)


class Engine:
    """The engine with its governor; it begins at the hover `torque`."""

    def __init__(self, torque):
        self.held = torque

    def torque(self, time, speed):
        if time >= FAILURE:
            return 0.0
        missing = SPEED - speed
        self.held += INTEGRAL * missing * STEP
        return limited(self.held + PROPORTIONAL * missing, 0.0, MOST_TORQUE)


class Pilot:
    """Moves the collective (deg). `landing` is the time at which the pull before landing begins."""

    def __init__(self, pitch):
        self.pitch = pitch
        self.held = None  # deg, the integral part of the pitch in autorotation
        self.landing = None

    def move(self, time, height, sink, acceleration, speed):
        """The collective for the next step; `acceleration` is positive upwards."""
        if time < FAILURE + REACTION:
            return self.pitch
        # The sink rate from which the constant deceleration ends at the ground.
        left = max(height - GROUND_HEIGHT, 0.0)
        allowed = math.sqrt(TOUCH_DOWN**2 + 2.0 * DECELERATION * left)
        if self.landing is None and sink >= allowed:
            self.landing = time
        if self.landing is not None:
            wanted = DECELERATION + (sink - allowed) / CATCHING
            rate = PITCH_RATE_PER_ACCELERATION * (wanted - acceleration)
        else:
            rate = (self.for_speed(speed) - self.pitch) / STEP
        self.pitch += STEP * limited(rate, -LOWERING, PULLING)
        self.pitch = limited(self.pitch, LOWEST_PITCH, HIGHEST_PITCH)
        return self.pitch

    def for_speed(self, speed):
        """The pitch that brings the rotor back to its nominal speed and holds it there."""
        excess = speed - SPEED
        if self.held is None:
            # At the lower stop until the rotor is back within 5 % of its nominal speed.
            if excess < -0.05 * SPEED:
                return LOWEST_PITCH
            self.held = self.pitch - PITCH_PER_SPEED * excess
        self.held += PITCH_PER_ANGLE * excess * STEP
        return self.held + PITCH_PER_SPEED * excess


def fly(rotor):
    """The table, a row for each step until touch-down, and the time at which the pilot pulls."""
    rotor.set({"rpm": RPM, "heightAboveGround": START_HEIGHT})
    pitch = hover_pitch(rotor)
    engine, pilot = Engine(rotor["torque"]), Pilot(pitch)
    rotor.set({"driveTorque": rotor["torque"]})
    rotor.start()

    height, climb, rows = START_HEIGHT, 0.0, []
    while True:
        speed = rotor["rotorSpeed"] * math.pi / 30.0
        thrust = rotor["force[3]"]
        # The drag of the fuselage, some per cent of the weight, is left out.
        acceleration = thrust / MASS - GRAVITY
        torque = engine.torque(rotor.time, speed)
        pitch = pilot.move(rotor.time, height, -climb, acceleration, speed)
        rows.append(
            {
                "time": rotor.time,
                "height": height,
                "sink_rate": -climb,
                "collective": pitch,
                "rpm": rotor["rotorSpeed"],
                "drive_torque": torque,
                "rotor_torque": rotor["torque"],
                "thrust": thrust,
                "induced_velocity": rotor["inducedVelocity"],
                "stalled_fraction": rotor["stalledFraction"],
                "flow_state": rotor["flowState"],
            }
        )
        if height <= GROUND_HEIGHT:
            show(rows[-1])
            break
        if len(rows) % round(1.0 / STEP) == 1:
            show(rows[-1])
        if rotor.time > 120.0:
            raise RuntimeError("the helicopter does not come down")
        rotor.set(
            {
                "collective": math.radians(pitch),
                "driveTorque": torque,
                "velocity[3]": climb,
                "heightAboveGround": height,
            }
        )
        rotor.step(STEP)
        # Symplectic Euler: the mass moves at the new speed.
        climb += acceleration * STEP
        height = max(height + climb * STEP, GROUND_HEIGHT)
    return rows, pilot.landing


def steady(rows, landing):
    """Averages over the last two seconds before the pull: sink rate (m/s), rotor speed (rpm) and
    collective (deg)."""
    chosen = [row for row in rows if landing - 2.0 <= row["time"] < landing]
    return [sum(row[n] for row in chosen) / len(chosen) for n in ("sink_rate", "rpm", "collective")]


def plot(rows, landing, file):
    """The flight against time, on bands for the states of the flow."""
    times = [row["time"] for row in rows]
    end = times[-1]
    # Label and colour of each state; faster descents are darker, also in black and white.
    states = {
        "normal": ("normal", "white"),
        "vortexRing": ("vortex ring", "#fbe8c3"),
        "turbulentWake": ("turbulent wake", "#b5cde8"),
        "windmillBrake": ("windmill brake", "#8f9fc4"),
    }
    starts = [
        i for i in range(len(rows)) if i == 0 or rows[i]["flow_state"] != rows[i - 1]["flow_state"]
    ]
    bands = [
        (times[i], end if j is None else times[j], rows[i]["flow_state"])
        for i, j in zip(starts, [*starts[1:], None])
    ]
    sink, speed, pitch = steady(rows, landing)
    panels = [
        ("height of\nthe hub, m", [row["height"] for row in rows]),
        ("sink rate,\nm/s", [row["sink_rate"] for row in rows]),
        ("collective,\ndeg", [row["collective"] for row in rows]),
        ("rotor speed,\nrpm", [row["rpm"] for row in rows]),
        ("thrust /\nweight", [row["thrust"] / WEIGHT for row in rows]),
    ]
    figure, (strip, *axes) = plt.subplots(
        6,
        1,
        figsize=(9.0, 9.4),
        sharex=True,
        constrained_layout=True,
        gridspec_kw={"height_ratios": [0.28, 1.0, 1.0, 1.0, 1.0, 1.0]},
    )
    for begin, stop, name in bands:
        words, color = states[name]
        for axis in (strip, *axes):
            axis.axvspan(begin, stop, color=color, linewidth=0.0)
            axis.axvline(begin, color="0.6", linewidth=0.6)
        if stop - begin > 1.8:
            strip.text((begin + stop) / 2.0, 0.5, words, ha="center", va="center", fontsize=9)
        elif stop - begin > 0.6:
            short = words.replace(" ", "\n")
            strip.text((begin + stop) / 2.0, 0.5, short, ha="center", va="center", fontsize=7)
    strip.set_yticks([])
    strip.set_ylabel("flow", rotation=0, ha="right", va="center")
    for axis, (label, values) in zip(axes, panels):
        axis.plot(times, values, color="black", linewidth=1.6)
        axis.set_ylabel(label)
        axis.grid(True, color="0.5", alpha=0.3)
        for time in (FAILURE, FAILURE + REACTION, landing):
            axis.axvline(time, color="black", linewidth=0.9, linestyle=":")
    height_axis, sink_axis, pitch_axis, speed_axis, thrust_axis = axes
    events = [
        (FAILURE, "engine fails ", "right", 25.0),
        (FAILURE + REACTION, " pilot lowers\n the collective", "left", 25.0),
        (landing, "pilot pulls ", "right", 130.0),
    ]
    for time, words, side, height in events:
        height_axis.text(time, height, words, ha=side, va="bottom", fontsize=9)
    sink_axis.axhline(TEXTBOOK, color="black", linewidth=0.9, linestyle="--")
    sink_axis.text(0.2, TEXTBOOK, "1.85 $v_h$", va="bottom", fontsize=9)
    words = f"{sink:.1f} m/s = {sink / HOVER_INFLOW:.2f} $v_h$"
    sink_axis.text(16.0, sink - 1.0, words, va="top", fontsize=9)
    last = rows[-1]
    note = {"ha": "right", "va": "center", "fontsize": 9, "arrowprops": {"arrowstyle": "-"}}
    sink_axis.annotate(
        f"{last['sink_rate']:.1f} m/s", (end, last["sink_rate"]), (end - 2.2, 2.0), **note
    )
    pitch_axis.text(16.0, pitch + 1.0, f"{pitch:.1f} deg", va="bottom", fontsize=9)
    speed_axis.axhline(RPM, color="black", linewidth=0.9, linestyle="--")
    speed_axis.text(16.0, RPM - 6.0, "held by the collective", va="top", fontsize=9)
    speed_axis.text(0.2, RPM - 6.0, "held by the\nengine", va="top", fontsize=9)
    thrust_axis.axhline(1.0, color="black", linewidth=0.9, linestyle="--")
    for axis in axes:
        axis.set_xlim(0.0, end)
    for axis in (height_axis, sink_axis, pitch_axis, thrust_axis):
        axis.set_ylim(bottom=-0.02 * axis.get_ylim()[1])
    speed_axis.set_ylim(200.0, 370.0)
    thrust_axis.set_xlabel("time, s")
    figure.suptitle(
        "Engine failure in hover, vertical autorotation and landing: HelicopterRotor.fmu"
    )
    save_plot(figure, file)


def show(row):
    """Prints a row of the table."""
    print(
        f"{row['time']:6.2f} {row['height']:7.1f} {row['sink_rate']:6.2f} {row['collective']:11.2f}"
        f" {row['rpm']:6.1f} {row['thrust']:8.0f}  {row['flow_state']}",
        flush=True,
    )


def main():
    arguments = command_line(__doc__, out="folder for table and plot").parse_args()
    print("  time  height   sink  collective    rpm   thrust  flow")
    print("     s       m    m/s         deg               N")
    with Rotor(arguments.fmu, PARAMETERS) as rotor:
        rows, landing = fly(rotor)
    sink, speed, pitch = steady(rows, landing)
    print(
        f"Steady autorotation: {sink:.2f} m/s = {sink / HOVER_INFLOW:.2f} v_h at {speed:.0f} rpm,"
        f" collective {pitch:.2f} deg"
    )
    print(f"Touch-down: {rows[-1]['sink_rate']:.2f} m/s at {rows[-1]['rpm']:.0f} rpm")
    write_table(rows, arguments.out / "engine-off.csv")
    plot(rows, landing, arguments.out / "engine-off.png")
    print(f"Table and plot: {arguments.out / 'engine-off'}.csv, engine-off.png")


if __name__ == "__main__":
    main()
