"""Flies an experiment to convergence, call by call.

In Co-Simulation the FMU holds its inputs during a step, so that an importer's answer has an error of the first
order in the communication step. Here each step is cut into many parts, each with the inputs of its middle held,
which makes the error one of the second order. Outputs are those of the inputs that were held last; so the last part before
they are read holds the inputs of its end.
"""

import tempfile

import numpy as np
from fmpy import extract, read_model_description
from fmpy.fmi2 import FMU2Slave


class Rotor:
    """An instance of the FMU, which variables are set and read by name."""

    def __init__(self, fmu, folder):
        description = read_model_description(str(fmu))
        self.variables = {v.name: v for v in description.modelVariables}
        self.choices = {
            t.name: {item.name: int(item.value) for item in t.items}
            for t in description.typeDefinitions
            if t.items
        }
        self.slave = FMU2Slave(
            guid=description.guid,
            unzipDirectory=extract(str(fmu), unzipdir=folder),
            modelIdentifier=description.coSimulation.modelIdentifier,
            instanceName="reference",
        )
        self.slave.instantiate()

    def set(self, values):
        for name, value in values.items():
            variable = self.variables[name]
            if variable.type == "Enumeration":
                value = self.choices[variable.declaredType.name][value]
            kind = "Integer" if variable.type == "Enumeration" else variable.type
            getattr(self.slave, f"set{kind}")([variable.valueReference], [value])

    def get(self, names):
        values = []
        for name in names:
            variable = self.variables[name]
            kind = "Integer" if variable.type == "Enumeration" else variable.type
            values += getattr(self.slave, f"get{kind}")([variable.valueReference])
        return values


def inputs_at(experiment, time):
    return {name: np.interp(time, *zip(*corners)) for name, corners in experiment.inputs.items()}


def converged(fmu, experiment, parts):
    """Rows (time, outputs ...) at the experiment's interval, each communication step cut into `parts`.

    The rotor's own largest step goes with it: 0.5 deg at 10 parts, a sixth of the default.
    """
    azimuth_step = np.radians(5.0 / parts)
    with tempfile.TemporaryDirectory() as folder:
        rotor = Rotor(fmu, folder)
        rotor.set(experiment.parameters | {"numerics.azimuthStep": azimuth_step})
        rotor.slave.setupExperiment(startTime=0.0)
        rotor.slave.enterInitializationMode()
        rotor.set(inputs_at(experiment, 0.0))
        rotor.slave.exitInitializationMode()
        rows = [[0.0, *rotor.get(experiment.outputs)]]
        every = round(experiment.interval / experiment.step) * parts
        part = experiment.step / parts
        for i in range(round(experiment.stop / part)):
            is_recorded = (i + 1) % every == 0
            held = i + 1.0 if is_recorded else i + 0.5
            rotor.set(inputs_at(experiment, held * part))
            rotor.slave.doStep(currentCommunicationPoint=i * part, communicationStepSize=part)
            if is_recorded:
                rows.append([(i + 1) * part, *rotor.get(experiment.outputs)])
        rotor.slave.terminate()
        rotor.slave.freeInstance()
    return np.array(rows)
