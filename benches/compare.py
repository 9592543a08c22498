"""Times freestand, eqsig and obspy on the same files, in one run.

    python -m venv .venv && .venv/bin/pip install eqsig obspy
    cargo build --release
    .venv/bin/python benches/compare.py [target/release/freestand]

freestand is timed as a process, including its start, the reading of the files and its JSON; only reading is timed by the
example read_files, within the process on one thread. The others are timed within Python, without the start of Python or
their imports. Those that are not installed are left out.
"""

import json
import statistics
import subprocess
import sys
import tempfile
import time
from pathlib import Path

import numpy as np

SAMPLES, DT_S, FILES, RUNS = 8000, 0.01, 100, 5


def record(seed):
    """Noise under an envelope: 8000 samples, m/s2."""
    noise = np.random.default_rng(seed).standard_normal(SAMPLES)
    t = np.arange(SAMPLES) * DT_S
    return noise * (t / 10) * np.exp(1 - t / 10)


def write_at2(path, accel):
    values = [f"{a / 9.80665:15.7E}" for a in accel]
    lines = ["".join(values[i : i + 5]) for i in range(0, len(values), 5)]
    head = ["PEER STRONG MOTION DATABASE RECORD", "Synthetic noise", "ACCELERATION TIME SERIES IN UNITS OF G"]
    path.write_text("\n".join([*head, f"NPTS= {SAMPLES:6}, DT= {DT_S:7.4f} SEC", *lines]) + "\n")


def write_knet(path, accel):
    """The 17 header lines of the format, then counts, eight a line."""
    scale_gal = 3920 / 6182761
    counts = [f"{round(a * 100 / scale_gal):8d} " for a in accel]
    fields = [
        ("Origin Time", "2018/01/24 19:51:00"), ("Lat.", "41.0"), ("Long.", "142.4"), ("Depth. (km)", "30"),
        ("Mag.", "6.2"), ("Station Code", "AOM001"), ("Station Lat.", "41.5"), ("Station Long.", "140.9"),
        ("Station Height(m)", "24"), ("Record Time", "2018/01/24 19:51:38"), ("Sampling Freq(Hz)", f"{1 / DT_S:.0f}Hz"),
        ("Duration Time(s)", f"{SAMPLES * DT_S:.0f}"), ("Dir.", "N-S"), ("Scale Factor", "3920(gal)/6182761"),
        ("Max. Acc. (gal)", f"{100 * np.abs(accel - accel.mean()).max():.3f}"),
        ("Last Correction", "2018/01/24 19:51:23"), ("Memo.", ""),
    ]
    lines = [f"{name:<18}{value}" for name, value in fields]
    lines += ["".join(counts[i : i + 8]) for i in range(0, len(counts), 8)]
    path.write_text("\n".join(lines) + "\n")


def median_s(work):
    times = []
    for _ in range(RUNS):
        start = time.perf_counter()
        work()
        times.append(time.perf_counter() - start)
    return statistics.median(times)


def freestand(binary, *args):
    done = subprocess.run([binary, *map(str, args)], capture_output=True, text=True)
    if done.returncode != 0:
        raise RuntimeError(done.stderr.strip().splitlines()[0])
    return json.loads(done.stdout)


def line(what, own_s, name, other_s):
    beside = "" if other_s is None else f"{name} {1e3 * other_s:9.1f} ms   {other_s / own_s:6.1f} times"
    print(f"{what:<44} freestand {1e3 * own_s:8.1f} ms   {beside}", flush=True)


def spectrum(binary, folder):
    path, periods = folder / "one.AT2", np.geomspace(0.1, 5.0, 200)
    write_at2(path, record(0))
    grid = ", ".join(f"{t!r} s" for t in periods.tolist())
    command = ["motion", "spectrum", path, "--periods", grid, "--json", "--quiet"]
    own = freestand(binary, *command)
    own_s = median_s(lambda: freestand(binary, *command))
    try:
        from eqsig import sdof
    except ImportError:
        line(f"spectrum, {len(periods)} periods, {SAMPLES} samples", own_s, "", None)
        return
    accel = np.array("".join(path.read_text().splitlines(keepends=True)[4:]).split(), float) * 9.80665
    other = sdof.pseudo_response_spectra(accel, DT_S, periods, 0.05)
    worst = np.abs(np.array(own["psa_g"]) * 9.80665 / other[2] - 1).max()
    other_s = median_s(lambda: sdof.pseudo_response_spectra(accel, DT_S, periods, 0.05))
    line(f"spectrum, {len(periods)} periods, {SAMPLES} samples", own_s, "eqsig", other_s)
    print(f"    largest difference of the pseudo-acceleration: {worst:.1e}")


def reading(binary, folder, what, extension, write, name, other):
    paths = [folder / f"{i:03}.{extension}" for i in range(FILES)]
    for i, path in enumerate(paths):
        write(path, record(i))
    command = ["motion", "info", *paths, "--json", "--quiet"]
    try:
        found = freestand(binary, *command)["motions"]
    except RuntimeError as error:
        print(f"{what}: not read ({error})")
        return
    assert len(found) == FILES and all(one["npts"] == SAMPLES for one in found)
    own_s = median_s(lambda: freestand(binary, *command))
    other_s = median_s(lambda: [other(path) for path in paths]) if other else None
    example = ["cargo", "run", "-q", "--release", "-p", "freestand-benches", "--example", "read_files", "--", *paths]
    reading_s = float(subprocess.run(example, check=True, capture_output=True, text=True).stdout)
    line(f"{FILES} {what} files, reading only", reading_s, name, other_s)
    line(f"{FILES} {what} files with all measures", own_s, f"{name}, reading only,", other_s)


def at2_by_numpy(path):
    return np.array("".join(path.read_text().splitlines(keepends=True)[4:]).split(), float)


def knet_by_obspy():
    try:
        import obspy
    except ImportError:
        return None
    return lambda path: obspy.read(str(path), format="KNET", apply_calib=True)


def main():
    binary = sys.argv[1] if len(sys.argv) > 1 else "target/release/freestand"
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        spectrum(binary, folder)
        reading(binary, folder, "AT2", "AT2", write_at2, "NumPy", at2_by_numpy)
        reading(binary, folder, "K-NET", "NS", write_knet, "obspy", knet_by_obspy())


main()
