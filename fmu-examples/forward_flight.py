"""Flies the rotor from hover to an advance ratio of 0.35 at constant thrust, with three inflow models.

At each speed the collective that keeps the thrust of hover is found by secant steps through the
FMU, one communication step each: the rotor has no memory, so that every step is an answer.

    python forward_flight.py --fmu HelicopterRotor.fmu --out FOLDER

prints collective, H-force and power against advance ratio, and writes forward-flight.csv and
forward-flight.png into FOLDER. Blades are rigid and the shaft is upright; forces are means over a turn.
"""

import argparse
import csv
import math
import sys
import tempfile
from pathlib import Path

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
from fmpy import extract, read_model_description
from fmpy.fmi2 import FMU2Slave

RPM = 960.0
TIP_SPEED = RPM * math.pi / 30.0 * 0.762  # m/s, of the default rotor
ADVANCE_RATIOS = [0.025 * i for i in range(15)]
HOVER_PITCH = 8.0  # deg
STEP = 0.01  # s
MODELS = {"annulus": "-", "uniform": "--", "drees": ":"}


class Rotor:
    """The FMU as a function of collective and forward speed, for one inflow model."""

    def __init__(self, unzipped, description, model):
        self.reference = {v.name: v.valueReference for v in description.modelVariables}
        choices = next(t for t in description.typeDefinitions if t.name == "InflowModel").items
        number = next(int(item.value) for item in choices if item.name == model)
        self.slave = FMU2Slave(
            guid=description.guid,
            unzipDirectory=unzipped,
            modelIdentifier=description.coSimulation.modelIdentifier,
            instanceName=model,
        )
        self.slave.instantiate()
        self.slave.setInteger([self.reference["model.inflow"]], [number])
        self.slave.setupExperiment(startTime=0.0)
        self.slave.enterInitializationMode()
        self.slave.setReal([self.reference["rpm"]], [RPM])
        self.slave.exitInitializationMode()
        self.time = 0.0

    def fly(self, pitch, speed, names):
        """The named outputs at a collective in degrees and a forward speed in m/s."""
        inputs = [self.reference["collective"], self.reference["velocity[1]"]]
        self.slave.setReal(inputs, [math.radians(pitch), speed])
        self.slave.doStep(currentCommunicationPoint=self.time, communicationStepSize=STEP)
        self.time += STEP
        return self.slave.getReal([self.reference[name] for name in names])

    def trim(self, thrust, speed, pitch):
        """The collective in degrees that gives the thrust (N), from a guess, by the secant method."""

        def excess(at):
            return self.fly(at, speed, ["thrust"])[0] - thrust

        before, now = pitch, pitch + 0.5
        excess_before, excess_now = excess(before), excess(now)
        for _ in range(20):
            if abs(excess_now) < 1e-9 * abs(thrust):
                return now
            slope = (excess_now - excess_before) / (now - before)
            before, excess_before = now, excess_now
            now -= excess_now / slope
            excess_now = excess(now)
        raise RuntimeError(f"no collective gives {thrust:.1f} N at {speed:.1f} m/s")

    def close(self):
        self.slave.terminate()
        self.slave.freeInstance()


def sweep(unzipped, description, model):
    """Rows of model, mu, collective (deg), H-force (N) and power (W) at the thrust of hover."""
    rotor = Rotor(unzipped, description, model)
    pitch = HOVER_PITCH
    (thrust,) = rotor.fly(pitch, 0.0, ["thrust"])
    for mu in ADVANCE_RATIOS:
        speed = mu * TIP_SPEED
        pitch = rotor.trim(thrust, speed, pitch)
        force, power = rotor.fly(pitch, speed, ["hubForce[1]", "power"])
        yield {"model": model, "mu": mu, "collective": pitch, "H": -force, "power": power}
    rotor.close()


def plot(rows, file):
    """Power, collective and H-force against advance ratio."""
    figure, axes = plt.subplots(1, 3, figsize=(12, 4.2), constrained_layout=True)
    labels = {"power": "power, W", "collective": "collective, deg", "H": "H-force, N"}
    for axis, (name, label) in zip(axes, labels.items()):
        for model, line in MODELS.items():
            chosen = [row for row in rows if row["model"] == model]
            axis.plot(
                [row["mu"] for row in chosen],
                [row[name] for row in chosen],
                line,
                color="black",
                label=model,
            )
        axis.set_xlabel("advance ratio")
        axis.set_ylabel(label)
        axis.set_xlim(0, ADVANCE_RATIOS[-1])
        axis.grid(True, color="0.85")
    axes[0].set_ylim(bottom=0)
    axes[0].legend(frameon=False, title="inflow model")
    figure.suptitle("HelicopterRotor.fmu in level forward flight at the thrust of hover, rigid blades")
    figure.savefig(file, dpi=130)
    plt.close(figure)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--fmu", type=Path, required=True, help="the HelicopterRotor.fmu to fly")
    parser.add_argument("--out", type=Path, default=Path("."), help="folder for table and plot")
    arguments = parser.parse_args()
    if not arguments.fmu.is_file():
        sys.exit(f"{arguments.fmu} does not exist; make it with `cargo run --release -- package`")
    arguments.out.mkdir(parents=True, exist_ok=True)

    rows = []
    print("model          mu  collective, deg  H-force, N  power, W")
    with tempfile.TemporaryDirectory() as folder:
        unzipped = extract(str(arguments.fmu), unzipdir=folder)
        description = read_model_description(unzipped)
        for model in MODELS:
            for row in sweep(unzipped, description, model):
                rows.append(row)
                print(
                    f"{model:10s} {row['mu']:6.3f}  {row['collective']:15.3f}"
                    f"  {row['H']:10.3f}  {row['power']:8.1f}",
                    flush=True,
                )
    with (arguments.out / "forward-flight.csv").open("w", newline="", encoding="utf-8") as out:
        writer = csv.DictWriter(out, fieldnames=list(rows[0]))
        writer.writeheader()
        writer.writerows(rows)
    plot(rows, arguments.out / "forward-flight.png")
    print(f"Table: {arguments.out / 'forward-flight.csv'}")
    print(f"Plot:  {arguments.out / 'forward-flight.png'}")


if __name__ == "__main__":
    main()
