"""FMPy: https://pypi.org/project/FMPy"""

import shutil
import tempfile

from fmpy import extract, instantiate_fmu, read_model_description, simulate_fmu
from fmpy.fmi2 import FMU2Slave
from fmpy.ssp import ssd
from fmpy.ssp.simulation import simulate_ssp
from fmpy.validation import validate_fmu

import system
from flight import STEP, STEPS, main


def simulate(fmu, variables, kind="CoSimulation", outputs=("thrust",), **options):
    """The values of some outputs at the end."""
    result = simulate_fmu(
        fmu,
        fmi_type=kind,
        stop_time=STEP * STEPS,
        step_size=STEP,
        output_interval=STEP,
        start_values={v.name: v.value for v in variables},
        output=outputs,
        **options,
    )
    return [result[output][-1] for output in outputs]


def simulate_twice(fmu, variables, outputs=("thrust",)):
    """With one instance, which is reset in between."""
    description = read_model_description(fmu)
    folder = extract(fmu)
    instance = instantiate_fmu(folder, description, "CoSimulation")
    ends = []
    for _ in range(2):
        options = {"fmu_instance": instance, "model_description": description, "terminate": False}
        ends += simulate(fmu, variables, outputs=outputs, **options)
        instance.reset()
    instance.freeInstance()
    shutil.rmtree(folder)
    return ends


def load(fmu, variables):
    problems = validate_fmu(fmu)
    if problems:
        raise RuntimeError("\n".join(problems))
    return fly(fmu, variables)


def fly(fmu, variables):
    return simulate(fmu, variables)


def exchange(fmu, variables):
    return simulate(fmu, variables, "ModelExchange")


def again(fmu, variables):
    return simulate(fmu, variables) + simulate(fmu, variables)


def reset(fmu, variables):
    return simulate_twice(fmu, variables)


def two(fmu, variables):
    description = read_model_description(fmu)
    references = {v.name: v.valueReference for v in description.modelVariables}
    folder = extract(fmu)
    instances = []
    for name, wanted in [("first", variables), ("second", [])]:
        instance = FMU2Slave(
            guid=description.guid,
            unzipDirectory=folder,
            modelIdentifier=description.coSimulation.modelIdentifier,
            instanceName=name,
        )
        instance.instantiate()
        setters = {
            "Real": instance.setReal,
            "Integer": instance.setInteger,
            "Enumeration": instance.setInteger,
            "Boolean": instance.setBoolean,
            "String": instance.setString,
        }
        for v in wanted:
            setters[v.kind]([references[v.name]], [v.value])
        instance.setupExperiment(startTime=0.0)
        instance.enterInitializationMode()
        instance.exitInitializationMode()
        instances.append(instance)
    for i in range(STEPS):
        for instance in instances:
            instance.doStep(i * STEP, STEP)
    thrusts = [i.getReal([references["thrust"]])[0] for i in instances]
    for instance in instances:
        instance.terminate()
        instance.freeInstance()
    shutil.rmtree(folder)
    return thrusts


def ssp(fmu, variables):
    """FMPy ignores the parameters in an .ssp file, and takes a set of its own."""
    parameters = [ssd.Parameter(name=f"rotor.{v.name}", value=v.value) for v in variables]
    with tempfile.TemporaryDirectory() as folder:
        file = system.write(fmu, variables, folder)
        result = simulate_ssp(
            file,
            stop_time=STEP * STEPS,
            step_size=STEP,
            parameter_set=ssd.ParameterSet(parameters=parameters),
        )
    return [result["thrust"][-1]]


MODES = {
    "load": load,
    "fly": fly,
    "exchange": exchange,
    "two": two,
    "again": again,
    "reset": reset,
    "ssp": ssp,
}

if __name__ == "__main__":
    main(MODES)
