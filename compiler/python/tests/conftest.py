"""What several tests need."""

from __future__ import annotations

import os
import subprocess
from pathlib import Path
from typing import Callable

import numpy as np
import pytest

import asperity

PROMPT = "rough abrasive sheet with gritty particles"
ROOT = Path(__file__).parents[3]


@pytest.fixture(scope="session")
def texture() -> asperity.Texture:
    """The first texture of the README."""
    return asperity.compile(PROMPT)


@pytest.fixture(scope="session")
def grit() -> asperity.Texture:
    return asperity.builtin()


@pytest.fixture(scope="session")
def hatt() -> Path:
    """The folder with the user's own copy of the HaTT."""
    folder = Path(os.environ.get("ASPERITY_HATT") or ROOT / "../shared/hatt/models")
    if not folder.is_dir():
        pytest.skip(f"no HaTT in {folder}: set ASPERITY_HATT")
    return folder


@pytest.fixture(scope="session")
def command() -> Callable[..., str]:
    """Runs the command `asperity`, whose binary ASPERITY_BINARY names."""
    binary = os.environ.get("ASPERITY_BINARY")
    if not binary:
        pytest.skip("no command asperity to compare with: set ASPERITY_BINARY")

    def run(*arguments: object) -> str:
        command = [binary, *map(str, arguments)]
        return subprocess.run(command, check=True, capture_output=True, text=True).stdout

    return run


@pytest.fixture(scope="session")
def trajectory_mm() -> np.ndarray:
    """A tap, strokes at several speeds and depths, and a way out, mm, at 1 kHz. Shape (4000, 3)."""
    t_s = np.arange(4000) / 1000
    x = 40 * np.sin(2 * np.pi * 0.7 * t_s)
    y = 15 * np.sin(2 * np.pi * 1.9 * t_s)
    z = 2 - 5 * np.abs(np.sin(2 * np.pi * 0.45 * t_s))
    return np.round(np.stack([x, y, z], axis=1), 5)
