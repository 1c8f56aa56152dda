//! Watch for devices being plugged in and out.

use std::collections::BTreeMap;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Duration;

use rusb::{Context, Device, Hotplug, HotplugBuilder, UsbContext as _};

use super::error::UsbError;
use super::ids::Ids;
use super::scan::{Found, context, scan};

/// Time between two looks.
const LOOK: Duration = Duration::from_millis(500);

/// A change of the bus.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Event {
    /// A device of the list was plugged in, or was there at the beginning.
    Arrived(Found),
    /// It was plugged out.
    Left(Found),
}

/// Raises a flag when libusb tells of a change.
struct Bell(Arc<AtomicBool>);

impl Hotplug<Context> for Bell {
    fn device_arrived(&mut self, _: Device<Context>) {
        self.0.store(true, Ordering::Release);
    }

    fn device_left(&mut self, _: Device<Context>) {
        self.0.store(true, Ordering::Release);
    }
}

/// Returns true if libusb reports changes on this system.
#[must_use]
pub fn has_hotplug() -> bool {
    rusb::has_hotplug()
}

/// Tells what is plugged in and out until `each` gives false. It is called with `None` at least
/// twice a second. Where libusb tells of changes, a look follows at once; elsewhere, and in case it
/// misses one, there is a look every half second.
///
/// # Errors
/// [`UsbError::NoUsb`].
pub fn watch(ids: &Ids, mut each: impl FnMut(Option<Event>) -> bool) -> Result<(), UsbError> {
    let context = context()?;
    let rung = Arc::new(AtomicBool::new(false));
    // A system without hot-plug, or that refuses it, is looked at by the clock.
    let _registration = rusb::has_hotplug().then(|| {
        let bell = Box::new(Bell(rung.clone()));
        HotplugBuilder::new().register(&context, bell).ok()
    });
    let mut there: BTreeMap<(u8, u8), Found> = BTreeMap::new();
    loop {
        let now = scan(ids)?.into_iter().filter(|found| found.kind.is_some());
        let now: BTreeMap<_, _> = now
            .map(|found| ((found.bus, found.address), found))
            .collect();
        let left = there.iter().filter(|(place, _)| !now.contains_key(place));
        let left = left.map(|(_, found)| Event::Left(found.clone()));
        let came = now.iter().filter(|(place, _)| !there.contains_key(place));
        let came = came.map(|(_, found)| Event::Arrived(found.clone()));
        for event in left.chain(came).collect::<Vec<_>>() {
            if !each(Some(event)) {
                return Ok(());
            }
        }
        there = now;
        let begun = std::time::Instant::now();
        while begun.elapsed() < LOOK && !rung.swap(false, Ordering::AcqRel) {
            if !each(None) {
                return Ok(());
            }
            let step = Duration::from_millis(50);
            // Where there are no events to wait for, waiting must not become spinning.
            let waited = std::time::Instant::now();
            let _ = context.handle_events(Some(step));
            std::thread::sleep(step.saturating_sub(waited.elapsed()));
        }
    }
}
