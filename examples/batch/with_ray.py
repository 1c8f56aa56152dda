#!/usr/bin/env python3
"""Builds a library on a Ray cluster: one task per shard, merged by the driver.

    python3 with_ray.py library.toml -o library.aspl --shards 64

RAY_ADDRESS names the cluster (`auto`, or HOST:PORT); without it, Ray starts one on this machine. Workers need the
command `asperity` and nothing else: Ray sends them the manifest's folder, and their shards come back through its
object store, so no file system has to be shared.
"""

from __future__ import annotations

import argparse
import os
import pathlib
import subprocess
import sys
import tempfile

import ray


class Killed(Exception):
    """A signal ended a build, such as the one that the out-of-memory killer sends."""


# Ray itself retries a task whose worker or node died.
@ray.remote(num_cpus=1, max_retries=3, retry_exceptions=[Killed])
def build(manifest: str, shard: str) -> subprocess.CompletedProcess[bytes]:
    """Builds one shard. To standard output, `asperity` writes all of it or nothing."""
    command = ["asperity", "build", manifest, "--locked", "--quiet", "--shard", shard, "-o", "-"]
    # As many threads as the task has processors.
    done = subprocess.run(command, capture_output=True, env={**os.environ, "RAYON_NUM_THREADS": "1"})
    if done.returncode < 0:
        raise Killed(f"ended by signal {-done.returncode}")
    # Returned even if it failed by itself, because another attempt would fail again.
    return done


def collect(tasks: dict[ray.ObjectRef, str], folder: pathlib.Path) -> list[pathlib.Path]:
    """Writes every shard into a folder as it arrives, and reports progress."""
    parts: list[pathlib.Path] = []
    count = len(tasks)
    while tasks:
        (task, *_), _ = ray.wait(list(tasks))
        # Once nothing refers to the task, its bytes leave the object store.
        shard = tasks.pop(task)
        try:
            done = ray.get(task)
        except ray.exceptions.RayError as error:
            sys.exit(f"shard {shard}: {error}")
        if done.returncode != 0:
            sys.exit(f"shard {shard}: {done.stderr.decode()}")
        parts.append(folder / f"{shard.replace('/', '-of-')}.aspl")
        parts[-1].write_bytes(done.stdout)
        print(f"shard {shard}: {len(done.stdout):,} bytes; {len(parts)} of {count} done", file=sys.stderr)
    return parts


def main() -> None:
    parser = argparse.ArgumentParser(description="Build a library of haptic textures on a Ray cluster.")
    parser.add_argument("manifest", type=pathlib.Path)
    parser.add_argument("-o", "--output", type=pathlib.Path, required=True)
    parser.add_argument("--shards", type=int, help="default: four per processor of the cluster")
    args = parser.parse_args()

    folder = str(args.manifest.resolve().parent)
    ray.init(runtime_env={"working_dir": folder, "excludes": ["*.aspl"]}, log_to_driver=False)
    count = args.shards or 4 * int(ray.cluster_resources()["CPU"])
    shards = [f"{i}/{count}" for i in range(1, count + 1)]
    tasks = {build.remote(args.manifest.name, shard): shard for shard in shards}
    with tempfile.TemporaryDirectory(prefix=".parts-", dir=args.output.resolve().parent) as parts:
        files = collect(tasks, pathlib.Path(parts))
        if subprocess.run(["asperity", "merge", *files, "-o", args.output]).returncode:
            sys.exit("the shards were built, but could not be merged")


if __name__ == "__main__":
    main()
