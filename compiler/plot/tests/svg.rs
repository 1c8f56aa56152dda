//! The SVG of a canvas.

use asperity_plot::{Canvas, Marker, Rect, Stroke, TextStyle, ink};

/// Claim: the SVG is well-formed XML with one element for each thing drawn, its text readable
/// as it was given; a canvas that does not record has no SVG.
#[test]
fn what_is_drawn_is_recorded_as_well_formed_xml() {
    let mut canvas = Canvas::recording(200, 100).unwrap();
    canvas.line(
        &[(0.0, 0.0), (50.0, 20.0), (90.0, 5.0)],
        Stroke::new(ink::BLUE, 2.0).dashed(),
        None,
    );
    canvas.marker(
        (60.0, 60.0),
        Marker::Circle,
        8.0,
        Some(ink::GREEN.alpha(128)),
        None,
    );
    canvas.fill_rect(Rect::new(5.0, 70.0, 30.0, 10.0), ink::GRID);
    canvas.text(
        "a < b & c, 1 + z⁻¹",
        (100.0, 50.0),
        &TextStyle::new(20.0).upwards(),
    );
    let svg = canvas.svg().unwrap();
    let document = roxmltree::Document::parse(&svg).unwrap();
    let count = |name| {
        document
            .descendants()
            .filter(|n| n.has_tag_name(("http://www.w3.org/2000/svg", name)))
            .count()
    };
    assert_eq!((count("path"), count("rect"), count("text")), (2, 2, 1));
    let text = document
        .descendants()
        .find(|n| n.is_text() && n.text().unwrap().contains('z'));
    assert_eq!(text.unwrap().text(), Some("a < b & c, 1 + z⁻¹"));
    assert!(Canvas::new(10, 10).unwrap().svg().is_none());
}
