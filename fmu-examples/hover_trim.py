"""Trims a hovering rotor by Newton's method and linearises it, with the FMU's exact derivatives.

The rotor has flapping blades on offset hinges and dynamic inflow, and hovers in a wind from ahead
and from the side. The trim finds the collective, the two shaft tilts and the cyclic pitch at which
the rotor carries the weight straight up without moments at the hub. It holds at the azimuth at
which the FMU starts, with blade 1 over the tail; the loads pulsate, and their averages over one
revolution differ from it by some 0.03 % of the weight.

Both the Jacobian of the trim (in Initialization Mode, where the states move with the inputs) and
the matrices of the linear model (in Continuous-Time Mode, where the states are held) come from
fmi2GetDirectionalDerivative.

    python hover_trim.py --fmu HelicopterRotor.fmu --out FOLDER

prints the trim, step by step, and the eigenvalues, and writes into FOLDER

    hover-trim.npz          the trim and the matrices A, B, C, D with the names of rows and columns
    step-response.csv, .png the linear model beside the FMU after a step of the collective
"""

import math

import numpy as np

from rotor import Rotor, unpacked
from script import command_line, plt, save_plot

# The FMU's default rotor at sea level.
RADIUS = 0.762  # m
CHORD = 0.0508  # m
CUTOUT = 1.0 / 6.0
BLADES = 4
SPEED = 960.0 * math.pi / 30.0  # rad/s
DENSITY = 1.225  # kg/m3
WEIGHT = 60.0  # N
PARAMETERS = {
    "models.inflow": "pittPetersDynamic",
    "flapping.enabled": True,
    "flapping.hingeOffset": 0.05,
    # From a Lock number rho a c R^4/I of 8.
    "flapping.inertia": DENSITY * 2.0 * math.pi * CHORD * RADIUS**4 / 8.0,
}
WIND = {"wind[1]": -4.0, "wind[2]": 2.0}  # m/s

TRIMMED = {
    "force[1]": 0.0,
    "force[2]": 0.0,
    "force[3]": WEIGHT,
    "hubMoment[1]": 0.0,
    "hubMoment[2]": 0.0,
}  # N, N.m
ROUGH = {
    "collective": math.radians(6.0),
    "tilt": 0.0,
    "lateralTilt": 0.0,
    "cyclicLongitudinal": 0.0,
    "cyclicLateral": 0.0,
}  # rad
TOLERANCE = 1e-6  # of the weight, and of the weight times the radius

INPUTS = [
    "collective",
    "cyclicLongitudinal",
    "cyclicLateral",
    "velocity[1]",
    "velocity[2]",
    "velocity[3]",
]
OUTPUTS = ["force[1]", "force[2]", "force[3]", "hubMoment[1]", "hubMoment[2]", "coning"]
INFLOW = [f"state.inflow[{i}]" for i in (1, 2, 3)]
FLAPPING = [
    f"state.{kind}[{i}]" for kind in ("flapAngle", "flapRate") for i in range(1, BLADES + 1)
]
# Coning, flapping to the rear and to the advancing side, differential flapping.
MULTIBLADE = ["b0", "b1c", "b1s", "bd"]
AZIMUTHS = 12  # between two blade passages, over which the linear model is averaged

STEP = math.radians(0.5)  # of the collective
STEP_TIME, STOP_TIME, INTERVAL = 0.05, 0.35, 0.001  # s


def trim(rotor, wanted, guess):
    """The inputs named in `guess` at which the outputs are as `wanted`, and the residuals before
    each step and after the last."""
    controls = np.array(list(guess.values()))
    scale = np.array([WEIGHT * RADIUS if "oment" in name else WEIGHT for name in wanted])
    residuals = []
    while True:
        rotor.set(dict(zip(guess, controls)))
        excess = np.subtract(rotor.get(wanted), list(wanted.values()))
        residuals.append(float(np.abs(excess / scale).max()))
        if residuals[-1] < TOLERANCE:
            return dict(zip(guess, controls.tolist())), residuals
        if len(residuals) > 20:
            raise RuntimeError(f"no trim found in 20 steps; the residual is {residuals[-1]:.1e}")
        controls = controls - np.linalg.solve(rotor.jacobian(wanted, guess), excess)


def multiblade(azimuth):
    """The transformation T with (inflow, flap angles, flap rates) = T y, and its rate of change.

    y is the inflow, and coning, cyclic and differential flapping with their rates in non-rotating
    axes (multiblade coordinates; Johnson 1980, Helicopter Theory, ch. 8-2).
    """
    psi = azimuth + 2.0 * math.pi / BLADES * np.arange(BLADES)
    one, zero = np.ones(BLADES), np.zeros(BLADES)
    c = np.array([one, np.cos(psi), np.sin(psi), (-1.0) ** np.arange(BLADES)]).T
    first = SPEED * np.array([zero, -np.sin(psi), np.cos(psi), zero]).T
    second = SPEED**2 * np.array([zero, -np.cos(psi), -np.sin(psi), zero]).T
    none = np.zeros_like(c)
    inflow = len(INFLOW)
    transform, rate = np.eye(inflow + 2 * BLADES), np.zeros((inflow + 2 * BLADES,) * 2)
    transform[inflow:, inflow:] = np.block([[c, none], [first, c]])
    rate[inflow:, inflow:] = np.block([[first, none], [second, first]])
    return transform, rate


def linear_model(rotor):
    """A, B, C, D of a started rotor with flapping blades, in multiblade coordinates.

    They are averages over one blade passage, because in the wind they change with the azimuth.
    """
    states = INFLOW + FLAPPING
    rates = [f"der({name})" for name in states]
    y = np.linalg.solve(multiblade(0.0)[0], rotor.get(states))
    total = 0.0
    for azimuth in np.arange(AZIMUTHS) * 2.0 * math.pi / BLADES / AZIMUTHS:
        transform, rate = multiblade(azimuth)
        rotor.set_states({"azimuth": azimuth} | dict(zip(states, transform @ y)))
        a = np.linalg.solve(transform, rotor.jacobian(rates, states) @ transform - rate)
        b = np.linalg.solve(transform, rotor.jacobian(rates, INPUTS))
        c = rotor.jacobian(OUTPUTS, states) @ transform
        total = total + np.block([[a, b], [c, rotor.jacobian(OUTPUTS, INPUTS)]])
    mean, n = total / AZIMUTHS, len(states)
    return mean[:n, :n], mean[:n, n:], mean[n:, :n], mean[n:, n:]


def linear_response(a, b, c, d, times):
    """Changes of the outputs after the step of the collective at STEP_TIME, by
    y(t) = (exp(A t) - 1) A^-1 b."""
    values, vectors = np.linalg.eig(a)
    modal = np.linalg.solve(vectors, b[:, 0] * STEP)
    since = np.clip(times - STEP_TIME, 0.0, None)[:, None]
    y = ((np.expm1(values * since) / values * modal) @ vectors.T).real
    return y @ c.T + np.where(since > 0.0, d[:, 0] * STEP, 0.0)


def fly(fmu, inputs, step):
    """Times and outputs (rows) of the FMU in Co-Simulation, with a step of the collective at
    STEP_TIME."""
    times = np.arange(round(STOP_TIME / INTERVAL) + 1) * INTERVAL
    with Rotor(fmu, PARAMETERS) as rotor:
        rotor.set(inputs)
        rows = [rotor.get(OUTPUTS)]
        for time in times[:-1]:
            if abs(time - STEP_TIME) < 0.5 * INTERVAL:
                rotor.set({"collective": inputs["collective"] + step})
            rotor.step(INTERVAL)
            rows.append(rotor.get(OUTPUTS))
    return times, np.array(rows)


def hover_in_still_air(fmu):
    """Eigenvalues of the inflow with rigid blades and a lift slope of 2 pi, by the linear model and
    by theory, and the residuals of the trim."""
    parameters = {
        "models.inflow": "pittPetersDynamic",
        "models.lift": "twoPi",
        "models.tipLoss": "none",
        "models.compressibility": "none",
    }
    with Rotor(fmu, parameters, "ModelExchange") as rotor:
        _, residuals = trim(rotor, {"force[3]": WEIGHT}, {"collective": ROUGH["collective"]})
        rotor.start()
        a = rotor.jacobian([f"der({name})" for name in INFLOW], INFLOW)
        v0 = rotor["inducedVelocity"]
    # Apparent mass against momentum theory, 2 v^2, and the lift of the blades, for small angles
    # (Pitt & Peters 1981).
    blades = 2.0 * math.pi * BLADES * CHORD / (math.pi * RADIUS) * SPEED * RADIUS
    mean = -(4.0 * v0 + blades * (1.0 - CUTOUT**2) / 4.0) / (RADIUS * 8.0 / (3.0 * math.pi))
    slope = -(v0 + blades * (1.0 - CUTOUT**4) / 16.0) / (RADIUS * 16.0 / (45.0 * math.pi))
    return np.diag(a), [mean, slope, slope], residuals


def plot(times, flown, linear, file):
    figure, axes = plt.subplots(2, 1, figsize=(7.0, 6.0), constrained_layout=True, sharex=True)
    for axis, name, factor, label in (
        (axes[0], "force[3]", 1.0, "upward force, N"),
        (axes[1], "coning", 180.0 / math.pi, "coning $a_0$, deg"),
    ):
        column = OUTPUTS.index(name)
        axis.plot(1e3 * times, factor * flown[:, column], color="black", linewidth=2.5, label="FMU")
        axis.plot(1e3 * times, factor * linear[:, column], "--", color="0.6", label="linear model")
        axis.set_ylabel(label)
        axis.grid(True, color="0.85")
    axes[0].legend()
    axes[0].set_title(
        f"Hover in a wind: collective raised by {math.degrees(STEP):g} deg"
        f" at {1e3 * STEP_TIME:g} ms"
    )
    axes[1].set_xlabel("time, ms")
    save_plot(figure, file)


def show(title, residuals):
    print(f"{title}: residuals before each Newton step and after the last")
    print("  " + "  ".join(f"{residual:.1e}" for residual in residuals))


def main():
    help_text = "folder for the model, the table and the plot"
    arguments = command_line(__doc__, out=help_text).parse_args()
    arguments.out.mkdir(parents=True, exist_ok=True)

    with unpacked(arguments.fmu) as fmu:
        with Rotor(fmu, PARAMETERS, "ModelExchange") as rotor:
            rotor.set(WIND)
            controls, residuals = trim(rotor, TRIMMED, ROUGH)
            show("Trim in the wind", residuals)
            for name, value in controls.items():
                print(f"  {name:18s} {math.degrees(value):8.4f} deg")
            rotor.start()
            a, b, c, d = linear_model(rotor)
        print("Eigenvalues of the linear model, 1/s, and their frequencies per revolution")
        for value in sorted(np.linalg.eigvals(a), key=lambda v: (v.real, v.imag)):
            if value.imag >= 0.0:
                frequency = abs(value) / SPEED
                print(f"  eigenvalue {value.real:9.2f} +- {value.imag:7.2f} i   {frequency:.3f}")

        still, theory, still_residuals = hover_in_still_air(fmu)
        show("Rigid blades in still air", still_residuals)
        print("Eigenvalues of their inflow, 1/s: mean, slope fore and aft, slope to the side")
        print("  linear model " + " ".join(f"{value:9.3f}" for value in still))
        print("  theory       " + " ".join(f"{value:9.3f}" for value in theory))

        inputs = WIND | controls
        times, flown = fly(fmu, inputs, STEP)
        _, held = fly(fmu, inputs, 0.0)

    # The linear model gives changes from the mean of the trimmed loads, which pulsate with each
    # blade passage.
    linear = held.mean(axis=0) + linear_response(a, b, c, d, times)
    loads = ", ".join(f"{value:.4f}" for value in held.mean(axis=0)[:5])
    print(f"Mean loads of the trim: {loads} N, N.m")
    np.savez(
        arguments.out / "hover-trim.npz",
        **dict(A=a, B=b, C=c, D=d, inputs=INPUTS, outputs=OUTPUTS),
        states=INFLOW + MULTIBLADE + [f"der({name})" for name in MULTIBLADE],
        trim=list(inputs.values()),
        trimmed=list(inputs),
    )
    np.savetxt(
        arguments.out / "step-response.csv",
        np.column_stack([times, flown, held, linear]),
        delimiter=",",
        comments="",
        header=",".join(
            ["time", *(f"{kind}:{name}" for kind in ("step", "held", "linear") for name in OUTPUTS)]
        ),
    )
    plot(times, flown, linear, arguments.out / "step-response.png")
    print(
        f"Written: {arguments.out / 'hover-trim'}.npz, {arguments.out / 'step-response'}.csv, .png"
    )


if __name__ == "__main__":
    main()
