//! `asperity.export`.

use crate::{
    arguments::{Seed, within},
    contents::Texture,
    error::Failure,
    library::Library,
    records::{of_fields, value},
};
use asperity::{
    interchange::{
        self, ClipFormat, Format, Language, Options, SourceOptions, export_source, header_beside,
        parse_symbol, ranges, session,
    },
    views::preview,
};
use asperity_io::output::Outputs;
use pyo3::{IntoPyObjectExt as _, prelude::*, types::PyBytes};
use serde_json::Value;
use std::path::{Path, PathBuf};

/// Argument of an export.
#[derive(FromPyObject)]
pub(crate) enum Exportable<'py> {
    Texture(Bound<'py, Texture>),
    Library(Bound<'py, Library>),
}

/// A file, the header beside it, and what is reported.
struct Written {
    data: Vec<u8>,
    header: Option<Vec<u8>>,
    report: Value,
}

/// Exports a texture to another tool's format, and reports what the format loses.
///
/// The bytes are those of ``asperity export``. Most formats hold neither speed nor force: they get
/// one stroke and the taps, as the runtime renders them. Other threads run meanwhile.
///
/// Parameters
/// ----------
/// texture : Texture or Library
///     What is exported. A library goes into source text as a whole.
/// to : {"c-array", "rust", "hjif", "hmpg", "ahap", "haptic", "gltf", "wav", "csv"}
///     The format; ``docs/export.md`` describes each.
/// path : str or os.PathLike, optional
///     The file to write. A C array in ``NAME.c`` also gets ``NAME.h``.
/// speed_mm_s : float, optional
///     Speed of the stroke, mm/s, 1 to 1000; 100 by default.
/// force_n : float, optional
///     Normal force of the stroke, N, 0.05 to 20; 1 by default.
/// time_s : float, optional
///     Duration of the stroke, s, 0.3 to 60; 1 by default.
/// taps : bool, default False
///     Whether there are taps, and no stroke unless one is described.
/// full_scale_m_s2, tap_full_scale_m_s2 : float, optional
///     Acceleration at full scale in strokes and in taps, m/s², 0.001 to 10000; the largest in the
///     clip by default.
/// seed : int, default 0
///     Seed of the excitation.
/// rate : float, optional
///     Rate of the servo loop, Hz; that of the texture by default.
/// size : int, default 256
///     Width and height of the pictures of glTF, pixels.
/// symbol : str, optional
///     Symbol of the array in source text; ``asperity_image_`` and the name by default.
/// keep_preview : bool, default False
///     Whether source text keeps preview pictures, which a runtime does not read.
///
/// Returns
/// -------
/// Exported
///     The bytes, and the loss of each stroke and tap.
///
/// Raises
/// ------
/// UsageError
///     For an argument outside its range.
/// AsperityError
///     Where the format cannot hold the texture, or the file cannot be written.
///
/// Examples
/// --------
/// >>> import asperity
/// >>> exported = asperity.export(asperity.builtin(), "ahap", time_s=0.5)
/// >>> exported.data.startswith(b"{")
/// True
/// >>> for part in exported.report["parts"]:
/// ...     print(part["part"])
/// stroke 100 mm/s 1 N
#[pyfunction]
#[pyo3(
    signature = (
        texture, to, path=None, *, speed_mm_s=None, force_n=None, time_s=None, taps=false,
        full_scale_m_s2=None, tap_full_scale_m_s2=None, seed=Seed(0), rate=None, size=preview::SIZE,
        symbol=None, keep_preview=false
    ),
    text_signature = "(texture, to, path=None, *, speed_mm_s=None, force_n=None, time_s=None, \
                      taps=False, full_scale_m_s2=None, tap_full_scale_m_s2=None, seed=0, \
                      rate=None, size=256, symbol=None, keep_preview=False)"
)]
#[allow(clippy::too_many_arguments, reason = "keyword arguments of Python")]
pub(crate) fn export<'py>(
    py: Python<'py>,
    texture: Exportable<'py>,
    to: &str,
    path: Option<PathBuf>,
    speed_mm_s: Option<f32>,
    force_n: Option<f32>,
    time_s: Option<f32>,
    taps: bool,
    full_scale_m_s2: Option<f32>,
    tap_full_scale_m_s2: Option<f32>,
    seed: Seed,
    rate: Option<f32>,
    size: u32,
    symbol: Option<&str>,
    keep_preview: bool,
) -> PyResult<Bound<'py, PyAny>> {
    let format: Format = to.parse().map_err(|rule: String| {
        Failure::usage(
            format!("to = {to:?}: not {rule}"),
            "give one of these formats",
        )
    })?;
    for (name, number, range) in [
        ("speed_mm_s", speed_mm_s, ranges::SPEED_MM_S),
        ("force_n", force_n, ranges::FORCE_N),
        ("time_s", time_s, ranges::TIME_S),
        ("full_scale_m_s2", full_scale_m_s2, ranges::FULL_SCALE_M_S2),
        (
            "tap_full_scale_m_s2",
            tap_full_scale_m_s2,
            ranges::FULL_SCALE_M_S2,
        ),
    ] {
        number.map_or(Ok(0.0), |number| within(name, number, &range))?;
    }
    let options = Options {
        session: session(speed_mm_s, force_n, time_s, taps),
        rate_hz: rate,
        seed: seed.0,
        full_scale_m_s2: full_scale_m_s2.map(f64::from),
        tap_full_scale_m_s2: tap_full_scale_m_s2.map(f64::from),
        size_px: within("size", size, &preview::SIZES)?,
    };
    if matches!(format, Format::Clip(_)) && (symbol.is_some() || keep_preview) {
        let name = if keep_preview {
            "keep_preview"
        } else {
            "symbol"
        };
        return Err(Failure::usage(
            format!("{name}: a {format} file has none"),
            "give it with to=\"c-array\" or to=\"rust\" alone",
        )
        .into());
    }
    if let Some(symbol) = symbol {
        parse_symbol(symbol).map_err(|rule| {
            Failure::usage(
                format!("symbol = {symbol:?}: not {rule}"),
                "give another name",
            )
        })?;
    }
    let source_options = SourceOptions {
        header: None,
        symbol,
        keep_preview,
    };
    let target = match &texture {
        Exportable::Texture(texture) => ExportTarget::Texture(texture.get()),
        Exportable::Library(library) => ExportTarget::Library(library.get()),
    };
    let written = py.detach(|| {
        let written = target.written(format, path.as_deref(), &options, source_options)?;
        if let Some(path) = &path {
            written.write(path)?;
        }
        Ok::<_, Failure>(written)
    })?;
    let header = written.header.map(|header| PyBytes::new(py, &header));
    of_fields(
        py,
        "Exported",
        [
            ("data", PyBytes::new(py, &written.data).into_any()),
            ("header", header.into_bound_py_any(py)?),
            ("report", value(py, &written.report)?),
        ],
    )
}

/// Object to export, without the interpreter.
enum ExportTarget<'a> {
    Texture(&'a Texture),
    Library(&'a Library),
}

impl ExportTarget<'_> {
    fn written(
        &self,
        format: Format,
        path: Option<&Path>,
        options: &Options,
        source_options: SourceOptions<'_>,
    ) -> Result<Written, Failure> {
        match (self, format) {
            (Self::Texture(texture), Format::Clip(format)) => clip(texture, format, options),
            (Self::Texture(texture), Format::Source(language)) => {
                let contents = &texture.contents;
                let name = contents.asset()?.name();
                source(name, contents.bytes(), language, path, source_options)
            }
            (Self::Library(library), Format::Source(language)) => source(
                &library.name(),
                &library.bytes()?,
                language,
                path,
                source_options,
            ),
            (Self::Library(_), Format::Clip(_)) => Err(Failure::usage(
                format!("texture: a {format} file holds one texture, not a library"),
                "export each texture of the library",
            )),
        }
    }
}

/// Strokes and taps of a texture.
fn clip(texture: &Texture, format: ClipFormat, options: &Options) -> Result<Written, Failure> {
    let asset = texture.contents.asset()?;
    let exported = interchange::export(&asset, format, options)?;
    let mut report = exported.json(asset.name());
    report["format"] = format.name().into();
    Ok(Written {
        data: exported.bytes,
        header: None,
        report,
    })
}

/// The bytes of an asset or a library as source text.
fn source(
    name: &str,
    bytes: &[u8],
    language: Language,
    path: Option<&Path>,
    options: SourceOptions<'_>,
) -> Result<Written, Failure> {
    let beside = path.and_then(|path| header_beside(language, path));
    let header = beside.as_deref().and_then(Path::file_name);
    let header = header.map(|name| name.to_string_lossy().into_owned());
    let options = SourceOptions {
        header: header.as_deref(),
        ..options
    };
    let written = export_source(language, name, bytes, &options)?;
    let report = written.json(language, name);
    Ok(Written {
        data: written.text,
        header: written.header,
        report,
    })
}

impl Written {
    /// Writes the file and its header, both or none.
    fn write(&self, path: &Path) -> Result<(), Failure> {
        let mut outputs = Outputs::beside::<&Path>([]);
        let file = outputs.open(path)?;
        let beside = self
            .header
            .as_ref()
            .map(|text| (path.with_extension("h"), text));
        let header = outputs.open_if(beside.as_ref().map(|(path, _)| &**path))?;
        outputs.fill(file, &self.data)?;
        if let (Some(file), Some((_, text))) = (header, &beside) {
            outputs.fill(file, text)?;
        }
        Ok(outputs.commit()?)
    }
}
