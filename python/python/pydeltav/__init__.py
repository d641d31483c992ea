"""Reconstructs a two-vehicle collision from its damage.

The engine of the program ``deltav``, with the same bits: CRASH3 turns the damage of both vehicles into an energy, and
planar impact mechanics finds the speed at which the impact dissipates exactly that energy.

>>> import pydeltav
>>> case = pydeltav.Case.example()
>>> result = case.reconstruct()
>>> f"{result.found.value * 3.6:.1f} km/h"
'82.3 km/h'
>>> case.impact()
Traceback (most recent call last):
    ...
pydeltav.CaseError: error: `vehicle1.speed` is missing: `impact()` needs it
...
"""

from pydeltav._pydeltav import (
    Analysis,
    Avoidance,
    Case,
    Columns,
    Comparison,
    Drawing,
    Estimate,
    Judgement,
    Result,
    Rows,
    RowStream,
    Schema,
    Sensitivity,
    Uncertainty,
    __version__,
    case_schema,
    crush_table,
    estimate_table,
    impact_table,
    reconstruct_table,
    result_schema,
    stream_table,
)
from pydeltav._errors import CaseError, NoAnswerError, Problem
from pydeltav._record import Record
from pydeltav import ciss as ciss  # isort: skip
from pydeltav import results as results  # isort: skip

__all__ = [
    "Analysis",
    "Avoidance",
    "Case",
    "CaseError",
    "Columns",
    "Comparison",
    "Drawing",
    "Estimate",
    "Judgement",
    "NoAnswerError",
    "Problem",
    "Record",
    "Result",
    "RowStream",
    "Rows",
    "Schema",
    "Sensitivity",
    "Uncertainty",
    "__version__",
    "case_schema",
    "crush_table",
    "estimate_table",
    "impact_table",
    "reconstruct_table",
    "result_schema",
    "stream_table",
]
