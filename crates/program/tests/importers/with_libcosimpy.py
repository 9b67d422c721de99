"""libcosimpy, the Python interface of libcosim: https://pypi.org/project/libcosimpy"""

import tempfile

from libcosimpy.CosimExecution import CosimExecution
from libcosimpy.CosimLogging import CosimLogLevel, log_output_level
from libcosimpy.CosimObserver import CosimObserver
from libcosimpy.CosimSlave import CosimLocalSlave

import system
from flight import STEP, STEPS, main

NANOSECONDS = round(STEP * 1e9)


class Flight:
    """An execution with one or more rotors."""

    def __init__(self, execution):
        self.execution = execution
        self.observer = CosimObserver.create_last_value()
        assert execution.add_observer(self.observer)
        self.references = []

    def add(self, fmu, name, variables):
        slave = CosimLocalSlave(fmu, name)
        index = self.execution.add_local_slave(slave)
        assert index >= 0, "the FMU was not added"
        self.find(index)
        setters = {
            "Real": self.execution.real_initial_value,
            "Integer": self.execution.integer_initial_value,
            "Boolean": self.execution.boolean_initial_value,
            "String": self.execution.string_initial_value,
            "Enumeration": self.execution.integer_initial_value,
        }
        for v in variables:
            reference, _ = self.references[index][v.name]
            if not setters[v.kind](index, reference, v.value):
                raise RuntimeError(f"{v.name} was not set")
        return self

    def find(self, index):
        found = self.execution.slave_variables(index)
        self.references.append({v.name.decode(): (v.reference, v.type) for v in found})

    def fly(self):
        assert self.execution.step(STEPS), "the steps failed"
        thrusts = []
        for index, references in enumerate(self.references):
            thrust, _ = references["thrust"]
            thrusts += self.observer.last_real_values(index, [thrust])
        return thrusts


def empty():
    return Flight(CosimExecution.from_step_size(NANOSECONDS))


def fly(fmu, variables):
    return empty().add(fmu, "rotor", variables).fly()


def two(fmu, variables):
    return empty().add(fmu, "first", variables).add(fmu, "second", []).fly()


def again(fmu, variables):
    return fly(fmu, variables) + fly(fmu, variables)


def ssp(fmu, variables):
    with tempfile.TemporaryDirectory() as folder:
        file = system.write(fmu, variables, folder, connector=False)
        flight = Flight(CosimExecution.from_ssp_file(system.unpacked(file), NANOSECONDS))
        flight.find(0)
        return flight.fly()


if __name__ == "__main__":
    log_output_level(CosimLogLevel.WARNING)
    main({"fly": fly, "two": two, "again": again, "ssp": ssp})
