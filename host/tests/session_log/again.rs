//! Sessions rendered again are bit-identical.

use asperity_host::session_log::{Comparison, Ending, TextureInfo, render_again, start};

use super::session::{Shared, asset, conditions, entries, other, read};

#[test]
fn a_session_with_two_textures_is_rendered_again_to_the_bit() {
    let entries = entries(6000);
    assert!(entries.iter().filter(|entry| entry.next_texture).count() == 1);
    let shared = Shared::default();
    let (mut recorder, writing) = start(shared.clone(), &conditions(), 16_384).expect("a thread");
    writing.announce(TextureInfo::of("other", other()));
    entries.iter().for_each(|entry| recorder.push(*entry));
    drop(recorder);
    let summary = writing.finish().expect("written");
    assert_eq!((summary.recorded, summary.lost), (6000, 0));

    let bytes = shared.0.lock().expect("no panic").clone();
    let recording = read(&bytes).expect("a recording");
    assert_eq!(recording.ending, Ending::Whole(summary));
    assert_eq!(recording.conditions, conditions());
    assert!(
        recording
            .entries
            .iter()
            .zip(&entries)
            .all(|(read, wrote)| read.has_bits_of(wrote))
    );
    let comparison = render_again(&recording, asset).expect("rendered");
    assert!(
        comparison.is_same() && comparison.compared == 6000,
        "{comparison:?}"
    );

    // The comparison can fail: in one bit of one force, and with another seed.
    let mut touched = recording.clone();
    let force = &mut touched.entries[4000].force_n[2];
    *force = f32::from_bits(force.to_bits() ^ 1);
    let comparison = render_again(&touched, asset).expect("rendered");
    assert_eq!(
        (comparison.different, comparison.first.expect("one").entry),
        (1, 4000)
    );
    let mut reseeded = recording.clone();
    reseeded.conditions.seed += 1;
    assert!(render_again(&reseeded, asset).expect("rendered").different > 1000);
    // What follows a lost tick is not compared: the runtime was given something else.
    let mut gap = recording.clone();
    drop(gap.entries.drain(3000..3003));
    gap.entries[3000].lost_before = 3;
    let comparison = render_again(&gap, asset).expect("rendered");
    let wanted = Comparison {
        compared: 3000,
        not_compared: 2997,
        ..Comparison::default()
    };
    assert_eq!((comparison, comparison.is_same()), (wanted, false));
    assert!(
        render_again(&recording, |_| None).is_err(),
        "no bytes, no comparison"
    );
    assert!(
        render_again(&recording, |_| Some(other().to_vec())).is_err(),
        "other bytes"
    );

    println!("{:.1} bytes a tick", bytes.len() as f64 / 6000.0);
}
