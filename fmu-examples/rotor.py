"""HelicopterRotor.fmu in FMPy, with its variables by name.

    from math import radians
    from rotor import Rotor

    with Rotor("HelicopterRotor.fmu", {"models.inflow": "pittPetersDynamic"}) as rotor:
        rotor.set({"rpm": 960.0, "collective": radians(8.0)})
        for _ in range(100):
            rotor.step(0.01)
        print(rotor["thrust"], "N")

Copy this file beside your own script; it needs FMPy and NumPy. Values are in the units of
modelDescription.xml. Enumerations are set and read by the names of their items. Errors are of the
class RotorError and quote what the FMU logged; its warnings go to Python's logger "rotor", which
prints them unless you tell it otherwise.
"""

import difflib
import logging
import tempfile
from contextlib import ExitStack, contextmanager
from ctypes import c_double
from pathlib import Path

import numpy as np
from fmpy import calloc, extract, free, read_model_description
from fmpy.fmi1 import FMICallException
from fmpy.fmi2 import (
    FMU2Model,
    FMU2Slave,
    fmi2CallbackAllocateMemoryTYPE,
    fmi2CallbackFreeMemoryTYPE,
    fmi2CallbackFunctions,
    fmi2CallbackLoggerTYPE,
    fmi2Warning,
)

LOG = logging.getLogger("rotor")
INTERFACES = {"CoSimulation": FMU2Slave, "ModelExchange": FMU2Model}


class RotorError(Exception):
    """What was refused and why, in a sentence."""


@contextmanager
def unpacked(fmu):
    """The folder with the content of an .fmu, removed at the end. A folder is used as it is: name
    one to unpack once for several instances."""
    if Path(fmu).is_dir():
        yield str(fmu)
        return
    if not Path(fmu).is_file():
        raise RotorError(f"{fmu} does not exist; name the .fmu or the folder with its content")
    with tempfile.TemporaryDirectory(prefix="rotor-") as folder:
        yield extract(str(fmu), unzipdir=folder)


def as_numbers(description, values):
    """Values by name, with items of enumerations as numbers, as FMPy's simulate_fmu needs them."""
    variables = {v.name: v for v in description.modelVariables}
    return {name: _as_fmi(_find(variables, name), value) for name, value in values.items()}


class Rotor:
    """One instance of the FMU.

    It begins in Initialization Mode: parameters and inputs can be set, and outputs are those of the
    steady start with them. `start`, or the first `step`, ends this mode. Then fixed parameters can
    no longer be set, and outputs are those at the end of the last step.

    `fmu`: the .fmu, or the folder where it is unpacked already, which saves time where several
    instances are made. `interface`: "CoSimulation" or "ModelExchange".
    """

    def __init__(self, fmu, parameters=None, interface="CoSimulation"):
        if interface not in INTERFACES:
            raise RotorError(
                f"there is no interface {interface}; take one of {', '.join(INTERFACES)}"
            )
        self.interface = interface
        self.time = 0.0  # s
        self._is_started = False
        self._words = []
        callbacks = fmi2CallbackFunctions()
        callbacks.logger = fmi2CallbackLoggerTYPE(self._log)
        callbacks.allocateMemory = fmi2CallbackAllocateMemoryTYPE(calloc)
        callbacks.freeMemory = fmi2CallbackFreeMemoryTYPE(free)
        with ExitStack() as cleanup:
            folder = cleanup.enter_context(unpacked(fmu))
            self.description = read_model_description(folder)
            self.variables = {v.name: v for v in self.description.modelVariables}
            self.fmu = INTERFACES[interface](
                guid=self.description.guid,
                unzipDirectory=folder,
                modelIdentifier=self.description.coSimulation.modelIdentifier,
                instanceName="rotor",
            )
            try:
                self.fmu.instantiate(callbacks=callbacks)
            except Exception as error:
                self.fmu.freeLibrary()
                raise RotorError(f"cannot instantiate: {self._said(error)}") from error
            cleanup.callback(self.fmu.freeInstance)
            self._initialize(parameters or {})
            # All went well: the instance and the folder stay until `close`.
            self._cleanup = cleanup.pop_all()

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.close()

    def close(self):
        """Terminates and frees the instance, and removes the folder that it was unpacked into."""
        if self._is_started:
            self._is_started = False
            try:
                self.fmu.terminate()
            except FMICallException:
                pass  # After an error there is nothing to terminate.
        self._cleanup.close()

    def restart(self, parameters=None):
        """A fresh rotor with other parameters, in Initialization Mode; all others have their
        defaults again. Faster than a new instance."""
        self._call("cannot restart", self.fmu.reset)
        self._initialize(parameters or {})

    def _initialize(self, parameters):
        self.time, self._is_started = 0.0, False
        self.set(parameters)
        self._call("cannot set up the experiment", self.fmu.setupExperiment)
        self._call("cannot initialise", self.fmu.enterInitializationMode)

    def start(self):
        """Ends Initialization Mode; in Model Exchange, enters Continuous-Time Mode."""
        self._call("cannot initialise", self.fmu.exitInitializationMode)
        self._is_started = True
        if self.interface == "ModelExchange":
            while self._call("cannot start", self.fmu.newDiscreteStates)[0]:
                pass
            self._call("cannot start", self.fmu.enterContinuousTimeMode)

    def set(self, values):
        """Sets parameters or inputs: {name: value}."""
        reals = {}
        for name, value in values.items():
            variable = self._variable(name)
            if variable.type == "Real":
                reals[name] = float(value)
                continue
            kind = "Integer" if variable.type == "Enumeration" else variable.type
            setter = getattr(self.fmu, f"set{kind}")
            arguments = [variable.valueReference], [_as_fmi(variable, value)]
            self._call(f"cannot set {name}", setter, *arguments)
        if reals:
            references, numbers = self._references(reals), list(reals.values())
            self._call(f"cannot set {', '.join(reals)}", self.fmu.setReal, references, numbers)

    def get(self, names):
        """The values of variables, a list in the order of their names."""
        if all(self._variable(name).type == "Real" for name in names):
            return self._call("cannot read", self.fmu.getReal, self._references(names))
        return [self[name] for name in names]

    def __getitem__(self, name):
        """The value of one variable."""
        variable = self._variable(name)
        kind = "Integer" if variable.type == "Enumeration" else variable.type
        getter = getattr(self.fmu, f"get{kind}")
        (value,) = self._call(f"cannot read {name}", getter, [variable.valueReference])
        if variable.type == "Enumeration":
            items = variable.declaredType.items
            return next(item.name for item in items if int(item.value) == value)
        if variable.type == "Boolean":
            return bool(value)
        return value.decode("utf-8") if variable.type == "String" else value

    def step(self, duration, rates=None):
        """Moves on by `duration`, s, in Co-Simulation.

        `rates`: {input: its rate of change per second}. These inputs move linearly during this
        step, from the values that they have now; all others are held.
        """
        self._need("CoSimulation")
        if not self._is_started:
            self.start()
        if rates:
            arguments = self._references(rates), [1] * len(rates), list(rates.values())
            self._call("cannot set rates", self.fmu.setRealInputDerivatives, *arguments)
        self._call(f"cannot step at {self.time:g} s", self.fmu.doStep, self.time, duration)
        self.time += duration

    def jacobian(self, unknowns, knowns):
        """Exact derivatives of the unknowns (rows) by the knowns (columns).

        In Initialization Mode the states move with the inputs to the steady start; after it they
        are held. A state derivative is called "der(...)", with the name of its state.
        """
        rows = self._references(unknowns)
        derivative = self.fmu.getDirectionalDerivative
        columns = [
            self._call("cannot differentiate", derivative, rows, [known], [1.0])
            for known in self._references(knowns)
        ]
        return np.array(columns).T

    def save(self):
        """The complete state, to go back to with `restore`, in this or another instance."""
        state = self._call("cannot save", self.fmu.getFMUstate)
        try:
            stored = self._call("cannot save", self.fmu.serializeFMUstate, state)
        finally:
            self.fmu.freeFMUstate(state)
        return self.time, self._is_started, stored

    def restore(self, saved):
        """Goes back to what `save` returned."""
        time, is_started, stored = saved
        state = self._call("cannot restore", self.fmu.deSerializeFMUstate, stored)
        try:
            self._call("cannot restore", self.fmu.setFMUstate, state)
        finally:
            self.fmu.freeFMUstate(state)
        self.time, self._is_started = time, is_started

    def set_states(self, values):
        """Sets continuous states by name in Model Exchange, once started; all others are kept."""
        self._need("ModelExchange")
        count = self.description.numberOfContinuousStates
        vector = (c_double * count)()
        self._call("cannot read the states", self.fmu.getContinuousStates, vector, count)
        order = [unknown.variable.derivative.name for unknown in self.description.derivatives]
        for name, value in values.items():
            if name not in order:
                raise RotorError(f"{name} is not a continuous state")
            vector[order.index(name)] = value
        self._call("cannot set the states", self.fmu.setContinuousStates, vector, count)

    def _need(self, interface):
        if self.interface != interface:
            raise RotorError(f'this needs a rotor with interface="{interface}"')

    def _variable(self, name):
        return _find(self.variables, name)

    def _references(self, names):
        return [_find(self.variables, name).valueReference for name in names]

    def _call(self, what, function, *arguments):
        self._words.clear()
        try:
            return function(*arguments)
        except FMICallException as error:
            raise RotorError(f"{what}: {self._said(error)}") from error

    def _said(self, error):
        return " ".join(self._words) or str(error)

    def _log(self, _environment, _instance, status, _category, message):
        text = message.decode("utf-8", errors="replace").replace("%%", "%")
        if status > fmi2Warning:
            self._words.append(text)
        else:
            LOG.log(logging.WARNING if status == fmi2Warning else logging.INFO, text)


def _find(variables, name):
    try:
        return variables[name]
    except KeyError:
        near = difflib.get_close_matches(name, variables, n=3)
        hint = f"; the nearest names are {', '.join(near)}" if near else ""
        raise RotorError(f"the FMU has no variable {name}{hint}") from None


def _as_fmi(variable, value):
    """A value as the FMI functions take it: the item of an enumeration as its number."""
    if variable.type != "Enumeration":
        return value
    numbers = {item.name: int(item.value) for item in variable.declaredType.items}
    if value not in numbers:
        raise RotorError(f"{variable.name} cannot be {value}; it is one of {', '.join(numbers)}")
    return numbers[value]
