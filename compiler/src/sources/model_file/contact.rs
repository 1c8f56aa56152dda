//! The contact law of a document: every number in its range, a spring that rises.

use super::check::{in_range, length};
use asperity_formats::limits;
use asperity_io::diagnostic::Fault;
use asperity_texture::model::ContactLaw;

/// Deepest point of a spring, mm.
const DEEPEST_MM: f32 = 65.5;
/// Least distance of two points, mm: an asset counts micrometres.
const STEP_MM: f64 = 0.0009;

/// Checks a law.
///
/// # Errors
/// The first field that an asset could not hold.
pub(super) fn check(law: &ContactLaw) -> Result<(), Fault> {
    const ABOVE_0: f32 = f32::MIN_POSITIVE;
    spring(law)?;
    let stiffness = (ABOVE_0, limits::MAX_STIFFNESS_N_M);
    let damping = (0.0, limits::MAX_LOAD_DAMPING_S_M);
    in_range("contact.damping_s_m", law.damping_s_m, damping)?;
    if let Some(part) = &law.relaxation {
        let field = |key: &str| format!("contact.relaxation.{key}");
        in_range(&field("stiffness_n_m"), part.stiffness_n_m, stiffness)?;
        in_range(&field("time_s"), part.time_s, limits::RELAXATION_S)?;
    }
    if let Some(part) = &law.imprint {
        let field = |key: &str| format!("contact.imprint.{key}");
        let deepest_mm = 1000.0 * limits::MAX_YIELD_M;
        in_range(&field("yield_mm"), part.yield_mm, (0.0, deepest_mm))?;
        in_range(&field("share"), part.share, (ABOVE_0, 1.0))?;
        in_range(&field("heal"), part.heal, (0.0, 1.0))?;
        let recovery = (0.0, limits::MAX_RECOVERY_S);
        in_range(&field("recovery_s"), part.recovery_s, recovery)?;
    }
    if let Some(part) = &law.drag {
        let field = |key: &str| format!("contact.drag.{key}");
        let viscous = (0.0, limits::MAX_VISCOUS_N_S_M2);
        in_range(&field("viscous_n_s_m2"), part.viscous_n_s_m2, viscous)?;
        let plough = (0.0, limits::MAX_PLOUGH_N_M);
        in_range(&field("plough_n_m"), part.plough_n_m, plough)?;
        if part.viscous_n_s_m2 == 0.0 && part.plough_n_m == 0.0 {
            let remedy = "leave it out, or state viscous_n_s_m2 or plough_n_m";
            return Err(Fault::new("both numbers are 0", remedy).field("contact.drag"));
        }
    }
    if let Some(part) = &law.adhesion {
        let field = |key: &str| format!("contact.adhesion.{key}");
        in_range(&field("pull_n"), part.pull_n, (ABOVE_0, limits::MAX_PULL_N))?;
        in_range(&field("stiffness_n_m"), part.stiffness_n_m, stiffness)?;
    }
    Ok(())
}

fn spring(law: &ContactLaw) -> Result<(), Fault> {
    let points = &law.spring;
    length("contact.spring", points.len(), 0, limits::MAX_SPRING_POINTS)?;
    let (mut depth_mm, mut force_n) = (0.0, 0.0);
    for (index, point) in points.iter().enumerate() {
        let field = |key: &str| format!("contact.spring[{index}].{key}");
        let depths = ((depth_mm + STEP_MM) as f32, DEEPEST_MM);
        in_range(&field("depth_mm"), point.depth_mm, depths)?;
        // A force may be that of the point before it, whatever f32 makes of it.
        let forces = ((force_n * (1.0 - 1e-6)) as f32, limits::MAX_FORCE_N);
        in_range(&field("force_n"), point.force_n, forces)?;
        (depth_mm, force_n) = (point.depth_mm, point.force_n);
    }
    if !points.is_empty() && force_n == 0.0 {
        let remedy = "give forces that rise from 0, or leave the spring out";
        return Err(Fault::new("every force is 0", remedy).field("contact.spring"));
    }
    if points
        .windows(2)
        .any(|pair| pair[1].force_n < pair[0].force_n)
    {
        let what = "a force is below the one before it";
        let fault = Fault::new(what, "sort the points; forces do not fall with depth");
        return Err(fault.field("contact.spring"));
    }
    let steepest = law.steepest_n_m().unwrap_or(1.0);
    let most = limits::MAX_STIFFNESS_N_M;
    if steepest > f64::from(most) {
        let what = format!("{steepest:.0} N/m at its steepest, must be at most {most}");
        let remedy = "move the points apart in depth; its units are mm and N";
        return Err(Fault::new(what, remedy).field("contact.spring"));
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::super::{from_json, to_json};
    use crate::sources::builtin;
    use serde_json::{Value, json};

    fn document(contact: &Value) -> Vec<u8> {
        let mut document: Value = serde_json::from_slice(&to_json(&builtin::texture())).unwrap();
        assert_eq!(document.get("contact"), None);
        document["contact"] = contact.clone();
        serde_json::to_vec(&document).unwrap()
    }

    fn whole() -> Value {
        json!({
            "spring": [{"depth_mm": 3.3, "force_n": 0.3}, {"depth_mm": 6.0, "force_n": 0.3},
                {"depth_mm": 9.0, "force_n": 2.1}],
            "damping_s_m": 0.7,
            "relaxation": {"stiffness_n_m": 90.0, "time_s": 1.5},
            "imprint": {"yield_mm": 2.0, "share": 0.3, "heal": 0.1, "recovery_s": 2.5},
            "drag": {"viscous_n_s_m2": 100.0, "plough_n_m": 5.0},
            "adhesion": {"pull_n": 0.1, "stiffness_n_m": 60.0},
        })
    }

    #[test]
    fn a_contact_law_reads_back_to_the_bit_and_states_the_wall() {
        let texture = from_json(&document(&whole())).unwrap();
        assert!((texture.wall.stiffness_n_m - 600.0).abs() < 1e-9);
        let text = to_json(&texture);
        assert_eq!(
            serde_json::from_slice::<Value>(&text).unwrap()["contact"],
            whole()
        );
        let back = from_json(&text).unwrap();
        assert_eq!((back.contact, back.wall), (texture.contact, texture.wall));
    }

    #[test]
    fn a_contact_law_out_of_range_is_refused_by_its_field() {
        let cases: [(&str, Value, &str); 14] = [
            ("/spring/0/depth_mm", json!(0.0), "spring[0].depth_mm"),
            ("/spring/1/depth_mm", json!(3.3), "spring[1].depth_mm"),
            ("/spring/2/depth_mm", json!(66.0), "spring[2].depth_mm"),
            ("/spring/1/force_n", json!(0.2), "spring[1].force_n"),
            (
                "/spring",
                json!([{"depth_mm": 1.0, "force_n": 0.0}]),
                "spring",
            ),
            (
                "/spring",
                json!([{"depth_mm": 0.01, "force_n": 900.0}]),
                "spring",
            ),
            ("/damping_s_m", json!(101.0), "damping_s_m"),
            ("/relaxation/time_s", json!(0.001), "relaxation.time_s"),
            ("/imprint/share", json!(0.0), "imprint.share"),
            ("/imprint/heal", json!(1.1), "imprint.heal"),
            ("/imprint/recovery_s", json!(61.0), "imprint.recovery_s"),
            ("/drag", json!({}), "drag"),
            ("/drag/plough_n_m", json!(-1.0), "drag.plough_n_m"),
            ("/adhesion/pull_n", json!(0.0), "adhesion.pull_n"),
        ];
        for (place, value, field) in cases {
            let mut contact = whole();
            *contact.pointer_mut(place).unwrap() = value;
            let fault = from_json(&document(&contact)).unwrap_err();
            assert_eq!(fault.field, format!("contact.{field}"), "{fault}");
        }
        let unknown = from_json(&document(&json!({"springs": []}))).unwrap_err();
        assert!(unknown.what.contains("unknown field"), "{unknown}");
    }
}
