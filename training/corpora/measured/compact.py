#!/usr/bin/env python3
"""Makes modes.csv from the source archive of PyPI `tdw` 1.13.0.0.

    pip download --no-deps --no-binary :all: tdw==1.13.0.0
    python3 compact.py tdw-1.13.0.0.tar.gz > modes.csv

Objects whose file repeats another's are left out, and so are all modes but the first ten, which are
the ones that the package itself plays.
"""

import json
import re
import sys
import tarfile

FOLDER = "tdw/add_ons/py_impact/material_data/"


def main(archive: str) -> None:
    seen = set()
    print("material,object,freq_hz,level_db,decay_s")
    with tarfile.open(archive) as files:
        names = [n for n in files.getnames() if FOLDER in n and n.endswith("_mm.json")]
        # Two files have a slip in their name.
        parts = []
        for name in names:
            found = re.search(r"([A-Za-z_]+)_(\d)_mm\.json$", name)
            material = found[1].lower().replace("plastc", "plastic")
            is_slip = found[1] != material
            parts.append((material, int(found[2]), is_slip, name))
        for material, size, is_slip, name in sorted(parts):
            modes = json.load(files.extractfile(name))
            key = json.dumps(modes, sort_keys=True)
            if key in seen:
                continue
            seen.add(key)
            label = f"{size}b" if is_slip and (material, size, False) in [p[:3] for p in parts] else size
            rows = list(zip(modes["cf"], modes["op"], modes["rt"]))[:10]
            for freq_hz, level_db, decay_s in sorted(rows):
                print(f"{material},{label},{freq_hz:.1f},{level_db:.2f},{decay_s:.4f}")


if __name__ == "__main__":
    main(sys.argv[1])
