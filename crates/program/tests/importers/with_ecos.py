"""Ecos in Python: https://pypi.org/project/ecospy. It needs the Debian package libtbb12."""

import tempfile
from pathlib import Path

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


def controlled(fmu, variables):
    """The thrust that a controller holds, which is an FMU of FMI 3.0. It needs the shared library
    of Python."""
    from pythonfmu3.builder import FmuBuilder

    script = Path(__file__).with_name("governor.py")
    with tempfile.TemporaryDirectory() as folder, EcosSimulationStructure() as structure:
        governor = FmuBuilder.build_FMU(script, dest=folder)
        structure.add_model("rotor", fmu)
        structure.add_model("governor", str(governor))
        structure.make_real_connection("rotor::thrust", "governor::thrust")
        structure.make_real_connection("governor::collective", "rotor::collective")
        with EcosSimulation(step_size=1e-2, structure=structure) as simulation:
            if not simulation.init():
                raise RuntimeError(EcosLib.get_last_error())
            simulation.step(500)
            held = ["rotor::thrust", "governor::collective"]
            answers = [simulation.get_real(name) for name in held]
            simulation.terminate()
    return answers


if __name__ == "__main__":
    EcosLib.set_log_level("warn")
    main({"fly": fly, "two": two, "again": again, "reset": reset, "ssp": ssp, "controlled": controlled})
