//! Properties of a texture model by itself, on the built-in texture: mixtures as the runtime renders them, attributes,
//! and shifts of them.

use asperity::{
    emit::lower::lower,
    model::{
        attributes,
        mixture::{Field, places},
        shift::{adjust, scales, to},
    },
    signal::spectrum::{ArmaModel, log_spectral_distance_db},
    sources::builtin,
};
use asperity_formats::Asset;
use asperity_runtime::HostTexture;

#[test]
fn the_runtime_renders_the_same_model_everywhere() {
    let texture = builtin::texture();
    let lowered = lower(&texture, None).unwrap();
    let asset = Asset::parse(&lowered.bytes).unwrap();
    let mut slot = Box::new(HostTexture::new());
    slot.load(&asset, asset.grid().sample_rate_hz()).unwrap();
    let field = Field::new(&texture.grid);
    for (speed_mm_s, force_n) in places(&texture.grid) {
        let ours = field.model(&field.locate(speed_mm_s, force_n).unwrap());
        let filter = slot.filter_at(speed_mm_s as f32, force_n as f32);
        let monic = |c: &[f32]| {
            std::iter::once(1.0)
                .chain(c.iter().map(|&c| f64::from(c)))
                .collect()
        };
        let runtime = ArmaModel {
            a: monic(&filter.a),
            b: monic(&filter.b),
            level_m_s2: f64::from(filter.level_m_s2),
            ..ours.clone()
        };
        // Near rest, rounding in f32 leaves a small level where there is none.
        if ours.level_m_s2 > 1e-4 {
            let distance_db = log_spectral_distance_db(&ours, &runtime);
            assert!(
                distance_db < 0.02,
                "{speed_mm_s} mm/s, {force_n} N: {distance_db} dB"
            );
        }
    }
}

#[test]
fn twice_the_excitation_is_six_db_rougher_and_no_sharper() {
    let quiet = builtin::texture();
    let mut loud = quiet.clone();
    for vertex in &mut loud.grid.vertices {
        vertex.sigma_m_s2 *= 2.0;
    }
    let (quiet, loud) = (attributes::of(&quiet), attributes::of(&loud));
    let rise_db = loud.rough_db.unwrap() - quiet.rough_db.unwrap();
    assert!((rise_db - 20.0 * 2.0_f64.log10()).abs() < 1e-9);
    assert!((loud.sharp_hz.unwrap() - quiet.sharp_hz.unwrap()).abs() < 1e-9);
}

#[test]
fn a_meter_measures_each_texture_as_if_it_were_alone() {
    let first = builtin::texture();
    let mut other = first.clone();
    other.grid.sample_rate_hz = 2000.0;
    other.taps.sample_rate_hz = 20_000.0;
    let mut meter = attributes::Meter::default();
    for texture in [&first, &other, &other, &first] {
        assert_eq!(meter.of(texture), attributes::of(texture));
    }
    assert_ne!(attributes::of(&first), attributes::of(&other));
}

#[test]
fn a_texture_without_taps_has_no_hardness() {
    let mut texture = builtin::texture();
    texture.taps.traces.clear();
    assert_eq!(attributes::of(&texture).hard_hz, None);
}

#[test]
fn attributes_arrive_where_they_were_wanted_and_the_others_stay() {
    let before = builtin::texture();
    let old = attributes::of(&before);
    for (k, change) in [
        (0, 5.0),
        (0, -8.0),
        (1, 0.35),
        (1, -0.3),
        (2, 0.4),
        (2, -0.3),
    ] {
        let target = scales(&old)[k].expect("defined") + change;
        let mut wanted = [None; 3];
        wanted[k] = Some(target);
        let shift = to(&wanted, &old);
        let mut after = before.clone();
        adjust(&mut after, &shift);
        let new = scales(&attributes::of(&after));
        for (j, (new, old)) in new.iter().zip(scales(&old)).enumerate() {
            let expected = if j == k { Some(target) } else { old };
            let apart = new.zip(expected).map(|(x, y)| (x - y).abs());
            assert!(
                apart.is_some_and(|apart| apart < 0.03),
                "{k} {change}: {j} {apart:?}"
            );
        }
    }
}
