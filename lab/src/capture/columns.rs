//! Meanings of a sensor's columns: `t_us,ax_g,ay_g,az_g,fz_N`.

use asperity_recording::description::{Axis, Quantity, Unit};

/// Most columns of a sensor.
const MOST: usize = 16;

/// A channel: what it measures, along which axis, in which unit.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Channel {
    /// Acceleration or force.
    pub quantity: Quantity,
    /// Its axis; [`Axis::Along`] for a sensor of one axis.
    pub axis: Axis,
    /// Its unit.
    pub unit: Unit,
}

impl Channel {
    /// Its name in the header of a table.
    #[must_use]
    pub fn name(&self) -> String {
        let letter = match self.quantity {
            Quantity::Force => 'f',
            _ => 'a',
        };
        match self.axis {
            Axis::Along => letter.to_string(),
            axis => format!("{letter}{axis}"),
        }
    }
}

/// The content of a column.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Column {
    /// The sensor's own clock, in units of so many seconds.
    Clock(f64),
    /// The sensor's count of samples.
    Count,
    /// A measured value.
    Channel(Channel),
    /// Not used.
    Skipped,
}

/// The columns of a sensor, in order.
#[derive(Debug, Clone, PartialEq)]
pub struct Layout(Vec<Column>);

impl Layout {
    /// Reads names with commas between them: `t_s`, `t_ms`, `t_us` or `t_ns` is a clock, `n` a count
    /// of samples, `-` a column that is not used; `ax`, `ay`, `az` or `a` is an acceleration, `fx`,
    /// `fy`, `fz` or `f` a force, with `_` and a unit unless it is g or N.
    ///
    /// # Errors
    /// A sentence that names the column at fault.
    pub fn parse(text: &str) -> Result<Self, String> {
        let columns = text.split(',').map(|name| column(name.trim()));
        let columns = columns.take(MOST + 1).collect::<Result<Vec<_>, _>>()?;
        if columns.len() > MOST {
            return Err(format!("has more than {MOST} columns"));
        }
        let layout = Self(columns);
        let names: Vec<String> = layout.channels().map(Channel::name).collect();
        for (n, name) in names.iter().enumerate() {
            if names[..n].contains(name) {
                return Err(format!("names {name} twice"));
            }
        }
        let times = layout
            .0
            .iter()
            .filter(|column| matches!(column, Column::Clock(_) | Column::Count));
        if times.count() > 1 {
            return Err("has two columns that count time".into());
        }
        if !layout.has(Quantity::Acceleration) {
            return Err("has no acceleration, such as ax_g".into());
        }
        Ok(layout)
    }

    /// Accelerations for so many channels without names: one axis, or x, y and z.
    #[must_use]
    pub fn of_width(channels: usize) -> Option<Self> {
        match channels {
            1 => Self::parse("a").ok(),
            3 => Self::parse("ax,ay,az").ok(),
            _ => None,
        }
    }

    /// All columns.
    #[must_use]
    pub fn columns(&self) -> &[Column] {
        &self.0
    }

    /// The measured ones.
    pub fn channels(&self) -> impl Iterator<Item = &Channel> {
        self.0.iter().filter_map(|column| match column {
            Column::Channel(channel) => Some(channel),
            _ => None,
        })
    }

    /// Returns true if the quantity is measured.
    #[must_use]
    pub fn has(&self, quantity: Quantity) -> bool {
        self.channels().any(|channel| channel.quantity == quantity)
    }

    /// Place among the channels of the force along the surface's normal.
    #[must_use]
    pub fn load(&self) -> Option<usize> {
        self.channels()
            .position(|c| c.quantity == Quantity::Force && c.axis == Axis::Z)
    }

    /// Returns true if the sensor has a clock of its own.
    #[must_use]
    pub fn has_clock(&self) -> bool {
        self.0.iter().any(|c| matches!(c, Column::Clock(_)))
    }
}

fn column(name: &str) -> Result<Column, String> {
    match name {
        "t_s" => return Ok(Column::Clock(1.0)),
        "t_ms" => return Ok(Column::Clock(1e-3)),
        "t_us" => return Ok(Column::Clock(1e-6)),
        "t_ns" => return Ok(Column::Clock(1e-9)),
        "n" => return Ok(Column::Count),
        "-" => return Ok(Column::Skipped),
        _ => {}
    }
    let unknown = || {
        let shown: String = name.chars().take(20).collect();
        format!("has a column `{shown}`, which is none of t_us, n, ax_g, fz_N, …")
    };
    let (what, unit) = match name.split_once('_') {
        Some((what, unit)) => (what, Some(unit)),
        None => (name, None),
    };
    let (quantity, usual) = match what.as_bytes().first() {
        Some(b'a') => (Quantity::Acceleration, "g"),
        Some(b'f') => (Quantity::Force, "N"),
        _ => return Err(unknown()),
    };
    let axis = match &what[1..] {
        "" => Axis::Along,
        "x" => Axis::X,
        "y" => Axis::Y,
        "z" => Axis::Z,
        _ => return Err(unknown()),
    };
    let name = unit.unwrap_or(usual);
    let unit = Unit::named(name, quantity).ok_or_else(|| {
        let shown: String = name.chars().take(20).collect();
        format!(
            "has the unit `{shown}`, which is none of {quantity}: {}",
            Unit::all(quantity)
        )
    })?;
    Ok(Column::Channel(Channel {
        quantity,
        axis,
        unit,
    }))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_say_quantity_axis_and_unit() {
        let layout = Layout::parse("t_us, ax_m/s^2,-,az,fz_mN").expect("a layout");
        assert!(layout.has_clock());
        assert_eq!(layout.columns().len(), 5);
        let names: Vec<String> = layout.channels().map(Channel::name).collect();
        assert_eq!(names, ["ax", "az", "fz"]);
        let units: Vec<&str> = layout.channels().map(|c| c.unit.name).collect();
        assert_eq!(units, ["m/s^2", "g", "mN"]);
        assert_eq!(layout.load(), Some(2));
    }

    #[test]
    fn what_cannot_be_meant_is_refused_with_its_name() {
        for (text, part) in [
            ("ax,ax_mg", "ax twice"),
            ("t_us,n,ax", "two columns"),
            ("fz_N", "no acceleration"),
            ("ax_gee", "`gee`"),
            ("aé", "`aé`"),
            ("speed", "`speed`"),
            ("", "``"),
        ] {
            let error = Layout::parse(text).expect_err(text);
            assert!(error.contains(part), "{text}: {error}");
        }
        assert!(Layout::parse(&["-"; 17].join(",")).is_err());
    }
}
