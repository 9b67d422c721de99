"""fmuloader: https://pypi.org/project/fmuloader"""

import xml.etree.ElementTree as ElementTree
import zipfile

from fmuloader.fmi2 import Fmi2Slave, Fmi2Type

from flight import STEP, STEPS, main

NAME = "HelicopterRotor"


class Rotor:
    """An instance, with variables by name: fmuloader does not read modelDescription.xml."""

    def __init__(self, fmu, kind=Fmi2Type.CO_SIMULATION):
        with zipfile.ZipFile(fmu) as archive:
            root = ElementTree.fromstring(archive.read("modelDescription.xml"))
        variables = root.iter("ScalarVariable")
        self.references = {v.get("name"): int(v.get("valueReference")) for v in variables}
        self.states = sum("derivative" in v.attrib for v in root.iter("Real"))
        self.slave = Fmi2Slave(fmu, model_identifier=NAME)
        self.slave.instantiate("rotor", kind, guid=root.get("guid"))

    def initialize(self, variables):
        setters = {
            "Real": self.slave.set_real,
            "Integer": self.slave.set_integer,
            "Enumeration": self.slave.set_integer,
            "Boolean": self.slave.set_boolean,
            "String": self.slave.set_string,
        }
        for v in variables:
            setters[v.kind]([self.references[v.name]], [v.value])
        self.slave.setup_experiment(start_time=0.0)
        self.slave.enter_initialization_mode()
        self.slave.exit_initialization_mode()
        return self

    @property
    def thrust(self):
        return self.slave.get_real([self.references["thrust"]])[0]

    def end(self):
        self.slave.terminate()
        self.slave.free_instance()


def step(*rotors):
    for i in range(STEPS):
        for rotor in rotors:
            rotor.slave.do_step(i * STEP, STEP)


def fly(fmu, variables):
    rotor = Rotor(fmu).initialize(variables)
    step(rotor)
    thrust = rotor.thrust
    rotor.end()
    return [thrust]


def two(fmu, variables):
    rotors = [Rotor(fmu).initialize(variables), Rotor(fmu).initialize([])]
    step(*rotors)
    thrusts = [rotor.thrust for rotor in rotors]
    for rotor in rotors:
        rotor.end()
    return thrusts


def again(fmu, variables):
    return fly(fmu, variables) + fly(fmu, variables)


def reset(fmu, variables):
    rotor = Rotor(fmu)
    thrusts = []
    for _ in range(2):
        rotor.initialize(variables)
        step(rotor)
        thrusts.append(rotor.thrust)
        rotor.slave.reset()
    rotor.slave.free_instance()
    return thrusts


def exchange(fmu, variables):
    """fmuloader has no solver. This is Heun's method of second order."""
    rotor = Rotor(fmu, Fmi2Type.MODEL_EXCHANGE).initialize(variables)
    slave, n = rotor.slave, rotor.states
    while slave.new_discrete_states().newDiscreteStatesNeeded:
        pass
    slave.enter_continuous_time_mode()
    x = slave.get_continuous_states(n)
    for i in range(STEPS):
        first = slave.get_derivatives(n)
        slave.set_time((i + 1) * STEP)
        slave.set_continuous_states([a + STEP * b for a, b in zip(x, first)])
        second = slave.get_derivatives(n)
        x = [a + STEP / 2 * (b + c) for a, b, c in zip(x, first, second)]
        slave.set_continuous_states(x)
        slave.completed_integrator_step()
    thrust = rotor.thrust
    rotor.end()
    return [thrust]


if __name__ == "__main__":
    main({"fly": fly, "exchange": exchange, "two": two, "again": again, "reset": reset})
