//! Every fault on every back end: what becomes of the force, and when.

use asperity_host::device::dhd::Dhd;
use asperity_host::device::fault_injection::InjectedFault;
use asperity_host::device::fault_injection::trial::{AFTER, FaultResponse, LASTS, Trial};
use asperity_host::device::openhaptics::OpenHaptics;
use asperity_host::device::replay::{AtEnd, Replay};
use asperity_host::device::{Description, Device, DeviceError, Reading};
use asperity_host::fault_plan::FaultPlan;
use asperity_host::session_log::{Encoder, SessionLog};
use asperity_runtime::{Config, HostTexture};

use asperity_tests::figures;

use super::servo::{SEED, Servo, asset, conditions, load};
use super::simulated::Simulated;
use crate::fakes::{Fake, alone};

/// A device in free air that takes any force.
struct Null(Description);

impl Device for Null {
    fn description(&self) -> &Description {
        &self.0
    }

    fn read(&mut self) -> Result<Reading, DeviceError> {
        Ok(Reading {
            position_m: [0.0, 0.0, 0.05],
            fresh: true,
            buttons: 0,
        })
    }

    fn write(&mut self, _force_n: [f32; 3]) -> Result<(), DeviceError> {
        Ok(())
    }
}

fn null() -> Null {
    Null(Description {
        name: "null".into(),
        serial: None,
        peak_force_n: 3.3,
        continuous_force_n: 3.3,
        unconfirmed: Vec::new(),
    })
}

/// Runs one fault; `hand` moves the device before each period.
fn run<D: Device>(
    device: D,
    texture: &HostTexture,
    kind: InjectedFault,
    warm_up: u32,
    hand: impl FnMut(u32),
) -> FaultResponse {
    let trial = Trial {
        texture,
        config: &Config::default(),
        warm_up,
        seed: SEED,
    };
    trial.run(device, kind, hand).expect("a configuration")
}

/// A stroke at a depth of 6 mm, m in the world frame.
fn stroke(period: u32) -> [f64; 3] {
    let t_s = f64::from(period) * 1e-3;
    [0.02 * (4.0 * t_s).sin(), 0.0, -0.006]
}

/// A back end's name, and what each fault does on it.
type Column = (&'static str, Box<dyn FnMut(InjectedFault) -> FaultResponse>);

fn columns(texture: &'static HostTexture, bytes: &[u8]) -> Vec<Column> {
    // Mid-stroke: the third motion of the script and on.
    let warm_up = 4600;
    let mut encoder = Encoder::new(Vec::new(), &conditions(bytes, "sim:")).expect("a vector");
    let mut recorded = Servo::new(Simulated::new(1, 2), texture, FaultPlan::default(), 1);
    for _ in 0..warm_up + LASTS + AFTER {
        encoder
            .push(&recorded.period().entry)
            .expect("a vector takes all");
    }
    let (file, _) = encoder.finish(0).expect("a vector takes all");
    let recording = SessionLog::read(&mut &file[..]).expect("a recording");
    let mut columns: Vec<Column> = vec![
        (
            "null",
            Box::new(move |kind| run(null(), texture, kind, 50, |_| ())),
        ),
        (
            "replay",
            Box::new(move |kind| {
                let replay =
                    Replay::new(recording.clone(), AtEnd::Leave, "test").expect("a replay");
                run(replay, texture, kind, warm_up, |_| ())
            }),
        ),
        (
            "simulated Touch",
            Box::new(move |kind| run(Simulated::new(1, 2), texture, kind, warm_up, |_| ())),
        ),
    ];
    let (hd, dhd) = (Fake::new("hd", &["-DMANUAL"]), Fake::new("dhd", &[]));
    columns.push((
        "OpenHaptics, fake",
        Box::new(move |kind| {
            let _alone = alone();
            let device = OpenHaptics::open(&hd.uri("openhaptics", "")).expect("a device");
            let period = hd.function::<extern "C" fn()>("fake_period");
            run(device, texture, kind, 500, |n| {
                // The device's frame: x right, y up, z toward the user, mm.
                let [x, y, z] = stroke(n).map(|m| 1e3 * m);
                hd.place([x, z, -y]);
                period();
            })
        }),
    ));
    columns.push((
        "DHD, fake",
        Box::new(move |kind| {
            let device = Dhd::open(&dhd.uri("dhd", "")).expect("a device");
            run(device, texture, kind, 500, |n| {
                // The device's frame: x toward the user, y right, z up, m.
                let [x, y, z] = stroke(n);
                dhd.place([-y, x, z]);
            })
        }),
    ));
    columns
}

#[test]
fn every_fault_on_every_back_end() {
    let bytes = asset();
    let texture: &'static HostTexture = Box::leak(load(&bytes));
    let limits = Config::default().limits;
    let slew_n = limits.slew_n_s / Config::default().servo_rate_hz;
    let mut columns = columns(texture, &bytes);
    let mut rows = Vec::new();
    let mut each = FaultResponse::TABLE_HEAD.to_owned();
    for kind in InjectedFault::ALL {
        let mut of_kind = Vec::new();
        for (name, column) in &mut columns {
            let row = column(kind);
            let what = format!("{} on {name}: {row:?}", kind.name());
            assert_eq!(row.broken(kind, limits.peak_n, slew_n), None, "{what}");
            assert!(*name == "null" || row.before_n > 0.1, "{what}");
            each += &row.line(kind, name);
            of_kind.push(row);
        }
        rows.push((kind, of_kind));
    }
    println!("{each}");
    let command = "-p asperity-sim --test it every_fault_on_every";
    figures::hold("faults", command, [("table", table(&rows)), ("each", each)]);
}

fn periods(count: Option<u32>) -> String {
    count.map_or("–".into(), |count| format!("{count} ms"))
}

/// A line a fault, with the least and the most of all back ends.
fn table(rows: &[(InjectedFault, Vec<FaultResponse>)]) -> String {
    let mut table = String::from(
        "| fault | to the safe state | from there to 2 % of the force | whole force after the fault | steepest, N a period | \
         safe states | reports |\n|---|---:|---:|---:|---:|---:|---:|\n",
    );
    for (kind, rows) in rows {
        table += &format!(
            "| {} | {} | {} | {} | {} | {} | {} |\n",
            kind.name(),
            range(rows, |row| row.safe_after, periods),
            range(rows, |row| row.zero_after, periods),
            range(rows, |row| row.whole_after, periods),
            range(
                rows,
                |row| row.steepest_n,
                |force_n| format!("{force_n:.2}")
            ),
            range(rows, |row| row.faults, |count| count.to_string()),
            range(rows, |row| row.reports, |count| count.to_string()),
        );
    }
    table
}

/// The least and the most of a quantity, or the one value.
fn range<T: PartialOrd + Copy>(
    rows: &[FaultResponse],
    of: impl Fn(&FaultResponse) -> T,
    text: impl Fn(T) -> String,
) -> String {
    let values = || rows.iter().map(&of);
    let least = values().reduce(|a, b| if b < a { b } else { a });
    let most = values().reduce(|a, b| if b > a { b } else { a });
    let [least, most] = [least, most].map(|value| value.map_or(String::new(), &text));
    if least == most {
        least
    } else {
        format!("{least} to {most}")
    }
}
