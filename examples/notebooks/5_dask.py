# %% [markdown]
# # An assessment on a Dask cluster
#
# `freestand.dask.assess` divides a list into shards, which the workers of a cluster calculate. The
# files are those of one process, byte for byte. Here the cluster is on this machine;
# [docs/dask.md](../../docs/dask.md) has SLURM and Kubernetes.

# %%
import tempfile
from pathlib import Path

import freestand as fs
import numpy as np
import pandas as pd
from dask.distributed import Client, LocalCluster
from freestand.dask import assess

folder = Path(tempfile.mkdtemp())
rng = np.random.default_rng(1)
city = pd.DataFrame({
    "id": [f"object-{i}" for i in range(24)],
    "level_ratio": rng.integers(0, 3, 24) / 2,
    "height [m]": rng.uniform(1, 2.2, 24).round(2),
    "thickness [m]": rng.uniform(0.25, 0.6, 24).round(2),
})
study = {
    "ground": {"count": 3}, "building": {"storeys": 3},
    "worlds": {"first": 4, "most": 8, "shares": False}, "assessment": {"compliant": False},
}

# %%
cluster = LocalCluster(n_workers=2, threads_per_worker=1, dashboard_address=None)
client = Client(cluster)
result = assess(study, city, out=folder / "out", shards=6, client=client)
len(result.objects)                                         # → 24
result.objects.to_pandas()[["id", "decision", "p_overturn", "worlds"]].head()

# %%
client.close()
cluster.close()
alone = fs.assess(study, city, out=folder / "alone", parquet=True)
files = ("objects.csv", "objects.parquet", "worlds.csv")
all((folder / "out" / one).read_bytes() == (folder / "alone" / one).read_bytes() for one in files)     # → True
