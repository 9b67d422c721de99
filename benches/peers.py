"""Times HelicopterRotor.fmu beside dynbem, CCBlade and JSBSim, in turns on one core.

    python -m pip install --no-deps -r benches/requirements.txt
    python benches/peers.py

prints a table in Markdown, and what is alike in each comparison and what is not; `--out FILE` also
writes it. It needs Linux, and Python 3.11 or later for WISDEM, of which CCBlade is a part.

In each turn every case runs for some milliseconds, one after the other. A ratio is the median over
the turns of the ratio within a turn: what slows the machine slows both sides. Times are the
processor time of this process.
"""

import argparse
import contextlib
import gc
import os
import platform
import statistics
import sys
import tempfile
import textwrap
import time
import zipfile
from datetime import datetime, timezone
from importlib.metadata import version
from pathlib import Path

from fmu_cases import Fmu, PeerError, fmu_cases, section
from peer_cases import peer_cases

FMU = Path("target/fmu/HelicopterRotor.fmu")
PACKAGES = ("dynbem", "wisdem", "jsbsim", "numpy", "scipy")
COLUMNS = ("", "What", "Thrust, N", "Time", "Elements", "Per element", "Real time", "Ratio", "to")
CHUNKS = 20  # of a turn, where something is subtracted
HOW_TO_READ = """\
Time is that of one call from Python. Real time: how many times faster than real time. Ratio: time
per element, or per simulated second where there are no elements, over that of the row in the last
column; the median over the turns, and the quartiles. Above 1 the FMU is faster."""


# ---------------------------------------------------------------- timing


def timed(run, count):
    begin = time.process_time_ns()
    run(count)
    return (time.process_time_ns() - begin) * 1e-9


def runs_in(run, duration):
    """How many runs take so long, s."""
    count = 1
    while (spent := timed(run, count)) < 0.2 * duration:
        count *= 2
    return max(1, round(count * duration / spent))


def time_of(case, count):
    """Time of a run, s, the mean of so many."""
    if not case.overhead:
        return timed(case.run, count) / count
    # The difference is small, so that the two must alternate quickly.
    count = 1 + count // CHUNKS
    spent = [timed(case.run, count) - timed(case.overhead, count) for _ in range(CHUNKS)]
    return statistics.median(spent) / count


def measure(cases, repeat, duration):
    """Times of a call of each case, s; a list with one for each turn."""
    counts = [runs_in(case.run, duration) for case in cases]
    times = [[] for _ in cases]
    gc.disable()
    for _ in range(repeat):
        for case, count, series in zip(cases, counts, times):
            series.append(case.runs * time_of(case, count))
    gc.enable()
    return times


# ---------------------------------------------------------------- the table


def scaled(seconds):
    for factor, unit in ((1.0, "s"), (1e3, "ms"), (1e6, "µs")):
        if seconds * factor >= 1.0:
            return f"{seconds * factor:.3g} {unit}"
    return f"{seconds * 1e9:.3g} ns"


def ratio(cases, times, index):
    case, other = cases[index], cases[index].beside
    work, other_work = case.elements, other.elements
    if not work:
        work, other_work = case.simulated, other.simulated
    pairs = zip(times[index], times[cases.index(other)])
    ratios = [(a / work) / (b / other_work) for a, b in pairs]
    if len(ratios) == 1:
        return f"{ratios[0]:.3g}"
    low, middle, high = statistics.quantiles(ratios, n=4, method="inclusive")
    return f"{middle:.3g} ({low:.3g} to {high:.3g})"


def rows(cases, times):
    for index, case in enumerate(cases):
        middle = statistics.median(times[index])
        yield (
            f"{index + 1}",
            case.what,
            f"{case.thrust:.0f}" if case.thrust is not None else "",
            scaled(middle),
            f"{case.elements or 'none'}",
            scaled(middle / case.elements) if case.elements else "",
            f"{case.simulated / middle:.3g}" if case.simulated else "",
            ratio(cases, times, index) if case.beside else "",
            f"{cases.index(case.beside) + 1}" if case.beside else "",
        )


def processor():
    with contextlib.suppress(OSError):
        for line in Path("/proc/cpuinfo").read_text(encoding="utf-8").splitlines():
            if line.startswith("model name"):
                return line.split(":", 1)[1].strip()
    return platform.machine()


def report(fmu, cases, times):
    versions = ", ".join(f"{package} {version(package)}" for package in PACKAGES)
    python = platform.python_version()
    yield f"{datetime.now(timezone.utc):%Y-%m-%d}, {processor()}, one core, {len(times[0])} turns."
    yield f"HelicopterRotor.fmu {fmu.version}, {versions}, Python {python}."
    yield ""
    for row in (COLUMNS, ["--:", "---", *["--:"] * 7], *rows(cases, times)):
        yield f"| {' | '.join(row)} |"
    yield ""
    yield HOW_TO_READ
    yield ""
    for number, case in enumerate(cases, 1):
        start = f"{number}. "
        note = " ".join(case.note.split())
        yield textwrap.fill(start + note, 100, subsequent_indent=" " * len(start))


def write(text, file):
    """The file appears whole or not at all."""
    temporary = file.with_name(file.name + ".tmp")
    try:
        file.parent.mkdir(parents=True, exist_ok=True)
        temporary.write_text(text, encoding="utf-8")
        temporary.replace(file)
    except OSError as error:
        raise PeerError(f"cannot write {file}: {error.strerror}; name another --out") from error


# ---------------------------------------------------------------- command line


def above_zero(kind):
    def parse(text):
        value = kind(text)
        if value <= 0:
            raise argparse.ArgumentTypeError(f"{text} is not above 0")
        return value

    parse.__name__ = kind.__name__  # For argparse's message about what is no number.
    return parse


def command_line():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    add = parser.add_argument
    add("--fmu", type=Path, default=FMU, help="the FMU to time (default: %(default)s)")
    add("--out", type=Path, help="file for the table, in Markdown")
    add("--repeat", type=above_zero(int), default=101, help="turns (default: %(default)s)")
    duration = "time of each case in a turn (default: %(default)s)"
    add("--milliseconds", type=above_zero(float), default=10.0, help=duration)
    add("--core", type=int, help="core to run on (default: the last that is allowed)")
    return parser.parse_args()


def pin(core):
    """Keeps this process on one core."""
    if not hasattr(os, "sched_setaffinity"):
        raise PeerError("this system cannot keep a process on one core; run the script on Linux")
    allowed = sorted(os.sched_getaffinity(0))
    if core is not None and core not in allowed:
        raise PeerError(f"--core {core} is not allowed for this process; take one of {allowed}")
    os.sched_setaffinity(0, {allowed[-1] if core is None else core})
    # Read when NumPy and dynbem are loaded: their threads would share the core.
    for library in ("OMP", "OPENBLAS", "RAYON"):
        os.environ[f"{library}_NUM_THREADS"] = "1"


def compare(arguments):
    pin(arguments.core)
    if not arguments.fmu.is_file():
        hint = "make it with `cargo run --release -- package`"
        raise PeerError(f"{arguments.fmu} does not exist; {hint}")
    with tempfile.TemporaryDirectory(prefix="peers-") as folder:
        try:
            with zipfile.ZipFile(arguments.fmu) as archive:
                archive.extractall(folder)
        except zipfile.BadZipFile:
            raise PeerError(f"{arguments.fmu} is not an FMU; name a HelicopterRotor.fmu") from None
        fmu = Fmu(Path(folder))
        cases = list(fmu_cases(fmu))
        cases += peer_cases(cases[0], cases[2], section(Path(folder)))
        times = measure(cases, arguments.repeat, 1e-3 * arguments.milliseconds)
    text = "\n".join(report(fmu, cases, times)) + "\n"
    print(text, end="")
    if arguments.out:
        write(text, arguments.out)


def main():
    arguments = command_line()
    try:
        compare(arguments)
    except ModuleNotFoundError as error:
        hint = "`python -m pip install --no-deps -r benches/requirements.txt`"
        sys.exit(f"The package {error.name} is missing; install what is compared with {hint}.")
    except (PeerError, OSError) as error:
        sys.exit(f"Error: {error}")


if __name__ == "__main__":
    main()
