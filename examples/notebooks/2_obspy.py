# %% [markdown]
# # From an ObsPy record to a shock
#
# ObsPy reads the records of seismological networks, removes the response of the instrument and
# filters. It returns an acceleration against time, which freestand reads directly. This notebook
# first writes a miniSEED file, so that it needs no network. Read your own record with `obspy.read`,
# or load it with ObsPy's FDSN client.

# %%
import tempfile
from pathlib import Path

import freestand as fs
import numpy as np
import obspy

folder = tempfile.TemporaryDirectory()
record = Path(folder.name) / "roof.mseed"
accel = 3.5 * np.loadtxt("../../validation/rocking/records/synthfloor.csv")       # m/s²
header = {"network": "XX", "station": "ROOF", "channel": "HNE", "delta": 0.005}
obspy.Stream([obspy.Trace(accel, header)]).write(record, format="MSEED")

# %%
trace = obspy.read(record)[0]
trace.detrend("demean")
motion = fs.Motion.from_obspy(trace, unit="m/s2")    # a trace does not state its unit
motion.name         # → XX.ROOF..HNE
motion.dt_s         # → 0.005
motion.pga_g        # → 0.357

# %% [markdown]
# ## The object
#
# A cabinet on rubber pads rocks. The shock of the hardest landing follows from the largest uplift.

# %%
cabinet = fs.Block(height_m=2.4, thickness_m=0.5, mass_kg=150, stiffness_n_m=4.38e6)
result = cabinet.rock(motion, history=True)
result.outcome                      # → rocked
1e3 * result.uplift_m               # → 91.8
result.edge_acceleration_g          # → 4.42

# %%
result.plot()

# %% [markdown]
# ## What the contents of the cabinet withstand
#
# With a tolerance, the shock becomes a verdict, and the landing a pulse with a duration.

# %%
landing = cabinet.shock(uplift_m=result.uplift_m, tolerance_g=10, tolerance_duration_s=0.011)
landing.verdict                     # → ok
landing.demand_capacity_ratio       # → 0.728
1e3 * landing.pulse_duration_s      # → 18.1
