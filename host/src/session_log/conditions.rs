//! Metadata of a recording, sufficient to render it again.

use asperity_formats::Solid;
use asperity_runtime::{
    Config, FrictionConfig, Limits, MechanicsConfig, SafetyConfig, TapConfig, VibrationAxis,
};
use serde::{Deserialize, Serialize};

/// Identity of the asset, or of a scene's library, that played.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct TextureInfo {
    /// Display name.
    pub name: String,
    /// CRC-32 of all its bytes.
    pub crc32: u32,
    /// Length, bytes.
    pub bytes: u64,
}

impl TextureInfo {
    /// Returns the identity of an asset or a library.
    #[must_use]
    pub fn of(name: impl Into<String>, asset: &[u8]) -> Self {
        Self {
            name: name.into(),
            crc32: crc32fast::hash(asset),
            bytes: asset.len() as u64,
        }
    }

    /// Returns true if these are the bytes that played.
    #[must_use]
    pub fn is(&self, asset: &[u8]) -> bool {
        self.bytes == asset.len() as u64 && self.crc32 == crc32fast::hash(asset)
    }
}

/// Conditions of a session.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Conditions {
    /// Program and version that recorded.
    pub program: String,
    /// The device, as its URI names it.
    pub device: String,
    /// The texture that played first; `None` for what is no single texture, such as a scene.
    pub texture: Option<TextureInfo>,
    /// The library of the scene that played. `None` for a texture, and in files of programs that did
    /// not write it; readers before this field skip it.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub scene: Option<TextureInfo>,
    /// Seed of the excitation.
    pub seed: u64,
    /// Configuration of the renderer, servo rate included.
    #[serde(with = "ConfigFields")]
    pub config: Config,
}

/// Names the fields of the runtime's configuration; the compiler checks that none is missing.
#[derive(Serialize, Deserialize)]
#[serde(remote = "Config", deny_unknown_fields)]
struct ConfigFields {
    servo_rate_hz: f32,
    velocity_cutoff_hz: f32,
    normal_cutoff_hz: f32,
    #[serde(with = "SolidFields")]
    solid: Solid,
    #[serde(with = "VibrationAxisNames")]
    vibration_axis: VibrationAxis,
    #[serde(with = "LimitsFields")]
    limits: Limits,
    #[serde(with = "TapFields")]
    tap: TapConfig,
    #[serde(with = "FrictionFields")]
    friction: FrictionConfig,
    #[serde(with = "MechanicsFields")]
    mechanics: MechanicsConfig,
    #[serde(with = "SafetyFields")]
    safety: SafetyConfig,
    parameter_time_constant_s: f32,
}

#[derive(Serialize, Deserialize)]
#[serde(remote = "Solid", rename_all = "lowercase", deny_unknown_fields)]
enum SolidFields {
    Plane {
        point_m: [f32; 3],
        normal: [f32; 3],
    },
    Sphere {
        center_m: [f32; 3],
        radius_m: f32,
    },
    Box {
        center_m: [f32; 3],
        half_extents_m: [f32; 3],
    },
}

#[derive(Serialize, Deserialize)]
#[serde(remote = "VibrationAxis", rename_all = "lowercase")]
enum VibrationAxisNames {
    Tangent,
    Binormal,
}

#[derive(Serialize, Deserialize)]
#[serde(remote = "Limits", deny_unknown_fields)]
struct LimitsFields {
    peak_n: f32,
    slew_n_s: f32,
}

#[derive(Serialize, Deserialize)]
#[serde(remote = "TapConfig", deny_unknown_fields)]
struct TapFields {
    min_speed_m_s: f32,
    rearm_m: f32,
}

#[derive(Serialize, Deserialize)]
#[serde(remote = "FrictionConfig", deny_unknown_fields)]
struct FrictionFields {
    stiffness_n_m: f32,
    dead_zone_m: f32,
    leak_speed_m_s: f32,
}

#[derive(Serialize, Deserialize)]
#[serde(remote = "MechanicsConfig", deny_unknown_fields)]
struct MechanicsFields {
    damping_n_s_m: f32,
    coulomb_n: f32,
    fastest_m_s: f32,
    position_step_m: f32,
    delay_ticks: u32,
}

#[derive(Serialize, Deserialize)]
#[serde(remote = "SafetyConfig", deny_unknown_fields)]
struct SafetyFields {
    hold_ticks: u32,
    ramp_s: f32,
    #[serde(default = "reach_before_it_was_recorded")]
    reach_m: f32,
}

/// Recordings that name no reach were made when it was 10 km.
fn reach_before_it_was_recorded() -> f32 {
    1.0e4
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn conditions_read_back_to_the_bit() {
        let mut config = Config {
            servo_rate_hz: 1000.0 / 3.0,
            ..Config::default()
        };
        config.limits.slew_n_s = f32::MIN_POSITIVE;
        config.mechanics.position_step_m = 5.5e-5 + f32::EPSILON;
        for solid in [
            config.solid,
            Solid::Sphere {
                center_m: [0.1, -0.2, 1e-30],
                radius_m: 0.3,
            },
            Solid::Box {
                center_m: [0.1; 3],
                half_extents_m: [0.7; 3],
            },
        ] {
            config.solid = solid;
            let conditions = Conditions {
                program: "test".into(),
                device: "null:".into(),
                texture: Some(TextureInfo::of("a \"b\"\n", b"123456789")),
                scene: None,
                seed: u64::MAX,
                config: config.clone(),
            };
            let text = serde_json::to_vec(&conditions).expect("JSON");
            let back: Conditions = serde_json::from_slice(&text).expect("JSON");
            assert_eq!(back, conditions);
            assert_eq!(
                back.texture.expect("a texture").crc32,
                0xCBF4_3926,
                "the checksum's check value"
            );
        }
    }

    #[test]
    fn a_recording_that_names_no_reach_is_replayed_with_that_of_its_time() {
        let conditions = Conditions {
            program: "test".into(),
            device: "sim:".into(),
            texture: None,
            scene: None,
            seed: 1,
            config: Config::default(),
        };
        let mut value = serde_json::to_value(&conditions).expect("JSON");
        assert_eq!(value["config"]["safety"]["reach_m"], 1.0);
        let safety = value["config"]["safety"]
            .as_object_mut()
            .expect("an object");
        safety.remove("reach_m");
        let back: Conditions = serde_json::from_value(value).expect("an older recording");
        assert_eq!(back.config.safety.reach_m, 1.0e4);
    }

    /// Other programs write and read the same version, with and without the scene.
    #[test]
    fn a_scene_is_named_and_fields_that_are_not_known_are_skipped() {
        let scene = TextureInfo::of("a scene of 2 surfaces", b"123456789");
        let conditions = Conditions {
            program: "test".into(),
            device: "sim:".into(),
            texture: None,
            scene: Some(scene.clone()),
            seed: 1,
            config: Config::default(),
        };
        let mut value = serde_json::to_value(&conditions).expect("JSON");
        assert_eq!(value["scene"]["crc32"], 0xCBF4_3926_u32);
        value["of_a_later_program"] = 1.into();
        let back: Conditions = serde_json::from_value(value.clone()).expect("skipped");
        assert_eq!(back.scene, Some(scene));
        let fields = value.as_object_mut().expect("an object");
        fields.remove("scene");
        let back: Conditions = serde_json::from_value(value).expect("the scene may be absent");
        assert_eq!(back.scene, None);
        let without = serde_json::to_string(&back).expect("JSON");
        assert!(!without.contains("\"scene\""), "{without}");
    }
}
