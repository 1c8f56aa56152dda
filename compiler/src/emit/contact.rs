//! From a contact law in SI units to the section `CONT`, and back.

use asperity_formats::{self as formats, ContactParts, EncodeError, FormatError};
use asperity_texture::model::{Adhesion, ContactLaw, Drag, Imprint, Relaxation, SpringPoint, Wall};

/// A law in the numbers of the format.
#[derive(Debug, Clone)]
pub(super) struct LoweredLaw {
    /// Everything but the spring.
    numbers: ContactParts<'static>,
    spring: Vec<formats::SpringPoint>,
}

impl LoweredLaw {
    /// Lowers a law.
    ///
    /// # Errors
    /// [`FormatError::Invalid`] for a spring out of range, or one that falls.
    pub(super) fn of(law: &ContactLaw) -> Result<Self, EncodeError> {
        let relaxation = law.relaxation.map(|part| formats::Relaxation {
            stiffness_n_m: part.stiffness_n_m as f32,
            time_s: part.time_s as f32,
        });
        let imprint = law.imprint.map(|part| formats::Imprint {
            yield_m: (part.yield_mm / 1000.0) as f32,
            share: part.share as f32,
            heal: part.heal as f32,
            recovery_s: part.recovery_s as f32,
        });
        let drag = law.drag.map(|part| formats::Drag {
            viscous_n_s_m2: part.viscous_n_s_m2 as f32,
            plough_n_m: part.plough_n_m as f32,
        });
        let adhesion = law.adhesion.map(|part| formats::Adhesion {
            pull_n: part.pull_n as f32,
            stiffness_n_m: part.stiffness_n_m as f32,
        });
        Ok(Self {
            numbers: ContactParts {
                damping_s_m: law.damping_s_m as f32,
                relaxation: relaxation.unwrap_or_default(),
                imprint: imprint.unwrap_or_default(),
                drag: drag.unwrap_or_default(),
                adhesion: adhesion.unwrap_or_default(),
                spring: &[],
            },
            spring: spring(law)?,
        })
    }

    /// The parts to encode.
    pub(super) fn parts(&self) -> ContactParts<'_> {
        ContactParts {
            spring: &self.spring,
            ..self.numbers
        }
    }
}

/// The stiffness of `SURF`: the steepest slope of the spring, or the wall's own, N/m.
pub(super) fn stiffness_n_m(wall: &Wall, law: Option<&ContactLaw>) -> f64 {
    let steepest = law.and_then(ContactLaw::steepest_n_m);
    steepest.unwrap_or(wall.stiffness_n_m)
}

/// The shape of a spring: its forces over its steepest slope.
fn spring(law: &ContactLaw) -> Result<Vec<formats::SpringPoint>, EncodeError> {
    let steepest = law.steepest_n_m().unwrap_or(0.0);
    let mut last = formats::SpringPoint::default();
    let mut points = Vec::with_capacity(law.spring.len());
    for (index, point) in law.spring.iter().enumerate() {
        let shape_m = point.force_n / steepest;
        let code = formats::SpringPoint::nearest(point.depth_mm / 1000.0, shape_m);
        let mut code = code.ok_or(EncodeError::Rejected(FormatError::Invalid {
            field: "contact.spring.depth_m",
            index: index as u32,
            value: point.depth_mm / 1000.0,
            rule: "0 to 0.0655 m, with a force that rises from 0",
        }))?;
        // Rounding may make the steepest line a micrometre too steep.
        let most = last.shape_code + code.depth_code.saturating_sub(last.depth_code);
        if code.shape_code == most + 1 {
            code.shape_code = most;
        }
        points.push(code);
        last = code;
    }
    Ok(points)
}

/// The law that an asset holds, and its wall.
pub(super) fn raise(asset: &formats::Asset<'_>) -> (Wall, Option<ContactLaw>) {
    let coupling = asset.coupling();
    let mut wall = Wall {
        stiffness_n_m: f64::from(coupling.stiffness_n_m),
        damping_n_s_m: f64::from(coupling.damping_n_s_m),
    };
    let law = asset.contact().map(|law| {
        let (relaxation, imprint) = (&law.relaxation, &law.imprint);
        let (drag, adhesion) = (&law.drag, &law.adhesion);
        ContactLaw {
            spring: law
                .points()
                .map(|point| SpringPoint {
                    depth_mm: 1000.0 * point.depth_m(),
                    force_n: wall.stiffness_n_m * point.shape_m(),
                })
                .collect(),
            damping_s_m: law.damping_s_m.into(),
            relaxation: (relaxation.stiffness_n_m > 0.0).then(|| Relaxation {
                stiffness_n_m: relaxation.stiffness_n_m.into(),
                time_s: relaxation.time_s.into(),
            }),
            imprint: (imprint.share > 0.0).then(|| Imprint {
                yield_mm: 1000.0 * f64::from(imprint.yield_m),
                share: imprint.share.into(),
                heal: imprint.heal.into(),
                recovery_s: imprint.recovery_s.into(),
            }),
            drag: (drag.viscous_n_s_m2 > 0.0 || drag.plough_n_m > 0.0).then(|| Drag {
                viscous_n_s_m2: drag.viscous_n_s_m2.into(),
                plough_n_m: drag.plough_n_m.into(),
            }),
            adhesion: (adhesion.pull_n > 0.0).then(|| Adhesion {
                pull_n: adhesion.pull_n.into(),
                stiffness_n_m: adhesion.stiffness_n_m.into(),
            }),
        }
    });
    if let Some(slope) = law.as_ref().and_then(ContactLaw::stiffness_n_m) {
        wall.stiffness_n_m = slope;
    }
    (wall, law)
}
