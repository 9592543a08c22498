"""What a call from Python costs beyond the same work in Rust.

    cargo build --release -p freestand-benches --example python_calls
    pip install WHEEL        # of cargo xtask wheel
    python benches/python_calls.py target/release/examples/python_calls

Times are the least of many turns, on one thread, so that other programs count as little as possible.
"""

import subprocess
import sys
import time
import warnings
from pathlib import Path

import numpy as np

warnings.simplefilter("ignore")
RECORD = Path(__file__).parents[1] / "validation/rocking/records/synthfloor.csv"
IMPORT = "import numpy, time; t = time.process_time(); import freestand; print(time.process_time() - t)"


def least(turns, work):
    times = []
    for _ in range(turns):
        begun = time.perf_counter()
        work()
        times.append(time.perf_counter() - begun)
    return min(times)


def main():
    import freestand as fs

    imported = min(float(subprocess.check_output([sys.executable, "-c", IMPORT])) for _ in range(10))
    print(f"import beyond NumPy: {1e3 * imported:.1f} ms of processor time")
    rust = dict(line.split() for line in subprocess.check_output([sys.argv[1], RECORD], text=True).splitlines())
    motion = fs.read_motion(RECORD, scale=3.5)
    ours = {}
    for name, height in (("rock", 1.8), ("still", 0.4)):
        block = fs.Block(height, 0.4, 150, stiffness_n_m=4.38e6)
        ours[name] = least(2000, lambda: fs.rock(block, motion))
    for heights, thicknesses in ((40, 25), (64, 64)):
        sizes = np.linspace(0.3, 3, heights), np.linspace(0.1, 1, thicknesses)
        name = f"spectrum{heights * thicknesses}"
        ours[name] = least(20, lambda: fs.spectrum(motion, *sizes, mass_kg=150, stiffness_n_m=4.38e6, threads=1))
    for name, took in ours.items():
        theirs = float(rust[name])
        print(f"{name}: Rust {1e6 * theirs:.1f} µs, Python {1e6 * took:.1f} µs, "
              f"{1e6 * (took - theirs):+.1f} µs, {took / theirs:.3f} times")  # fmt: skip


main()
