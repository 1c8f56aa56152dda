//! Names in scripts that the embedded type face cannot set.

use asperity_plot::{Canvas, TextStyle};

fn drawn(text: &str) -> (Vec<u8>, f32) {
    let mut canvas = Canvas::new(400, 60).expect("a canvas");
    let style = TextStyle::new(24.0);
    canvas.text(text, (10.0, 40.0), &style);
    let width = canvas.text_width(text, &style);
    (canvas.png().expect("a picture"), width)
}

#[test]
fn a_name_is_drawn_as_it_is_spelt_and_takes_that_width() {
    for (name, spelt) in [
        ("木材", "Mu Cai"),
        ("خشب", "khshb"),
        ("cork 🔥", "cork fire"),
        ("\u{f8ff}", "U+F8FF"),
    ] {
        assert!(drawn(name) == drawn(spelt), "{name}");
    }
    // A character that no face has is drawn as a box, which these are not.
    assert!(drawn("木材").0 != drawn("火力").0);
}
