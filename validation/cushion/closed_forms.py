"""Peak, compression, duration and restitution of 0.365 kg from 100 mm on the pads of `freestand validate`, to 80 digits.

    pip install mpmath && python closed_forms.py

The integrals leave the last 1e-16 of their interval out, where the integrand is finite.
"""

from mpmath import atan2, diff, exp, findroot, gamma, log, mp, mpf, nstr, pi, quad, sqrt, cos

mp.dps = 80
G, M, H = mpf("9.80665"), mpf("0.365"), mpf("0.1")
V = sqrt(2 * G * H)


def show(name, peak_n, depth_m, time_s, e):
    print(f"{name:28} {nstr(peak_n / M / G, 12)} g  {nstr(1000 * depth_m, 12)} mm  {nstr(1000 * time_s, 12)} ms  {nstr(e, 12)}")


k = mpf("2.19e6")
w = sqrt(k / M)
show("linear", M * V * w, V / w, pi / w, 1)

K, n = mpf("2e7"), mpf("1.5")
d = ((n + 1) * M * V**2 / (2 * K)) ** (1 / (n + 1))
show("Hertz", K * d**n, d, 2 * sqrt(pi) * gamma(1 + 1 / (n + 1)) / gamma(mpf(1) / 2 + 1 / (n + 1)) * d / V, 1)

z = mpf("0.1")
s = sqrt(1 - z * z)
top = atan2(s * (1 - 4 * z * z), z * (3 - 4 * z * z)) / s
end = atan2(2 * z * s, 2 * z * z - 1) / s
show("Kelvin-Voigt, 0.1", M * V * w * exp(-z * top), V / w * exp(-z / s * atan2(s, z)), end / w, exp(-z * end))

L = mpf("0.3")
c = L * V
e = findroot(lambda e: c * (1 + e) - log((1 + c) / (1 - c * e)), mpf("0.8"))
scale = (n + 1) * M * V / (K * L)
force = lambda u: K * (scale * ((1 - u) - log((1 + c) / (1 + c * u)) / c)) ** (n / (n + 1)) * (1 + c * u)
peak = force(findroot(lambda u: diff(force, u), mpf("0.3")))
inwards = quad(lambda x: M * V * (n + 1) * x**n / force(1 - x ** (n + 1)), [mpf("1e-20"), mpf("1e-8"), 0.5, 1])
outwards = quad(lambda x: M * V * e * (n + 1) * x**n / force(e * x ** (n + 1) - e), [mpf("1e-18"), mpf("1e-6"), 0.5, 1])
show("Hunt-Crossley, 0.3 s/m", peak, (scale * (1 - log(1 + c) / c)) ** (1 / (n + 1)), inwards + outwards, e)

k0, db = mpf("1e6"), mpf("1e-3")
energy = M * G * H
peak = 2 * k0 * db / pi * sqrt(exp(pi**2 * energy / (2 * k0 * db**2)) - 1)
work = lambda d: -(2 * k0 * db / pi) * (2 * db / pi) * log(cos(pi * d / 2 / db))
d = findroot(lambda d: work(d) - energy, (mpf("0.5e-3"), mpf("0.9e-3")), solver="anderson")
fall = lambda x: 2 * d * x / sqrt(2 * (energy - work(d * (1 - x * x))) / M)
show("tangent, 1 mm", peak, d, 2 * quad(fall, [mpf("1e-16"), mpf("1e-6"), 0.1, 0.5, 1]), 1)
