//! A device that fails in mid-stroke, in a servo loop: the force is gone, the device is found again
//! and homed, and the force comes back by a ramp.

use crate::support::{Act, ObserverLog, Scripted, length, texture};
use asperity_host::device::fault_injection::{DeviceFaultInjector, InjectedFault};
use asperity_host::device::{Description, Device, DeviceError, Reading};
use asperity_host::fault_plan::FaultPlan;
use asperity_host::servo::{Event, Report, ServoLoop, Settings, SingleTexture, Virtual};
use asperity_runtime::{Config, Flags, Renderer, State};
use std::sync::atomic::AtomicBool;

static NEVER: AtomicBool = AtomicBool::new(false);

/// Tries of homing that a device takes after it was without power.
const HOMING_TRIES: u32 = 2;

/// A device behind faults that must be homed after it lost its power.
struct OnDesk<D> {
    faulty: DeviceFaultInjector<D>,
    /// A fault that starts with the reading of this number, for so many periods.
    starts: Option<(u64, InjectedFault, u32)>,
    readings: u64,
    homing_left: u32,
    recoveries: u32,
    /// Forces commanded by the loop.
    commanded: Vec<[f32; 3]>,
}

impl<D: Device> OnDesk<D> {
    fn new(
        device: D,
        plan: FaultPlan<InjectedFault>,
        starts: Option<(u64, InjectedFault, u32)>,
    ) -> Self {
        Self {
            faulty: DeviceFaultInjector::new(device, plan, 5),
            starts,
            readings: 0,
            homing_left: 0,
            recoveries: 0,
            commanded: Vec::new(),
        }
    }
}

impl<D: Device> Device for OnDesk<D> {
    fn description(&self) -> &Description {
        self.faulty.description()
    }

    fn read(&mut self) -> Result<Reading, DeviceError> {
        if let Some((at, kind, periods)) = self.starts
            && at == self.readings
        {
            self.faulty.start(kind, periods);
        }
        self.readings += 1;
        let read = self.faulty.read();
        if self.faulty.running() == Some(InjectedFault::Unplugged) {
            self.homing_left = HOMING_TRIES;
        } else if self.homing_left > 0 {
            return Err(DeviceError::NotCalibrated);
        }
        read
    }

    fn write(&mut self, force_n: [f32; 3]) -> Result<(), DeviceError> {
        self.commanded.push(force_n);
        if self.homing_left > 0 && self.faulty.running() != Some(InjectedFault::Unplugged) {
            return Err(DeviceError::NotCalibrated);
        }
        self.faulty.write(force_n)
    }

    fn recover(&mut self) -> Result<(), DeviceError> {
        self.faulty.recover()?;
        self.recoveries += 1;
        self.homing_left = self.homing_left.saturating_sub(1);
        if self.homing_left > 0 {
            return Err(DeviceError::NotCalibrated);
        }
        Ok(())
    }
}

/// Results of a session.
struct Session {
    report: Report,
    kept: ObserverLog,
    commanded: Vec<[f32; 3]>,
    /// Forces that reached the motors.
    forces: Vec<[f32; 3]>,
    recoveries: u32,
}

fn session(
    periods: u64,
    plan: FaultPlan<InjectedFault>,
    starts: Option<(u64, InjectedFault, u32)>,
) -> Session {
    session_with(&Config::default(), periods, plan, starts)
}

fn session_with(
    config: &Config,
    periods: u64,
    plan: FaultPlan<InjectedFault>,
    starts: Option<(u64, InjectedFault, u32)>,
) -> Session {
    let clock = Virtual::new();
    let (texture, _) = texture(config.servo_rate_hz);
    let renderer = Renderer::new(config).expect("a configuration");
    let calm = |_| Act::default();
    let mut scripted = Scripted::new(&clock, calm, calm);
    scripted.recovers = true;
    let mut device = OnDesk::new(&mut scripted, plan, starts);
    let mut kept = ObserverLog::default();
    let render = SingleTexture {
        renderer: &renderer,
        texture: &texture,
        state: State::new(1),
    };
    let settings = Settings {
        periods: Some(periods),
        ..Settings::at(1000)
    };
    let report = ServoLoop::new(&mut device, render, clock, &mut kept, settings).run(&NEVER);
    let (commanded, recoveries) = (device.commanded, device.recoveries);
    Session {
        report,
        kept,
        commanded,
        forces: scripted.forces,
        recoveries,
    }
}

/// The largest step between two forces, N.
fn largest_step(forces: &[[f32; 3]]) -> f32 {
    let steps = forces
        .windows(2)
        .map(|two| length(std::array::from_fn(|axis| two[1][axis] - two[0][axis])));
    steps.max_by(f32::total_cmp).unwrap_or(0.0)
}

/// The slew limit of a tick, with the rounding of the limiter's division, N.
const SLEW_N: f32 = 2.0 * (1.0 + 1e-5);

#[test]
fn a_device_that_is_unplugged_in_mid_stroke_and_back_recovers_by_itself() {
    const OUT: u64 = 500;
    const AWAY: u32 = 700;
    let run = session(
        4000,
        FaultPlan::default(),
        Some((OUT, InjectedFault::Unplugged, AWAY)),
    );
    assert!(
        length(run.commanded[OUT as usize - 1]) > 0.5,
        "in mid-stroke"
    );

    // Told once when it began and once when it was over.
    let began = Event::Failed {
        period: OUT,
        fault: DeviceError::Disconnected,
    };
    assert_eq!(run.kept.events.first(), Some(&began));
    let told = |wanted: fn(&Event) -> bool| run.kept.events.iter().filter(|e| wanted(e)).count();
    assert_eq!(told(|event| matches!(event, Event::Failed { .. })), 1);
    assert_eq!(told(|event| matches!(event, Event::Back { .. })), 1);
    assert_eq!(run.report.episodes, 1);
    // It was found again only after it was homed.
    assert_eq!(run.recoveries, HOMING_TRIES);
    assert_eq!(run.report.recovered, 1);
    assert!(
        run.report.recoveries > u64::from(HOMING_TRIES),
        "and tried before"
    );

    // The third bad sample is the safe state, and two ticks later there is no force.
    let flags = |tick: usize| run.kept.records[tick].output.flags;
    assert!(flags(OUT as usize + 2).contains(Flags::SAFE_STATE));
    let back = run
        .kept
        .records
        .iter()
        .position(|record| record.tick > OUT && record.sample.elapsed_ticks > 0);
    let back = back.expect("it comes back");
    assert!(back > (OUT + u64::from(AWAY)) as usize);
    assert!(
        run.commanded[OUT as usize + 5..back]
            .iter()
            .all(|force| *force == [0.0; 3])
    );
    // The sample covers the time away, so the runtime knows of it.
    assert!(run.kept.records[back].sample.elapsed_ticks > AWAY);

    // The gain rises by 1/(ramp · rate) a tick, so no force is above that part of the peak.
    let config = Config::default();
    let ramp_ticks = config.safety.ramp_s * config.servo_rate_hz;
    for (n, force) in run.commanded[back..].iter().enumerate() {
        let gain = (n + 1) as f32 / ramp_ticks;
        let most = config.limits.peak_n * if gain < 1.0 { gain } else { 1.0 };
        assert!(
            length(*force) <= most + 1e-4,
            "{n} ticks after it came back"
        );
    }
    let last = run.commanded.len() - 20;
    assert!(length(run.commanded[last]) > 0.5, "the force comes back");
    assert!(largest_step(&run.commanded) <= SLEW_N);
    assert!(run.report.ended_without_force);
}

#[test]
fn no_fault_of_any_kind_makes_a_force_beyond_the_limits() {
    let starts = |kind| Some((300, kind, 40));
    for kind in InjectedFault::ALL {
        let run = session(1500, FaultPlan::default(), starts(kind));
        assert!(largest_step(&run.commanded) <= SLEW_N, "{kind:?}");
        let peak = run.commanded.iter().map(|force| length(*force));
        let peak = peak.max_by(f32::total_cmp).unwrap_or(f32::NAN);
        assert!(peak <= 3.3 * (1.0 + 1e-5), "{kind:?}");
        assert!(run.report.ended_without_force, "{kind:?}");
        assert!(length(run.commanded[1400]) > 0.5, "{kind:?}: it goes on");
    }
    // All of them at once, one period in a hundred.
    let run = session(60_000, FaultPlan::all(&InjectedFault::ALL, 0.01, 60), None);
    assert!(run.report.episodes > 100, "{}", run.report.episodes);
    assert!(largest_step(&run.commanded) <= SLEW_N);
    assert!(run.report.ended_without_force);
}

#[test]
fn what_a_device_holds_is_left_at_the_slew_limit() {
    // Forces do not arrive for 40 periods, in which the wanted force goes to zero. At 0.1 N a tick
    // the device holds more than one step.
    let mut config = Config::default();
    config.limits.slew_n_s = 100.0;
    let starts = Some((300, InjectedFault::WriteFailed, 40));
    let run = session_with(&config, 1500, FaultPlan::default(), starts);
    assert_eq!(run.report.write_faults, 40);
    assert!(run.report.eased > 0, "one force at least");
    let most = 0.1 * (1.0 + 1e-5);
    assert!(largest_step(&run.forces) <= most, "at the motors as well");
    assert!(run.forces.iter().any(|force| length(*force) > 0.3));
    assert!(run.report.ended_without_force);
}

#[test]
fn positions_that_no_hand_can_have_are_faults_and_are_recorded_as_such() {
    for kind in [InjectedFault::OutOfRange, InjectedFault::NotFinite] {
        let run = session(1500, FaultPlan::default(), Some((300, kind, 10)));
        let records = &run.kept.records[300..310];
        assert!(
            records
                .iter()
                .all(|record| record.reading == Err(DeviceError::Garbled))
        );
        assert!(
            records
                .iter()
                .all(|record| record.sample.elapsed_ticks == 0)
        );
        assert_eq!(run.report.read_faults, 10, "{kind:?}");
        assert_eq!(run.report.recoveries, 0, "shorter than the patience");
    }
}
