"""All parts of all cases, flown by as many processes as there are cores."""

import multiprocessing
import os
import tempfile
from pathlib import Path

from fmpy import extract

from cases import CASES
from rotor import FlightError, Rotor


def fly_all(fmu):
    """What every part of every case found, by case and part."""
    # The longest first, so that no process is left alone with one of them at the end.
    tasks = [(case, task) for case, module in CASES.items() for task in module.TASKS]
    tasks.sort(key=lambda task: task[0] != "autogiro" and task != ("descent", "law"))
    flown = {case: {} for case in CASES}
    with tempfile.TemporaryDirectory(prefix="validation-") as folder:
        unzipped = extract(str(fmu), unzipdir=folder)
        # As everywhere but on Linux, so that it is the same everywhere.
        context = multiprocessing.get_context("spawn")
        with context.Pool(os.cpu_count(), prepare, (unzipped,)) as pool:
            for done, (case, task, found) in enumerate(pool.imap_unordered(fly_one, tasks), 1):
                flown[case][task] = found
                print(f"progress {done} {len(tasks)} {case}: {task}", flush=True)
    return flown


def prepare(unzipped):
    """Gives a process its instance of the FMU."""
    global ROTOR, RESOURCES
    ROTOR, RESOURCES = Rotor(unzipped), Path(unzipped) / "resources"


def fly_one(task):
    case, name = task
    try:
        return case, name, CASES[case].fly(ROTOR, name, RESOURCES)
    except Exception as error:
        # The cause, in words that survive the way to the other process.
        raise FlightError(f"{case}, {name}: {type(error).__name__}: {error}") from None
