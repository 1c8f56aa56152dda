//! Where a scene is to run, and what it may cost there.

use super::{
    cost::{Cost, Surfaces, sizes},
    counted::COSTS,
};
use asperity_texture::model::TextureModel;
use std::{fmt, str::FromStr};

/// Where a scene is to run: a processor at a clock, or a number of instructions on the first
/// processor of the table.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Target {
    cost: &'static Cost,
    supply: Supply,
}

#[derive(Debug, Clone, Copy, PartialEq)]
enum Supply {
    ClockHz(f64),
    Instructions(u64),
}

impl Target {
    /// Executed instructions of a tick with this texture among these surfaces.
    #[must_use]
    pub fn instructions(&self, texture: &TextureModel, surfaces: Surfaces) -> u64 {
        self.cost.instructions(sizes(texture), surfaces)
    }

    /// The most that [`Target::instructions`] is above what was counted, percent.
    #[must_use]
    pub fn above_percent(&self) -> f64 {
        self.cost.above_percent
    }

    /// Instructions that a tick may take: those stated, or this share of the clocks of a period, at
    /// one instruction a clock.
    #[must_use]
    pub fn budget(&self, servo_rate_hz: f64, share: f64) -> u64 {
        match self.supply {
            Supply::ClockHz(hz) => (hz / servo_rate_hz * share) as u64,
            Supply::Instructions(count) => count,
        }
    }

    /// The first processor of the table, without a limit.
    #[must_use]
    pub fn unlimited() -> Self {
        Self {
            cost: &COSTS[0],
            supply: Supply::Instructions(u64::MAX),
        }
    }

    /// Name of the processor whose instructions are counted.
    #[must_use]
    pub fn processor(&self) -> &'static str {
        self.cost.processor
    }
}

impl fmt::Display for Target {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.supply {
            Supply::ClockHz(hz) => write!(f, "{}@{}MHz", self.cost.processor, hz / 1e6),
            Supply::Instructions(u64::MAX) => f.write_str(self.cost.processor),
            Supply::Instructions(count) => {
                write!(f, "{count} instructions of a {}", self.cost.processor)
            }
        }
    }
}

impl FromStr for Target {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        if let Ok(count) = text.parse() {
            return Ok(Self {
                cost: &COSTS[0],
                supply: Supply::Instructions(count),
            });
        }
        let known: Vec<&str> = COSTS.iter().map(|cost| cost.processor).collect();
        let known = known.join(", ");
        let wrong = || {
            format!(
                "a processor and its clock, e.g. cortex-m4f@168MHz, or a number of instructions; processors: {known}"
            )
        };
        let (name, clock) = text.split_once('@').ok_or_else(wrong)?;
        let cost = COSTS
            .iter()
            .find(|cost| cost.processor == name)
            .ok_or_else(|| format!("no processor {name:?} was measured, only: {known}"))?;
        let mhz: f64 = clock
            .strip_suffix("MHz")
            .and_then(|mhz| mhz.parse().ok())
            .filter(|mhz| (0.001..=1e6).contains(mhz))
            .ok_or_else(wrong)?;
        Ok(Self {
            cost,
            supply: Supply::ClockHz(1e6 * mhz),
        })
    }
}

#[cfg(test)]
mod tests {
    use super::{super::counted::MEASURED, *};

    #[test]
    fn no_count_is_above_the_model_nor_further_below_than_stated() {
        for (
            processor,
            [
                poles,
                zeros,
                triangles,
                laws,
                contacts,
                axes,
                planes,
                spheres,
                boxes,
            ],
            count,
        ) in MEASURED
        {
            let cost = COSTS.iter().find(|cost| cost.processor == processor);
            let cost = cost.expect("an entry");
            let surfaces = Surfaces([planes, spheres, boxes]);
            let modelled =
                cost.instructions([poles, zeros, triangles, laws, contacts, axes], surfaces);
            // Both sides are rounded up to a whole instruction.
            let most = (count as f64 * (1.0 + cost.above_percent / 100.0)).ceil() as u64;
            assert!(
                (count..=most).contains(&modelled),
                "{processor}, {poles} poles, {zeros} zeros, {laws} laws, {contacts} contact laws, {axes} directions: {count} counted, {modelled} modelled"
            );
        }
    }

    #[test]
    fn a_target_is_a_clock_or_a_number() {
        let budget = |text: &str| text.parse::<Target>().map(|t| t.budget(1000.0, 0.5));
        assert_eq!(budget("cortex-m4f@168MHz"), Ok(84_000));
        assert_eq!(budget("5000"), Ok(5000));
        for wrong in ["", "cortex-m4f", "cortex-m4f@fast", "cortex-m4f@NaNMHz"] {
            assert!(budget(wrong).unwrap_err().contains("cortex-m4f@168MHz"));
        }
        let unknown = budget("z80@4MHz").unwrap_err();
        assert!(unknown.contains("z80") && unknown.contains("cortex-m4f"));
    }
}
