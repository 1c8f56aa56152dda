"""Haptic textures: compile, edit and build them, look at them, render them.

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
    Scene,
    Texture,
    __version__,
    blend,
    build,
    builtin,
    compile,
    compose,
    diff,
    encode,
    export,
    import_effect,
    import_hatt,
    import_model,
    import_recording,
    import_surface,
    load,
    merge,
    pack,
    plot,
)
from ._records import (
    Attributes,
    Exported,
    Friction,
    FrictionAnchor,
    Gains,
    Grid,
    LawPoint,
    Provenance,
    Sizes,
    Taps,
    Wall,
)
from ._rendered import Counters, Flags, Rendered
from ._solids import Box, Plane, Sphere

__all__ = [
    "AsperityError",
    "AsperityWarning",
    "Attributes",
    "Author",
    "Box",
    "Counters",
    "Exported",
    "Flags",
    "Friction",
    "FrictionAnchor",
    "Gains",
    "Grid",
    "LawPoint",
    "Library",
    "NoSuchTextureError",
    "Output",
    "Plane",
    "Provenance",
    "Rendered",
    "Renderer",
    "Scene",
    "Sizes",
    "Sphere",
    "Taps",
    "Texture",
    "UsageError",
    "Wall",
    "__version__",
    "blend",
    "build",
    "builtin",
    "compile",
    "compose",
    "diff",
    "encode",
    "export",
    "import_effect",
    "import_hatt",
    "import_model",
    "import_recording",
    "import_surface",
    "load",
    "merge",
    "pack",
    "plot",
]
