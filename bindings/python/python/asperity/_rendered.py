"""What ticks give, as plain records."""

from __future__ import annotations

from dataclasses import dataclass
from enum import IntFlag
from typing import List, Optional

import numpy as np
from numpy.typing import NDArray

from ._records import _Described


class Flags(IntFlag):
    """What happened in a tick."""

    CONTACT = 1
    """The stylus is inside the surface."""
    TAP_STARTED = 2
    """A tap transient started."""
    TAP_ACTIVE = 4
    """A tap transient is under way."""
    OUTSIDE_GRID = 8
    """Speed or force lie outside the grid; an edge model answers."""
    PEAK_LIMITED = 16
    """The force was cut to the device's peak."""
    SLEW_LIMITED = 32
    """The force was held back by the slew limit."""
    HELD_SAMPLE = 64
    """A bad sample; the last good one was held."""
    SAFE_STATE = 128
    """The safe state: the force goes to zero."""
    RAMPING = 256
    """The force comes back after a fault."""
    VIB_CLAMPED = 512
    """The vibration reached its bound."""


@dataclass(frozen=True)
class Counters:
    """Counts of what happened since a renderer was made or reset.

    Attributes
    ----------
    ticks : int
        Ticks.
    bad_samples : int
        Samples that were stale, not finite or out of reach.
    missed_ticks : int
        Servo periods that were reported as missed.
    faults : int
        Times the safe state was entered.
    taps : int
        Taps.
    peak_limited : int
        Ticks whose force was cut to the peak.
    slew_limited : int
        Ticks whose force was held back by the slew limit.
    """

    ticks: int
    bad_samples: int
    missed_ticks: int
    faults: int
    taps: int
    peak_limited: int
    slew_limited: int


@dataclass(frozen=True, eq=False, repr=False)
class Rendered(_Described):
    """What ticks gave, one row a tick; N is their number.

    The columns are those of ``asperity render``, in metres where that prints millimetres.

    Attributes
    ----------
    force_n : ndarray of float32, shape (N, 3)
        Force on the hand, N.
    depth_m : ndarray of float32, shape (N,)
        Depth inside the surface, m; 0 outside.
    speed_mm_s : ndarray of float32, shape (N,)
        Estimated tangential speed, mm/s.
    normal_force_n : ndarray of float32, shape (N,)
        Stiffness times depth, N: the force that looks up the grid.
    vib_m_s2 : ndarray of float32, shape (N,)
        The vibration before device gain, m/s².
    tap_n : ndarray of float32, shape (N,)
        Tap force along the normal, N.
    friction_n : ndarray of float32, shape (N,)
        Magnitude of the friction force, N.
    flags : ndarray of uint16, shape (N,)
        What happened, as bits of `Flags`.
    surface : ndarray of int16, shape (N,), or None
        Index of the surface in contact, -1 for none; only of a scene.
    """

    force_n: NDArray[np.float32]
    depth_m: NDArray[np.float32]
    speed_mm_s: NDArray[np.float32]
    normal_force_n: NDArray[np.float32]
    vib_m_s2: NDArray[np.float32]
    tap_n: NDArray[np.float32]
    friction_n: NDArray[np.float32]
    flags: NDArray[np.uint16]
    surface: Optional[NDArray[np.int16]] = None

    def __len__(self) -> int:
        return len(self.flags)

    def has(self, flag: Flags) -> NDArray[np.bool_]:
        """Where a flag is set.

        Parameters
        ----------
        flag : Flags
            One flag, or several of which all must be set.

        Returns
        -------
        ndarray of bool, shape (N,)
        """
        wanted = np.uint16(flag)
        where: NDArray[np.bool_] = np.equal(self.flags & wanted, wanted)
        return where


__all__: List[str] = ["Counters", "Flags", "Rendered"]
