//! `asperity.Renderer`.

use crate::{
    arguments::{Seed, Solid},
    columns::Columns,
    contents::Texture,
    error::Failure,
    motion,
    output::Output,
    records::{of_fields, with_fields},
    scene::Scene,
    servo::{self, Servo, ServoError},
};
use asperity::views::render::check_textures;
use asperity_formats::{FormatError, Library};
use asperity_runtime::{Config, LoadError, Sample, SceneError, VibrationAxis};
use pyo3::{IntoPyObjectExt as _, prelude::*, sync::MutexExt as _, types::IntoPyDict as _};
use std::sync::{Mutex, MutexGuard, PoisonError};

/// Ticks between two looks for Ctrl-C, below 0.1 s.
const TOGETHER: usize = 100_000;

/// Object to render.
#[derive(FromPyObject)]
pub(crate) enum Felt<'py> {
    Texture(Bound<'py, Texture>),
    Scene(Bound<'py, Scene>),
}

/// Renders a texture or a scene, as ``asperity render`` does, to the bit.
///
/// A tick is one servo period. The renderer keeps its state from call to call: rendering half a
/// trajectory and then the other half gives what rendering it at once gives.
///
/// Parameters
/// ----------
/// texture : Texture or Scene
///     The texture, or the scene with its surfaces.
/// solid : Plane, Sphere or Box, optional
///     What wears the texture, by default the plane z = 0. A scene has solids of its own.
/// seed : int, default 0
///     Seed of the excitation.
/// rate : float, optional
///     Rate of the servo loop, Hz: 1 to 20 times that of the texture, which is the default; of a
///     scene, its first texture's.
/// fixed_point : bool, default False
///     Whether to compute as processors without an FPU do.
/// peak_n : float, default 3.3
///     Largest force of the device, N.
/// slew_n_s : float, default 2000
///     Largest change of force, N/s.
/// reach_m : float, default 1
///     Largest coordinate of a position, m: beyond it a sample is bad, so that millimetres given as
///     metres are found out. ``asperity render`` takes 10 km.
/// vibration_axis : {"tangent", "binormal"}, default "tangent"
///     Whether the vibration acts along the motion or across it.
///
/// Raises
/// ------
/// UsageError
///     For an argument outside its range.
/// AsperityError
///     Where the texture does not fit the rate or the arithmetic.
///
/// Examples
/// --------
/// >>> import asperity, numpy as np
/// >>> t_s = np.arange(1000) / 1000
/// >>> stroke = np.stack([0.1 * t_s, 0 * t_s, np.full_like(t_s, -0.002)], axis=1)
/// >>> felt = asperity.Renderer(asperity.builtin(), seed=1).render(stroke)
/// >>> felt.force_n.shape
/// (1000, 3)
/// >>> ball = asperity.Sphere((0.0, 0.0, 0.0), radius_m=0.05)
/// >>> asperity.Renderer(asperity.builtin(), solid=ball).tick([0.0, 0.049, 0.0]).flags
/// <Flags.CONTACT: 1>
#[pyclass(frozen, module = "asperity")]
pub(crate) struct Renderer {
    name: String,
    rate_hz: f32,
    fixed_point: bool,
    is_scene: bool,
    servo: Mutex<(Box<dyn Servo>, u64)>,
}

impl Renderer {
    /// The loop, once no other thread renders with it.
    fn servo(&self, py: Python<'_>) -> MutexGuard<'_, (Box<dyn Servo>, u64)> {
        // A state is whole between any two ticks.
        self.servo
            .lock_py_attached(py)
            .unwrap_or_else(PoisonError::into_inner)
    }
}

#[pymethods]
impl Renderer {
    #[new]
    #[pyo3(
        signature = (
            texture, *, solid=None, seed=Seed(0), rate=None, fixed_point=false, peak_n=3.3,
            slew_n_s=2000.0, reach_m=1.0, vibration_axis="tangent"
        ),
        text_signature = "(texture, *, solid=None, seed=0, rate=None, fixed_point=False, \
                          peak_n=3.3, slew_n_s=2000.0, reach_m=1.0, vibration_axis='tangent')"
    )]
    #[allow(clippy::too_many_arguments, reason = "keyword arguments of Python")]
    fn new(
        py: Python<'_>,
        texture: Felt<'_>,
        solid: Option<Solid>,
        seed: Seed,
        rate: Option<f32>,
        fixed_point: bool,
        peak_n: f32,
        slew_n_s: f32,
        reach_m: f32,
        vibration_axis: &str,
    ) -> Result<Self, Failure> {
        let mut config = Config {
            vibration_axis: match vibration_axis {
                "tangent" => VibrationAxis::Tangent,
                "binormal" => VibrationAxis::Binormal,
                other => {
                    let message = format!("vibration_axis = {other:?}: not a tangent's name");
                    return Err(Failure::usage(message, "give \"tangent\" or \"binormal\""));
                }
            },
            ..Config::default()
        };
        config.limits.peak_n = peak_n;
        config.limits.slew_n_s = slew_n_s;
        config.safety.reach_m = reach_m;
        let (name, is_scene, servo) = match &texture {
            Felt::Texture(texture) => {
                let asset = texture.get().contents.asset()?;
                config.servo_rate_hz = rate.unwrap_or(asset.grid().sample_rate_hz());
                if let Some(Solid(solid)) = solid {
                    config.solid = solid;
                }
                let servo = servo::on_texture(&asset, &config, seed.0, fixed_point);
                (asset.name().to_owned(), false, servo)
            }
            Felt::Scene(_) if solid.is_some() => {
                let message = "solid: a scene has solids of its own";
                return Err(Failure::usage(message, "leave it out, or render a texture"));
            }
            Felt::Scene(scene) => {
                let scene = scene.as_super().get();
                let bytes = py.detach(|| scene.bytes())?;
                let library = Library::parse(&bytes).map_err(unreadable)?;
                let textures = library.index().len();
                check_textures(textures)?;
                let first = library.asset(0).map_err(unreadable)?;
                config.servo_rate_hz = rate.unwrap_or(first.grid().sample_rate_hz());
                let servo = servo::on_scene(&library, &config, seed.0, fixed_point);
                (
                    format!("scene with {}", scene.listed().join(", ")),
                    true,
                    servo,
                )
            }
        };
        let servo = servo.map_err(|error| refused(error).about(&name))?;
        Ok(Self {
            name,
            rate_hz: config.servo_rate_hz,
            fixed_point,
            is_scene,
            servo: Mutex::new((servo, seed.0)),
        })
    }

    /// Rate of the servo loop, Hz.
    #[getter]
    fn rate_hz(&self) -> f32 {
        self.rate_hz
    }

    /// True if it computes in fixed point.
    #[getter]
    fn fixed_point(&self) -> bool {
        self.fixed_point
    }

    /// The wall that is rendered: the texture's, lowered to what the device can bear. None of a
    /// scene, whose textures have one each.
    #[getter]
    fn wall<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        let Some([stiffness, damping]) = self.servo(py).0.wall() else {
            return Ok(py.None().into_bound(py));
        };
        let fields = [
            ("stiffness_n_m", stiffness.into_bound_py_any(py)?),
            ("damping_n_s_m", damping.into_bound_py_any(py)?),
        ];
        of_fields(py, "Wall", fields)
    }

    /// Counts since the renderer was made or reset.
    #[getter]
    fn counters<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        let counters = self.servo(py).0.counters();
        let fields = [
            ("ticks", counters.ticks),
            ("bad_samples", counters.bad_samples),
            ("missed_ticks", counters.missed_ticks),
            ("faults", counters.faults),
            ("taps", counters.taps),
            ("peak_limited", counters.peak_limited),
            ("slew_limited", counters.slew_limited),
        ];
        let mut bound = Vec::with_capacity(fields.len());
        for (name, count) in fields {
            bound.push((name, count.into_bound_py_any(py)?));
        }
        with_fields(py, "Counters", &bound.into_py_dict(py)?)
    }

    /// Renders one servo period.
    ///
    /// Parameters
    /// ----------
    /// position_m : sequence of 3 floats
    ///     Position of the stylus, m. NaN stands for a device that had nothing new.
    /// elapsed_ticks : int, default 1
    ///     Servo periods since the last sample: more after missed ones, 0 for nothing new.
    ///
    /// Returns
    /// -------
    /// Output
    #[pyo3(signature = (position_m, elapsed_ticks=1))]
    fn tick(&self, py: Python<'_>, position_m: [f64; 3], elapsed_ticks: u32) -> Output {
        let sample = Sample {
            position_m: position_m.map(|x| x as f32),
            elapsed_ticks,
        };
        let (output, surface) = self.servo(py).0.tick(&sample);
        Output(output, surface)
    }

    /// Renders a servo period for every row. Other threads run meanwhile. Ctrl-C stops between two
    /// ticks, and the state is then that of the last one.
    ///
    /// Parameters
    /// ----------
    /// positions_m : array_like of float, shape (N, 3)
    ///     Positions of the stylus, m. A NaN stands for a device that had nothing new.
    /// elapsed_ticks : array_like of int, shape (N,), optional
    ///     Servo periods since the last sample, by default 1.
    ///
    /// Returns
    /// -------
    /// Rendered
    ///     Arrays of N ticks.
    ///
    /// Raises
    /// ------
    /// UsageError
    ///     For arrays of another shape, or of something else than numbers.
    #[pyo3(signature = (positions_m, elapsed_ticks=None))]
    fn render<'py>(
        &self,
        py: Python<'py>,
        positions_m: &Bound<'py, PyAny>,
        elapsed_ticks: Option<&Bound<'py, PyAny>>,
    ) -> PyResult<Bound<'py, PyAny>> {
        // Copied, so that no other thread can change them while the ticks run.
        let positions_m = motion::positions(positions_m)?;
        let elapsed_ticks = elapsed_ticks
            .map(|array| motion::elapsed_ticks(array, positions_m.len()))
            .transpose()?;
        let columns = py.detach(|| -> PyResult<Columns> {
            let mut servo = self.servo.lock().unwrap_or_else(PoisonError::into_inner);
            let ticks = positions_m.len();
            let mut columns = Columns::zeros(ticks, self.is_scene);
            for from in (0..ticks).step_by(TOGETHER) {
                let some = from..ticks.min(from + TOGETHER);
                servo
                    .0
                    .render(some, &positions_m, elapsed_ticks.as_deref(), &mut columns);
                Python::attach(|py| py.check_signals())?;
            }
            Ok(columns)
        })?;
        columns.record(py)
    }

    /// Starts anew: at rest, without force, the counters at zero.
    ///
    /// Parameters
    /// ----------
    /// seed : int, optional
    ///     Seed of the excitation; the one before by default.
    #[pyo3(signature = (seed=None))]
    fn reset(&self, py: Python<'_>, seed: Option<Seed>) {
        let mut servo = self.servo(py);
        let seed = seed.map_or(servo.1, |seed| seed.0);
        servo.1 = seed;
        servo.0.reset(seed);
    }

    fn __repr__(&self) -> String {
        let arithmetic = if self.fixed_point {
            "fixed point"
        } else {
            "floats"
        };
        format!(
            "<Renderer of {:?} at {} Hz in {arithmetic}>",
            self.name, self.rate_hz
        )
    }
}

/// The error in the words of Python.
fn refused(error: ServoError) -> Failure {
    match error {
        ServoError::Config(error) => {
            let field = match error.field {
                "servo_rate_hz" => "rate",
                "limits.peak_n" => "peak_n",
                "limits.slew_n_s" => "slew_n_s",
                other => other,
            };
            let message = format!("{field} = {}: {}", error.value, error.rule);
            Failure::usage(message, "leave the argument out, or give one in this range")
        }
        ServoError::Scene(SceneError::Texture { index, cause }) => {
            refused(ServoError::Load(cause)).about(format!("texture {index}"))
        }
        ServoError::Scene(error) => Failure::new(error, "build the scene again"),
        ServoError::Load(error @ LoadError::Rate { model_hz, .. }) => {
            let remedy = format!("give rate={model_hz} or 2, 3, … 20 times as much");
            Failure::usage(error, remedy)
        }
        ServoError::Load(error @ LoadError::Range { .. }) => {
            Failure::new(error, "leave fixed_point out")
        }
        ServoError::Load(error) => Failure::new(
            error,
            "lower the rate, or make the texture again with fidelity=\"auto\"",
        ),
    }
}

fn unreadable(error: FormatError) -> Failure {
    Failure::new(error, "build the scene again")
}
