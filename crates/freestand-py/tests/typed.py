"""What a user writes, for the type checker: `mypy --strict` reads it, nothing runs it."""

import freestand as fs
import numpy as np
import numpy.typing as npt
from freestand.dask import assess

motion: fs.Motion = fs.read_motion("record.AT2", unit="g")
cabinet = fs.Block(height_m=1.8, thickness_m=0.4, mass_kg=150, stiffness_n_m=4.38e6)
result: fs.RockResult = fs.rock(cabinet, motion, walls=fs.Walls(left_m=0.02), history=True)
largest: float = result.peak_rotation_rad
shock: float | None = result.edge_acceleration_g
if result.history is not None:
    rotation: npt.NDArray[np.float64] = result.history["theta_rad"]

table: fs.Table = fs.spectrum([motion], np.linspace(0.3, 3, 64), [0.2, 0.4], mass_kg=150, stiffness_n_m=4.38e6)
pad: fs.DropTestResult = fs.drop_test(["a.csv", "b.csv"], mass_kg=0.365, height_m=0.1)
landing: float = fs.shock(cabinet, cushion=pad, pads_per_edge=2, cg_rise_m=0.016).edge_acceleration_g
answer: str = fs.check_object(2, 0.3, place="Melbourne").answer
spectrum: npt.NDArray[np.float64] = fs.code_spectrum(site="Ce", hazard_factor=0.11).sa_g
objects: fs.Table = fs.assess("hospital.toml", inventory="list.xlsx", progress=lambda stage, done, total: None).objects
on_a_cluster: fs.AssessResult = assess("city.toml", inventory="city.csv", out="/shared/out", shards=2000)
