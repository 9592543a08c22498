"""Quarter-wavelength amplification of the rock under Melbourne as a sum over a million layers.

A recipe of its own: no closed form of a travel time, no rule of integration. Standard library only.
"""

import math
from bisect import bisect_left

LAYERS = 1_000_000
SOURCE_DENSITY, SOURCE_VELOCITY = 2800.0, 3500.0
# Tang (2019): from depth, reference depth, velocity there, power.
MIDDLE = math.log(3.32 / 1.07) / math.log(4.0 / 0.05)
PIECES = [(0.0, 30.0, 940.0, 0.3297), (50.0, 4000.0, 3320.0, MIDDLE), (4000.0, 8000.0, 3520.0, 0.0833)]


def velocity(z):
    reference, v, power = next(piece[1:] for piece in reversed(PIECES) if z >= piece[0])
    return v * (z / reference) ** power


def density(v):
    """Boore (2016): Brocher's Vp, Gardner's density; kg/m3."""
    b = v / 1000.0
    vp = 0.9409 + 2.0947 * b - 0.8206 * b**2 + 0.2683 * b**3 - 0.0251 * b**4
    if b < 0.3:
        return 1000.0 * (1.0 + 1.53 * b**0.85 / (0.35 + 1.889 * b**1.7))
    if b < 3.55:
        return 1000.0 * 1.74 * vp**0.25
    return 1000.0 * (1.6612 * vp - 0.4721 * vp**2 + 0.0671 * vp**3 - 0.0043 * vp**4 + 0.000106 * vp**5)


def main():
    lowest, highest = math.log(1e-11), math.log(60e3)
    edges = [math.exp(lowest + (highest - lowest) * i / LAYERS) for i in range(LAYERS + 1)]
    edges = sorted(set(edges) | {50.0, 4000.0})
    times, masses = [0.0], [0.0]
    for top, bottom in zip(edges, edges[1:]):
        v = velocity(math.sqrt(top * bottom))
        times.append(times[-1] + (bottom - top) / v)
        masses.append(masses[-1] + (bottom - top) * density(v))
    for frequency in [0.1, 0.2, 0.5, 1.0, 2.0, 5.0, 10.0, 20.0, 50.0]:
        time = 0.25 / frequency
        i = bisect_left(times, time)
        share = (time - times[i - 1]) / (times[i] - times[i - 1])
        depth = edges[i - 1] + share * (edges[i] - edges[i - 1])
        mass = masses[i - 1] + share * (masses[i] - masses[i - 1])
        ratio = math.sqrt(SOURCE_DENSITY * SOURCE_VELOCITY / (mass / depth * depth / time))
        print(f"{frequency:5.1f} Hz {ratio:.5f}")


if __name__ == "__main__":
    main()
