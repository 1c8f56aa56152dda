//! Pattern classes, each with a synthesis of its own.

mod clear;
mod cloth;
mod heap;
mod hide;
mod lattice;
mod masonry;
mod metal;
mod mineral;
mod pile;
mod porous;
mod sheet;
mod tufts;
mod wood;

use crate::{appearance::Appearance, surface::Surface};
use serde::Deserialize;

/// Names the patterns and calls their synthesis.
macro_rules! patterns {
    ($($name:ident => $module:ident::$function:ident,)*) => {
        /// Pattern of a material; in the table of materials by the name in kebab case.
        #[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Deserialize)]
        #[serde(rename_all = "kebab-case")]
        pub(crate) enum Pattern { $(#[doc = concat!("See `", stringify!($module), "::", stringify!($function), "`.")] $name,)* }

        impl Pattern {
            #[cfg(test)]
            pub(crate) const ALL: &[Self] = &[$(Self::$name,)*];
        }

        /// The surface of a pattern in a look, `size` pixels wide and high.
        pub(crate) fn draw(pattern: Pattern, appearance: &Appearance, size: usize) -> Surface {
            let surface = match pattern { $(Pattern::$name => $module::$function(appearance, size),)* };
            if lies_across(pattern) { surface.turned() } else { surface }
        }
    };
}

/// Returns true for a pattern whose synthesis draws ribs, grain or brush marks across the picture. They run up and down in
/// every picture, as they run along y in a texture.
const fn lies_across(pattern: Pattern) -> bool {
    use Pattern::{Board, Brushed, Grooves, Planks, Ribs};
    matches!(pattern, Board | Brushed | Grooves | Planks | Ribs)
}

patterns! {
    Grit => mineral::grit,
    Sand => mineral::sand,
    Pebbles => mineral::pebbles,
    Cobbles => masonry::cobbles,
    Granite => mineral::granite,
    Terrazzo => mineral::terrazzo,
    Marble => mineral::marble,
    Concrete => masonry::concrete,
    Plaster => masonry::plaster,
    Strata => mineral::strata,
    Cracks => mineral::cracks,
    Brick => masonry::brick,
    Tile => masonry::tile,
    Aggregate => masonry::aggregate,
    Plain => cloth::plain,
    Coarse => cloth::coarse,
    Twill => cloth::twill,
    Denim => cloth::denim,
    Knit => cloth::knit,
    Corduroy => cloth::corduroy,
    Silk => cloth::silk,
    Velvet => cloth::velvet,
    Sheet => cloth::sheet,
    Net => cloth::net,
    Lace => cloth::lace,
    Basket => cloth::basket,
    Rope => cloth::rope,
    Grass => pile::grass,
    Fur => pile::fur,
    Hair => pile::hair,
    Felt => pile::felt,
    Fleece => tufts::fleece,
    Loops => tufts::loops,
    ThickLoops => tufts::thick_loops,
    CutPile => tufts::cut_pile,
    Shag => pile::shag,
    Bristles => tufts::bristles,
    Straw => pile::straw,
    Tangle => pile::tangle,
    Stubble => pile::stubble,
    Moss => tufts::moss,
    Brushed => metal::brushed,
    Polished => metal::polished,
    Hammered => metal::hammered,
    Lugs => metal::lugs,
    Knurl => metal::knurl,
    Rust => metal::rust,
    Cast => metal::cast,
    Spangle => metal::spangle,
    Crumple => metal::crumple,
    Ribs => metal::ribs,
    Grooves => metal::grooves,
    Mesh => lattice::mesh,
    Holes => lattice::holes,
    Hexagons => lattice::hexagons,
    Lozenges => lattice::lozenges,
    Rings => lattice::rings,
    Studs => lattice::studs,
    Domes => lattice::domes,
    Dimples => lattice::dimples,
    Blocks => lattice::blocks,
    Pits => lattice::pits,
    Tread => lattice::tread,
    Glitter => lattice::glitter,
    Board => wood::board,
    Planks => wood::planks,
    TreeRings => wood::rings,
    Bark => wood::bark,
    Birch => wood::birch,
    Cork => wood::cork,
    Chips => wood::chips,
    Bamboo => wood::bamboo,
    Leather => hide::leather,
    Suede => hide::suede,
    Skin => hide::skin,
    Whorls => hide::whorls,
    Scales => hide::scales,
    Leaf => hide::leaf,
    Feather => hide::feather,
    Bumps => hide::bumps,
    Sponge => porous::sponge,
    Foam => porous::foam,
    Beads => porous::beads,
    Wedges => porous::wedges,
    Crust => porous::crust,
    Paper => sheet::paper,
    Cardboard => sheet::cardboard,
    Print => sheet::print,
    Plastic => sheet::plastic,
    Moulded => sheet::moulded,
    Layers => sheet::layers,
    Glass => clear::glass,
    BumpyGlass => clear::bumpy_glass,
    Frosted => clear::frosted,
    Ice => clear::ice,
    Frost => clear::frost,
    Snow => clear::snow,
    Liquid => clear::liquid,
    Drops => clear::drops,
    Grains => heap::grains,
    Discs => heap::discs,
    Beans => heap::beans,
    Balls => heap::balls,
    Crystals => heap::crystals,
}
