"""What wears a texture: a plane, a sphere or a box, in metres."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Tuple

_Vector = Tuple[float, float, float]


@dataclass(frozen=True)
class Plane:
    """The half-space below a plane.

    Attributes
    ----------
    point_m : tuple of 3 floats, default (0, 0, 0)
        A point of the plane, m.
    normal : tuple of 3 floats, default (0, 0, 1)
        The direction out of the solid, of any length.
    """

    point_m: _Vector = (0.0, 0.0, 0.0)
    normal: _Vector = (0.0, 0.0, 1.0)


@dataclass(frozen=True)
class Sphere:
    """A ball.

    Attributes
    ----------
    center_m : tuple of 3 floats
        Its centre, m.
    radius_m : float
        Its radius, m.
    """

    center_m: _Vector
    radius_m: float


@dataclass(frozen=True)
class Box:
    """A box with its edges along the axes.

    Attributes
    ----------
    center_m : tuple of 3 floats
        Its centre, m.
    half_extents_m : tuple of 3 floats
        Half the lengths of its edges, m.
    """

    center_m: _Vector
    half_extents_m: _Vector
