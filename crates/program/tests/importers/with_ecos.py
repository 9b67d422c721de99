"""Ecos in Python: https://pypi.org/project/ecospy. It needs the Debian package libtbb12."""

import tempfile

from ecospy import EcosLib, EcosSimulation, EcosSimulationStructure

import system
from flight import STEP, STEPS, main

SET = "start"


def simulate(rotors, fmu):
    """Flies rotors, each with its variables by name."""
    with EcosSimulationStructure() as structure:
        values = {}
        for name, variables in rotors.items():
            structure.add_model(name, fmu)
            values |= {f"{name}::{v.name}": v.value for v in variables}
        structure.add_parameter_set(SET, values)
        with EcosSimulation(step_size=STEP, structure=structure) as simulation:
            return run(simulation, rotors)


def run(simulation, rotors, times=1, parameter_set=SET):
    thrusts = []
    for _ in range(times):
        if not simulation.init(parameter_set=parameter_set):
            raise RuntimeError(EcosLib.get_last_error())
        simulation.step(STEPS)
        thrusts += [simulation.get_real(f"{name}::thrust") for name in rotors]
        if len(thrusts) < times:
            simulation.reset()
    simulation.terminate()
    return thrusts


def fly(fmu, variables):
    return simulate({"rotor": variables}, fmu)


def two(fmu, variables):
    return simulate({"first": variables, "second": []}, fmu)


def again(fmu, variables):
    return fly(fmu, variables) + fly(fmu, variables)


def reset(fmu, variables):
    with EcosSimulationStructure() as structure:
        structure.add_model("rotor", fmu)
        structure.add_parameter_set(SET, {f"rotor::{v.name}": v.value for v in variables})
        with EcosSimulation(step_size=STEP, structure=structure) as simulation:
            return run(simulation, ["rotor"], times=2)


def ssp(fmu, variables):
    with tempfile.TemporaryDirectory() as folder:
        file = system.write(fmu, variables, folder, connector=False)
        with EcosSimulation(step_size=STEP, ssp_path=file) as simulation:
            return run(simulation, ["rotor"])


if __name__ == "__main__":
    EcosLib.set_log_level("warn")
    main({"fly": fly, "two": two, "again": again, "reset": reset, "ssp": ssp})
