"""What the scripts of this folder share beside the rotor: command line, tables and plots."""

import argparse
import csv
from pathlib import Path

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt


def command_line(documentation, out=None, out_required=False):
    """A parser with --fmu and, if there is a help text for it, --out. The first line of the
    documentation describes the script."""
    parser = argparse.ArgumentParser(description=documentation.splitlines()[0])
    parser.add_argument("--fmu", type=fmu, required=True, help="the HelicopterRotor.fmu to fly")
    if out:
        default = None if out_required else Path(".")
        parser.add_argument("--out", type=Path, default=default, required=out_required, help=out)
    return parser


def fmu(text):
    """Path of an .fmu that exists."""
    if not Path(text).is_file():
        hint = "make it with `cargo run --release -- package`"
        raise argparse.ArgumentTypeError(f"{text} does not exist; {hint}")
    return Path(text)


def write_table(rows, file):
    """A CSV file of dictionaries with the same keys; it appears whole or not at all."""
    file.parent.mkdir(parents=True, exist_ok=True)
    temporary = file.with_suffix(".tmp")
    with temporary.open("w", newline="", encoding="utf-8") as out:
        writer = csv.DictWriter(out, fieldnames=list(rows[0]))
        writer.writeheader()
        writer.writerows(rows)
    temporary.replace(file)


def save_plot(figure, file):
    """The plot appears whole or not at all."""
    file.parent.mkdir(parents=True, exist_ok=True)
    temporary = file.with_suffix(".tmp")
    figure.savefig(temporary, dpi=130, format=file.suffix[1:])
    temporary.replace(file)
    plt.close(figure)
