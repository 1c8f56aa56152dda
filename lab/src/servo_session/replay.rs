//! A recording as a device: the conditions of its session, and whether forces repeat.

use super::error::ServoSessionError;
use super::opened::{OpenDevice, Repeated, Replayed};
use asperity_host::device::replay::Replay;
use asperity_host::device::{Description, Device, DeviceError, OpenError, Reading, Uri};
use asperity_host::session_log::pace;
use std::sync::Arc;
use std::sync::atomic::Ordering::Relaxed;

/// A recording that tells how it compares from its servo thread.
struct Compared {
    replay: Replay,
    readings: usize,
    repeated: Arc<Repeated>,
}

/// Opens `replay:FILE?end=leave|loop`.
///
/// # Errors
/// [`ServoSessionError::Open`].
pub(super) fn open(uri: &Uri) -> Result<OpenDevice, ServoSessionError> {
    let replay = Replay::open(uri).map_err(|error| OpenError::Failed {
        uri: uri.to_string(),
        why: error.to_string(),
        remedy: error.remedy().into(),
    })?;
    let recording = replay.recording();
    let repeats = uri.setting("end") == Some("loop");
    let repeated = Arc::<Repeated>::default();
    let conditions = recording.conditions.clone();
    let replayed = Replayed {
        exchanges: recording.textures.len(),
        lost: recording.lost(),
        repeated: Arc::clone(&repeated),
        conditions,
    };
    Ok(OpenDevice {
        mechanics: replayed.conditions.config.mechanics,
        profile: None,
        pace: pace(recording, repeats),
        replayed: Some(replayed),
        device: Box::new(Compared {
            replay,
            readings: 0,
            repeated,
        }),
    })
}

impl Device for Compared {
    fn description(&self) -> &Description {
        self.replay.description()
    }

    fn read(&mut self) -> Result<Reading, DeviceError> {
        self.readings += 1;
        self.replay.read()
    }

    fn write(&mut self, force_n: [f32; 3]) -> Result<(), DeviceError> {
        self.replay.write(force_n)?;
        // After its end a recording has nothing to compare with.
        if self.readings <= self.replay.recording().entries.len() {
            let (forces, different) = self.replay.compared();
            self.repeated.forces.store(forces, Relaxed);
            self.repeated.different.store(different, Relaxed);
        }
        Ok(())
    }

    fn recover(&mut self) -> Result<(), DeviceError> {
        self.replay.recover()
    }
}
