"""Shows how accurate the FMU's two interfaces are, and which setting decides.

In Model Exchange it is the tolerance of the importer's solver, in Co-Simulation
numerics.azimuthStep.

Each of three manoeuvres begins with a jump of an input: the collective in hover with dynamic
inflow, the cyclic pitch in forward flight with flapping blades, and the driving torque, after which
the rotor runs down. (Inputs jump, because in Model Exchange FMPy holds inputs that move within each
output interval, which would be an error of its own.)

Each manoeuvre is flown by Co-Simulation with the shortest step, by Model Exchange with FMPy's CVode
at relative tolerances from 1e-3 to 1e-9, and by Co-Simulation with longer steps. Errors are the
largest over all outputs and times, relative to the largest magnitude of the output.

    python solver_accuracy.py --fmu HelicopterRotor.fmu --out FOLDER

prints the errors and writes solver-accuracy.csv and solver-accuracy.png into FOLDER.
"""

import math

import numpy as np
from fmpy import read_model_description, simulate_fmu

from rotor import as_numbers, unpacked
from script import command_line, plt, save_plot, write_table

FINEST = 0.001  # rad, numerics.azimuthStep of the run that the others are compared with
TOLERANCES = [10.0**-k for k in range(3, 10)]
AZIMUTH_STEPS = [0.75, 1.5, 3.0, 6.0, 12.0]  # deg
DEFAULT_STEP = 3.0  # deg
JUMP_TIME = 0.0525  # s; between two output points, so that none has two values
INTERVAL = 0.005  # s

# Duration (s), parameters and inputs, the input that jumps from its first to its second value,
# outputs, marker. FMPy limits CVode's steps to a 50th of the duration; in a shorter flight this
# limit would hide the effect of the tolerance.
MANOEUVRES = {
    "hover": (
        2.0,
        {"models.inflow": "pittPetersDynamic"},
        {"collective": (math.radians(8.0), math.radians(10.0))},
        ["thrust", "torque", "inducedVelocity"],
        "o",
    ),
    "forward flight": (
        0.4,
        {
            "models.inflow": "pittPetersDynamic",
            "flapping.enabled": True,
            "flapping.hingeOffset": 0.04,
            "velocity[1]": 15.0,
            "tilt": math.radians(4.0),
        },
        {"cyclicLongitudinal": (0.0, math.radians(2.0))},
        ["thrust", "torque", "coning", "longitudinalFlapping", "lateralFlapping"],
        "s",
    ),
    "run-down": (
        2.0,
        {"drive.mode": "torque", "drive.inertia": 0.25, "models.inflow": "pittPetersDynamic"},
        {"driveTorque": (4.23, 0.0)},
        ["thrust", "torque", "rotorSpeed"],
        "^",
    ),
}


class Manoeuvre:
    """One manoeuvre, flown by FMPy through either interface."""

    def __init__(self, unzipped, description, name):
        self.duration, parameters, jump, self.outputs, _ = MANOEUVRES[name]
        self.unzipped, self.description = unzipped, description
        self.start = as_numbers(description, parameters)
        # All inputs are given, because FMPy warns of missing ones. Two rows at one time are a jump.
        inputs = {
            v.name: (v.start, v.start) for v in description.modelVariables if v.causality == "input"
        }
        inputs |= {name: (value, value) for name, value in parameters.items() if name in inputs}
        inputs |= jump
        columns = {name: [before, before, after, after] for name, (before, after) in inputs.items()}
        columns = {"time": [0.0, JUMP_TIME, JUMP_TIME, self.duration]} | columns
        self.inputs = np.rec.fromarrays(
            [np.array(column, dtype=float) for column in columns.values()], names=list(columns)
        )

    def fly(self, interface, parameters, **options):
        """Outputs (columns) at the output points (rows)."""
        result = simulate_fmu(
            self.unzipped,
            model_description=self.description,
            fmi_type=interface,
            start_values=self.start | parameters,
            input=self.inputs,
            output=self.outputs,
            stop_time=self.duration,
            output_interval=INTERVAL,
            record_events=False,
            **options,
        )
        # Co-Simulation also has a row at the jump.
        points = result["time"] / INTERVAL
        rows = np.abs(points - np.round(points)) < 1e-6
        return np.array([result[name][rows] for name in self.outputs]).T

    def co_simulation(self, azimuth_step):
        return self.fly("CoSimulation", {"numerics.azimuthStep": azimuth_step})

    def model_exchange(self, tolerance):
        """Starts as the finest run does: the periodic start is found in steps of
        numerics.azimuthStep."""
        start = {"numerics.azimuthStep": FINEST}
        return self.fly("ModelExchange", start, relative_tolerance=tolerance)


def errors(manoeuvre):
    """Pairs of tolerance and error in Model Exchange, and of azimuth step (deg) and error in
    Co-Simulation."""
    exact = manoeuvre.co_simulation(FINEST)
    largest = np.abs(exact).max(axis=0)

    def error(flown):
        return float((np.abs(flown - exact) / largest).max())

    return (
        [(tolerance, error(manoeuvre.model_exchange(tolerance))) for tolerance in TOLERANCES],
        [(step, error(manoeuvre.co_simulation(math.radians(step)))) for step in AZIMUTH_STEPS],
    )


def order(pairs):
    """Slope of the least-squares line through the logarithms of the pairs."""
    return float(np.polyfit(*np.log(np.array(pairs)).T, 1)[0])


def plot(found, file):
    figure, (left, right) = plt.subplots(
        1, 2, figsize=(9.5, 4.6), constrained_layout=True, sharey=True
    )
    for name, (exchange, simulation) in found.items():
        for axis, pairs in ((left, exchange), (right, simulation)):
            style = {"marker": MANOEUVRES[name][-1], "color": "black", "markerfacecolor": "white"}
            axis.loglog(*np.array(pairs).T, linewidth=0.8, label=name, **style)
    tolerances, steps = np.array(TOLERANCES), np.array(AZIMUTH_STEPS)
    left.loglog(tolerances, tolerances, "--", color="0.5", label="error = tolerance")
    least = min(pairs[1][0][1] for pairs in found.values())
    right.loglog(steps, 0.3 * least * (steps / steps[0]) ** 3, "--", color="0.5", label="order 3")
    right.axvline(DEFAULT_STEP, color="0.5", linestyle=":", label="default")
    left.set_title("Model Exchange, FMPy's CVode")
    left.set_xlabel("relative tolerance of the solver")
    left.set_ylabel("largest error, part of the output's largest magnitude")
    right.set_title("Co-Simulation")
    right.set_xlabel("numerics.azimuthStep, deg")
    right.set_xticks(AZIMUTH_STEPS, [f"{step:g}" for step in AZIMUTH_STEPS])
    right.minorticks_off()
    for axis in (left, right):
        axis.grid(True, color="0.88")
        axis.legend(frameon=False)
    save_plot(figure, file)


def main():
    arguments = command_line(__doc__, out="folder for the table and the plot").parse_args()
    found, rows = {}, []
    with unpacked(arguments.fmu) as folder:
        description = read_model_description(folder)
        for name in MANOEUVRES:
            found[name] = errors(Manoeuvre(folder, description, name))
            kinds = (("ModelExchange", "relative tolerance"), ("CoSimulation", "azimuth step, deg"))
            for (interface, setting), pairs in zip(kinds, found[name]):
                print(f"{name}, {interface}: order {order(pairs):.2f}", flush=True)
                print(f"  {setting:20s}" + "".join(f"{value:9.2g}" for value, _ in pairs))
                print(f"  {'largest error':20s}" + "".join(f"{error:9.1e}" for _, error in pairs))
                for value, error in pairs:
                    row = {"manoeuvre": name.replace(" ", "-"), "interface": interface}
                    rows.append(row | {"setting": value, "error": error})
    write_table(rows, arguments.out / "solver-accuracy.csv")
    plot(found, arguments.out / "solver-accuracy.png")
    print(f"Table and plot: {arguments.out / 'solver-accuracy'}.csv, .png")


if __name__ == "__main__":
    main()
