"""How hard an earthquake knocks a free-standing object, and whether it falls over.

    import freestand as fs
    cabinet = fs.Block(height_m=1.8, thickness_m=0.4, mass_kg=150, stiffness_n_m=4.38e6)
    result = cabinet.rock(fs.read_motion("record.AT2"))

All arguments and results are in SI units, and every name ends in its unit.
"""

from typing import TYPE_CHECKING

from ._block import Block, Cushion, Sliding, Walls
from ._body import Body, BodyResult
from ._errors import BadValue, FreestandError, FreestandWarning, Interrupted, Problem, ReadError, SolveError, StudyError
from ._freestand import study_toml
from ._ground import code_spectrum, floor, synth
from ._ida import ida
from ._laboratory import drop_test, shock_spectrum, static_test
from ._motion import Motion, read_motion, read_motions
from ._requests import (
    assess,
    check_inventory,
    check_object,
    fragility,
    restrain,
    restrain_list,
    risk,
    run,
    validate,
)
from ._results import (
    AssessResult,
    CodeSpectrumResult,
    DropTestResult,
    FloorResult,
    FragilityResult,
    IdaResult,
    InventoryCheck,
    MotionSpectrumResult,
    ObjectResult,
    RestrainListResult,
    RestrainResult,
    RiskResult,
    RockResult,
    RunResult,
    ShockResult,
    ShockSpectrumResult,
    StaticTestResult,
    SynthResult,
    ValidateResult,
    version,
)
from ._rocking import rock, shock, spectrum
from ._table import Table

if TYPE_CHECKING:
    from . import plot as plot
else:

    def __getattr__(name: str) -> object:
        """Imports `freestand.plot` when it is first used."""
        if name == "plot":
            import importlib

            return importlib.import_module(".plot", __name__)
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")


__version__ = version()

__all__ = [
    "AssessResult",
    "BadValue",
    "Block",
    "Body",
    "BodyResult",
    "CodeSpectrumResult",
    "Cushion",
    "DropTestResult",
    "FloorResult",
    "FragilityResult",
    "FreestandError",
    "FreestandWarning",
    "IdaResult",
    "Interrupted",
    "InventoryCheck",
    "Motion",
    "MotionSpectrumResult",
    "ObjectResult",
    "Problem",
    "ReadError",
    "RestrainListResult",
    "RestrainResult",
    "RiskResult",
    "RockResult",
    "RunResult",
    "ShockResult",
    "ShockSpectrumResult",
    "Sliding",
    "SolveError",
    "StaticTestResult",
    "StudyError",
    "SynthResult",
    "Table",
    "ValidateResult",
    "Walls",
    "assess",
    "check_inventory",
    "check_object",
    "code_spectrum",
    "drop_test",
    "floor",
    "fragility",
    "ida",
    "read_motion",
    "read_motions",
    "restrain",
    "restrain_list",
    "risk",
    "rock",
    "run",
    "shock",
    "shock_spectrum",
    "spectrum",
    "static_test",
    "study_toml",
    "synth",
    "validate",
]
