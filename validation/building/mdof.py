"""Peak floor accelerations of a ten-storey shear building under the 1940 El Centro record, without the program.

    python3 mdof.py elCentro.AT2

The matrices M, C, K are integrated in time (fourth-order Runge-Kutta, 20 steps in each sample interval, the record linear
between its samples); modal superposition is not used, except where modes are deliberately left out. Plain Python; takes a minute.
"""

import math
import sys

N, PERIOD_S, ZETA, TAIL_S, SUBSTEPS = 10, 1.0, 0.05, 20.0, 20


def record(path):
    """Samples in g of an AT2 file, with the tail of zeros."""
    lines = open(path).read().splitlines()
    dt = 0.02
    values = [float(word) for line in lines[4:] for word in line.split()]
    return dt, values + [0.0] * round(TAIL_S / dt)


# Equal storeys of unit mass; closed forms give the stiffness for the period, the modes and their participation.
ANGLES = [(2 * i + 1) * math.pi / (2 * N + 1) for i in range(N)]
STIFFNESS = (math.pi / PERIOD_S / math.sin(ANGLES[0] / 2)) ** 2
OMEGA = [2 * math.sqrt(STIFFNESS) * math.sin(angle / 2) for angle in ANGLES]
MODES = [[math.sin(angle * (j + 1)) for j in range(N)] for angle in ANGLES]
NORM = [sum(x * x for x in mode) for mode in MODES]
GAMMA = [sum(mode) / norm for mode, norm in zip(MODES, NORM)]


def stiffness_matrix():
    k = [[0.0] * N for _ in range(N)]
    for j in range(N):
        k[j][j] = STIFFNESS * (2.0 if j + 1 < N else 1.0)
        if j + 1 < N:
            k[j][j + 1] = k[j + 1][j] = -STIFFNESS
    return k


def rayleigh_damping(first, second):
    a1 = 2 * ZETA / (OMEGA[first] + OMEGA[second])
    a0 = a1 * OMEGA[first] * OMEGA[second]
    k = stiffness_matrix()
    return [[a1 * k[i][j] + (a0 if i == j else 0.0) for j in range(N)] for i in range(N)]


def modal_damping():
    """C = sum of 2 zeta omega phi phi' / (phi' phi): the same ratio in every mode."""
    c = [[0.0] * N for _ in range(N)]
    for omega, mode, norm in zip(OMEGA, MODES, NORM):
        for i in range(N):
            for j in range(N):
                c[i][j] += 2 * ZETA * omega * mode[i] * mode[j] / norm
    return c


def absolute_histories(k, c, dt, ground):
    """-(C v + K u) of every degree of freedom at every sample."""
    n = len(k)
    rows = [(list(k[i]), list(c[i])) for i in range(n)]

    def absolute(u, v):
        return [-sum(a * x for a, x in zip(ki, u)) - sum(a * x for a, x in zip(ci, v)) for ki, ci in rows]

    u, v, h = [0.0] * n, [0.0] * n, dt / SUBSTEPS
    histories = [[a] for a in absolute(u, v)]
    for a0, a1 in zip(ground, ground[1:]):
        for step in range(SUBSTEPS):
            g0 = a0 + (a1 - a0) * step / SUBSTEPS
            g1 = a0 + (a1 - a0) * (step + 0.5) / SUBSTEPS
            g2 = a0 + (a1 - a0) * (step + 1) / SUBSTEPS
            k1v = [a - g0 for a in absolute(u, v)]
            k2u = [y + 0.5 * h * d for y, d in zip(v, k1v)]
            k2v = [a - g1 for a in absolute([y + 0.5 * h * d for y, d in zip(u, v)], k2u)]
            k3u = [y + 0.5 * h * d for y, d in zip(v, k2v)]
            k3v = [a - g1 for a in absolute([y + 0.5 * h * d for y, d in zip(u, k2u)], k3u)]
            k4u = [y + h * d for y, d in zip(v, k3v)]
            k4v = [a - g2 for a in absolute([y + h * d for y, d in zip(u, k3u)], k4u)]
            u = [y + h / 6 * (a + 2 * b + 2 * c_ + d) for y, a, b, c_, d in zip(u, v, k2u, k3u, k4u)]
            v = [y + h / 6 * (a + 2 * b + 2 * c_ + d) for y, a, b, c_, d in zip(v, k1v, k2v, k3v, k4v)]
        for history, a in zip(histories, absolute(u, v)):
            history.append(a)
    return histories


def peak(history):
    return max(abs(a) for a in history)


def report(name, floors):
    """Floors 1, 5 and 10, and half-way between floors 5 and 6."""
    between = [(a + b) / 2 for a, b in zip(floors[4], floors[5])]
    values = [peak(floors[0]), peak(floors[4]), peak(between), peak(floors[9])]
    print(f"{name}: " + ", ".join(f"{value:.6f}" for value in values))


dt, ground = record(sys.argv[1])
k = stiffness_matrix()
report("modal 5 %, all modes", absolute_histories(k, modal_damping(), dt, ground))
report("Rayleigh 5 % at modes 1 and 3", absolute_histories(k, rayleigh_damping(0, 2), dt, ground))
oscillators = [absolute_histories([[w * w]], [[2 * ZETA * w]], dt, ground)[0] for w in OMEGA[:3]]
for name, keep in (("modal 5 %, 3 modes and the residual", 1.0), ("modal 5 %, 3 modes alone", 0.0)):
    floors = []
    for j in range(N):
        shares = [GAMMA[i] * MODES[i][j] for i in range(3)]
        residual = keep * (1 - sum(shares))
        floors.append([residual * g + sum(s * a for s, a in zip(shares, now)) for g, now in zip(ground, zip(*oscillators))])
    report(name, floors)
