# %% [markdown]
# # A hospital: which objects must be restrained?
#
# The list of [the hospital](../hospital) is used as it came from the ward. To finish in seconds, the
# notebook calculates at most 160 worlds, on a rigid base only. The verdicts of the full study are on
# the page of the example.

# %%
from pathlib import Path

import freestand as fs

hospital = Path("../hospital")
study = (hospital / "study.toml").read_text() + "\ncompliant = false\n[worlds]\nmost = 160\nshares = false\n"
understood = fs.check_inventory(hospital / "inventory.csv", study=study)
len(understood.objects)                 # → 28
understood.counts

# %%
result = fs.assess(study, hospital / "inventory.csv")
objects = result.objects.to_pandas()
(objects["decision"] == "restrain").sum()       # → 14
objects["decision"].value_counts()

# %% [markdown]
# ## The most urgent objects

# %%
objects.sort_values("rank")[["rank", "item", "floor", "decision", "p_overturn", "worlds"]].head(6)

# %%
cylinders = objects[objects["item"].str.contains("oxygen", case=False)].iloc[0]
cylinders["decision"]                   # → restrain
cylinders["p_overturn"]                 # → 1.0

# %% [markdown]
# The reason of each verdict is a sentence. Objects whose interval still contains the accepted
# probability after 160 worlds are too close to call: they count as *restrain*, and their reason
# says so.

# %%
print(cylinders["why"])
objects["close_call"].sum()             # → 4

# %%
import matplotlib.pyplot as plt

few = objects.dropna(subset=["p_overturn"]).sort_values("p_overturn")
fig, ax = plt.subplots(figsize=(7, 6), layout="constrained")
low, high = few["p_overturn"] - few["p_overturn_low"], few["p_overturn_high"] - few["p_overturn"]
ax.errorbar(few["p_overturn"], few["item"].str.slice(0, 34) + " " + few["id"].astype(str), xerr=[low, high], fmt="o")
_ = ax.set(xlabel="probability of overturning, with its 98 % interval", xlim=(0, 1))
