//! Hardness of woods.
//!
//! The model heard a few woods tapped; measured hardness ranks the others. Side hardness at 12 % moisture (Janka, ASTM
//! D143), from the Wood Handbook of the Forest Products Laboratory (FPL-GTR-282, tables 5-3 and 5-5), and approximate
//! figures from dealers for woods that it lacks.

/// Woods, sorted, and the force that presses half a ball of 11.28 mm in, lbf.
const JANKA: &[(&str, f64)] = &[
    ("acacia", 1700.0),
    ("alder", 590.0),
    ("apple wood", 1730.0),
    ("ash wood", 1320.0),
    ("aspen", 350.0),
    ("balsa", 80.0),
    ("bamboo", 1380.0),
    ("basswood", 410.0),
    ("beech", 1300.0),
    ("birch", 1260.0),
    ("black cherry", 950.0),
    ("black locust", 1700.0),
    ("black walnut", 1010.0),
    ("boxwood", 2840.0),
    ("brazilian walnut", 3680.0),
    ("bubinga", 2410.0),
    ("cedar", 350.0),
    ("cherry wood", 950.0),
    ("chestnut wood", 540.0),
    ("cottonwood", 430.0),
    ("cypress", 510.0),
    ("douglas fir", 710.0),
    ("eastern white pine", 380.0),
    ("ebony", 3080.0),
    ("elm", 830.0),
    ("fir", 490.0),
    ("hard maple", 1450.0),
    ("hemlock", 540.0),
    ("hickory", 1820.0),
    ("hornbeam", 1860.0),
    ("ipe", 3680.0),
    ("iroko", 1260.0),
    ("jarrah", 1910.0),
    ("jatoba", 2350.0),
    ("kauri", 980.0),
    ("larch", 830.0),
    ("lignum vitae", 4500.0),
    ("lime wood", 410.0),
    ("linden", 410.0),
    ("mahogany", 800.0),
    ("maple", 1450.0),
    ("meranti", 800.0),
    ("merbau", 1500.0),
    ("oak", 1290.0),
    ("olive wood", 2700.0),
    ("padauk", 1725.0),
    ("paulownia", 300.0),
    ("pear wood", 1660.0),
    ("pine", 560.0),
    ("plum wood", 1550.0),
    ("poplar", 540.0),
    ("purpleheart", 2520.0),
    ("red cedar", 350.0),
    ("red oak", 1290.0),
    ("redwood", 450.0),
    ("rosewood", 2440.0),
    ("rubberwood", 960.0),
    ("sapele", 1510.0),
    ("silver birch", 1210.0),
    ("spruce", 510.0),
    ("sugar maple", 1450.0),
    ("sycamore", 770.0),
    ("teak", 1000.0),
    ("walnut", 1010.0),
    ("wenge", 1630.0),
    ("western red cedar", 350.0),
    ("white oak", 1360.0),
    ("white pine", 380.0),
    ("willow", 400.0),
    ("yellow pine", 870.0),
    ("yellow poplar", 540.0),
    ("yew", 1600.0),
    ("zebrawood", 1575.0),
];

/// The names of woods whose hardness is known.
pub fn woods() -> impl Iterator<Item = &'static str> {
    JANKA.iter().map(|(name, _)| *name)
}

/// Ends of a name that say that it is of the wood: "oak wood", "cherry timber".
const WOOD: [&str; 3] = [" wood", " timber", " lumber"];

/// Side hardness of a wood, lbf.
#[must_use]
pub fn janka(name: &str) -> Option<f64> {
    let line = |name: &str| JANKA.binary_search_by(|(known, _)| (*known).cmp(name)).ok();
    let bare = WOOD.iter().find_map(|end| name.strip_suffix(end));
    let found = line(name)
        .or_else(|| line(bare?))
        .or_else(|| line(&format!("{} wood", bare?)));
    Some(JANKA[found?].1)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn woods_are_sorted_and_found() {
        assert!(JANKA.windows(2).all(|pair| pair[0].0 < pair[1].0));
        assert_eq!(janka("oak"), janka("oak wood"));
        assert_eq!(janka("cherry timber"), janka("cherry wood"));
        assert_eq!(janka("cherry"), None, "a fruit");
        assert!(janka("ebony") > janka("balsa"));
    }
}
