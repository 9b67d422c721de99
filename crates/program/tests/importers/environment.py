"""The folder into which the importers are installed: a Python environment, and Rust programs."""

import fcntl
import re
import shutil
import subprocess
import sys
import sysconfig
import venv
from pathlib import Path

from importers import FMI_SIM

HERE = Path(__file__).resolve().parent
REQUIREMENTS = HERE / "requirements.txt"
MANIFEST = HERE / "rust" / "Cargo.toml"


class Environment:
    def __init__(self, folder):
        self.folder = Path(folder).resolve()
        self.python = self.folder / "python" / "bin" / "python"
        self.rust = self.folder / "rust"

    def install(self, importers):
        self.folder.mkdir(parents=True, exist_ok=True)
        with open(self.folder / "lock", "w") as lock:
            # Until no other process installs.
            fcntl.flock(lock, fcntl.LOCK_EX)
            self.install_locked(importers)

    def install_locked(self, importers):
        self.install_python()
        if any(importer.is_rust for importer in importers):
            run(["cargo", "build", "--locked", "--manifest-path", MANIFEST, *self.target()])
        if FMI_SIM in importers:
            version = versions()[FMI_SIM.package]
            options = ["--locked", "--debug", "--root", self.rust, *self.target()]
            run(["cargo", "install", *options, f"fmi-sim@{version}"])

    def install_python(self):
        folder = self.folder / "python"
        installed = folder / "requirements.txt"
        if installed.is_file() and installed.read_text() == REQUIREMENTS.read_text():
            return
        shutil.rmtree(folder, ignore_errors=True)
        venv.create(folder, with_pip=True)
        options = ["--quiet", "--disable-pip-version-check", "-r", REQUIREMENTS]
        run([self.python, "-m", "pip", "install", *options])
        # Copied last: an environment without this file is made again.
        shutil.copy(REQUIREMENTS, installed)

    def target(self):
        return ["--quiet", "--target-dir", self.rust / "target"]

    def command(self, importer):
        if importer.is_rust:
            return [self.rust / "target" / "debug" / importer.program]
        return [self.python, "-W", "ignore", HERE / importer.program]

    @property
    def variables(self):
        """Environment variables of the scripts."""
        return {
            "FMI_SIM": str(self.rust / "bin" / "fmi-sim"),
            # For FMUs that contain Python.
            "LD_LIBRARY_PATH": sysconfig.get_config_var("LIBDIR") or "",
        }


def run(command):
    done = subprocess.run(command, capture_output=True, text=True)
    if done.returncode != 0:
        sys.exit(f"{' '.join(map(str, command))} failed:\n{done.stdout}{done.stderr}")


def versions():
    """The versions of the packages, by name."""
    found = {}
    for line in REQUIREMENTS.read_text().splitlines():
        name, _, version = line.partition("==")
        found[name] = version.split()[0] if version else None
    crates = re.findall(r'^([\w-]+) = .*"=([\d.]+)"', MANIFEST.read_text(), re.MULTILINE)
    return found | dict(crates)
