//! `asperity.Output`.

use asperity_runtime as runtime;
use pyo3::prelude::*;

/// Output of a tick.
///
/// Attributes
/// ----------
/// force_n : tuple of float
///     Force on the hand: x, y, z, N.
/// depth_m : float
///     Depth inside the surface, m; 0 outside.
/// speed_mm_s : float
///     Estimated tangential speed, mm/s.
/// normal_force_n : float
///     Stiffness times depth, N: the force that looks up the grid.
/// vib_m_s2 : float
///     The vibration before device gain, m/s².
/// tap_n : float
///     Tap force along the normal, N.
/// friction_n : float
///     Magnitude of the friction force, N.
/// flags : Flags
///     What happened.
/// surface : int or None
///     Index of the surface in contact; only in a scene.
#[pyclass(frozen, module = "asperity")]
pub(crate) struct Output(pub(crate) runtime::Output, pub(crate) Option<usize>);

#[pymethods]
impl Output {
    #[getter]
    fn force_n(&self) -> (f32, f32, f32) {
        self.0.force_n.into()
    }

    #[getter]
    fn depth_m(&self) -> f32 {
        self.0.depth_m
    }

    #[getter]
    fn speed_mm_s(&self) -> f32 {
        self.0.speed_mm_s
    }

    #[getter]
    fn normal_force_n(&self) -> f32 {
        self.0.normal_force_n
    }

    #[getter]
    fn vib_m_s2(&self) -> f32 {
        self.0.vib_m_s2
    }

    #[getter]
    fn tap_n(&self) -> f32 {
        self.0.tap_n
    }

    #[getter]
    fn friction_n(&self) -> f32 {
        self.0.friction_n
    }

    #[getter]
    fn flags<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        let flags = py.import("asperity")?.getattr("Flags")?;
        flags.call1((self.0.flags.bits(),))
    }

    #[getter]
    fn surface(&self) -> Option<usize> {
        self.1
    }

    fn __repr__(&self) -> String {
        let names: Vec<&str> = runtime::Flags::ALL
            .iter()
            .filter(|(flag, _)| self.0.flags.contains(*flag))
            .map(|(_, name)| *name)
            .collect();
        let [x, y, z] = self.0.force_n;
        format!("<Output: force ({x}, {y}, {z}) N; {}>", names.join(", "))
    }
}
