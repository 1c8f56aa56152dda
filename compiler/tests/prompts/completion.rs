//! One modality decides the other.

use super::PROMPTS;
use asperity::{
    builtin, learned::complete, mesh, raise, spectrum::trace_centroid_hz, tap_synthesis,
};
use asperity_formats::Asset;

#[test]
fn taps_decoded_from_a_grid_fit_the_texture_they_complete() {
    let texture = builtin::texture();
    let taps = complete::taps_of_grid(PROMPTS.model(), &texture.grid, &texture.gains).unwrap();
    assert_eq!(taps.traces.len(), 13);
    let completed = asperity::model::TextureModel { taps, ..texture };
    let lowered = asperity::lower::lower(&completed, None).unwrap();
    asperity::verify::verify(&completed, &lowered.bytes).unwrap();
    assert_eq!(
        raise::raise(&Asset::parse(&lowered.bytes).unwrap())
            .taps
            .traces
            .len(),
        13
    );
}

#[test]
fn a_tap_bank_alone_gives_a_whole_grid_and_a_harder_one_a_harder_texture() {
    let gains = builtin::texture().gains;
    let grid = |freq_hz| {
        let bank = tap_synthesis::bank(freq_hz, &gains);
        complete::grid_of_taps(PROMPTS.model(), &bank).unwrap()
    };
    assert_eq!(mesh::check(&grid(200.0)), Ok(()));
    // What taps as soft as foam or as hard as steel come back as, through the latent.
    let back = |freq_hz| {
        let taps = complete::taps_of_grid(PROMPTS.model(), &grid(freq_hz), &gains).unwrap();
        trace_centroid_hz(&taps.traces[12].accel_m_s2, taps.sample_rate_hz).unwrap()
    };
    assert!(back(90.0) < back(340.0));
}
