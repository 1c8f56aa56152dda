//! The global constants of the generator, and the file that states them.

use crate::CorpusError;
use asperity_surface::stylus::Stylus;
use serde::{Deserialize, Serialize};

/// Name of the file in error messages.
const FILE: &str = "training/corpora/generator.toml";
/// The committed file.
const EMBEDDED: &str = include_str!("../../../corpora/generator.toml");
/// Width of a 95 % interval of a normal distribution, standard deviations.
const INTERVAL_DEVIATIONS: f64 = 2.0 * 1.959_964;

macro_rules! constants {
    ($($(#[$meaning:meta])* $name:ident,)*) => {
        /// Values of all constants; units and meanings as in `training/corpora/generator.toml`.
        #[derive(Debug, Clone, Copy, PartialEq)]
        pub struct Constants {
            $($(#[$meaning])* pub $name: f64,)*
        }

        impl Constants {
            /// Their names, in order.
            pub const NAMES: [&'static str; COUNT] = [$(stringify!($name)),*];

            /// Their values, in the order of [`Self::NAMES`].
            #[must_use]
            pub const fn to_array(&self) -> [f64; COUNT] {
                [$(self.$name),*]
            }

            /// The reverse of [`Self::to_array`].
            #[must_use]
            pub const fn from_array(values: [f64; COUNT]) -> Self {
                let [$($name),*] = values;
                Self { $($name),* }
            }
        }

        /// Number of constants.
        pub const COUNT: usize = [$(stringify!($name)),*].len();
    };
}

constants! {
    /// Level at 100 mm/s and 1 N of a relief of 5 µm and 10 MPa, dB re 1 m/s².
    level_db,
    /// dB a decade of height.
    level_per_height_db,
    /// dB a decade of modulus.
    level_per_modulus_db,
    /// p in RMS ∝ v^p at 10 MPa.
    speed_exponent,
    /// Its growth for a decade of modulus.
    speed_exponent_per_modulus,
    /// p in RMS ∝ F^p at 10 MPa.
    force_exponent,
    /// Its growth for a decade of modulus.
    force_exponent_per_modulus,
    /// Power of the broad relief relative to the line, at the wavelength of a line one octave wide.
    background,
    /// b in the power k^−b of the broad relief.
    background_slope,
    /// Length over which the contact averages heights, mm.
    contact_mm,
    /// Resonance of the stylus on a contact of 10 MPa at 1 N, Hz.
    resonance_hz,
    /// Its exponent in the modulus.
    resonance_modulus_exponent,
    /// Its exponent in the force.
    resonance_force_exponent,
    /// Damping ratio of the hand.
    hand_damping,
    /// Share of white noise in the power.
    floor,
    /// μ where the corpus states 1, at 10 MPa and 5 µm.
    friction,
    /// Exponent of the stated μ.
    friction_exponent,
    /// Exponent of the modulus in μ.
    friction_modulus_exponent,
    /// Exponent of the height in μ.
    friction_height_exponent,
}

/// Which values the constants have.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum ConstantSet {
    /// Fitted to measured materials.
    #[default]
    Calibrated,
    /// From physics and openly licensed measurements alone.
    Open,
}

/// A value with the ends of its 95 % interval.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Estimate {
    /// The value.
    pub value: f64,
    /// Lower end.
    pub low: f64,
    /// Upper end.
    pub high: f64,
}

impl Estimate {
    /// Four significant digits of each number.
    #[must_use]
    pub fn rounded(self) -> Self {
        let round = |x: f64| format!("{x:.3e}").parse().unwrap_or(x);
        Self {
            value: round(self.value),
            low: round(self.low),
            high: round(self.high),
        }
    }
}

/// A constant as the file states it.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Constant {
    /// A name of [`Constants::NAMES`].
    pub name: String,
    /// Unit of its values.
    pub unit: String,
    /// Its meaning.
    pub meaning: String,
    /// True if it is positive and fitted as its logarithm.
    pub logarithmic: bool,
    /// By physics and open data; the prior of the fit.
    pub open: Estimate,
    /// Source of the open value.
    pub source: String,
    /// The farthest that one material left out moves the calibrated value, as a share of the distance to the end of its
    /// interval, on the scale of the fit.
    pub moved: f64,
    /// Fitted to measured materials.
    pub calibrated: Estimate,
}

impl Constant {
    /// The value on the scale that it is fitted on, natural logarithms for logarithmic ones.
    #[must_use]
    pub fn scaled(&self, value: f64) -> f64 {
        if self.logarithmic {
            libm::log(value)
        } else {
            value
        }
    }

    /// The reverse of [`Self::scaled`].
    #[must_use]
    pub fn unscaled(&self, scaled: f64) -> f64 {
        if self.logarithmic {
            libm::exp(scaled)
        } else {
            scaled
        }
    }

    /// Standard deviation of the prior, on the scale of the fit.
    #[must_use]
    pub fn prior_deviation(&self) -> f64 {
        (self.scaled(self.open.high) - self.scaled(self.open.low)) / INTERVAL_DEVIATIONS
    }
}

/// The file.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ConstantsFile {
    /// Every constant, in the order of [`Constants::NAMES`].
    pub constant: Vec<Constant>,
}

impl ConstantsFile {
    /// The committed file.
    ///
    /// # Errors
    /// [`CorpusError`] that names the constant and its fault.
    pub fn embedded() -> Result<Self, CorpusError> {
        Self::parse(EMBEDDED)
    }

    fn parse(text: &str) -> Result<Self, CorpusError> {
        let file: Self = toml::from_str(text).map_err(|error| CorpusError::Syntax {
            file: FILE.into(),
            message: error.to_string(),
        })?;
        let names = file.constant.iter().map(|c| c.name.as_str());
        if !names.eq(Constants::NAMES) {
            let what = format!(
                "{FILE}: the constants must be {:?}, in this order",
                Constants::NAMES
            );
            return Err(CorpusError::Faults { faults: vec![what] });
        }
        let holds = |c: &Constant, of: &Estimate| {
            let ordered = of.low <= of.value && of.value <= of.high;
            ordered && of.low.is_finite() && of.high.is_finite() && (!c.logarithmic || of.low > 0.0)
        };
        let faulty = file
            .constant
            .iter()
            .filter(|c| !holds(c, &c.open) || !holds(c, &c.calibrated));
        let faults: Vec<String> = faulty
            .map(|c| {
                format!(
                    "{FILE}: {}: low, value, high must ascend, above 0 where logarithmic",
                    c.name
                )
            })
            .collect();
        if faults.is_empty() {
            Ok(file)
        } else {
            Err(CorpusError::Faults { faults })
        }
    }

    /// The values of a set.
    #[must_use]
    pub fn values(&self, set: ConstantSet) -> Constants {
        let mut values = [0.0; COUNT];
        for (value, constant) in values.iter_mut().zip(&self.constant) {
            *value = match set {
                ConstantSet::Calibrated => constant.calibrated.value,
                ConstantSet::Open => constant.open.value,
            };
        }
        Constants::from_array(values)
    }

    /// The text of the file, with the comments of the committed one before the first constant.
    ///
    /// # Errors
    /// Of the serialiser.
    pub fn text(&self) -> Result<String, toml::ser::Error> {
        let head: String = EMBEDDED
            .lines()
            .take_while(|line| !line.starts_with('['))
            .map(|line| format!("{line}\n"))
            .collect();
        Ok(head + &toml::to_string(self)?)
    }
}

impl Constants {
    /// Tool and hand.
    #[must_use]
    pub const fn stylus(&self) -> Stylus {
        Stylus {
            resonance_hz: self.resonance_hz,
            modulus_exponent: self.resonance_modulus_exponent,
            force_exponent: self.resonance_force_exponent,
            hand_damping: self.hand_damping,
        }
    }

    /// A committed set.
    ///
    /// # Errors
    /// As [`ConstantsFile::embedded`].
    pub fn embedded(set: ConstantSet) -> Result<Self, CorpusError> {
        Ok(ConstantsFile::embedded()?.values(set))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use asperity_surface::vibration::FLOOR;

    #[test]
    fn there_are_at_most_thirty_and_the_file_states_each_with_its_source() {
        let file = ConstantsFile::embedded().unwrap();
        assert!(COUNT <= 30 && file.constant.len() == COUNT);
        assert!(
            file.constant
                .iter()
                .all(|c| !c.unit.is_empty() && !c.meaning.is_empty() && !c.source.is_empty())
        );
        let values = file.values(ConstantSet::Calibrated);
        assert_eq!(Constants::from_array(values.to_array()), values);
        assert_ne!(values, file.values(ConstantSet::Open));
        assert_eq!(values.stylus(), Stylus::CALIBRATED);
        assert!((values.floor / FLOOR - 1.0).abs() < 1e-3);
    }

    #[test]
    fn the_file_is_written_as_it_is_read() {
        let file = ConstantsFile::embedded().unwrap();
        let text = file.text().unwrap();
        assert!(text.starts_with("# Constants of the generator"));
        assert_eq!(ConstantsFile::parse(&text).unwrap(), file);
    }

    #[test]
    fn a_constant_that_is_missing_or_beyond_its_interval_is_named() {
        let renamed = EMBEDDED.replacen("\"floor\"", "\"roof\"", 1);
        let beyond = EMBEDDED.replacen("high = 640.0", "high = 1.0", 1);
        for (text, named) in [(renamed, "\"floor\""), (beyond, "resonance_hz")] {
            let message = ConstantsFile::parse(&text).unwrap_err().to_string();
            assert!(
                message.contains(FILE) && message.contains(named),
                "{message}"
            );
        }
    }
}
