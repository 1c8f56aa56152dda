//! No device: it rests at a set height, and takes any force.

use super::{Description, Device, DeviceError, Reading, Uri, open::OpenError};

/// Where it rests by default, m: in free air over the plane z = 0.
const FREE_AIR_M: f32 = 0.05;
/// Largest distance of its resting height from zero, mm.
const REACH_MM: f32 = 1000.0;

/// A device that is none. Every reading is fresh.
#[derive(Debug, Clone)]
pub struct NullDevice {
    description: Description,
    z_m: f32,
}

impl NullDevice {
    /// A device that rests at a height over the plane z = 0, m.
    #[must_use]
    pub fn at(z_m: f32) -> Self {
        Self {
            description: Description {
                name: "no device".into(),
                serial: None,
                // A Touch's, so that the same forces are rendered.
                peak_force_n: 3.3,
                continuous_force_n: 3.3,
                unconfirmed: Vec::new(),
            },
            z_m,
        }
    }

    /// `null:` or `null:?z_mm=-1`.
    ///
    /// # Errors
    /// [`OpenError`] for another setting, or a height that is none.
    pub fn open(uri: &Uri) -> Result<Self, OpenError> {
        uri.allow(&["z_mm"])?;
        let Some(text) = uri.setting("z_mm") else {
            return Ok(Self::at(FREE_AIR_M));
        };
        let z_mm = text.parse().ok();
        let z_mm = z_mm.filter(|z_mm: &f32| z_mm.abs() <= REACH_MM);
        z_mm.map(|z_mm| Self::at(1e-3 * z_mm))
            .ok_or_else(|| OpenError::setting(uri, "z_mm", "a height of -1000 to 1000 mm"))
    }
}

impl Device for NullDevice {
    fn description(&self) -> &Description {
        &self.description
    }

    fn read(&mut self) -> Result<Reading, DeviceError> {
        Ok(Reading {
            position_m: [0.0, 0.0, self.z_m],
            fresh: true,
            buttons: 0,
        })
    }

    fn write(&mut self, _: [f32; 3]) -> Result<(), DeviceError> {
        Ok(())
    }
}
