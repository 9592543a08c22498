"""What the Python peers share: the file that rk4.c reads, and the lines that it writes."""

import sys

import numpy as np

REST = 1e-6  # rad/s: at or below it, a landing ends in rest, as in rk4.c


def chosen(count, sample):
    """A random sample of the blocks, the same in every run, whose mean time represents that of all blocks."""
    return np.random.default_rng(1).choice(count, sample, replace=False)


def read():
    """Step, samples in g, and p², α, tan α and restitution of each block (of a sample of `sys.argv[2]`, or all)."""
    numbers = np.array(open(sys.argv[1]).read().split(), float)
    dt, g, n, count = numbers[0], numbers[1], int(numbers[2]), int(numbers[3])
    samples, sizes = numbers[4 : 4 + n] / g, numbers[4 + n :].reshape(count, 2)
    if len(sys.argv) > 2:
        sizes = sizes[chosen(count, int(sys.argv[2]))]
    height, thickness = sizes.T
    alpha = np.arctan2(thickness, height)
    p2 = 0.75 * g / (0.5 * np.hypot(height, thickness))
    restitution = np.maximum(1 - 1.5 * np.sin(alpha) ** 2, 0)
    return dt, samples, p2, alpha, thickness / height, restitution


def write(seconds, peaks):
    print(f"{seconds:.9f}")
    for peak in peaks:
        print(f"{peak:.17g}")
