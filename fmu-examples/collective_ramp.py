"""Reads the rotor's thrust while the collective ramps from 0 to 12 degrees in two seconds.

This shows FMPy's own calls, one by one, as in a simulation loop that you write yourself. The other
examples use rotor.py, which makes these calls for them.

    python collective_ramp.py --fmu HelicopterRotor.fmu
"""

import argparse
import math
import tempfile
from pathlib import Path

from fmpy import extract, read_model_description
from fmpy.fmi2 import FMU2Slave

STEP = 0.1  # s
RAMP_TIME = 2.0  # s
LAST_PITCH = 12.0  # deg


def ramp(fmu):
    """Yields time (s), collective (deg) and thrust (N) at every communication point."""
    description = read_model_description(str(fmu))
    reference = {v.name: v.valueReference for v in description.modelVariables}
    with tempfile.TemporaryDirectory() as folder:
        slave = FMU2Slave(
            guid=description.guid,
            unzipDirectory=extract(str(fmu), unzipdir=folder),
            modelIdentifier=description.coSimulation.modelIdentifier,
            instanceName="rotor",
        )
        slave.instantiate()
        slave.setupExperiment(startTime=0.0)
        slave.enterInitializationMode()
        slave.setReal([reference["rpm"], reference["collective"]], [960.0, 0.0])
        slave.exitInitializationMode()
        for i in range(round(RAMP_TIME / STEP)):
            pitch = LAST_PITCH * (i + 1) * STEP / RAMP_TIME
            slave.setReal([reference["collective"]], [math.radians(pitch)])
            slave.doStep(currentCommunicationPoint=i * STEP, communicationStepSize=STEP)
            (thrust,) = slave.getReal([reference["thrust"]])
            yield (i + 1) * STEP, pitch, thrust
        slave.terminate()
        slave.freeInstance()


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--fmu", type=Path, required=True, help="the HelicopterRotor.fmu to fly")
    print("time, s  collective, deg  thrust, N")
    for time, pitch, thrust in ramp(parser.parse_args().fmu):
        print(f"{time:7.1f}  {pitch:15.1f}  {thrust:9.2f}")


if __name__ == "__main__":
    main()
