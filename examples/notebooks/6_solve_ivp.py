# %% [markdown]
# # A rocking block compared with SciPy's `solve_ivp`
#
# The equation of a rocking block is short, so SciPy can solve it as a check. With the
# rotation θ, the slenderness angle α, the frequency parameter p and the acceleration a of the
# floor,
#
# θ″ = −p² [ sin(± α − θ) + (a/g) cos(± α − θ) ],
#
# with + while θ > 0. At each impact the other edge takes over, and the angular velocity is
# multiplied by Housner's ratio.

# %%
import time

import freestand as fs
import numpy as np
from scipy.integrate import solve_ivp

g = 9.80665
motion = fs.read_motion("../../validation/rocking/records/onesine_T1.0.csv", scale=3)
block = fs.Block(height_m=2.0, thickness_m=0.5)
alpha, p, ratio = block.slenderness_angle_rad, block.frequency_rad_s, block.restitution_ratio


def rocked(until_s):
    """Times of impacts, and the largest rotation."""
    floor = lambda t: np.interp(t, motion.time_s, motion.accel_m_s2)
    lifted = np.argmax(np.abs(motion.accel_m_s2) > g * np.tan(alpha))
    # A floor that accelerates to the right rotates the block to the left.
    side, state, begin = -np.sign(motion.accel_m_s2[lifted]), [0.0, 0.0], _crossing(lifted)
    times, largest = [], 0.0
    while True:
        def slope(t, y, side=side):
            tilt = side * alpha - y[0]
            return [y[1], -(p**2) * (np.sin(tilt) + floor(t) / g * np.cos(tilt))]

        def impact(t, y):
            return y[0]

        impact.terminal, impact.direction = True, -side
        found = solve_ivp(
            slope, (begin, until_s), state, events=impact, method="DOP853", rtol=1e-11, atol=1e-13, max_step=motion.dt_s
        )
        largest = max(largest, np.abs(found.y[0]).max())
        if found.status != 1:
            return np.array(times), largest
        begin, side, state = found.t[-1], -side, [0.0, ratio * found.y[1, -1]]
        times.append(begin)


def _crossing(index):
    """When the motion, linear between its samples, reaches the acceleration that lifts an edge."""
    before, after = np.abs(motion.accel_m_s2[index - 1 : index + 1])
    return motion.time_s[index - 1] + motion.dt_s * (g * np.tan(alpha) - before) / (after - before)


# %% [markdown]
# The events of `solve_ivp` are found on its interpolant, so the method needs one of high order:
# with RK45 the times of impacts differ by 4e-7 s. `largest` is the largest rotation at the steps,
# which are at most 5 ms long.

# %%
begun = time.perf_counter()
times, largest = rocked(until_s=2.5)
scipy_s = time.perf_counter() - begun
print(len(times), largest)                                          # → 3 0.1029

# %%
begun = time.perf_counter()
result = block.rock(motion, accuracy="tight", history=True)
freestand_s = time.perf_counter() - begun
result.outcome                                                      # → rocked
ours = result.impacts["time_s"][: len(times)]
bool(np.abs(ours - times).max() < 1e-7)                             # → True
bool(abs(result.peak_rotation_rad / largest - 1) < 1e-4)            # → True
print(f"largest difference of the times of impacts: {np.abs(ours - times).max():.1e} s")
print(f"solve_ivp takes {scipy_s / freestand_s:.0f} times as long")

# %%
result.plot()
