//! Outputs of many ticks, a column per quantity.

use crate::{
    arrays::{list, table},
    records::of_fields,
};
use asperity_runtime::Output;
use pyo3::prelude::*;

/// Columns of the record `Rendered`.
#[derive(Debug)]
pub(crate) struct Columns {
    force_n: Vec<[f32; 3]>,
    depth_m: Vec<f32>,
    speed_mm_s: Vec<f32>,
    normal_force_n: Vec<f32>,
    vib_m_s2: Vec<f32>,
    tap_n: Vec<f32>,
    friction_n: Vec<f32>,
    flags: Vec<u16>,
    /// Index of the surface in contact, -1 for none; only of a scene.
    surface: Option<Vec<i16>>,
}

impl Columns {
    /// Columns of this many ticks, all zero.
    pub(crate) fn zeros(ticks: usize, is_scene: bool) -> Self {
        Self {
            force_n: vec![[0.0; 3]; ticks],
            depth_m: vec![0.0; ticks],
            speed_mm_s: vec![0.0; ticks],
            normal_force_n: vec![0.0; ticks],
            vib_m_s2: vec![0.0; ticks],
            tap_n: vec![0.0; ticks],
            friction_n: vec![0.0; ticks],
            flags: vec![0; ticks],
            surface: is_scene.then(|| vec![-1; ticks]),
        }
    }

    /// Writes what a tick gave.
    #[inline]
    pub(crate) fn set(&mut self, tick: usize, output: &Output) {
        self.force_n[tick] = output.force_n;
        self.depth_m[tick] = output.depth_m;
        self.speed_mm_s[tick] = output.speed_mm_s;
        self.normal_force_n[tick] = output.normal_force_n;
        self.vib_m_s2[tick] = output.vib_m_s2;
        self.tap_n[tick] = output.tap_n;
        self.friction_n[tick] = output.friction_n;
        self.flags[tick] = output.flags.bits();
    }

    /// Writes which surface was touched; a scene has 64 at most.
    #[inline]
    pub(crate) fn touch(&mut self, tick: usize, surface: Option<usize>) {
        if let Some(column) = &mut self.surface {
            column[tick] = surface.map_or(-1, |index| index as i16);
        }
    }

    /// The record. No column is copied.
    pub(crate) fn record(self, py: Python<'_>) -> PyResult<Bound<'_, PyAny>> {
        let surface = match self.surface {
            Some(column) => list(py, column),
            None => py.None().into_bound(py),
        };
        of_fields(
            py,
            "Rendered",
            [
                ("force_n", table(py, self.force_n.into_flattened(), 3)?),
                ("depth_m", list(py, self.depth_m)),
                ("speed_mm_s", list(py, self.speed_mm_s)),
                ("normal_force_n", list(py, self.normal_force_n)),
                ("vib_m_s2", list(py, self.vib_m_s2)),
                ("tap_n", list(py, self.tap_n)),
                ("friction_n", list(py, self.friction_n)),
                ("flags", list(py, self.flags)),
                ("surface", surface),
            ],
        )
    }
}
