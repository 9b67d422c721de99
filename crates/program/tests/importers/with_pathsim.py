"""PathSim with its FMU blocks: https://pypi.org/project/pathsim-fmi"""

from pathsim import Connection, Simulation
from pathsim.blocks import Constant
from pathsim.solvers import RKDP54
from pathsim_fmi import CoSimulationFMU, ModelExchangeFMU
from pathsim_fmi.wrapper import FMUWrapper

from flight import STEP, STEPS, main

# Half a step early, so that rounding errors do not decide which step is the last.
END = STEP * (STEPS - 0.5)
# In Co-Simulation the block's first step is at time 0, so that it is one step ahead of PathSim.
CO_SIMULATION_END = END - STEP


def connected(fmu, variables, block_type=CoSimulationFMU, **options):
    """A block, and a system in which its inputs have their start values: PathSim would set inputs
    to 0 that are not connected."""
    block = block_type(fmu, start_values={v.name: v.value for v in variables}, **options)
    description = block.fmu_wrapper.model_description
    starts = {v.name: float(v.start) for v in description.modelVariables if v.causality == "input"}
    sources = {name: Constant(start) for name, start in starts.items()}
    connections = [Connection(source, block[name]) for name, source in sources.items()]
    return block, [block, *sources.values()], connections


def simulate(*systems, end=CO_SIMULATION_END, **options):
    """Runs systems side by side."""
    blocks = [block for _, blocks, _ in systems for block in blocks]
    connections = [connection for _, _, connections in systems for connection in connections]
    simulation = Simulation(blocks, connections, dt=STEP, log=False, **options)
    simulation.run(end)
    return simulation


def thrust(system):
    return system[0].outputs["thrust"]


def fly(fmu, variables):
    system = connected(fmu, variables, dt=STEP)
    simulate(system)
    return [thrust(system)]


def exchange(fmu, variables):
    system = connected(fmu, variables, ModelExchangeFMU)
    simulate(system, end=END, Solver=RKDP54, tolerance_lte_abs=1e-9, tolerance_lte_rel=1e-6)
    return [thrust(system)]


def two(fmu, variables):
    systems = [connected(fmu, variables, dt=STEP), connected(fmu, [], dt=STEP)]
    simulate(*systems)
    return [thrust(system) for system in systems]


def again(fmu, variables):
    return fly(fmu, variables) + fly(fmu, variables)


def reset(fmu, variables):
    system = connected(fmu, variables, dt=STEP)
    simulation = simulate(system)
    first = thrust(system)
    simulation.reset()
    simulation.run(CO_SIMULATION_END)
    return [first, thrust(system)]


def workaround(fmu, variables):
    """Lets PathSim's blocks set strings, which they refuse."""
    set_other = FMUWrapper.set_variable

    def set_variable(self, name, value):
        variable = self.variable_map[name]
        if variable.type == "String":
            self.fmu.setString([variable.valueReference], [value])
        else:
            set_other(self, name, value)

    FMUWrapper.set_variable = set_variable
    return fly(fmu, variables)


MODES = {
    "fly": fly,
    "exchange": exchange,
    "two": two,
    "again": again,
    "reset": reset,
    "workaround": workaround,
}

if __name__ == "__main__":
    main(MODES)
