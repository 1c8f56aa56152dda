"""Haptic textures: compile them from a prompt, look at them, render them.

>>> import asperity
>>> texture = asperity.compile("rough abrasive sheet with gritty particles")
>>> texture.grid.sample_rate_hz
1000.0
>>> renderer = asperity.Renderer(texture, seed=1)
>>> felt = renderer.render([[0.0, 0.0, -0.001]] * 100)
>>> bool(felt.has(asperity.Flags.CONTACT).all())
True

Positions are in metres, forces in newtons; other units are in the names. A tick is one servo
period. Every error says what is wrong and what to do about it.
"""

from ._errors import AsperityError, AsperityWarning, NoSuchTextureError, UsageError
from ._native import (
    Author,
    Library,
    Output,
    Renderer,
    Texture,
    __version__,
    builtin,
    compile,
    import_hatt,
    import_model,
    load,
    pack,
    plot,
)
from ._records import (
    Attributes,
    Counters,
    Flags,
    Friction,
    FrictionAnchor,
    Gains,
    Grid,
    LawPoint,
    Provenance,
    Rendered,
    Sizes,
    Taps,
    Wall,
)

__all__ = [
    "AsperityError",
    "AsperityWarning",
    "Attributes",
    "Author",
    "Counters",
    "Flags",
    "Friction",
    "FrictionAnchor",
    "Gains",
    "Grid",
    "LawPoint",
    "Library",
    "NoSuchTextureError",
    "Output",
    "Provenance",
    "Rendered",
    "Renderer",
    "Sizes",
    "Taps",
    "Texture",
    "UsageError",
    "Wall",
    "__version__",
    "builtin",
    "compile",
    "import_hatt",
    "import_model",
    "load",
    "pack",
    "plot",
]
