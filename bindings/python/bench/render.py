"""How many ticks a second `Renderer.render` takes, beside the plain Rust loop.

    python bench/render.py PLAIN_LOOP [--ticks N] [--rounds N]

PLAIN_LOOP is the program of this folder: cargo build --release -p asperity-python-bench. Both
render the same stroke on the same texture, in turn. Before anything is timed, the forces of both
are compared to the bit.
"""

from __future__ import annotations

import argparse
import statistics
import subprocess
import sys
import tempfile
import time
from pathlib import Path

import numpy as np

import asperity


def stroke(ticks: int) -> np.ndarray:
    """A circle at 120 mm/s, 2.4 mm deep: the middle of most grids. Shape (ticks, 3), m."""
    angle = 2.4e-3 * np.arange(ticks)
    depth = np.full(ticks, -2.4e-3)
    return np.stack([0.05 * np.cos(angle), 0.05 * np.sin(angle), depth], axis=1)


def plain(program: str, asset: Path, positions: Path, forces: Path) -> float:
    """Nanoseconds a tick of one round of the plain loop."""
    command = [program, str(asset), str(positions), str(forces), "1"]
    return float(subprocess.run(command, check=True, capture_output=True, text=True).stdout)


def python(renderer: asperity.Renderer, positions_m: np.ndarray) -> float:
    """Nanoseconds a tick of one call of `render`, its arrays included."""
    renderer.reset()
    start = time.perf_counter()
    rendered = renderer.render(positions_m)
    took = time.perf_counter() - start
    return took * 1e9 / len(rendered)


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("plain_loop")
    parser.add_argument("--ticks", type=int, default=1_000_000)
    parser.add_argument("--rounds", type=int, default=9)
    arguments = parser.parse_args()

    texture = asperity.compile("rough abrasive sheet with gritty particles")
    positions_m = stroke(arguments.ticks).astype(np.float32)
    with tempfile.TemporaryDirectory() as folder:
        asset, positions, forces = (Path(folder, name) for name in ("asset", "positions", "forces"))
        texture.save(asset)
        positions.write_bytes(positions_m.astype("<f4").tobytes())
        plain(arguments.plain_loop, asset, positions, forces)
        renderer = asperity.Renderer(texture, seed=1)
        if renderer.render(positions_m).force_n.astype("<f4").tobytes() != forces.read_bytes():
            print("the forces differ from those of the plain loop", file=sys.stderr)
            return 1
        rounds = [
            (plain(arguments.plain_loop, asset, positions, forces), python(renderer, positions_m))
            for _ in range(arguments.rounds)
        ]
    loop_ns = statistics.median(loop for loop, _ in rounds)
    python_ns = statistics.median(call for _, call in rounds)
    ratio = statistics.median(call / loop for loop, call in rounds)
    print("forces: the same bits")
    print(f"plain Rust loop  {loop_ns:6.1f} ns a tick, best {min(rounds)[0]:.1f}")
    best = min(call for _, call in rounds)
    print(f"Renderer.render  {python_ns:6.1f} ns a tick, best {best:.1f}")
    print(f"{1e3 / python_ns:.1f} million ticks a second, best {1e3 / best:.1f}; {ratio:.2f} times the plain loop's time")
    return 0


if __name__ == "__main__":
    sys.exit(main())
