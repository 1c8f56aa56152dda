"""Builds a scene from a manifest, strokes over it, and exports what one of its textures feels like."""

from pathlib import Path

import numpy as np

import asperity

MANIFEST = """
[[texture]]
name = "paper"
prompt = "rough abrasive sheet with gritty particles"

[[texture]]
name = "cork"
prompt = "cork"

[[surface]]
texture = "paper"
plane = { point_m = [0, 0, 0], normal = [0, 0, 1] }

[[surface]]
texture = "cork"
sphere = { center_m = [0, 0, 0], radius_m = 0.02 }
"""

Path("desk.toml").write_text(MANIFEST)
scene = asperity.build("desk.toml", "desk.aspl", progress=lambda done, total: print(done, "of", total))
assert isinstance(scene, asperity.Scene)
for surface in scene.surfaces:
    print(surface["kind"], "of", surface["texture"])

# Along x at 100 mm/s, 2 mm deep in the plane, and deeper in the ball that lies in it.
t_s = np.arange(1000) / 1000
stroke_m = np.stack([0.1 * t_s - 0.05, 0 * t_s, np.full_like(t_s, -0.002)], axis=1)
felt = asperity.Renderer(scene, seed=1).render(stroke_m)
assert felt.surface is not None
for index, surface in enumerate(scene.surfaces):
    ticks = felt.surface == index
    level = 20 * np.log10(felt.vib_m_s2[ticks].std())
    print(f"{surface['texture']}: {ticks.sum()} ticks, {level:.1f} dB re 1 m/s²")

exported = asperity.export(scene["cork"], "ahap", "cork.ahap")
for part in exported.report["parts"]:
    print(part["part"], part["loss"])
