"""What the Python peers share: the file that rk4.c reads, and the lines that it writes."""

import sys

import numpy as np

REST = 1e-6  # rad/s: at or below it a landing ends in rest, as in rk4.c


def read():
    """Step, samples in g, and p², α, tan α and restitution of each block; of the first `sys.argv[2]` spread over all."""
    numbers = np.array(open(sys.argv[1]).read().split(), float)
    dt, g, n, count = numbers[0], numbers[1], int(numbers[2]), int(numbers[3])
    samples, sizes = numbers[4 : 4 + n] / g, numbers[4 + n :].reshape(count, 2)
    if len(sys.argv) > 2:
        sizes = sizes[np.linspace(0, count - 1, int(sys.argv[2])).astype(int)]
    height, thickness = sizes.T
    alpha = np.arctan2(thickness, height)
    p2 = 0.75 * g / (0.5 * np.hypot(height, thickness))
    restitution = np.maximum(1 - 1.5 * np.sin(alpha) ** 2, 0)
    return dt, samples, p2, alpha, thickness / height, restitution


def write(seconds, peaks):
    print(f"{seconds:.9f}")
    for peak in peaks:
        print(f"{peak:.17g}")
