//! Recordings and timelines that tests make.

use crate::{
    channel::{Channel, Numbers},
    description::{self, Axis, Column, Description, Quantity, SensorFile, Tool, Unit},
    reader::Recording,
    signal::resample::Clock,
    timeline::{RATE_HZ, Timeline},
};

/// A channel from 0 s on, of a file named after its quantity.
pub(crate) fn channel(quantity: Quantity, axis: Axis, rate_hz: f64, values: &[f64]) -> Channel {
    let mut numbers = Numbers::default();
    let samples = (2..)
        .zip(values)
        .map(|(line, x)| numbers.take(*x, line) as f32)
        .collect();
    numbers.finish();
    Channel {
        label: described(quantity, axis).label(),
        file: format!("{quantity}.csv"),
        quantity,
        axis,
        range: None,
        clock: Clock {
            start_s: 0.0,
            rate_hz,
        },
        samples,
        numbers,
    }
}

/// Description of a channel in SI units.
pub(crate) fn described(quantity: Quantity, axis: Axis) -> description::Channel {
    let unit = Unit::named(&Unit::si(quantity).replace('²', "^2"), quantity);
    description::Channel {
        column: Column::Index(0),
        quantity,
        axis,
        unit: unit.expect("a unit"),
        scale: 1.0,
        range: None,
    }
}

/// A recording of channels, each a file of its own.
pub(crate) fn recording(channels: Vec<Channel>) -> Recording {
    let files = channels.iter().map(|channel| SensorFile {
        file: channel.file.clone(),
        line: 1,
        rate_hz: Some(channel.clock.rate_hz),
        clock: None,
        clock_unit: "s",
        clock_s: 1.0,
        start_s: 0.0,
        channels: vec![described(channel.quantity, channel.axis)],
    });
    Recording {
        folder: "made".into(),
        description: Description {
            name: "made".into(),
            device: None,
            tool: Tool::default(),
            files: files.collect(),
        },
        channels,
        clocks: Vec::new(),
    }
}

/// A timeline that presses with 1 N at 50 mm/s, and of which all is good.
pub(crate) fn timeline(count: usize) -> Timeline {
    Timeline {
        clock: Clock {
            start_s: 0.0,
            rate_hz: RATE_HZ,
        },
        accel_m_s2: vec![vec![0.0; count]],
        steady_m_s2: vec![0.0],
        speed_mm_s: vec![50.0; count],
        heading: vec![[1.0, 0.0]; count],
        height_m: None,
        load_n: vec![1.0; count],
        unsmoothed_load_n: vec![1.0; count],
        bias_n: 0.0,
        drag_n: Some(vec![0.4; count]),
        contact: vec![true; count],
        good: vec![true; count],
    }
}

/// Asserts that two numbers agree to within `apart`.
#[track_caller]
pub(crate) fn near(found: f64, expected: f64, apart: f64) {
    assert!(
        (found - expected).abs() <= apart,
        "{found} is not {expected}"
    );
}
