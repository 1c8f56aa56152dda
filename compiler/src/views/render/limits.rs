//! What a rendering takes at most.

/// Bytes of one row of a trajectory; four numbers take below 100.
pub const MAX_ROW_BYTES: usize = 64 * 1024;
/// Textures of a scene, of which each takes a slot; `asperity build` packs 64 at most.
pub const MAX_SCENE_TEXTURES: usize = 1024;
