//! A HaTT material as its file states it, with every statement checked.

use super::{
    filter::{self, Filter},
    xml::{self, Element, WRONG_FILE, WRONG_VALUE},
};
use asperity_formats::limits;
use asperity_io::diagnostic::Fault;
use std::path::Path;

/// A HaTT material.
#[derive(Debug, Clone, PartialEq)]
pub struct Material {
    /// Name of the material.
    pub name: String,
    /// Sample rate of every model, Hz.
    pub sample_rate_hz: f64,
    /// Coefficient of kinetic friction.
    pub mu: f64,
    /// Right border of the grid, mm/s.
    pub max_speed_mm_s: f64,
    /// Upper border of the grid, N.
    pub max_force_n: f64,
    /// The models, in source order.
    pub models: Vec<SourceModel>,
    /// Indices of models, 0-based, in source order.
    pub triangles: Vec<[usize; 3]>,
}

/// ARMA model of a material: power spectrum `var·gain²·|MA|²/|AR|²`.
#[derive(Debug, Clone, PartialEq)]
pub struct SourceModel {
    /// Tangential speed, mm/s.
    pub speed_mm_s: f64,
    /// Normal force, N.
    pub force_n: f64,
    /// The denominator.
    pub ar: Filter,
    /// The numerator.
    pub ma: Filter,
    /// Variance of the excitation, (m/s²)².
    pub variance: f64,
    /// Gain of the numerator.
    pub gain: f64,
}

/// Coordinates are printed with six decimals: what differs from the border by less
/// than this share of it lies on it.
const BORDER_TOLERANCE: f64 = 1e-6;

/// Reads a material from the bytes of its file.
///
/// # Errors
/// [`Fault`] with the line and the field of the first thing that is wrong.
pub fn parse(file: &Path, bytes: &[u8]) -> Result<Material, Fault> {
    let document = xml::parse(file, bytes)?;
    let root = Element::root(file, &document);
    if root.name() != "modelSet" {
        let found: String = root.name().chars().take(40).collect();
        let what = format!("root element is <{found}>, <modelSet> expected");
        return Err(root.fault(what, WRONG_FILE));
    }
    for (field, expected) in [
        ("AccelUnits", "m/s^2"),
        ("SpeedUnits", "mm/s"),
        ("ForceUnits", "N"),
    ] {
        unit(&root, field, expected)?;
    }
    let name = name(&root)?;
    let models = root.children("model");
    if models.is_empty() {
        return Err(root.fault("has no <model>", WRONG_VALUE));
    }
    let count = |field, min, max| root.child("", field)?.count(field, min, max);
    let number = |field, rule: &str, min: f64, max: f64| {
        root.child("", field)?
            .number(field, rule, |v| v >= min && v <= max)
    };
    let (min_rate, max_rate) = limits::SAMPLE_RATE_HZ;
    let header = Header {
        sample_rate_hz: number(
            "SampleRate",
            "100 to 200000 Hz",
            min_rate.into(),
            max_rate.into(),
        )?,
        max_speed_mm_s: number(
            "maxSpeed",
            "above 0, at most 10000 mm/s",
            f64::MIN_POSITIVE,
            limits::MAX_SPEED_MM_S.into(),
        )?,
        max_force_n: number(
            "maxForce",
            "above 0, at most 1000 N",
            f64::MIN_POSITIVE,
            limits::MAX_FORCE_N.into(),
        )?,
        models: count("numMod", 3, limits::MAX_VERTICES)?,
        triangles: count("numTri", 1, limits::MAX_TRIANGLES)?,
        ar_order: count("numARCoeff", 1, limits::MAX_ORDER)?,
        ma_order: count("numMACoeff", 0, limits::MAX_ORDER)?,
    };
    let mu = number("mu", "0 to 10", 0.0, limits::MAX_MU.into())?;
    let speeds = header.positions(&root, "speedList", header.max_speed_mm_s)?;
    let forces = header.positions(&root, "forceList", header.max_force_n)?;
    root.check_count("model", models.len(), (header.models, "numMod"))?;
    let models = models
        .iter()
        .enumerate()
        .map(|(index, element)| header.model(element, index, speeds[index], forces[index]))
        .collect::<Result<_, _>>()?;
    Ok(Material {
        name,
        sample_rate_hz: header.sample_rate_hz,
        mu,
        max_speed_mm_s: header.max_speed_mm_s,
        max_force_n: header.max_force_n,
        models,
        triangles: header.triangles(&root)?,
    })
}

fn unit(root: &Element<'_, '_>, field: &str, expected: &str) -> Result<(), Fault> {
    let element = root.child("", field)?;
    if element.text() == expected {
        return Ok(());
    }
    let value: String = element.text().chars().take(40).collect();
    Err(element.fault(
        format!("{field} = {value:?}, {expected:?} expected"),
        format!("convert the file to {expected}"),
    ))
}

fn name(root: &Element<'_, '_>) -> Result<String, Fault> {
    let element = root.child("", "material")?;
    let value = element.text();
    let reason = if value.is_empty() {
        "empty"
    } else if value.len() > limits::MAX_NAME_BYTES {
        "longer than 64 bytes"
    } else if value.chars().any(char::is_control) {
        "holds a control character"
    } else {
        return Ok(value.to_owned());
    };
    let value: String = value.chars().take(80).collect();
    Err(element.fault(
        format!("material = {value:?}: {reason}"),
        "give <material> a name of 1 to 64 bytes without control characters",
    ))
}

/// List lengths and ranges stated by the head of the file.
struct Header {
    sample_rate_hz: f64,
    max_speed_mm_s: f64,
    max_force_n: f64,
    models: usize,
    triangles: usize,
    ar_order: usize,
    ma_order: usize,
}

impl Header {
    /// A coordinate of every model, those next to the border put on it.
    fn positions(
        &self,
        root: &Element<'_, '_>,
        field: &str,
        border: f64,
    ) -> Result<Vec<f64>, Fault> {
        let slack = border * BORDER_TOLERANCE;
        let rule = format!("0 to {border}");
        let list = root.child("", field)?;
        let values = list.list(field, (self.models, "numMod"), &rule, |v| {
            (0.0..=border + slack).contains(&v)
        })?;
        Ok(values
            .into_iter()
            .map(|v| if border - v <= slack { border } else { v })
            .collect())
    }

    fn triangles(&self, root: &Element<'_, '_>) -> Result<Vec<[usize; 3]>, Fault> {
        let elements = root.children("tri");
        root.check_count("tri", elements.len(), (self.triangles, "numTri"))?;
        let rule = format!("a model number, 1 to {}", self.models);
        elements
            .iter()
            .enumerate()
            .map(|(index, element)| {
                let field = format!("tri {}", index + 1);
                let corners =
                    element.list(&field, (3, "the corners of a triangle"), &rule, |v| {
                        v.fract() == 0.0 && v >= 1.0 && v <= self.models as f64
                    })?;
                let corner = |k: usize| corners[k] as usize - 1;
                let triangle = [corner(0), corner(1), corner(2)];
                for (k, other) in [(1, 0), (2, 0), (2, 1)] {
                    if triangle[k] == triangle[other] {
                        let rule = "another model than the other two corners";
                        let field = format_args!("{field}[{k}]");
                        return Err(element.out_of_range(field, corners[k], rule));
                    }
                }
                Ok(triangle)
            })
            .collect()
    }

    fn model(
        &self,
        element: &Element<'_, '_>,
        index: usize,
        speed_mm_s: f64,
        force_n: f64,
    ) -> Result<SourceModel, Fault> {
        let place = format!("model {} ", index + 1);
        let number = |field: &str, rule: &str, min: f64, max: f64| {
            element
                .child(&place, field)?
                .number(format_args!("{place}{field}"), rule, |v| {
                    v >= min && v <= max
                })
        };
        let stated = number("modNum", "the number of the model", 1.0, 1e6)?;
        let agree = |field: &str, value: f64, other: &str, other_value: f64, slack: f64| {
            if (value - other_value).abs() <= slack {
                return Ok(());
            }
            Err(element.child(&place, field)?.fault(
                format!("{place}{field} = {value}, but {other} = {other_value}"),
                format!("make it agree with {other}, or fetch the file again from HaTT"),
            ))
        };
        let ordinal = (index + 1) as f64;
        agree("modNum", stated, "its place in the file", ordinal, 0.0)?;
        for (field, list, value, border) in [
            ("speedMod", "speedList", speed_mm_s, self.max_speed_mm_s),
            ("forceMod", "forceList", force_n, self.max_force_n),
        ] {
            let found = number(field, "not negative", 0.0, f64::MAX)?;
            let slack = border * BORDER_TOLERANCE;
            agree(field, found, &format!("{list}[{index}]"), value, slack)?;
        }
        let (ar, ma) = (
            self.filter(
                element,
                &place,
                ("ARcoeff", "ARlsf"),
                ("numARCoeff", self.ar_order),
            )?,
            self.filter(
                element,
                &place,
                ("MAcoeff", "MAlsf"),
                ("numMACoeff", self.ma_order),
            )?,
        );
        let max_sigma = f64::from(limits::MAX_SIGMA_M_S2);
        Ok(SourceModel {
            speed_mm_s,
            force_n,
            ar,
            ma,
            variance: number("var", "0 to 1e8", 0.0, max_sigma * max_sigma)?,
            gain: number(
                "gain",
                "above 0, at most 1e4",
                f64::MIN_POSITIVE,
                limits::MAX_GAIN.into(),
            )?,
        })
    }

    /// A polynomial that is given twice: by coefficients and by LSFs.
    fn filter(
        &self,
        element: &Element<'_, '_>,
        place: &str,
        (coefficients, frequencies): (&str, &str),
        (stated_by, order): (&str, usize),
    ) -> Result<Filter, Fault> {
        let field = format!("{place}{coefficients}");
        let holder = element.child(place, coefficients)?;
        let monic = holder.list(&field, (order + 1, stated_by), "finite", |_| true)?;
        if monic[0] != 1.0 {
            let rule = "1, as the polynomial is monic";
            return Err(holder.out_of_range(format_args!("{field}[0]"), monic[0], rule));
        }
        let lsf = element.child(place, frequencies)?.list(
            &format!("{place}{frequencies}"),
            (order, stated_by),
            "0 to π rad",
            // Six decimals may round π up.
            |v| (0.0..=std::f64::consts::PI + 1e-6).contains(&v),
        )?;
        filter::choose(monic, lsf, self.sample_rate_hz).map_err(|distance_db| {
            let what = format!(
                "{field}: the line spectral frequencies are {distance_db:.3} dB from the coefficients, \
                 whose polynomial has roots on or outside the unit circle"
            );
            let remedy =
                "compare ARcoeff/MAcoeff and ARlsf/MAlsf of this model with the original file";
            holder.fault(what, remedy)
        })
    }
}
