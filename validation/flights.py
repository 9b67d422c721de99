"""The parts of all cases, flown by as many processes as there are cores."""

import logging
import math
import multiprocessing
import os
from pathlib import Path

from cases import CASES
from rotor import Rotor, RotorError, unpacked

STEP = 0.01  # s; a rotor without states only computes its outputs in a step


class CaseRotor(Rotor):
    """The one instance of a process, with the methods that the cases share."""

    def begin(self, parameters):
        """A fresh rotor with these parameters and inputs, started."""
        self.restart(parameters)
        self.start()

    def fly(self, outputs, step=STEP, **inputs):
        """The outputs, a tuple in the order of their names, after a step with these inputs; inputs
        that are not named are kept."""
        self.set(inputs)
        self.step(step)
        values = self.get(outputs)
        if not all(map(math.isfinite, values)):
            raise RotorError(f"{outputs} = {values} with {inputs}")
        return tuple(values)

    def models(self, parameters):
        """All physical models of a flight in one line, defaults included."""
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


def fly_all(fmu):
    """The results of all parts: {case: {part: result}}."""
    # The longest parts come first, so that no process flies one of them alone at the end.
    tasks = [(case, task) for case, module in CASES.items() for task in module.TASKS]
    tasks.sort(key=lambda task: task[0] != "autogiro" and task != ("descent", "law"))
    flown = {case: {} for case in CASES}
    # Processes are spawned on every system, so that flights are the same on all.
    context = multiprocessing.get_context("spawn")
    with (
        unpacked(fmu) as folder,
        context.Pool(os.cpu_count(), prepare, (folder,)) as pool,
    ):
        for done, (case, task, found) in enumerate(pool.imap_unordered(fly_one, tasks), 1):
            flown[case][task] = found
            print(f"progress {done} {len(tasks)} {case}: {task}", flush=True)
    return flown


def prepare(folder):
    """Gives a process its instance of the FMU."""
    global ROTOR, RESOURCES
    # Standard error is for the sentence on a case that failed.
    logging.getLogger("rotor").setLevel(logging.ERROR)
    ROTOR, RESOURCES = CaseRotor(folder), Path(folder) / "resources"


def fly_one(task):
    case, name = task
    try:
        return case, name, CASES[case].fly(ROTOR, name, RESOURCES)
    except Exception as error:
        # Only the text of an error survives the way to the other process.
        raise RotorError(f"{case}, {name}: {type(error).__name__}: {error}") from None
