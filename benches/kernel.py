"""Compares the kernel for many blocks on one thread with a loop in C and Python peers, on the same blocks and motion.

    cargo build --release -p freestand-benches --example kernel
    python3 -m venv ../peers && ../peers/bin/pip install numpy scipy numba "jax[cpu]"
    ../peers/bin/python benches/kernel.py [target/release/examples/kernel]

Needs numpy and a C compiler; peers whose library cannot be imported are left out. All of them end at the last sample, and
time the solution of all blocks, without reading and printing. The kernel and the C loop take turns, and the best of REPEATS counts,
so that other work on the machine affects both equally. For the other peers, the best of REPEATS_OF_PEERS counts.
"""

import subprocess
import sys
import tempfile
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parent / "peers"))
from case import chosen

HERE = Path(__file__).resolve().parent
RECORD, SCALE = HERE.parent / "validation/rocking/records/bench4000.csv", 0.5
REPEATS, REPEATS_OF_PEERS = 7, 3
# The smallest and the largest height and thickness [m]; 64 values of each.
GRIDS = [((0.3, 4), (0.1, 1)), ((4, 20), (0.4, 0.8))]
LEVELS = ["fast", "standard", "tight"]
# Peers in Python, and the number of blocks that each solves: all, or a sample for the slow one.
PEERS = [("rk4_numba", None), ("rk4_jax", None), ("events_scipy", 64)]
OVERTURNED = np.pi / 2


def peer(command, scale_up=1):
    """Seconds and peak rotations, and the share of the block-steps that moved, if the peer counts it."""
    done = subprocess.run(list(map(str, command)), capture_output=True, text=True)
    if done.returncode:
        return None
    first, *lines = done.stdout.splitlines()
    seconds, *moving = map(float, first.split())
    return seconds * scale_up, np.array([float(line.split()[0]) for line in lines]), moving


def outcomes(found):
    return np.where(found >= OVERTURNED * (1 - 1e-9), 2, found > 0)


def line(name, ns, own_ns, found, exact, insensitive):
    """One row: errors relative to freestand's `tight`, for blocks that rocked in both and are not sensitive."""
    apart = outcomes(found) != outcomes(exact)
    rocked = insensitive & ~apart & (outcomes(exact) == 1)
    error = np.abs(found[rocked] / exact[rocked] - 1)
    median, most = np.quantile(error, [0.5, 0.99]) if len(error) else (np.nan, np.nan)
    apart = f"{apart.sum()} ({(apart & insensitive).sum()})"
    print(f"| {name} | {ns:.2f} | {ns / own_ns:.2f} | {median:.1e} | {most:.1e} | {apart} |", flush=True)


def write_case(path, motion, blocks):
    numbers = [f"0.005 9.80665 {len(motion)} {len(blocks)}", *map(repr, motion)]
    path.write_text("\n".join([*numbers, *(f"{h!r} {t!r}" for h, t in blocks)]) + "\n")


def compare(binary, grid, folder):
    record = [float(text) for text in RECORD.read_text().splitlines() if not text.startswith("#")]
    sides = [np.linspace(*ends, 64).tolist() for ends in grid]
    blocks = [(h, t) for h in sides[0] for t in sides[1]]
    case, larger = folder / "case.txt", folder / "larger.txt"
    write_case(case, [SCALE * a for a in record], blocks)
    # A motion that is larger by 1e-6 changes a block that is not sensitive by less than 1e-5 (validation/rocking).
    write_case(larger, [SCALE * (1 + 1e-6) * a for a in record], blocks)
    loop, own = [], {level: [] for level in LEVELS}
    for _ in range(REPEATS):
        loop.append(peer([folder / "rk4", case]))
        for level in LEVELS:
            own[level].append(peer([binary, case, level]))
    if None in own["tight"]:
        sys.exit(f"{binary} did not run: build it with `cargo build --release -p freestand-benches --example kernel`")
    exact, other = own["tight"][0][1], peer([binary, larger, "tight"])[1]
    insensitive = (outcomes(other) == outcomes(exact)) & (np.abs(other - exact) <= 1e-5 * exact)

    steps = len(blocks) * (len(record) - 1)
    c_s, c_peaks, moving = min(loop, key=lambda one: one[0])
    c_ns = 1e9 * c_s / steps
    name = " by ".join(f"{low:g}–{high:g} m" for low, high in grid)
    print(f"\n{name}, × {SCALE}: {len(blocks)} blocks, {steps} block-steps, {moving[0]:.0%} moving;", end=" ")
    print(f"{(outcomes(exact) == 1).sum()} rocked, {(outcomes(exact) == 2).sum()} overturned, {(~insensitive).sum()} sensitive\n")
    print("| solver | ns per block-step | relative to the C loop | error, median | error, 99 % | different outcomes |")
    print("|---|---|---|---|---|---|")
    for level, found in own.items():
        seconds, peaks, _ = min(found, key=lambda one: one[0])
        line(f"freestand, {level}", 1e9 * seconds / steps, c_ns, peaks, exact, insensitive)
    line("RK4 in C", c_ns, c_ns, c_peaks, exact, insensitive)
    for name, sample in PEERS:
        some = np.arange(len(blocks)) if sample is None else chosen(len(blocks), sample)
        command = [sys.executable, HERE / f"peers/{name}.py", case, *([] if sample is None else [sample])]
        found = [peer(command, scale_up=len(blocks) / len(some)) for _ in range(REPEATS_OF_PEERS)]
        if None in found:
            print(f"| {name} | left out: it did not run | | | | |")
            continue
        found = min(found, key=lambda one: one[0])
        label = name if sample is None else f"{name}, from {sample} blocks"
        line(label, 1e9 * found[0] / steps, c_ns, found[1], exact[some], insensitive[some])


def main():
    binary = sys.argv[1] if len(sys.argv) > 1 else HERE.parent / "target/release/examples/kernel"
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        source = HERE / "peers/rk4.c"
        subprocess.run(["cc", "-O3", "-march=native", "-o", folder / "rk4", source, "-lm"], check=True)
        for grid in GRIDS:
            compare(binary, grid, folder)


main()
