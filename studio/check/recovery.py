"""Effects that `asperity study simulate` plants are found by the analysis, and none where none is planted.

python recovery.py ASPERITY STUDY.toml: for each of 100 seeds, 20 simulated participants, once with a dominance of 0.1 and once
with none. Of the 95 % intervals of each attribute, 90 to 98 have to hold what was planted, and at most 8 may find an effect that
was not.
"""

import re
import subprocess
import sys
import tempfile
from pathlib import Path

from asperity import study

SEEDS, PARTICIPANTS, PLANTED = 100, 20, 0.1


def dominance(asperity, design, seed, folder):
    """The intervals of the weight of the higher anchor, by attribute."""
    where = Path(folder) / "simulated"
    subprocess.run([asperity, "study", "simulate", str(design), "--participants", str(PARTICIPANTS), "--seed", str(seed),
                    "-o", str(where), "--quiet"], check=True)
    table = study.midpoints.dominance(study.load(where).ratings)
    return {row.attribute: (row.low, row.high, row.found) for row in table.itertuples()}


def main(asperity, design):
    text = Path(design).read_text(encoding="utf-8")
    held, found = {}, {}
    for seed in range(SEEDS):
        for planted in (PLANTED, 0.0):
            with tempfile.TemporaryDirectory() as folder:
                file = Path(folder) / "study.toml"
                file.write_text(re.sub(r"(?m)^dominance = .*$", f"dominance = {planted}", text), encoding="utf-8")
                for attribute, (low, high, is_found) in dominance(asperity, file, seed, folder).items():
                    if planted:
                        held[attribute] = held.get(attribute, 0) + (low <= 0.5 + planted <= high)
                    else:
                        found[attribute] = found.get(attribute, 0) + is_found
    print(f"of {SEEDS} seeds, intervals that hold what was planted: {held}; effects found where none was: {found}")
    assert held and all(90 <= count <= 98 for count in held.values()), held
    assert all(count <= 8 for count in found.values()), found


main(*sys.argv[1:])
