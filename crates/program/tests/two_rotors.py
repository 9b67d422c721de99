"""Flies two .fmu files that were made for rotors of their own, in one process at the same time.

    python two_rotors.py GENERAL_FMU FMU ROTOR_FILE FMU ROTOR_FILE

Each must give what the general FMU gives with that rotor file. Prints what differs, and exits
with 1 if anything does. All start values are set, as many tools do.
"""

import shutil
import sys

from fmpy import extract, read_model_description
from fmpy.fmi2 import FMU2Slave

OUTPUTS = ("thrust", "torque", "coning", "longitudinalFlapping", "rotorSpeed", "tipReynolds")


class Flight:
    def __init__(self, fmu, instance):
        self.description = read_model_description(fmu)
        self.folder = extract(fmu)
        self.variables = {v.name: v for v in self.description.modelVariables}
        self.slave = FMU2Slave(
            guid=self.description.guid,
            unzipDirectory=self.folder,
            modelIdentifier=self.description.coSimulation.modelIdentifier,
            instanceName=instance,
        )
        self.slave.instantiate()
        self.slave.setupExperiment(startTime=0.0)

    def set(self, name, value):
        variable = self.variables[name]
        number = [variable.valueReference]
        match variable.type:
            case "Real":
                self.slave.setReal(number, [float(value)])
            case "Integer" | "Enumeration":
                self.slave.setInteger(number, [int(value)])
            case "Boolean":
                self.slave.setBoolean(number, [value in (True, "true")])
            case _:
                self.slave.setString(number, [value])

    def set_all(self):
        for variable in self.description.modelVariables:
            if variable.causality in ("input", "parameter") and variable.start is not None:
                self.set(variable.name, variable.start)

    def begin(self):
        self.slave.enterInitializationMode()
        self.slave.exitInitializationMode()

    def step(self, time):
        self.slave.doStep(currentCommunicationPoint=time, communicationStepSize=0.01)
        return [self.slave.getReal([self.variables[n].valueReference])[0] for n in OUTPUTS]

    def end(self):
        self.slave.terminate()
        self.slave.freeInstance()
        shutil.rmtree(self.folder, ignore_errors=True)


def main(general, first, first_file, second, second_file):
    own = [Flight(first, "a"), Flight(second, "b")]
    for flight in own:
        flight.set_all()
    others = [Flight(general, "c"), Flight(general, "d")]
    for flight, file in zip(others, (first_file, second_file)):
        flight.set("geometry.file", file)
    for flight in own + others:
        flight.set("velocity[1]", 12.0)
        flight.begin()
    same = True
    for step in range(5):
        found = [flight.step(0.01 * step) for flight in own + others]
        for name, one, other in zip("ab", found[:2], found[2:]):
            if one != other:
                print(f"{name}, step {step}: {one} {other}")
                same = False
        if found[0] == found[1]:
            print("both rotors are the same")
            same = False
    for flight in own + others:
        flight.end()
    print("thrust, N:", *(f"{values[0]:.2f}" for values in found[:2]))
    return same


if __name__ == "__main__":
    sys.exit(0 if main(*sys.argv[1:]) else 1)
