//! glTF 2.0 with `MPEG_haptic_material`: a square of the material, as it looks and as it feels.
//!
//! The file holds everything in data URIs. The material has the preview's picture, its normals and
//! its roughness. The extension has stiffness, friction, relief and vibration as textures. It leaves
//! the meaning of their values to the renderer, so each says in `extras`, in SI units, what white
//! stands for.

use super::{
    clip::Clip,
    envelope::transient_hz,
    haptic::{pretty, rounded},
    playback::{TonePoint, Track},
};
use crate::views::preview::{self, not_encoded};
use asperity_io::diagnostic::Fault;
use asperity_texture::model::{TextureModel, attributes};
use base64::{Engine as _, engine::general_purpose::STANDARD};
use serde_json::{Value, json};

const EXTENSION: &str = "MPEG_haptic_material";
/// Width of the square, m, and of one patch of the pictures.
const SIDE_M: f32 = 0.1;
/// Numbers of the textures.
const COLOR: usize = 0;
const NORMAL: usize = 1;
const RELIEF: usize = 2;
const WHITE: usize = 3;

/// The vibration as one number and another.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Vibration {
    /// RMS of the first stroke away from its ends, m/s².
    pub(super) rms_m_s2: f64,
    /// Its mean frequency, Hz.
    pub(super) freq_hz: f64,
}

/// The vibration of a clip; `None` without a stroke.
pub(super) fn vibration(clip: &Clip) -> Option<Vibration> {
    let signal = &clip.strokes.first()?.signal_m_s2;
    let margin = signal.len() / 8;
    let middle = &signal[margin..signal.len() - margin];
    let energy: f64 = middle.iter().map(|x| x * x).sum();
    Some(Vibration {
        rms_m_s2: (energy / middle.len().max(1) as f64).sqrt(),
        freq_hz: transient_hz(middle, clip.rate_hz),
    })
}

/// Returns the track that a player renders: a tone through every stroke, in full scales.
pub(super) fn played(clip: &Clip, vibration: Vibration) -> Track {
    let amplitude = std::f64::consts::SQRT_2 * vibration.rms_m_s2 / clip.scale.stroke_m_s2;
    let point = |t_s| TonePoint {
        t_s,
        amplitude,
        freq_hz: vibration.freq_hz,
    };
    let strokes = clip.strokes.iter();
    Track {
        tones: strokes
            .map(|take| vec![point(take.start_s), point(take.end_s(clip.rate_hz))])
            .collect(),
        ..Track::default()
    }
}

/// Writes a texture with the vibration of a clip.
pub(super) fn write(texture: &TextureModel, clip: &Clip, size_px: u32) -> Result<Vec<u8>, Fault> {
    let picture = preview::draw(texture, size_px)?;
    let image = |png: Vec<u8>| uri("image/png", &png);
    let images = [
        image(picture.png().map_err(not_encoded)?),
        image(picture.normal_png().map_err(not_encoded)?),
        image(picture.height_png().map_err(not_encoded)?),
        image(white()),
    ];
    let buffer = square();
    let view = |offset: usize, length: usize, target: u32| json!({ "buffer": 0, "byteOffset": offset, "byteLength": length, "target": target });
    let reference = |texture: usize, extras: Value| {
        json!([{
            "texture": { "index": texture },
            "type": "High_Resolution",
            "extras": extras,
        }])
    };
    let mut haptic = json!({
        "name": texture.name,
        "stiffness": reference(WHITE, json!({ "white_is_n_m": rounded(texture.wall.stiffness_n_m) })),
        "friction": reference(WHITE, json!({ "white_is_mu": rounded(texture.friction.mu) })),
        "vibrotactileTexture": reference(RELIEF, json!({ "side_m": SIDE_M })),
    });
    if let (Some(found), Some(take)) = (vibration(clip), clip.strokes.first()) {
        haptic["vibration"] = reference(
            WHITE,
            json!({
                "white_is_rms_m_s2": rounded(found.rms_m_s2),
                "mean_frequency_hz": rounded(found.freq_hz),
                "at": take.label,
            }),
        );
    }
    let gltf = json!({
        "asset": {
            "version": "2.0",
            "generator": concat!("asperity ", env!("CARGO_PKG_VERSION")),
        },
        "extensionsUsed": [EXTENSION],
        "extensions": { EXTENSION: { "materials": [haptic] } },
        "scene": 0,
        "scenes": [{ "nodes": [0] }],
        "nodes": [{ "mesh": 0, "name": texture.name }],
        "meshes": [{
            "name": texture.name,
            "primitives": [{
                "attributes": { "POSITION": 0, "NORMAL": 1, "TEXCOORD_0": 2 },
                "indices": 3,
                "material": 0,
            }],
            "extensions": { EXTENSION: { "hapticMaterialIndex": 0 } },
        }],
        "materials": [{
            "name": texture.name,
            "pbrMetallicRoughness": {
                "baseColorTexture": { "index": COLOR },
                "metallicFactor": 0.0,
                "roughnessFactor": roughness(texture),
            },
            "normalTexture": { "index": NORMAL },
        }],
        "textures": (0..images.len())
            .map(|source| json!({ "source": source, "sampler": 0 }))
            .collect::<Vec<_>>(),
        "images": images.iter().map(|uri| json!({ "uri": uri })).collect::<Vec<_>>(),
        // Repeated in both directions, which is the default.
        "samplers": [{}],
        "buffers": [{
            "byteLength": buffer.len(),
            "uri": uri("application/octet-stream", &buffer),
        }],
        "bufferViews": [
            view(0, 48, 34962), view(48, 48, 34962), view(96, 32, 34962), view(128, 12, 34963),
        ],
        "accessors": [
            {
                "bufferView": 0, "componentType": 5126, "count": 4, "type": "VEC3",
                "min": [0.0, 0.0, 0.0], "max": [SIDE_M, 0.0, SIDE_M],
            },
            { "bufferView": 1, "componentType": 5126, "count": 4, "type": "VEC3" },
            { "bufferView": 2, "componentType": 5126, "count": 4, "type": "VEC2" },
            { "bufferView": 3, "componentType": 5123, "count": 6, "type": "SCALAR" },
        ],
    });
    Ok(pretty(&gltf))
}

fn uri(kind: &str, bytes: &[u8]) -> String {
    format!("data:{kind};base64,{}", STANDARD.encode(bytes))
}

/// Roughness for the eye: slippery is glossy.
fn roughness(texture: &TextureModel) -> f64 {
    let mu = attributes::of(texture).mu;
    (0.25 + 0.6 * mu).clamp(0.0, 1.0)
}

/// A 1 × 1 white PNG.
fn white() -> Vec<u8> {
    let mut bytes = Vec::new();
    let mut encoder = png::Encoder::new(&mut bytes, 1, 1);
    encoder.set_color(png::ColorType::Grayscale);
    // Writing a pixel to memory cannot fail; a reader would find the picture empty.
    let _ = encoder
        .write_header()
        .and_then(|mut writer| writer.write_image_data(&[255]));
    bytes
}

/// Positions, normals and texture coordinates of four corners, and two triangles; up is +y.
fn square() -> Vec<u8> {
    let corners = [(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0f32)];
    let positions = corners
        .iter()
        .flat_map(|(u, v)| [u * SIDE_M, 0.0, v * SIDE_M]);
    let normals = corners.iter().flat_map(|_| [0.0, 1.0, 0.0]);
    let coordinates = corners.iter().flat_map(|&(u, v)| [u, v]);
    let floats = positions.chain(normals).chain(coordinates);
    let mut bytes: Vec<u8> = floats.flat_map(f32::to_le_bytes).collect();
    bytes.extend([0u16, 2, 1, 0, 3, 2].iter().flat_map(|i| i.to_le_bytes()));
    bytes
}
