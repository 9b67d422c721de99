"""fmi-sim, a program: https://crates.io/crates/fmi-sim. Its path is in the variable FMI_SIM."""

import csv
import os
import subprocess
import tempfile
from pathlib import Path

from flight import STEP, STEPS, main


def run(fmu, variables, interface):
    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder) / "out.csv"
        command = [os.environ["FMI_SIM"], "--model", fmu, "-o", file, interface]
        command += ["--step", str(STEP), "--output-interval", str(STEP), "-f", str(STEP * STEPS)]
        for v in variables:
            value = str(v.value).lower() if v.kind == "Boolean" else str(v.value)
            command += ["--init-values", f"{v.name}={value}"]
        done = subprocess.run(command, capture_output=True, text=True)
        if done.returncode != 0:
            raise RuntimeError(done.stdout + done.stderr)
        with open(file) as text:
            rows = list(csv.DictReader(text))
    return [rows[-1]["thrust"]]


def fly(fmu, variables):
    return run(fmu, variables, "co-simulation")


def exchange(fmu, variables):
    return run(fmu, variables, "model-exchange")


if __name__ == "__main__":
    main({"fly": fly, "exchange": exchange})
