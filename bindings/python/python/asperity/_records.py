"""What a texture holds, as plain records."""

from __future__ import annotations

from dataclasses import dataclass, fields
from typing import Any, Dict, List, Optional

import numpy as np
from numpy.typing import NDArray


class _Described:
    """A record whose arrays are shown by type and shape."""

    def __repr__(self) -> str:
        def shown(x: Any) -> str:
            return f"<{x.dtype} {x.shape}>" if isinstance(x, np.ndarray) else repr(x)

        values = ((field.name, getattr(self, field.name)) for field in fields(self))  # type: ignore[arg-type]
        return f"{type(self).__name__}({', '.join(f'{name}={shown(x)}' for name, x in values)})"


class _Shared(_Described):
    """A record with read-only arrays: all who ask the texture share them."""

    def __post_init__(self) -> None:
        for field in fields(self):  # type: ignore[arg-type]
            value = getattr(self, field.name)
            if isinstance(value, np.ndarray):
                value.flags.writeable = False


@dataclass(frozen=True, eq=False, repr=False)
class Grid(_Shared):
    """AR or ARMA models over speed and force, joined by triangles.

    The power spectrum at a vertex is ``(gain * sigma)**2 * |B|**2 / |A|**2``. Arrays are
    read-only; V is the number of vertices, T that of triangles.

    Attributes
    ----------
    order : int
        Order of A(z).
    sample_rate_hz : float
        Rate of every model, Hz.
    numerator : str
        What stands above A(z): ``"none"`` for 1, ``"nyquist"`` for 1 + z⁻¹, ``"lsf"`` for a
        monic B(z) of its own.
    speed_mm_s : ndarray of float64, shape (V,)
        Tangential speed of each vertex, mm/s.
    force_n : ndarray of float64, shape (V,)
        Normal force of each vertex, N.
    kind : ndarray of str, shape (V,)
        ``"interior"`` or ``"edge"``.
    lsf_rad : ndarray of float64, shape (V, order)
        Line spectral frequencies of A(z), rad, ascending in (0, π). The first belongs to the
        sum polynomial.
    ma_lsf_rad : ndarray of float64, shape (V, MA order), or None
        Line spectral frequencies of B(z), only where the numerator is ``"lsf"``.
    gain : ndarray of float64, shape (V,)
        Gain of the numerator.
    sigma_m_s2 : ndarray of float64, shape (V,)
        Standard deviation of the excitation before numerator and gain, m/s².
    triangles : ndarray of int64, shape (T, 3)
        Vertex indices.
    max_speed_mm_s, max_force_n : float
        The grid covers speeds and forces from 0 to these.
    """

    order: int
    sample_rate_hz: float
    numerator: str
    speed_mm_s: NDArray[np.float64]
    force_n: NDArray[np.float64]
    kind: NDArray[np.str_]
    lsf_rad: NDArray[np.float64]
    ma_lsf_rad: Optional[NDArray[np.float64]]
    gain: NDArray[np.float64]
    sigma_m_s2: NDArray[np.float64]
    triangles: NDArray[np.int64]
    max_speed_mm_s: float
    max_force_n: float


@dataclass(frozen=True, eq=False, repr=False)
class Taps(_Shared):
    """Tapping transients, one for every impact speed.

    Arrays are read-only; K is the number of traces, N their length.

    Attributes
    ----------
    sample_rate_hz : float
        Rate of every trace, Hz.
    speeds_m_s : ndarray of float64, shape (K,)
        Impact speeds, m/s, ascending.
    traces_m_s2 : ndarray of float64, shape (K, N)
        Accelerations along the surface normal, m/s².
    """

    sample_rate_hz: float
    speeds_m_s: NDArray[np.float64]
    traces_m_s2: NDArray[np.float64]


@dataclass(frozen=True)
class FrictionAnchor:
    """A reference material that friction was interpolated from.

    Attributes
    ----------
    name : str
        Name of the material.
    mu : float
        Its coefficient of kinetic friction.
    weight : float
        Its weight, 0 to 1.
    """

    name: str
    mu: float
    weight: float


@dataclass(frozen=True)
class LawPoint:
    """A point of a law of friction over speed.

    Attributes
    ----------
    speed_mm_s : float
        Tangential speed, mm/s.
    factor : float
        Factor of ``Friction.mu`` at that speed.
    """

    speed_mm_s: float
    factor: float


@dataclass(frozen=True)
class Friction:
    """Coulomb friction, or friction that depends on speed.

    Attributes
    ----------
    mu : float
        Coefficient of kinetic friction; with a law, what its factors multiply.
    anchors : list of FrictionAnchor
        What it was interpolated from; may be empty.
    law : list of LawPoint or None
        How friction depends on speed: straight lines between the points, constant outside.
    """

    mu: float
    anchors: List[FrictionAnchor]
    law: Optional[List[LawPoint]] = None


@dataclass(frozen=True)
class Wall:
    """The virtual wall ``F = k * depth - b * d(depth)/dt``.

    Attributes
    ----------
    stiffness_n_m : float
        Stiffness k, N/m.
    damping_n_s_m : float
        Damping b, N·s/m.
    """

    stiffness_n_m: float
    damping_n_s_m: float


@dataclass(frozen=True)
class Gains:
    """From accelerations to forces.

    Attributes
    ----------
    vib_s2_m : float
        Gain of the vibration, s²/m, of a force of `f_max_n`.
    effective_mass_kg : float
        Mass that turns the acceleration of a tap into a force, kg.
    f_max_n : float
        Force that `vib_s2_m` is relative to, N.
    """

    vib_s2_m: float
    effective_mass_kg: float
    f_max_n: float


@dataclass(frozen=True)
class Attributes:
    """How rough, sharp, hard and slippery a texture is, computed from it.

    An attribute is None where the texture does not define it: without taps, or without an
    interior vertex that sounds.

    Attributes
    ----------
    rough_db : float or None
        Mean level of the vibration above 40 Hz, dB re 1 (m/s²)².
    sharp_hz : float or None
        Mean spectral centroid of the same, Hz.
    hard_hz : float or None
        Spectral centroid of the fastest tap, Hz.
    mu : float
        Coefficient of kinetic friction; slipperiness is its negative.
    """

    rough_db: Optional[float]
    sharp_hz: Optional[float]
    hard_hz: Optional[float]
    mu: float


@dataclass(frozen=True)
class Sizes:
    """Sizes of an asset, bytes.

    Attributes
    ----------
    haptic : int
        What a runtime needs.
    preview : int
        The preview image, 0 without one.
    total : int
        The whole asset.
    """

    haptic: int
    preview: int
    total: int


@dataclass(frozen=True)
class Provenance:
    """Where a texture comes from.

    Attributes
    ----------
    generator : str
        The program that made it.
    source : str
        The file, corpus entry or model that it was made from.
    source_crc32 : int
        CRC-32 of the source's bytes; 0 where there is no file.
    prompt : str or None
        The prompt, for a texture that has one.
    seed : int
        Seed of everything random in its making.
    fidelity : str
        The fidelity that was asked for: ``"full"``, ``"auto"`` or an order.
    taps_synthetic : bool
        Whether the taps were synthesised rather than recorded.
    lsf_error_db : float
        RMS spectral error of LSF quantisation, dB.
    notes : str
        What a reader should know: synthetic parts, unconfirmed defaults.
    """

    generator: str
    source: str
    source_crc32: int
    prompt: Optional[str]
    seed: int
    fidelity: str
    taps_synthetic: bool
    lsf_error_db: float
    notes: str


@dataclass(frozen=True)
class Exported:
    """A texture in another tool's format, and what the format loses.

    Attributes
    ----------
    data : bytes
        The file.
    header : bytes or None
        The header of a C array that was written to ``NAME.c``.
    report : dict
        What ``asperity export --json`` prints, without the path: ``"parts"`` has each stroke and
        tap with its loss in dB over third octaves, ``"full_scale"`` the accelerations at full
        scale, m/s².
    """

    data: bytes
    header: Optional[bytes]
    report: Dict[str, Any]


__all__: List[str] = [
    "Attributes",
    "Exported",
    "Friction",
    "FrictionAnchor",
    "Gains",
    "Grid",
    "LawPoint",
    "Provenance",
    "Sizes",
    "Taps",
    "Wall",
]
