//! Edits along the sliders: through the latent space as far as it goes, the rest after decoding.

use super::{
    attribute_cache::AttributeCache,
    latent_editor::LatentEditor,
    solve::{along, reach},
};
use crate::{
    edit_memory::{AXES, Axis, Latents, Sliders},
    learned::Latent,
    pipeline::Request,
};
use asperity_io::diagnostic::Fault;
use asperity_texture::model::{attributes::Attributes, shift::Shift};

/// Times that a way through the latent space is corrected by what is kept at its end.
const CORRECTIONS: usize = 4;
/// Times that what is missing there is moved after decoding.
const CLOSINGS: usize = 4;
/// Distance at which no more is corrected, steps of a slider.
const NEAR: f64 = 0.5;
/// Steps that a correction may aim beyond what was asked for.
const FARTHER: f64 = 30.0;
/// Steps by which the centroid of the vibration may miss, before a way through the latent space is
/// given up for one that leaves the centroid as it is.
const SHARP: f64 = 2.5;

/// Steps that an edit missed, in the order of [`AXES`].
type Missing = [f64; 4];

fn worst(missing: &Missing) -> f64 {
    missing.iter().fold(0.0, |most: f64, x| most.max(x.abs()))
}

/// Sum of squares over all attributes: an error that cannot be closed does not hide the others.
fn sum_of_squares(missing: &Missing) -> f64 {
    missing.iter().map(|x| x * x).sum()
}

impl LatentEditor<'_> {
    /// The latents after an edit. Each slider moves its attribute by as many steps of the scale and
    /// leaves the others where they are: level and centroid of the vibration lie in what sliding was
    /// decoded from, the centroid of the taps in what tapping was, μ in friction.
    ///
    /// The latents go the shortest way among the model's materials. What they miss, for want of
    /// materials or because the asset keeps fewer vertices than are decoded, is moved after decoding,
    /// as the grammar of a prompt does. The centroid of the vibration has no such move.
    ///
    /// # Errors
    /// As [`kept_attributes`](Self::kept_attributes).
    pub fn edited(
        &self,
        latents: &Latents,
        sliders: &Sliders,
        request: &Request,
    ) -> Result<Latents, Fault> {
        self.searched(
            latents,
            sliders,
            &AttributeCache::new(self.prompt_compiler, request),
        )
    }

    /// The same, with a cache that may know these latents already.
    pub(super) fn searched(
        &self,
        latents: &Latents,
        sliders: &Sliders,
        cache: &AttributeCache<'_>,
    ) -> Result<Latents, Fault> {
        if sliders.are_still() {
            return Ok(*latents);
        }
        let before = cache.kept(latents)?;
        let through = self.through(latents, sliders, cache, &before)?;
        let (missing, edited) = self.closed(through, sliders, cache, &before)?;
        let sharp = missing[Axis::Sharp as usize].abs();
        if sharp > SHARP && sliders.sharper == 0.0 {
            let (plain, shifted) = self.closed(*latents, sliders, cache, &before)?;
            if worst(&plain) < worst(&missing) {
                return Ok(shifted);
            }
        }
        Ok(edited)
    }

    /// The latents after a way through the latent space, corrected by what is kept at its end.
    fn through(
        &self,
        latents: &Latents,
        sliders: &Sliders,
        cache: &AttributeCache<'_>,
        before: &Attributes,
    ) -> Result<Latents, Fault> {
        let mut aim = *sliders;
        let mut best = (f64::INFINITY, *latents);
        for _ in 0..CORRECTIONS {
            let edited = self.moved(latents, sliders, &aim, cache)?;
            let missing = self.missing_from(&cache.kept(&edited)?, sliders, before);
            // What is missing of the others can be moved after decoding.
            let sharp = missing[Axis::Sharp as usize].abs();
            let distance = sharp.max(0.5 * worst(&missing));
            if distance < best.0 {
                best = (distance, edited);
            }
            if worst(&missing) < NEAR {
                break;
            }
            for (axis, missing) in AXES.into_iter().zip(missing) {
                let furthest = sliders.along(axis).abs() + FARTHER;
                let step = aim.along(axis) + missing;
                *aim.along_mut(axis) = step.clamp(-furthest, furthest);
            }
        }
        Ok(best.1)
    }

    /// The latents with a shift that moves what is still missing, and what is missing then.
    fn closed(
        &self,
        latents: Latents,
        sliders: &Sliders,
        cache: &AttributeCache<'_>,
        before: &Attributes,
    ) -> Result<(Missing, Latents), Fault> {
        let mut now = latents;
        let mut best: Option<(Missing, Latents)> = None;
        for _ in 0..=CLOSINGS {
            let after = cache.kept(&now)?;
            let missing = self.missing_from(&after, sliders, before);
            if best.is_none_or(|(least, _)| sum_of_squares(&missing) < sum_of_squares(&least)) {
                best = Some((missing, now));
            }
            let closable = AXES.map(|axis| match axis {
                Axis::Sharp => 0.0,
                _ => missing[axis as usize],
            });
            if worst(&closable) < NEAR {
                break;
            }
            let more = self.scale.shift(&after, closable);
            now.shift = Shift {
                rough_db: now.shift.rough_db + more.rough_db,
                slippery: now.shift.slippery + more.slippery,
                hard: now.shift.hard + more.hard,
            };
        }
        Ok(best.unwrap_or(([0.0; 4], latents)))
    }

    fn missing_from(&self, after: &Attributes, sliders: &Sliders, before: &Attributes) -> Missing {
        AXES.map(|axis| {
            let places = self
                .scale
                .place(axis, after)
                .zip(self.scale.place(axis, before));
            places.map_or(0.0, |(after, before)| {
                sliders.along(axis) - (after - before)
            })
        })
    }

    /// The latents after a move to these aims, of the parts that the sliders ask to move. Attributes
    /// are those of what is decoded.
    fn moved(
        &self,
        latents: &Latents,
        sliders: &Sliders,
        aim: &Sliders,
        cache: &AttributeCache<'_>,
    ) -> Result<Latents, Fault> {
        let before = cache.decoded(latents)?;
        let mut edited = *latents;
        let asked = |axis: Axis| sliders.along(axis) != 0.0;
        let target = |axis: Axis| {
            let place = self.scale.place(axis, &before);
            place.map(|place| place + aim.along(axis))
        };
        let gradient = |axis: Axis| self.scale.gradients[axis as usize].as_slice();
        if asked(Axis::Rough) || asked(Axis::Sharp) {
            let axes = [Axis::Rough, Axis::Sharp];
            if let [Some(rough), Some(sharp)] = axes.map(target) {
                let seen = |z: &Latent| {
                    let slide = Latents {
                        slide: *z,
                        ..*latents
                    };
                    self.seen(&slide, &axes, cache)
                };
                let (start, gradients) = (&latents.slide, axes.map(gradient));
                edited.slide = reach(start, &gradients, &self.metric, &[rough, sharp], seen)?;
            }
        }
        if asked(Axis::Hard)
            && let Some(hard) = target(Axis::Hard)
        {
            let seen = |z: &Latent| {
                let tap = Latents {
                    tap: *z,
                    ..*latents
                };
                self.seen(&tap, &[Axis::Hard], cache)
            };
            let gradients = [gradient(Axis::Hard)];
            edited.tap = reach(&latents.tap, &gradients, &self.metric, &[hard], seen)?;
        }
        if asked(Axis::Slippery)
            && let Some(slippery) = target(Axis::Slippery)
        {
            let factor = libm::exp(-latents.shift.slippery);
            let seen = |z: &Latent| {
                let attributes = Attributes {
                    mu: factor * cache.mu(z),
                    ..before
                };
                self.scale.place(Axis::Slippery, &attributes).unwrap_or(0.0)
            };
            let gradient = gradient(Axis::Slippery);
            edited.friction = along(&latents.friction, gradient, &self.metric, slippery, seen);
        }
        Ok(edited)
    }

    /// Places on the sliders of what latents decode to.
    fn seen(
        &self,
        latents: &Latents,
        axes: &[Axis],
        cache: &AttributeCache<'_>,
    ) -> Result<Option<Vec<f64>>, Fault> {
        let attributes = cache.decoded(latents)?;
        let places = axes.iter().map(|&axis| self.scale.place(axis, &attributes));
        Ok(places.collect())
    }
}
