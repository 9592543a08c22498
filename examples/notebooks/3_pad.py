# %% [markdown]
# # A pad from drop tests
#
# The dynamic stiffness of the pads decides the shock, and only a test gives it. A steel plate of
# 365 g was dropped from 100 mm onto a pad; an accelerometer on the plate wrote the files (here:
# simulated tests with noise).

# %%
import freestand as fs
import numpy as np

pad = fs.drop_test([f"../../validation/cushion/drop-00{i}.csv" for i in (1, 2, 3)])
[test["quality"]["flags"] for test in pad.tests]        # → [[], [], []]
pad.stiffness_n_m / 1e3                                 # → 2192
pad.ci95_n_m[1] / 1e3                                   # → 2216
pad.pooled["exponent"]                                  # → 0.997

# %% [markdown]
# The exponent of 1 says that the pad is linear: its force is proportional to its compression.

# %%
pad.plot()

# %% [markdown]
# ## What the pad does under a cabinet
#
# Two pads under each edge share the landing. This is test 1 of Table I of the paper: 4 to 4.1 g
# were measured.

# %%
cabinet = fs.Block(height_m=2.3, thickness_m=0.6, mass_kg=140)
landing = cabinet.shock(cushion=pad, pads_per_edge=2, cg_rise_m=0.016)
landing.edge_acceleration_g                             # → 4.53

# %% [markdown]
# ## How soft must the pads be?
#
# If the contents withstand 3 g, the largest stiffness under an edge is, in N/mm:

# %%
required = cabinet.shock(cushion=pad, pads_per_edge=2, cg_rise_m=0.016, tolerance_g=3)
required.verdict                                        # → exceeded
required.max_stiffness_n_m / 1e3                        # → 1924

# %%
import matplotlib.pyplot as plt

stiffness_n_m = np.geomspace(0.2e6, 10e6, 40)
shocks = [cabinet.shock(stiffness_n_m=float(one), cg_rise_m=0.016).edge_acceleration_g for one in stiffness_n_m]
fig, ax = plt.subplots(figsize=(6, 3.5), layout="constrained")
ax.semilogx(stiffness_n_m / 1e3, shocks)
ax.axhline(3, linestyle=":", color="grey")
_ = ax.set(xlabel="stiffness under an edge [N/mm]", ylabel="shock [g]", title="rise of the centre of gravity: 16 mm")
