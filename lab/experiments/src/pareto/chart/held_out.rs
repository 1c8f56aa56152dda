//! Errors of each method in predicting measured models from the others.

use super::picture::{Picture, finished};
use super::rows::{self, Row};
use crate::pareto::held_out::{Exponents, Method, MethodSummary, Region};
use crate::pareto::statistics::Spread;
use asperity_kernels::design::{Level, Shape};
use asperity_plot::{Canvas, Color, PlotError, Rect, ink};

const SIZE: (u32, u32) = (2200, 1500);

pub(super) fn draw(held_out: &[MethodSummary]) -> Result<Picture, PlotError> {
    let mut canvas = Canvas::recording(SIZE.0, SIZE.1)?;
    let (width, height) = (SIZE.0 as f32 / 2.0, SIZE.1 as f32 / 2.0);
    let at = |column: f32, row: f32| Rect::new(column * width, row * height, width, height);
    let shape = |g: &MethodSummary| g.shape_db;
    let level = |g: &MethodSummary| g.level_db;
    let models = |region| {
        let group = held_out
            .iter()
            .find(|g| (g.method, g.region) == (Method::Nearest, region));
        group.map_or(0, |g| g.models)
    };
    rows::draw(
        &mut canvas,
        at(0.0, 0.0),
        (
            'a',
            &format!("Shape, {} models inside", models(Region::Inside)),
        ),
        "Distortion, level free: median and p95 (dB)",
        &shapes(held_out, shape),
    );
    rows::draw(
        &mut canvas,
        at(1.0, 0.0),
        (
            'b',
            &format!("Level, {} models inside", models(Region::Inside)),
        ),
        "Level error: median and p95 (dB)",
        &levels(held_out, Region::Inside, level),
    );
    rows::draw(
        &mut canvas,
        at(0.0, 1.0),
        (
            'c',
            &format!("Level, {} models towards rest", models(Region::TowardsRest)),
        ),
        "Level error: median and p95 (dB)",
        &levels(held_out, Region::TowardsRest, level),
    );
    rows::draw(
        &mut canvas,
        at(1.0, 1.0),
        (
            'd',
            &format!("Edge models, {} models beyond", models(Region::Beyond)),
        ),
        "Level error: median and p95 (dB)",
        &edges(held_out, level),
    );
    finished(&canvas)
}

type Value = fn(&MethodSummary) -> Option<Spread>;

fn row(
    held_out: &[MethodSummary],
    (method, region): (Method, Region),
    value: Value,
    color: Color,
    chosen: bool,
) -> Option<Row> {
    let group = held_out
        .iter()
        .find(|g| g.method == method && g.region == region)?;
    let mut name = method.names().1;
    if group.refused > 0 {
        name += &format!(", {} refused", group.refused);
    }
    Some(Row {
        name,
        spread: value(group)?,
        color,
        chosen,
    })
}

fn floor(held_out: &[MethodSummary], region: Region, value: Value) -> Option<Row> {
    row(held_out, (Method::Nearest, region), value, ink::GREY, false)
}

fn shapes(held_out: &[MethodSummary], value: Value) -> Vec<Row> {
    let of = |shape| {
        let chosen = shape == Shape::LsfCosine;
        let method = (Method::Shape(shape), Region::Inside);
        row(held_out, method, value, ink::BLUE, chosen)
    };
    let mut rows: Vec<Row> = Shape::ALL.into_iter().filter_map(of).collect();
    rows.extend(floor(held_out, Region::Inside, value));
    rows
}

fn levels(held_out: &[MethodSummary], region: Region, value: Value) -> Vec<Row> {
    let of = |level| {
        let chosen = level == Level::Rms;
        let method = (Method::Level(level), region);
        row(held_out, method, value, ink::GREEN, chosen)
    };
    let mut rows: Vec<Row> = Level::ALL.into_iter().filter_map(of).collect();
    rows.extend(floor(held_out, region, value));
    rows
}

fn edges(held_out: &[MethodSummary], value: Value) -> Vec<Row> {
    let of = |exponents| {
        let chosen = exponents == Exponents::Fitted;
        let method = (Method::Powers(exponents), Region::Beyond);
        row(held_out, method, value, ink::PURPLE, chosen)
    };
    let mut rows: Vec<Row> = Exponents::ALL.into_iter().filter_map(of).collect();
    rows.extend(floor(held_out, Region::Beyond, value));
    rows
}
