//! Completion of one modality from the other.

use super::PROMPTS;
use asperity::{
    emit::raise,
    learned::{Present, complete, texture},
    model::{TapBank, mesh, tap_synthesis},
    signal::spectrum::trace_centroid_hz,
    sources::builtin,
};
use asperity_formats::Asset;

#[test]
fn taps_decoded_from_a_grid_fit_the_texture_they_complete() {
    let texture = builtin::texture();
    let taps = complete::taps_of_grid(PROMPTS.model(), &texture.grid, &texture.gains).unwrap();
    assert_eq!(taps.traces.len(), 13);
    let completed = asperity::model::TextureModel { taps, ..texture };
    let lowered = asperity::emit::lower::lower(&completed, None).unwrap();
    asperity::emit::verify::verify(&completed, &lowered.bytes).unwrap();
    assert_eq!(
        raise::raise(&Asset::parse(&lowered.bytes).unwrap())
            .taps
            .traces
            .len(),
        13
    );
}

/// Taps from the grids of materials, against those that the same latents decode to: the mean of all taps says
/// less.
#[test]
fn taps_completed_from_a_grid_are_those_of_its_material() {
    let fastest_hz = |taps: &TapBank| {
        let trace = taps.traces.last().expect("a trace");
        trace_centroid_hz(&trace.accel_m_s2, taps.sample_rate_hz).expect("a sound")
    };
    let anchors = &PROMPTS.model().description().anchors;
    let pairs: Vec<[f64; 2]> = anchors
        .iter()
        .step_by(17)
        .map(|anchor| {
            let whole = PROMPTS.texture(&anchor.name).expect("a name");
            let taps = complete::taps_of_grid(PROMPTS.model(), &whole.grid, &whole.gains).unwrap();
            [&whole.taps, &taps].map(|taps| fastest_hz(taps).ln())
        })
        .collect();
    let mean =
        |of: &dyn Fn(&[f64; 2]) -> f64| pairs.iter().map(of).sum::<f64>() / pairs.len() as f64;
    let middle = mean(&|[own, _]| *own);
    let error = mean(&|[own, completed]| (completed - own).abs());
    let baseline = mean(&|[own, _]| (own - middle).abs());
    println!("ln ratio {error:.3}, of the mean {baseline:.3}");
    assert!(
        error < 0.15 && error < 0.25 * baseline,
        "{error} against {baseline}"
    );
}

#[test]
fn a_tap_bank_alone_gives_a_whole_grid_and_a_harder_one_a_harder_texture() {
    let gains = builtin::texture().gains;
    let grid = |freq_hz| {
        let bank = tap_synthesis::bank(freq_hz, &gains);
        let description = PROMPTS.model().description();
        let channels = complete::tap_channels(&description.taps, &bank);
        let z = PROMPTS.model().encode(Present::Taps(&channels)).unwrap();
        texture::grid(&description.grid, &PROMPTS.model().decode_grid(&z).unwrap())
    };
    assert_eq!(mesh::check(&grid(200.0)), Ok(()));
    // What taps as soft as foam or as hard as steel come back as, through the latent.
    let back = |freq_hz| {
        let taps = complete::taps_of_grid(PROMPTS.model(), &grid(freq_hz), &gains).unwrap();
        trace_centroid_hz(&taps.traces[12].accel_m_s2, taps.sample_rate_hz).unwrap()
    };
    assert!(back(90.0) < back(340.0));
}
