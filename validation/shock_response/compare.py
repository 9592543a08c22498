"""Compares spectra of the program with those of pyyeti and endaq; exits with 1 if they differ by more than the tolerance.

    python validation/shock_response/compare.py target/release/freestand
"""

import json
import subprocess
import sys
import tempfile
import warnings
from pathlib import Path

import numpy as np

warnings.filterwarnings("ignore")
RATE = 20e3
FREQUENCIES = "5 Hz:2 kHz:6/oct"
DAMPING = 0.05


def records():
    """A half-sine, a ringing shock and noise: seconds at RATE, m/s²."""
    t = np.arange(8000) / RATE
    pulse = np.where((t >= 0.05) & (t <= 0.061), np.sin(np.pi * (t - 0.05) / 0.011), 0.0)
    since = np.clip(t - 0.05, 0, None)
    ring = sum(a * np.exp(-since / d) * np.sin(2 * np.pi * f * since) for a, f, d in [(9, 60, 0.05), (20, 700, 0.01)])
    noise = np.random.default_rng(7).normal(size=len(t)) * np.hanning(len(t))
    return {"half-sine": 100 * pulse, "ringing": 10 * ring, "noise": 30 * noise}


def own(binary, path, *flags):
    command = [binary, "shock-spectrum", path, "--frequencies", FREQUENCIES, "--damping", str(DAMPING), "--json", "-q", *flags]
    done = subprocess.run(list(map(str, command)), capture_output=True, text=True)
    if done.returncode:
        sys.exit(done.stderr)
    spectrum = json.loads(done.stdout)["spectra"][0]
    return np.array(spectrum["frequencies_hz"]), np.array(spectrum["values"])


def main():
    from endaq.calc.shock import shock_spectrum
    from pyyeti.srs import srs
    from scipy.signal import resample
    import pandas as pd

    binary, failed = sys.argv[1], False

    def hold(what, ours, theirs, tolerance):
        nonlocal failed
        worst = float(np.max(np.abs(ours / theirs - 1)))
        verdict = "ok" if worst <= tolerance else "FAILED"
        failed |= not worst <= tolerance  # NaN is no agreement.
        print(f"{verdict:6} {worst:.1e} of {tolerance:.0e}  {what}")

    with tempfile.TemporaryDirectory() as folder:
        for name, a in records().items():
            path = Path(folder) / f"{name}.csv"
            lines = (f"{k / RATE!r},{value!r}" for k, value in enumerate(a.tolist()))
            path.write_text("\n".join(["time [s],acceleration [m/s2]", *lines]) + "\n")
            q = 0.5 / DAMPING
            kinds = [("absolute-acceleration", "absacce"), ("relative-displacement", "reldisp"), ("pseudo-velocity", "pvelo")]
            for kind, stype in kinds:
                f, ours = own(binary, path, "--kind", kind, "--peak", "primary", "--no-upsample")
                theirs = srs(a, RATE, f, q, stype=stype, rolloff="none", parallel="no")
                hold(f"{name}, {kind}, primary, as sampled: pyyeti", ours, theirs, 1e-6)
            for peak, word in [("positive", "pos"), ("negative", "neg")]:
                f, ours = own(binary, path, "--peak", peak, "--no-upsample")
                theirs = srs(a, RATE, f, q, peak=word, rolloff="none", parallel="no", time="total")
                hold(f"{name}, {peak}, as sampled: pyyeti", ours, np.abs(theirs), 2e-3)
            f, ours = own(binary, path, "--peak", "primary")
            theirs = srs(resample(a, 32 * len(a)), 32 * RATE, f, q, rolloff="none", parallel="no")
            hold(f"{name}, primary, upsampled: scipy's FFT and pyyeti", ours, theirs, 1e-3)
            if name != "noise":
                theirs = srs(a, RATE, f, q, ppc=128, rolloff="lanczos", parallel="no")
                hold(f"{name}, primary, upsampled: pyyeti, Lanczos", ours, theirs, 2e-3)
            frame = pd.DataFrame({"a": a}, index=pd.Index(np.arange(len(a)) / RATE, name="time"))
            for kind, mode in [("absolute-acceleration", "srs"), ("pseudo-velocity", "pvss")]:
                f, ours = own(binary, path, "--kind", kind, "--no-upsample")
                theirs = shock_spectrum(frame, freqs=f, damp=DAMPING, mode=mode, max_time=None)["a"].to_numpy()
                hold(f"{name}, {kind}, maximax, as sampled: endaq", ours, theirs, 2e-3)
    sys.exit(failed)


main()
