"""Maps a rotor: 100,000 conditions, by Dask on all cores or on a cluster, into a Zarr store.

    python rotor_map.py --fmu HelicopterRotor.fmu --out FOLDER

computes loads for every combination of collective, edgewise speed, climb and rotor speed, and
writes map.zarr, map.csv (times) and map.png into FOLDER. It computes the map several times: in this
process, and with one and more workers, of which one is killed half-way. All maps have the same
bits.

    python rotor_map.py --fmu ... --out ... --scheduler tcp://ADDRESS:8786

computes it once, on the workers of a cluster, which must find the .fmu under the same path. A store
that an interrupted run has left is completed: what is in it is not computed again.
"""

import os
import shutil
import signal
import sys
import time
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent))

import numpy as np
import psutil
import xarray as xr
from distributed import Client, LocalCluster, as_completed

import conditions
from conditions import AXES, BLOCK, BLOCKS, CONDITIONS, LOADS, compute
from script import command_line, plt, save_plot, write_table


class Store:
    """The map in a Zarr store. Blocks that are not yet computed are NaN."""

    def __init__(self, folder):
        self.folder = folder
        if not folder.exists():
            shape = tuple(len(values) for values in AXES.values())
            empty = {name: (tuple(AXES), np.full(shape, np.nan)) for name in LOADS}
            data = xr.Dataset(empty, coords=AXES)
            for name, (_, unit) in LOADS.items():
                data[name].attrs["units"] = unit
            chunks = {name: {"chunks": (1, 1, *BLOCK)} for name in LOADS}
            temporary = folder.with_suffix(".tmp")
            shutil.rmtree(temporary, ignore_errors=True)
            data.to_zarr(temporary, encoding=chunks, consolidated=False)
            temporary.rename(folder)

    def missing(self):
        last = list(LOADS)[-1]
        done = np.isfinite(xr.open_zarr(self.folder, consolidated=False)[last][:, :, 0, 0]).values
        return [block for block in BLOCKS if not done[block]]

    def write(self, block, loads):
        """The last of the loads is written last: with it the block is complete."""
        region = {"rpm": slice(block[0], block[0] + 1), "climb": slice(block[1], block[1] + 1)}
        region |= {"speed": slice(None), "collective": slice(None)}
        for name, values in zip(LOADS, loads):
            data = xr.Dataset({name: (tuple(AXES), values[None, None])})
            data.to_zarr(self.folder, region=region, consolidated=False)

    def move(self, folder):
        shutil.rmtree(folder, ignore_errors=True)
        self.folder = self.folder.rename(folder)

    def bits(self):
        data = xr.open_zarr(self.folder, consolidated=False)
        return {name: data[name].values.tobytes() for name in LOADS}


def in_this_process(fmu, blocks):
    for block in blocks:
        yield compute(fmu, block)


def with_workers(client, fmu, blocks):
    """Blocks in the order in which they are ready. Dask computes those of a lost worker again."""
    futures = client.map(compute, [fmu] * len(blocks), blocks, pure=False)
    ready = as_completed(futures, with_results=True)
    del futures  # so that each result is forgotten once it is stored
    for _, result in ready:
        yield result


def fill(store, results, name, at_half=None):
    """Stores the results as they come. Calls `at_half` when half of them are there."""
    total = len(store.missing())
    for i, (block, loads) in enumerate(results):
        store.write(block, loads)
        if i % 10 == 0:
            print(f"progress {i} {total} {name}")
        if at_half and i == total // 2:
            at_half()


def map_alone(fmu, out, workers, kill=False):
    """Computes the whole map with local workers (0: in this process). A row of the table, and the
    store."""
    name = f"{workers} worker{'s' * (workers != 1)}" if workers else "this process, without Dask"
    name += ", one killed" * kill
    folder = out / f"{name.replace(' ', '-').replace(',', '')}.zarr"
    shutil.rmtree(folder, ignore_errors=True)
    store = Store(folder)
    memory = []
    if not workers:
        began = time.perf_counter()
        fill(store, in_this_process(fmu, store.missing()), name)
        seconds = time.perf_counter() - began
        memory = [megabytes()] * 2
    else:
        options = {"processes": True, "threads_per_worker": 1, "dashboard_address": None}
        with LocalCluster(n_workers=workers, **options) as cluster, Client(cluster) as client:
            client.run(compute, fmu, BLOCKS[0])  # Each has loaded the FMU when the clock starts.
            began = time.perf_counter()

            def at_half():
                memory.append(max(client.run(megabytes).values()))
                if kill:
                    victim = next(iter(client.run(os.getpid).values()))
                    print(f"killing worker process {victim}")
                    os.kill(victim, signal.SIGKILL)

            fill(store, with_workers(client, fmu, store.missing()), name, at_half)
            seconds = time.perf_counter() - began
            memory.append(max(client.run(megabytes).values()))
    row = {"run": name, "workers": workers, "seconds": seconds, "rate": CONDITIONS / seconds}
    print(
        f"{name:26s} {seconds:6.1f} s, {row['rate']:6.0f} conditions/s;"
        f" {memory[0]:.0f} MB a process at half, {memory[-1]:.0f} MB at the end"
    )
    return row | {"memory_half": memory[0], "memory_end": memory[-1]}, store


def megabytes():
    return psutil.Process().memory_info().rss / 1e6


def plot(store, file):
    """From the map: thrust against collective and speed, and the power that carries a weight."""
    data = xr.open_zarr(store.folder, consolidated=False).sel(rpm=960.0)
    figure, axes = plt.subplots(1, 2, figsize=(10.0, 4.6), constrained_layout=True)
    level = data.thrust.sel(climb=0.0)
    filled = axes[0].contourf(data.collective, data.speed, level, 12, cmap="YlGnBu")
    lines = axes[0].contour(data.collective, data.speed, level, [60.0], colors="black")
    axes[0].clabel(lines, fmt="%g N")
    figure.colorbar(filled, ax=axes[0], label="thrust, N")
    axes[0].set_xlabel("collective, deg")
    axes[0].set_ylabel("edgewise speed, m/s")
    axes[0].set_title("Thrust at 960 rev/min")
    for climb, style in ((-2.0, ":"), (0.0, "-"), (2.0, "--"), (4.0, "-.")):
        loads = data.sel(climb=climb)
        power = [
            np.interp(60.0, thrust, torque) * 960.0 * np.pi / 30.0
            for thrust, torque in zip(loads.thrust.values, loads.torque.values)
        ]
        axes[1].plot(data.speed, power, style, color="black", label=f"climb {climb:g} m/s")
    axes[1].set_xlabel("edgewise speed, m/s")
    axes[1].set_ylabel("power, W")
    axes[1].set_title("Power at a thrust of 60 N")
    axes[1].grid(True, color="0.85")
    axes[1].legend()
    save_plot(figure, file)


def main():
    parser = command_line(__doc__, out="folder for the map, the times and the picture")
    parser.add_argument("--scheduler", help="address of a Dask scheduler with its own workers")
    arguments = parser.parse_args()
    fmu, out = str(arguments.fmu.resolve()), arguments.out
    out.mkdir(parents=True, exist_ok=True)
    if arguments.scheduler:
        store = Store(out / "map.zarr")
        with Client(arguments.scheduler) as client:
            for module in (
                Path(conditions.__file__).parent.parent / "rotor.py",
                conditions.__file__,
            ):
                client.upload_file(str(module))
            fill(store, with_workers(client, fmu, store.missing()), "cluster")
        print(f"{CONDITIONS} conditions are in {store.folder}")
    else:
        cores = max(2, os.cpu_count())
        first, store = map_alone(fmu, out, 0)
        rows, bits = [first | {"same_bits": True}], store.bits()
        for workers, kill in ((1, False), (cores, False), (cores, True)):
            row, other = map_alone(fmu, out, workers, kill)
            rows.append(row | {"same_bits": other.bits() == bits})
            shutil.rmtree(other.folder)
        store.move(out / "map.zarr")
        same = all(row["same_bits"] for row in rows)
        print(f"All {CONDITIONS} conditions are the same in all runs: {same}")
        write_table(rows, out / "map.csv")
    plot(store, out / "map.png")


if __name__ == "__main__":
    main()
