//! Notations of grades, as people write them.

use super::*;
use crate::words::normalise;

/// The first grade of a prompt, as it is shown.
fn shown(prompt: &str) -> Option<String> {
    let tokens = normalise(prompt);
    let context = Context::of(&tokens);
    (0..tokens.len()).find_map(|at| Some(read(&tokens[at..], context)?.1.to_string()))
}

#[test]
fn a_number_is_read_in_every_notation() {
    for (prompt, expected) in [
        ("P80 sandpaper", "P80"),
        ("sandpaper P 80", "P80"),
        ("80-grit sandpaper", "80 grit"),
        ("80grit paper", "80 grit"),
        ("sandpaper, grit 80", "80 grit"),
        ("sandpaper, grit: 80", "80 grit"),
        ("sandpaper with a grit size of 80", "80 grit"),
        ("#80 sandpaper", "80 grit"),
        ("grit P120", "P120"),
        ("a 1,000 grit whetstone", "1000 grit"),
        ("20-mesh sand", "20 mesh"),
        ("sand, mesh size 60", "60 mesh"),
        ("Shore A 60 rubber", "Shore A 60"),
        ("rubber, 60 Shore A", "Shore A 60"),
        ("60A Shore rubber", "Shore A 60"),
        ("rubber of Shore hardness A60", "Shore A 60"),
        ("30A silicone", "Shore A 30"),
        ("TPU 95A", "Shore A 95"),
        ("plastic, Shore D80", "Shore D 80"),
        ("plastic, Shore 80D", "Shore D 80"),
        ("rubber of Shore 60A", "Shore A 60"),
        ("75D durometer plastic", "Shore D 75"),
        ("durometer 40 rubber", "Shore A 40"),
        ("a mineral of Mohs hardness 7", "Mohs 7"),
        ("6.5 Mohs stone", "Mohs 6.5"),
        ("stone with hardness 3 on the Mohs scale", "Mohs 3"),
        ("steel, Ra 0.8", "Ra 0.8 µm"),
        ("Ra = 3.2 µm steel", "Ra 3.2 µm"),
        ("Ra 0,4 steel", "Ra 0.4 µm"),
        ("0.4µm Ra aluminium", "Ra 0.4 µm"),
        ("steel with a surface roughness of 6.3 microns", "Ra 6.3 µm"),
        ("63 µin Ra steel", "Ra 1.6002 µm"),
        ("400 thread count sheets", "400 thread count"),
        ("sheets with a thread count of 1,200", "1200 thread count"),
        ("600TC percale", "600 thread count"),
        ("15 denier tights", "15 denier"),
        ("1000D nylon", "1000 denier"),
        ("100 dtex polyester", "90 denier"),
        ("12 mm pile carpet", "12 mm pile"),
        ("a rug with a pile height of 3cm", "30 mm pile"),
        ("bastard file", "bastard cut"),
        ("a dead-smooth file", "dead smooth cut"),
        ("file, second cut", "second cut"),
        ("Swiss cut 00 file", "cut 00"),
        ("half-inch … 0.5 inch pile rug", "12.7 mm pile"),
        ("half-inch pile rug", "12.7 mm pile"),
        ("3/4 inch pile rug", "19.05 mm pile"),
        ("1 1/2\" pile rug", "38.1 mm pile"),
        ("half a millimetre pile rug", "0.5 mm pile"),
        ("1,5 cm pile rug", "15 mm pile"),
        ("P1,000 sandpaper", "P1000"),
        ("1 000 grit sandpaper", "1000 grit"),
        ("P1.000 sandpaper", "P1000"),
        ("steel, Ra 3.175", "Ra 3.175 µm"),
        ("P1k sandpaper", "P1000"),
        ("eighty-grit sandpaper", "80 grit"),
        ("four hundred thread count sheets", "400 thread count"),
        ("mesh 20 100 g of sand", "20 mesh"),
        ("14-wale corduroy", "14 wale"),
        ("sandpaper –80 grit", "80 grit"),
    ] {
        assert_eq!(shown(prompt).as_deref(), Some(expected), "{prompt}");
        assert_eq!(
            Grade::of(expected).map(|g| g.to_string()).as_deref(),
            Some(expected)
        );
    }
}

#[test]
fn other_numbers_are_none() {
    for prompt in [
        "3 mm thick rubber",
        "wire mesh 20 mm wide",
        "80 sheets of paper",
        "oak from 1870",
        "type 2 rubber",
        "A4 paper",
        "grit",
        "Mohs",
        "Shore A 400 rubber",
        "Shore 00 30 gel",
        "30 Shore 00 gel",
        "Shore OO 30 gel",
        "40 Shore C foam",
        "Shore E 40 foam",
        "a pile of 30 leaves",
        "2 threads of wool",
        "two mesh bags",
        "4D",
        "3D-printed plastic",
        "3D nylon",
    ] {
        assert_eq!(shown(prompt), None, "{prompt}");
    }
}
