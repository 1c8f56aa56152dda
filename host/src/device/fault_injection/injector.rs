//! A device behind faults.

use std::collections::BTreeMap;

use super::kind::InjectedFault;
use crate::device::{Description, Device, DeviceError, Reading};
use crate::fault_plan::{FaultPlan, FaultSchedule};

/// A device behind faults. Injectors stack.
#[derive(Debug)]
pub struct DeviceFaultInjector<D> {
    inner: D,
    schedule: FaultSchedule<InjectedFault>,
    /// Fault of the current period.
    now: Option<InjectedFault>,
    last: Reading,
    clock_step: u32,
    /// Periods that clock steps skipped.
    skipped: u64,
}

impl<D: Device> DeviceFaultInjector<D> {
    /// Puts a device behind the faults of a plan. The duration of a clock step is the number of
    /// periods that it skips.
    pub fn new(inner: D, plan: FaultPlan<InjectedFault>, seed: u64) -> Self {
        Self {
            inner,
            schedule: FaultSchedule::new(plan, seed),
            now: None,
            last: Reading {
                position_m: [0.0; 3],
                fresh: false,
                buttons: 0,
            },
            clock_step: 0,
            skipped: 0,
        }
    }

    /// The device behind the faults.
    pub fn inner(&self) -> &D {
        &self.inner
    }

    /// In how many periods each kind ran.
    pub fn counts(&self) -> &BTreeMap<InjectedFault, u64> {
        self.schedule.counts()
    }

    /// Periods that clock steps skipped.
    pub fn skipped(&self) -> u64 {
        self.skipped
    }

    /// The fault of the last reading.
    pub fn running(&self) -> Option<InjectedFault> {
        self.now
    }

    /// Starts a fault with the next reading; it replaces one that runs. A clock step skips
    /// `periods` periods at once.
    pub fn start(&mut self, kind: InjectedFault, periods: u32) {
        self.schedule.start(kind, periods);
    }

    /// Periods by which the clock has jumped since the last call. A loop adds them to those that
    /// passed by its own clock.
    pub fn take_clock_step(&mut self) -> u32 {
        std::mem::take(&mut self.clock_step)
    }

    fn draw(&mut self) -> Option<InjectedFault> {
        let (kind, periods) = self.schedule.draw()?;
        if kind == InjectedFault::ClockStep {
            self.clock_step = self.clock_step.saturating_add(periods);
            self.skipped += u64::from(periods);
            self.schedule.stop();
        }
        Some(kind)
    }

    /// Draws one of several values.
    fn one_of<const N: usize>(&mut self, values: [f32; N]) -> f32 {
        values[self.schedule.below(N as u64) as usize]
    }

    /// A reading with another coordinate.
    fn spoiled(&mut self, mut reading: Reading, coordinate: f32) -> Reading {
        reading.position_m[self.schedule.below(3) as usize] = coordinate;
        reading
    }
}

impl<D: Device> Device for DeviceFaultInjector<D> {
    fn description(&self) -> &Description {
        self.inner.description()
    }

    fn read(&mut self) -> Result<Reading, DeviceError> {
        self.now = self.draw();
        let read = self.inner.read();
        let Some(kind) = self.now else {
            let reading = read?;
            self.last = reading;
            return Ok(reading);
        };
        match kind {
            InjectedFault::Lost => Err(DeviceError::TimedOut),
            InjectedFault::Late => Ok(Reading {
                fresh: false,
                ..self.last
            }),
            InjectedFault::Duplicate => Ok(self.last),
            InjectedFault::Stuck => Ok(Reading {
                position_m: self.last.position_m,
                ..read?
            }),
            InjectedFault::NotFinite => {
                let coordinate = self.one_of([f32::NAN, f32::INFINITY, f32::NEG_INFINITY]);
                Ok(self.spoiled(read?, coordinate))
            }
            InjectedFault::OutOfRange => {
                let coordinate = self.one_of([-5.0, 2.5, 1e20]);
                Ok(self.spoiled(read?, coordinate))
            }
            InjectedFault::ShortTransfer => Err(DeviceError::ShortTransfer {
                got: self.schedule.below(16) as u16,
                wanted: 16,
            }),
            InjectedFault::Stalled => Err(DeviceError::Stalled),
            InjectedFault::Unplugged => Err(DeviceError::Disconnected),
            InjectedFault::WriteFailed | InjectedFault::ClockStep => {
                let reading = read?;
                self.last = reading;
                Ok(reading)
            }
        }
    }

    fn write(&mut self, force_n: [f32; 3]) -> Result<(), DeviceError> {
        match self.now {
            Some(InjectedFault::Unplugged) => {
                // Without its plug it has no force; what it says to that is lost too.
                let _ = self.inner.write([0.0; 3]);
                Err(DeviceError::Disconnected)
            }
            Some(InjectedFault::WriteFailed) => Err(DeviceError::TimedOut),
            _ => self.inner.write(force_n),
        }
    }

    fn recover(&mut self) -> Result<(), DeviceError> {
        match self.schedule.running() {
            Some(InjectedFault::Unplugged) => Err(DeviceError::Disconnected),
            _ => self.inner.recover(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Walks a metre to the right in a thousand readings, and remembers the last force.
    #[derive(Debug)]
    struct Walk {
        description: Description,
        steps: u32,
        force_n: [f32; 3],
    }

    fn walk() -> Walk {
        Walk {
            description: Description {
                name: "walk".into(),
                serial: None,
                peak_force_n: 1.0,
                continuous_force_n: 1.0,
                unconfirmed: Vec::new(),
            },
            steps: 0,
            force_n: [0.0; 3],
        }
    }

    impl Device for Walk {
        fn description(&self) -> &Description {
            &self.description
        }

        fn read(&mut self) -> Result<Reading, DeviceError> {
            self.steps += 1;
            Ok(Reading {
                position_m: [1e-3 * self.steps as f32, 0.0, 0.0],
                fresh: true,
                buttons: self.steps,
            })
        }

        fn write(&mut self, force_n: [f32; 3]) -> Result<(), DeviceError> {
            self.force_n = force_n;
            Ok(())
        }
    }

    #[test]
    fn each_fault_is_what_the_table_says() {
        let mut device = DeviceFaultInjector::new(walk(), FaultPlan::default(), 1);
        let mut run = |kind: InjectedFault| {
            let good = device.read().expect("no fault");
            device.write([0.5, 0.0, 0.0]).expect("no fault");
            device.start(kind, 2);
            let read = device.read();
            let wrote = device.write([0.7, 0.0, 0.0]);
            let skipped = device.take_clock_step();
            let force = device.inner().force_n[0];
            // The second period of the fault.
            let _ = device.read();
            (good, read, wrote, skipped, force)
        };
        for kind in InjectedFault::ALL {
            let (good, read, wrote, skipped, force) = run(kind);
            let next = Reading {
                position_m: [good.position_m[0] + 1e-3, 0.0, 0.0],
                fresh: true,
                buttons: good.buttons + 1,
            };
            let near = |reading: Reading| {
                (reading.position_m[0] - next.position_m[0]).abs() < 1e-6
                    && reading.buttons == next.buttons
            };
            match kind {
                InjectedFault::Lost => assert_eq!(read, Err(DeviceError::TimedOut)),
                InjectedFault::Late => assert_eq!(
                    read,
                    Ok(Reading {
                        fresh: false,
                        ..good
                    })
                ),
                InjectedFault::Duplicate => assert_eq!(read, Ok(good)),
                InjectedFault::Stuck => assert_eq!(
                    read,
                    Ok(Reading {
                        position_m: good.position_m,
                        ..next
                    })
                ),
                InjectedFault::NotFinite => assert!(
                    !read
                        .expect("a reading")
                        .position_m
                        .iter()
                        .all(|x| x.is_finite())
                ),
                InjectedFault::OutOfRange => assert!(
                    read.expect("a reading")
                        .position_m
                        .iter()
                        .any(|x| x.abs() > 1.0)
                ),
                InjectedFault::ShortTransfer => {
                    assert!(matches!(
                        read,
                        Err(DeviceError::ShortTransfer { wanted: 16, .. })
                    ))
                }
                InjectedFault::Stalled => assert_eq!(read, Err(DeviceError::Stalled)),
                InjectedFault::Unplugged => assert_eq!(read, Err(DeviceError::Disconnected)),
                InjectedFault::WriteFailed | InjectedFault::ClockStep => {
                    assert!(near(read.expect("a reading")))
                }
            }
            let expected = match kind {
                InjectedFault::Unplugged => (Err(DeviceError::Disconnected), 0, 0.0),
                InjectedFault::WriteFailed => (Err(DeviceError::TimedOut), 0, 0.5),
                InjectedFault::ClockStep => (Ok(()), 2, 0.7),
                _ => (Ok(()), 0, 0.7),
            };
            assert_eq!((wrote, skipped, force), expected, "{kind:?}");
        }
    }

    #[test]
    fn faults_come_at_their_rate_and_the_same_seed_gives_the_same_ones() {
        let run = |seed| {
            let plan = FaultPlan::all(&InjectedFault::ALL, 0.11, 1);
            let mut device = DeviceFaultInjector::new(walk(), plan, seed);
            let read: Vec<String> = (0..100_000)
                .map(|_| format!("{:?}", device.read()))
                .collect();
            (device.counts().clone(), read)
        };
        let (counts, read) = run(7);
        for kind in InjectedFault::ALL {
            // The bound is five standard deviations of a binomial count.
            let count = counts[&kind];
            let off = (count as f64 - 1000.0).abs();
            assert!(off < 5.0 * f64::sqrt(1000.0), "{kind:?}: {count}");
        }
        assert_eq!(read, run(7).1);
        assert_ne!(read, run(8).1);
    }

    #[test]
    fn injectors_stack() {
        let plan = FaultPlan::default().with(InjectedFault::Lost, 1.0, 1);
        let inner = DeviceFaultInjector::new(walk(), plan, 1);
        let mut outer = DeviceFaultInjector::new(inner, FaultPlan::default(), 1);
        assert_eq!(outer.read(), Err(DeviceError::TimedOut));
    }
}
