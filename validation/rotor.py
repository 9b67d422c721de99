"""The packaged FMU in FMPy: unzipped once, one instance in each process, reset between flights."""

import math

from fmpy import calloc, free, read_model_description
from fmpy.fmi1 import FMICallException
from fmpy.fmi2 import (
    FMU2Slave,
    fmi2CallbackAllocateMemoryTYPE,
    fmi2CallbackFreeMemoryTYPE,
    fmi2CallbackFunctions,
    fmi2CallbackLoggerTYPE,
)

STEP = 0.01  # s; without states a step only computes the outputs from the inputs


class FlightError(Exception):
    """What the FMU refused, in its own words."""


class Rotor:
    """One instance. `start` gives it parameters and inputs, `fly` new inputs, and both may be called again."""

    def __init__(self, unzipped):
        """`unzipped`: the folder with the content of the .fmu."""
        self.description = read_model_description(str(unzipped))
        self.variables = {v.name: v for v in self.description.modelVariables}
        self.words = []
        self.callbacks = fmi2CallbackFunctions()
        self.callbacks.logger = fmi2CallbackLoggerTYPE(self._log)
        self.callbacks.allocateMemory = fmi2CallbackAllocateMemoryTYPE(calloc)
        self.callbacks.freeMemory = fmi2CallbackFreeMemoryTYPE(free)
        self.slave = FMU2Slave(
            guid=self.description.guid,
            unzipDirectory=str(unzipped),
            modelIdentifier=self.description.coSimulation.modelIdentifier,
            instanceName="rotor",
        )
        self.slave.instantiate(callbacks=self.callbacks)
        self.used = False
        self.time = 0.0

    def _log(self, _environment, _name, _status, _category, message):
        self.words.append(message.decode(errors="replace").replace("%%", "%"))

    def _call(self, what, function, *arguments):
        self.words.clear()
        try:
            return function(*arguments)
        except FMICallException as error:
            raise FlightError(f"{what}: {' '.join(self.words) or error}") from error

    def start(self, parameters, **inputs):
        """A fresh rotor with the values by name; enumerations by the names of their choices."""
        if self.used:
            self._call("reset", self.slave.reset)
        self.used = True
        values = {**parameters, **inputs}
        self._call("set-up", self._set, values)
        self._call("set-up", self.slave.setupExperiment)
        self._call("initialisation", self.slave.enterInitializationMode)
        self._call("initialisation", self.slave.exitInitializationMode)
        self.time = 0.0

    def _set(self, values):
        for name, value in values.items():
            variable = self.variables[name]
            reference = [variable.valueReference]
            if variable.type == "Real":
                self.slave.setReal(reference, [float(value)])
            elif variable.type == "Integer":
                self.slave.setInteger(reference, [int(value)])
            elif variable.type == "Enumeration":
                self.slave.setInteger(reference, [self._choice(variable, value)])
            elif variable.type == "Boolean":
                self.slave.setBoolean(reference, [bool(value)])
            else:
                self.slave.setString(reference, [str(value)])

    @staticmethod
    def _choice(variable, name):
        for item in variable.declaredType.items:
            if item.name == name:
                return int(item.value)
        raise FlightError(f"{variable.name} has no choice {name}")

    def fly(self, outputs, step=STEP, **inputs):
        """The outputs, a tuple in the order of their names, after a step with these inputs (as they are, if not named)."""
        if inputs:
            names = list(inputs)
            references = [self.variables[n].valueReference for n in names]
            self._call("inputs", self.slave.setReal, references, [float(inputs[n]) for n in names])
        self._call(f"flight with {inputs}", self.slave.doStep, self.time, step)
        self.time += step
        references = [self.variables[n].valueReference for n in outputs]
        values = self._call("outputs", self.slave.getReal, references)
        if not all(map(math.isfinite, values)):
            raise FlightError(f"{outputs} = {values} with {inputs}")
        return tuple(values)

    def models(self, parameters):
        """The physical models of a flight in a line: all of them, also those that are defaults."""
        named = []
        for name, variable in self.variables.items():
            if not name.startswith("models."):
                continue
            choice = parameters.get(name)
            if choice is None:
                items = variable.declaredType.items if variable.declaredType else []
                names = {str(item.value): item.name for item in items}
                choice = names.get(str(variable.start), variable.start)
            named.append(f"{name.removeprefix('models.')} `{choice}`")
        elements = parameters.get("numerics.elements", self.variables["numerics.elements"].start)
        return f"{', '.join(named)}; {elements} elements"
