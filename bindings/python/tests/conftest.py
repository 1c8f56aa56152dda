"""What several tests need."""

from __future__ import annotations

import csv
import os
import signal
import subprocess
from pathlib import Path
from typing import Callable, Dict, List

import numpy as np
import pytest

import asperity

PROMPT = "rough abrasive sheet with gritty particles"
ROOT = Path(__file__).parents[3]
# A shell starts what runs in the background without Ctrl-C, and Python then leaves it so.
signal.signal(signal.SIGINT, signal.default_int_handler)
COLUMNS = ("speed_mm_s", "normal_force_n", "vib_m_s2", "tap_n", "friction_n")


def same_bits(one: np.ndarray, other: np.ndarray) -> None:
    assert one.dtype == other.dtype and one.shape == other.shape
    assert one.tobytes() == other.tobytes()


def same_table(rendered: asperity.Rendered, table: Dict[str, List[str]]) -> None:
    """Whether ticks are those that `asperity render` printed, to the bit."""

    def column(name: str) -> np.ndarray:
        return np.array(table[name], dtype=np.float32)

    for name in COLUMNS:
        same_bits(getattr(rendered, name), column(name))
    same_bits(rendered.force_n, np.stack([column(f"f{axis}_n") for axis in "xyz"], axis=1))
    same_bits(rendered.depth_m * np.float32(1000), column("depth_mm"))
    same_bits(rendered.flags, np.array(table["flags"], dtype=np.uint16))


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


@pytest.fixture
def printed(command, tmp_path) -> Callable[..., Dict[str, List[str]]]:
    """The columns that `asperity render` prints of a file over a trajectory."""

    def run(file: Path, trajectory_mm: np.ndarray, seed: int, rate_hz: float = 1000.0):
        with open(tmp_path / "in.csv", "w", newline="") as rows:
            writer = csv.writer(rows)
            writer.writerow(["t_s", "x_mm", "y_mm", "z_mm"])
            for tick, position in enumerate(trajectory_mm):
                writer.writerow([repr(tick / rate_hz), *map(repr, position.tolist())])
        command(
            *("render", file, "--trajectory", tmp_path / "in.csv"),
            *("-o", tmp_path / "out.csv", "--seed", seed, "--rate", rate_hz),
        )
        with open(tmp_path / "out.csv", newline="") as rows:
            table = list(csv.DictReader(rows))
        return {name: [row[name] for row in table] for name in table[0]}

    return run
