//! The import takes strokes as hands make them.

use asperity::{
    pipeline::Pipeline,
    sources::{builtin, recording},
};
use asperity_experiments::import_accuracy::{self, Sensors, Strokes, Until};
use asperity_recording::{segments::Segments, signal::quantile::median};
use asperity_tests::size::sized;

#[test]
fn free_strokes_give_a_texture_although_they_are_hardly_ever_steady() {
    let texture = builtin::texture();
    let stroked_s = sized("seconds of free strokes", 8.0, 20.0);
    let most_db = sized("median error of the cells, dB", 3.0, 2.0);
    let performance =
        import_accuracy::perform(&texture, Strokes::Free, Until::Strokes(stroked_s), 3)
            .expect("it renders");
    let folder = tempfile::tempdir().expect("a folder");
    let sensors = Sensors::seeded(3);
    import_accuracy::record(&performance, &texture, &sensors, 3, folder.path()).expect("room");
    let analysis =
        recording::analyse(folder.path(), false, &mut Pipeline::default()).expect("a texture");
    let covered_s = |is_steady: bool| {
        let segments = analysis.strokes.segments.iter();
        let kind = Segments {
            segments: segments
                .filter(|s| s.is_steady == is_steady)
                .cloned()
                .collect(),
            ..Segments::default()
        };
        kind.covered_s()
    };
    let comparison = import_accuracy::compare(&texture, &performance, &sensors, &analysis);
    let median_db = median(comparison.cells.iter().map(|cell| cell.error_db));
    println!(
        "{:.1} s steady, {:.1} s changing: {median_db:.2} dB in {} cells",
        covered_s(true),
        covered_s(false),
        comparison.cells.len()
    );
    assert!(covered_s(true) < 0.4 * stroked_s && covered_s(false) > covered_s(true));
    assert!(comparison.cells.len() >= 8 && median_db < most_db);
}
