//! Slices assemble what `model_at` computes at once, bit for bit.

extern crate std;

use super::{follower::Follower, onset::Onset};
use crate::{
    arithmetic::{Fixed, Float},
    capacity::HostCapacities,
    model::filter::Model,
    quantity::Quantity,
    render_arithmetic::RenderArithmetic,
    texture::Texture,
};
use asperity_formats::{Asset, Library};
use std::boxed::Box;

/// Order 20 with B(z), and orders 20 and 4 with a zero at Nyquist.
const LIBRARY: &[u8] = include_bytes!("../../tests/data/textures.aspl");

/// Speeds, mm/s, and forces, N: at rest, inside, on the border and beyond it.
const QUERIES: [(f32, f32); 9] = [
    (0.0, 0.0),
    (3.0, 0.02),
    (40.0, 0.5),
    (90.0, 1.0),
    (133.7, 2.3),
    (200.0, 3.0),
    (55.5, 0.0),
    (0.0, 1.7),
    (1.0e4, 50.0),
];

/// Ticks that take a query to its effect, whatever the texture, at one tick a sample.
const CYCLE_TICKS: u32 = 24;

fn compare<A: RenderArithmetic>(asset: &Asset<'_>, ticks_per_sample: u8) {
    let mut texture = Box::new(Texture::<HostCapacities, A>::new());
    let rate_hz = asset.grid().sample_rate_hz() * f32::from(ticks_per_sample);
    texture.load(asset, rate_hz).unwrap();
    for (speed_mm_s, force_n) in QUERIES {
        let (speed, force) = (Quantity::of(speed_mm_s), Quantity::of(force_n));
        let whole = texture.models.model_at(speed, force);
        let mut follower = Follower::START;
        let (mut onset, mut model) = (Onset::Begun, Model::SILENT);
        let mut queries = 0;
        for _ in 0..CYCLE_TICKS * u32::from(ticks_per_sample) {
            let way = || Quantity::whole(1);
            let gain = || Quantity::whole(1);
            follower.step(
                &texture.models,
                &texture.plan,
                way,
                gain,
                &mut onset,
                &mut model,
            );
            if follower.takes_query() {
                follower.query(&texture.models, &texture.plan, speed, force);
                queries += 1;
            }
        }
        assert!(queries > 1);
        assert!(
            model == whole,
            "{speed_mm_s} mm/s, {force_n} N at {ticks_per_sample} ticks a sample"
        );
    }
}

fn compare_all<A: RenderArithmetic>() {
    let library = Library::parse(LIBRARY).unwrap();
    assert!(library.index().len() >= 3);
    for index in 0..library.index().len() {
        for ticks_per_sample in [1, 2, 5, 20] {
            compare::<A>(&library.asset(index).unwrap(), ticks_per_sample);
        }
    }
}

#[test]
fn slices_assemble_the_whole_model_in_floats() {
    compare_all::<Float>();
}

#[test]
fn slices_assemble_the_whole_model_in_fixed_point() {
    compare_all::<Fixed>();
}
