//! Running the runtime offline: from a trajectory to what a hand would feel.
//!
//! ```
//! use asperity::{sources::builtin, emit::lower::lower, views::render::render};
//! use asperity_formats::Asset;
//! use std::path::Path;
//!
//! let bytes = lower(&builtin::texture(), None).expect("a texture that fits an asset").bytes;
//! let asset = Asset::parse(&bytes).expect("a valid asset");
//! // Three periods at 1 kHz, 2 mm deep in the plane z = 0.
//! let stroke = "t_s,x_mm,y_mm,z_mm\n0.000,0.0,0,-2\n0.001,0.1,0,-2\n0.002,0.2,0,-2\n";
//! let mut table = Vec::new();
//! let report = render(&asset, None, Path::new("stroke.csv"), stroke.as_bytes(), &mut table, 1)?;
//! assert_eq!((report.ticks, report.contact_ticks), (3, 3));
//! assert!(table.starts_with(b"tick,t_s,depth_mm,"));
//! # Ok::<(), asperity::views::render::RenderError>(())
//! ```

mod columns;
mod error;
mod trajectory;

pub use columns::{INPUT_COLUMNS, OUTPUT_COLUMNS, SURFACE_COLUMN};
pub use error::RenderError;

use super::offline_config;
use asperity_formats::{Asset, Library};
use asperity_io::diagnostic::Fault;
use asperity_runtime::{
    Flags, HostScene, HostTexture, Output, Renderer, Sample, SceneError, SceneState, State,
};
use error::{no_scene, not_loaded, unsupported};
use std::{
    io::{Read, Write},
    path::Path,
};
use trajectory::{Rows, no_table};

/// Most textures of a scene that is rendered, each of which takes a slot; `asperity build` packs 64 at most.
const MAX_SCENE_TEXTURES: usize = 1024;

/// Statistics of a run.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RenderReport {
    /// Rows rendered.
    pub ticks: u64,
    /// Rows in contact.
    pub contact_ticks: u64,
    /// Taps.
    pub taps: u32,
    /// Largest force, N.
    pub peak_force_n: f32,
}

/// Renders the trajectory read from `input` (called `file` in errors) on the infinite
/// plane z = 0 with the texture of `asset`, and writes one row a tick to `output`. The servo
/// loop runs at `rate_hz`, or else at the texture's own rate.
///
/// Same asset, trajectory and seed: same bytes. Floats are printed as the shortest text
/// that reads back to the same bits.
///
/// # Errors
/// [`RenderError`] with line and column of what is wrong; rows may have been written
/// by then, so write to something that can be abandoned.
pub fn render(
    asset: &Asset<'_>,
    rate_hz: Option<f32>,
    file: &Path,
    input: impl Read,
    mut output: impl Write,
    seed: u64,
) -> Result<RenderReport, RenderError> {
    let rate_hz = rate_hz.unwrap_or(asset.grid().sample_rate_hz());
    let config = offline_config(rate_hz);
    let renderer = Renderer::new(&config).map_err(|cause| unsupported(asset.name(), cause))?;
    let mut slot = Box::new(HostTexture::new());
    slot.load(asset, rate_hz)
        .map_err(|cause| not_loaded(asset.name(), cause))?;
    let mut state = State::new(seed);
    let rows = Rows::new(file, input, rate_hz)?;
    writeln!(output, "{}", OUTPUT_COLUMNS.join(",")).map_err(RenderError::Write)?;
    run(rows, output, |sample| {
        (renderer.tick(&slot, &mut state, sample), String::new())
    })
}

/// As [`render`], on the surfaces of a library's scene, at the rate of its first texture if none
/// is given; a row says at its end, under [`SURFACE_COLUMN`], which one is touched.
///
/// # Errors
/// As [`render`], and for a scene that the runtime does not load.
pub fn render_scene(
    library: &Library<'_>,
    rate_hz: Option<f32>,
    file: &Path,
    input: impl Read,
    mut output: impl Write,
    seed: u64,
) -> Result<RenderReport, RenderError> {
    let textures = library.index().len();
    check_textures(textures)?;
    let first = library.asset(0).map_err(|cause| {
        let (index, cause) = (0, cause.into());
        no_scene(SceneError::Texture { index, cause })
    })?;
    let config = offline_config(rate_hz.unwrap_or(first.grid().sample_rate_hz()));
    let renderer = Renderer::new(&config).map_err(|cause| unsupported(first.name(), cause))?;
    let mut slots = vec![HostTexture::new(); textures];
    let scene = HostScene::load(library, &config, &mut slots).map_err(no_scene)?;
    let mut state = SceneState::new(seed);
    let rows = Rows::new(file, input, config.servo_rate_hz)?;
    writeln!(output, "{},{SURFACE_COLUMN}", OUTPUT_COLUMNS.join(","))
        .map_err(RenderError::Write)?;
    run(rows, output, |sample| {
        let felt = renderer.tick_scene(&scene, &mut state, sample);
        let touched = state.touched().map(|index| index.to_string());
        (felt, format!(",{}", touched.unwrap_or_default()))
    })
}

/// Refuses a scene with more textures than are rendered at once.
///
/// # Errors
/// [`Fault`] with the number of them.
pub fn check_textures(found: usize) -> Result<(), Fault> {
    if found <= MAX_SCENE_TEXTURES {
        return Ok(());
    }
    let what = format!("the scene has {found} textures, {MAX_SCENE_TEXTURES} are rendered at most");
    let remedy = "build the scene again with `asperity build`, which packs only textures in use";
    Err(Fault::new(what, remedy))
}

/// Every row through `tick`, which may add columns.
fn run<R: Read>(
    mut rows: Rows<'_, R>,
    mut output: impl Write,
    mut tick: impl FnMut(&Sample) -> (Output, String),
) -> Result<RenderReport, RenderError> {
    let mut report = RenderReport {
        ticks: 0,
        contact_ticks: 0,
        taps: 0,
        peak_force_n: 0.0,
    };
    while let Some(row) = rows.next()? {
        // Millimetres to metres in f64, so that only one rounding is left.
        let position_m = row.position_mm.map(|mm| (mm / 1000.0) as f32);
        let (out, more) = tick(&Sample::at(position_m));
        let [fx, fy, fz] = out.force_n;
        writeln!(
            output,
            "{},{},{},{},{},{},{},{},{fx},{fy},{fz},{}{more}",
            report.ticks,
            row.t_s,
            out.depth_m * 1000.0,
            out.speed_mm_s,
            out.normal_force_n,
            out.vib_m_s2,
            out.tap_n,
            out.friction_n,
            out.flags.bits(),
        )
        .map_err(RenderError::Write)?;
        report.ticks += 1;
        report.contact_ticks += u64::from(out.depth_m > 0.0);
        report.taps += u32::from(out.flags.contains(Flags::TAP_STARTED));
        report.peak_force_n = report
            .peak_force_n
            .max((fx * fx + fy * fy + fz * fz).sqrt());
    }
    output.flush().map_err(RenderError::Write)?;
    if report.ticks == 0 {
        return Err(no_table(rows.file, "the trajectory has no rows").into());
    }
    Ok(report)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{emit::lower::lower, sources::builtin};
    use asperity_io::diagnostic::Diagnostic as _;
    use std::io;

    fn run(trajectory: &str, seed: u64) -> Result<(RenderReport, String), RenderError> {
        run_at(None, trajectory, seed)
    }

    fn run_at(
        rate_hz: Option<f32>,
        trajectory: &str,
        seed: u64,
    ) -> Result<(RenderReport, String), RenderError> {
        let bytes = lower(&builtin::texture(), None).unwrap().bytes;
        let asset = Asset::parse(&bytes).unwrap();
        let mut output = Vec::new();
        let report = render(
            &asset,
            rate_hz,
            Path::new("in.csv"),
            trajectory.as_bytes(),
            &mut output,
            seed,
        )?;
        Ok((report, String::from_utf8(output).unwrap()))
    }

    /// A stroke at 100 mm/s, 2 mm deep, `rows` long.
    fn stroke(rows: usize) -> String {
        let mut text = INPUT_COLUMNS.join(",");
        for n in 0..rows {
            let t_s = n as f64 / 1000.0;
            text.push_str(&format!("\n{t_s:.3},{:.4},0,-2", 100.0 * t_s));
        }
        text
    }

    #[test]
    fn every_row_has_its_tick_and_floats_read_back() {
        let (report, text) = run(&stroke(500), 3).unwrap();
        assert_eq!(
            (report.ticks, report.contact_ticks, report.taps),
            (500, 500, 0)
        );
        let mut lines = text.lines();
        assert_eq!(lines.next().unwrap(), OUTPUT_COLUMNS.join(","));
        let mut vibrates = false;
        for (tick, line) in lines.enumerate() {
            let fields: Vec<&str> = line.split(',').collect();
            assert_eq!(fields.len(), OUTPUT_COLUMNS.len());
            assert_eq!(fields[0], tick.to_string());
            for field in &fields[2..11] {
                let value: f32 = field.parse().unwrap();
                assert_eq!(value.to_string(), *field);
            }
            let depth_mm: f32 = fields[2].parse().unwrap();
            assert!((depth_mm - 2.0).abs() < 1e-6);
            vibrates |= fields[5].parse::<f32>().unwrap().abs() > 0.1;
        }
        assert!(vibrates);
    }

    #[test]
    fn a_rate_is_a_multiple_of_the_textures_own() {
        // Rows at 5 kHz.
        let mut text = INPUT_COLUMNS.join(",");
        for n in 0..500 {
            text.push_str(&format!(
                "\n{},{},0,-2",
                f64::from(n) * 2e-4,
                0.02 * f64::from(n)
            ));
        }
        let (report, _) = run_at(Some(5000.0), &text, 1).unwrap();
        assert_eq!(report.ticks, 500);
        let refused = run_at(Some(1000.0), &text, 1).unwrap_err();
        assert!(
            refused.to_string().contains("at 1000 Hz row 1 must be"),
            "{refused}"
        );
        let refused = run_at(Some(1500.0), &text, 1).unwrap_err();
        assert!(refused.to_string().contains("a whole number"), "{refused}");
        assert!(
            refused.remedy().contains("--rate 1000"),
            "{}",
            refused.remedy()
        );
    }

    #[test]
    fn the_seed_decides_the_noise_and_nothing_else_does() {
        let once = run(&stroke(300), 3).unwrap();
        assert_eq!(once, run(&stroke(300), 3).unwrap());
        assert_ne!(once.1, run(&stroke(300), 4).unwrap().1);
    }

    #[test]
    fn rows_without_an_end_are_refused_with_their_line() {
        let text = format!(
            "{}\n0,0,0,0\n{}",
            INPUT_COLUMNS.join(","),
            "1,".repeat(1 << 18)
        );
        let message = run(&text, 0).unwrap_err().to_string();
        assert_eq!(message, "in.csv: line 3 takes more than 65536 bytes");
        // Rows within the limit add up without end.
        assert_eq!(run(&stroke(20_000), 0).unwrap().0.ticks, 20_000);
    }

    #[test]
    fn every_dialect_renders_alike_and_a_cut_row_is_refused() {
        let plain = stroke(300);
        let semicolons = plain.replace(',', ";").replace('.', ",");
        let blanks = plain.replace(',', "  ");
        let expected = run(&plain, 3).unwrap();
        for text in [semicolons, blanks, format!("# a hand\n{plain}\n")] {
            assert_eq!(run(&text, 3).unwrap(), expected);
        }
        let error = run(&format!("{plain}\n0.3"), 3).unwrap_err();
        assert_eq!(
            error.to_string(),
            "in.csv: line 302 is cut: it has 1 values"
        );
    }

    #[test]
    fn a_scene_of_more_textures_than_are_rendered_is_refused_before_their_slots_are_made() {
        let bytes = lower(&builtin::texture(), None).unwrap().bytes;
        let names: Vec<String> = (0..=MAX_SCENE_TEXTURES)
            .map(|n| format!("{n:06}"))
            .collect();
        let textures: Vec<(&str, &[u8])> = names.iter().map(|n| (n.as_str(), &bytes[..])).collect();
        let surface = asperity_formats::SceneSurface {
            solid: asperity_formats::Solid::Plane {
                point_m: [0.0; 3],
                normal: [0.0, 0.0, 1.0],
            },
            from_m: [-1.0; 3],
            to_m: [1.0; 3],
            texture: 0,
        };
        let mut library = vec![0; asperity_formats::library::encoded_len(&textures) + 1000];
        let len = asperity_formats::library::encode_scene(&textures, &[surface], &mut library);
        let library = Library::parse(&library[..len.unwrap()]).unwrap();
        let file = Path::new("in.csv");
        let input = stroke(5);
        let error = render_scene(&library, None, file, input.as_bytes(), io::sink(), 0);
        let error = error.unwrap_err().to_string();
        assert!(error.contains("has 1025 textures"), "{error}");
    }

    #[test]
    fn bad_tables_are_refused_with_line_and_column() {
        let message = |text: &str| run(text, 0).unwrap_err().to_string();
        let head = INPUT_COLUMNS.join(",");
        for (text, expected) in [
            (
                "t_s,x_mm,z_mm\n0,0,0".to_owned(),
                "in.csv:1: column y_mm is missing",
            ),
            (
                format!("{head},x_mm\n0,0,0,0,0"),
                "in.csv:1: column x_mm appears twice",
            ),
            (
                format!("{head}\n0,0,0,0\n0.001,0,up,0"),
                "in.csv:3: y_mm = \"up\" is not",
            ),
            (
                format!("{head}\n0,0,0,NaN"),
                "in.csv:2: z_mm = \"NaN\" is not",
            ),
            (
                format!("{head}\n0,0,0,inf"),
                "in.csv:2: z_mm = \"inf\" is not",
            ),
            (format!("{head}\n0,0,0,"), "in.csv:2: z_mm = \"\" is not"),
            (
                format!("{head}\n0,0,0,0\n0.002,0,0,0"),
                "in.csv:3: t_s = 0.002 s, but at 1000 Hz row 1",
            ),
            (
                format!("{head}\n0,0,0,0\n0.001,0,0"),
                "in.csv: line 3 is cut",
            ),
            (head.clone(), "the trajectory has no rows"),
            (String::new(), "has no header"),
        ] {
            assert!(
                message(&text).contains(expected),
                "{text:?}: {}",
                message(&text)
            );
        }
    }

    #[test]
    fn times_with_few_digits_and_other_columns_are_accepted() {
        let text = "note,z_mm,y_mm,x_mm,t_s\na,1,0,0,5.0000\nb,1,0,0,5.0011\n";
        assert_eq!(run(text, 0).unwrap().0.ticks, 2);
    }
}
