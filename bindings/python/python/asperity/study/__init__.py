"""Analysis of a haptic user study: what `asperity study` recorded becomes one page of results.

``python -m asperity.study check DIR`` checks the dataset, with Python alone;
``python -m asperity.study report DIR`` writes the report, with pandas, SciPy and Matplotlib:
``pip install asperity[study]``. From Python, ``study.load(DIR)`` gives a `Study` of DataFrames,
whose ratings `study.midpoints`, `study.agreement`, `study.forms` and `study.exploration` take.
"""

from . import agreement, exploration, forms, midpoints
from .check import Finding, check
from .load import Study, StudyError, load
from .report import report, write_report
from .statistics import Estimate, Options

__all__ = [
    "Estimate", "Finding", "Options", "Study", "StudyError", "agreement", "check", "exploration",
    "forms", "load", "midpoints", "report", "write_report",
]
