"""Compares freestand with pyyeti and endaq on one thread: the shock response spectrum of 1 s at 100 kHz, 160 frequencies.

    cargo build --release
    python3 -m venv ../peers && ../peers/bin/pip install pyyeti endaq
    taskset -c 0 ../peers/bin/python benches/shock_response.py [target/release/freestand]

The time of freestand is the one that it reports (`timing.solve_s`: the spectrum, without reading and printing); the
others are timed over the same call. All take turns, and the best of REPEATS counts. pyyeti upsamples to 12 samples in a
period of the highest frequency if there are fewer (its default), endaq uses the samples unchanged; freestand is shown with 128
samples in every period and as sampled.
"""

import json
import os
import subprocess
import sys
import tempfile
import time
import warnings
from pathlib import Path

os.environ.setdefault("OMP_NUM_THREADS", "1")

import numpy as np
import pandas as pd
from endaq.calc.shock import shock_spectrum
from pyyeti.srs import srs

warnings.filterwarnings("ignore")
RATE, REPEATS = 100e3, 7


def shock():
    since = np.clip(np.arange(100_000) / RATE - 0.01, 0, None)
    tones = [(900, 120, 0.02), (1500, 1300, 0.005), (700, 4200, 0.002)]
    return sum(a * np.exp(-since / decay) * np.sin(2 * np.pi * f * since) for a, f, decay in tones)


def main():
    binary = sys.argv[1] if len(sys.argv) > 1 else Path(__file__).resolve().parent.parent / "target/release/freestand"
    a = shock()
    frequencies = 2 ** (np.arange(160) / 12)
    frame = pd.DataFrame({"a": a}, index=pd.Index(np.arange(len(a)) / RATE, name="time"))
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "shock.csv"
        lines = (f"{k / RATE:.5f},{value!r}" for k, value in enumerate(a.tolist()))
        path.write_text("\n".join(["time [s],acceleration [m/s2]", *lines]) + "\n")
        grid = ", ".join(f"{f!r} Hz" for f in frequencies.tolist())

        def own(*flags):
            command = [binary, "shock-spectrum", path, "--frequencies", grid, "--threads", "1", "--json", "-q", *flags]
            done = subprocess.run(list(map(str, command)), capture_output=True, text=True)
            if done.returncode:
                sys.exit(done.stderr)
            report = json.loads(done.stdout)
            return report["timing"]["solve_s"], np.array(report["spectra"][0]["values"])

        def timed(call):
            start = time.perf_counter()
            values = np.asarray(call()).ravel()
            return time.perf_counter() - start, values

        solvers = {
            "freestand, 128 samples per period": own,
            "freestand, as sampled": lambda: own("--no-upsample"),
            "pyyeti": lambda: timed(lambda: srs(a, RATE, frequencies, 10, parallel="no", time="total")),
            "endaq": lambda: timed(lambda: shock_spectrum(frame, freqs=frequencies, damp=0.05, max_time=None)),
        }
        found = {name: [] for name in solvers}
        for _ in range(REPEATS):
            for name, solve in solvers.items():
                found[name].append(solve())
    best = {name: min(runs, key=lambda one: one[0]) for name, runs in found.items()}
    first_s, exact = best["freestand, 128 samples per period"]
    print("| solver | ms | relative to freestand | largest difference |")
    print("|---|---|---|---|")
    for name, (seconds, values) in best.items():
        print(f"| {name} | {1e3 * seconds:.1f} | {seconds / first_s:.1f} | {np.max(np.abs(values / exact - 1)):.1e} |")


main()
