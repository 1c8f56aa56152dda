//! Profiles: heights along one line, as a stylus instrument writes them.

use super::{HeightMap, Size};
use crate::heights::{HeightField, SIDE};
use asperity_io::{
    diagnostic::Fault,
    table::{Table, TableError, TableProblem},
};

/// Units of length, mm.
const UNITS: [(&str, f64); 6] = [
    ("mm", 1.0),
    ("um", 1e-3),
    ("µm", 1e-3),
    ("μm", 1e-3),
    ("nm", 1e-6),
    ("m", 1e3),
];
/// Beginnings of the names of positions.
const POSITIONS: [&str; 6] = ["x", "pos", "dist", "lat", "length", "scan"];
const REMEDY: &str =
    "give a table with the columns x_mm and z_um, or with z_um alone and --width-mm";
/// Part of the width that a stated one may differ from the positions.
const NEAR: f64 = 0.01;
/// Most points.
const MOST: usize = 4_000_000;

/// A column of lengths.
struct Column {
    at: usize,
    per_mm: f64,
}

/// Reads a profile from a table in text. Its heights are the same in every direction.
///
/// # Errors
/// [`Fault`] for a table without a column of heights, a unit or a number, positions that do not ascend, a width that
/// contradicts them, and points too far apart.
pub fn profile(bytes: &[u8], size: &Size) -> Result<HeightMap, Fault> {
    let mut table = Table::open(bytes, &|text| unit(text).is_some()).map_err(fault)?;
    let layout = table.layout().clone();
    let is_position = |name: &str| {
        let name = name.to_lowercase();
        POSITIONS.iter().any(|position| name.starts_with(position))
    };
    let names = layout.columns.iter().enumerate();
    let (positions, heights): (Vec<_>, Vec<_>) = names.partition(|(_, name)| is_position(name));
    let (Some(height), true) = (heights.first(), heights.len() == 1 && positions.len() < 2) else {
        let what = format!(
            "a profile has one column of heights and one of positions or none; there are {:?}",
            layout.columns
        );
        return Err(Fault::new(what, REMEDY).line(layout.header));
    };
    let column = |(at, name): &(usize, &String)| -> Result<Column, Fault> {
        let below = layout.units.get(*at).and_then(|text| unit(text));
        let per_mm = below.or_else(|| unit(name)).ok_or_else(|| {
            let what = format!("the column {name:?} has no unit of length");
            Fault::new(what, REMEDY).line(layout.header)
        })?;
        Ok(Column { at: *at, per_mm })
    };
    let height = column(height)?;
    let position = positions.first().map(column).transpose()?;
    let (mut at_mm, mut heights_um) = (Vec::new(), Vec::new());
    while let Some(row) = table.next_row().map_err(fault)? {
        let number = |column: &Column| {
            let found = row.number(column.at).filter(|number| number.is_finite());
            found.map(|number| number * column.per_mm).ok_or_else(|| {
                let what = format!("{:?} is no length", row.text(column.at));
                Fault::new(what, "fill the gap, or remove the row").line(row.line)
            })
        };
        heights_um.push(1e3 * number(&height)?);
        if let Some(position) = &position {
            let here = number(position)?;
            if at_mm.last().is_some_and(|before| here <= *before) {
                let what = "positions do not ascend";
                return Err(Fault::new(what, "sort the rows, one profile a file").line(row.line));
            }
            at_mm.push(here);
        }
        if heights_um.len() > MOST {
            let what = format!("more than {MOST} points");
            return Err(Fault::new(what, "cut the profile"));
        }
    }
    let count = heights_um.len();
    if count < SIDE.0 {
        let what = format!("{count} points; at least {} are needed", SIDE.0);
        return Err(Fault::new(what, "give a longer profile"));
    }
    let steps = (count - 1) as f64;
    let pitch_mm = match (at_mm.first(), at_mm.last(), size.width_mm) {
        (Some(first), Some(last), stated) => {
            let pitch_mm = (last - first) / steps;
            if let Some(stated) =
                stated.filter(|mm| (mm / (pitch_mm * (steps + 1.0)) - 1.0).abs() > NEAR)
            {
                let what = format!(
                    "{stated} mm, where the positions span {:.3} mm",
                    last - first
                );
                return Err(Fault::new(what, "leave it out").field("width_mm").usage());
            }
            pitch_mm
        }
        (.., stated) => stated.ok_or_else(super::no_width)? / (steps + 1.0),
    };
    super::fine_enough(pitch_mm, pitch_mm * (steps + 1.0), count)?;
    let even: Vec<f32> = match at_mm.first() {
        Some(first) => (0..count)
            .map(|n| between(&at_mm, &heights_um, first + n as f64 * pitch_mm))
            .collect(),
        None => heights_um.iter().map(|h| *h as f32).collect(),
    };
    let factor = match size.depth_mm {
        Some(depth_mm) => 1e3 * depth_mm / f64::from(super::grey::range(&even)).max(1e-30),
        None => 1.0,
    };
    let rows = even.repeat(SIDE.0);
    let field = HeightField::new(count, [pitch_mm; 2], rows).ok_or_else(super::unheld)?;
    Ok(HeightMap {
        field: field.scaled(factor).levelled().bounded(),
        has_depth: true,
        is_profile: true,
        pixels: [count, 1],
        notes: Vec::new(),
    })
}

/// Height at a position, between its neighbours.
fn between(at_mm: &[f64], heights: &[f64], here: f64) -> f32 {
    let after = at_mm
        .partition_point(|at| *at < here)
        .clamp(1, at_mm.len() - 1);
    let share = (here - at_mm[after - 1]) / (at_mm[after] - at_mm[after - 1]);
    let share = share.clamp(0.0, 1.0);
    ((1.0 - share) * heights[after - 1] + share * heights[after]) as f32
}

/// The unit that a name ends in, as mm: `z_um`, `z (µm)`, `z [mm]`, `mm`.
fn unit(name: &str) -> Option<f64> {
    let end = name.trim().trim_end_matches([')', ']']);
    let word = end.rsplit(|c: char| !c.is_alphabetic()).next()?;
    UNITS
        .iter()
        .find(|(unit, _)| *unit == word)
        .map(|(_, mm)| *mm)
}

fn fault(error: TableError) -> Fault {
    let fault = match error.problem {
        TableProblem::Damaged { what, remedy } => Fault::new(what, remedy),
        other => Fault::new(other, REMEDY),
    };
    fault.line(error.line)
}
