#!/usr/bin/env python3
"""Makes profiles.csv from the source archive of PyPI `tdw` 1.13.0.0. Needs NumPy.

    python3 profiles.py tdw-1.13.0.0.tar.gz > profiles.csv

Power spectral density of each height profile over spatial frequency, averaged over third octaves:
segments of 45.7 mm, straight line taken off, Hann window, half overlap.
"""

import io
import sys
import tarfile

import numpy as np

FOLDER = "tdw/add_ons/py_impact/scrape_surfaces/"
STEP_MM = 1.394e-3
SEGMENT = 32768
# Third octaves of 1/mm: 0.079 to 12.6.
BANDS = range(-11, 12)


def spectrum(height_um):
    """Spatial frequencies, 1/mm, and one-sided density, um^2 mm."""
    window = np.hanning(SEGMENT)
    place = np.arange(SEGMENT)
    total, count = 0.0, 0
    for start in range(0, len(height_um) - SEGMENT + 1, SEGMENT // 2):
        part = height_um[start : start + SEGMENT]
        part = part - np.polyval(np.polyfit(place, part, 1), place)
        total = total + np.abs(np.fft.rfft(window * part)) ** 2
        count += 1
    density = 2.0 * total / count * STEP_MM / np.sum(window**2)
    return np.fft.rfftfreq(SEGMENT, STEP_MM), density


def main(archive: str) -> None:
    print("profile,k_per_mm,density_um2_mm")
    with tarfile.open(archive) as files:
        names = sorted(n for n in files.getnames() if FOLDER in n and n.endswith(".npy"))
        for name in names:
            raw = files.extractfile(name).read()
            height_um = 1e6 * np.load(io.BytesIO(raw), allow_pickle=False)
            k, density = spectrum(height_um)
            profile = name.rsplit("/", 1)[1][: -len(".npy")]
            for band in BANDS:
                centre = 10.0 ** (band / 10.0)
                inside = (k >= centre * 10**-0.05) & (k < centre * 10**0.05)
                # The lowest bands are narrower than the resolution.
                value = density[inside].mean() if inside.any() else np.interp(centre, k, density)
                print(f"{profile},{centre:.4g},{value:.4g}")


if __name__ == "__main__":
    main(sys.argv[1])
