"""The packages of the extra `study`, imported when they are first used.

So the package and its types are complete without them, and what is missing is said in one way.
"""

from __future__ import annotations

from importlib import import_module
from typing import Any


class _Module:
    def __init__(self, name: str) -> None:
        self._name = name

    def __getattr__(self, attribute: str) -> Any:
        try:
            module = import_module(self._name)
        except ImportError as error:
            raise ImportError(
                f"the analysis of a study needs {self._name.partition('.')[0]}: {error}\n"
                "  help: pip install asperity[study]"
            ) from error
        return getattr(module, attribute)


Frame = Any  # a pandas DataFrame
pandas: Any = _Module("pandas")
stats: Any = _Module("scipy.stats")
matplotlib: Any = _Module("matplotlib")
figure: Any = _Module("matplotlib.figure")
