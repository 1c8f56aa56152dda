//! What a rendering takes at most.

/// Textures of a scene, of which each takes a slot; `asperity build` packs 64 at most.
pub const MAX_SCENE_TEXTURES: usize = 1024;
