"""Threads, the interpreter's lock, Ctrl-C and fork."""

import multiprocessing
import os
import signal
import subprocess
import sys
import threading
import time
from concurrent.futures import ThreadPoolExecutor

import freestand as fs
import numpy as np
import pytest

LONG = fs.Motion(4 * np.sin(np.arange(12_000) * 0.03), 0.005)
SIZES = np.linspace(0.5, 3, 150), np.linspace(0.1, 1, 150)


def test_the_lock_is_released():
    """A thread of Python goes on while a spectrum is calculated."""
    ticks, ended = [], threading.Event()

    def tick():
        while not ended.is_set():
            ticks.append(time.perf_counter())
            time.sleep(0.001)

    thread = threading.Thread(target=tick)
    thread.start()
    begun = time.perf_counter()
    fs.spectrum(LONG, *SIZES, threads=1)
    took = time.perf_counter() - begun
    ended.set()
    thread.join()
    during = [one for one in ticks if begun < one < begun + took]
    # Were the lock held, there would be none; a busy machine gives fewer than one a millisecond.
    assert len(during) > 5, f"{len(during)} ticks in {took:.3f} s"


def test_calls_from_many_threads_are_the_same(cabinet, floor_motion):
    expected = cabinet.rock(floor_motion).to_dict()
    with ThreadPoolExecutor(8) as pool:
        for found in pool.map(lambda _: cabinet.rock(floor_motion).to_dict(), range(40)):
            assert found == expected


#: Says so when the process has worked for 0.3 s, in all of its threads.
TELL = """
import sys, threading, time

def tell():
    begun = time.process_time()
    while time.process_time() < begun + 0.3:
        time.sleep(0.01)
    print("works", flush=True)

threading.Thread(target=tell, daemon=True).start()
"""

#: An interrupted call raises `Interrupted`, and the script then ends with a status of its own.
INTERRUPTED = """
except KeyboardInterrupt as error:
    assert isinstance(error, fs.Interrupted), type(error)
    print("interrupted", flush=True)
    sys.exit(3)
"""

SPECTRUM = """
import freestand as fs, numpy as np
motion = fs.Motion(4 * np.sin(np.arange(20_000) * 0.03), 0.005)
heights, thicknesses = np.linspace(0.5, 3, 1000), np.linspace(0.1, 1, 1000)
motions = [fs.Motion(motion.accel_m_s2, 0.005, str(i)) for i in range(50)]
try:
    fs.spectrum(motions, heights, thicknesses)
"""

ROCK = """
import freestand as fs, numpy as np
motion = fs.Motion(1.5 * np.sin(np.arange(3_000_000) * 0.03), 0.005)
block = fs.Block(0.6, 0.3, mass_kg=10, stiffness_n_m=1e5)
try:
    while True:
        try:
            block.rock(motion)
        except fs.Interrupted:
            raise
        except KeyboardInterrupt:
            print("between", flush=True)
"""


@pytest.mark.skipif(sys.platform == "win32", reason="signals of Unix")
@pytest.mark.parametrize("script", [SPECTRUM, ROCK], ids=["spectrum", "one long history"])
def test_ctrl_c_stops(script):
    before, work = script.split("try:", 1)
    command = [sys.executable, "-W", "ignore", "-c", f"{before}{TELL}try:{work}{INTERRUPTED.lstrip()}"]
    child = subprocess.Popen(command, stdout=subprocess.PIPE, text=True)
    assert child.stdout.readline() == "works\n"
    # A chunk of the spectrum takes 50 ms on an idle machine, and all of it minutes; the histories
    # never end. A signal between two histories interrupts Python's own code, and is sent again.
    for _ in range(10):
        child.send_signal(signal.SIGINT)
        line = child.stdout.readline()
        if line != "between\n":
            break
    output, _ = child.communicate(timeout=60)
    assert (child.returncode, line + output) == (3, "interrupted\n")


def _in_child(queue, expected):
    queue.put(list(fs.spectrum(LONG, [1.0, 2.0], [0.2, 0.3], threads=2).rows()) == expected)


@pytest.mark.skipif(not hasattr(os, "fork"), reason="systems without fork")
@pytest.mark.filterwarnings("ignore::DeprecationWarning")
def test_a_child_made_by_fork_has_threads_of_its_own():
    expected = list(fs.spectrum(LONG, [1.0, 2.0], [0.2, 0.3], threads=2).rows())
    context = multiprocessing.get_context("fork")
    queue = context.Queue()
    child = context.Process(target=_in_child, args=(queue, expected))
    child.start()
    assert queue.get(timeout=60) is True
    child.join(10)
    assert child.exitcode == 0


def test_blocks_and_motions_go_to_other_processes(cabinet, floor_motion):
    with multiprocessing.get_context("spawn").Pool(1) as pool:
        found = pool.apply(fs.rock, (cabinet, floor_motion))
    assert found.to_dict() == cabinet.rock(floor_motion).to_dict()
