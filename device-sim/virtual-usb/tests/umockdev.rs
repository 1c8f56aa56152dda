//! The whole way of a real device: driver → rusb → libusb → usbfs, which umockdev stands in for →
//! USB/IP → virtual device. `.ci/check-usb` builds the bridge and runs these.
//!
//! A test serves a device and starts this program again under the bridge, as a child that opens the
//! device through libusb. The test sees what the device felt, the child what the driver saw.

use std::net::{SocketAddr, TcpListener};
use std::process::{Command, Output};
use std::sync::Arc;
use std::time::{Duration, Instant};

use asperity_formats::Asset;
use asperity_host::device::falcon::link::LinkCounts;
use asperity_host::device::falcon::on_usb;
use asperity_host::device::fault_injection::trial::Paced;
use asperity_host::device::supervised::{Plausible, Supervised};
use asperity_host::device::touch::{UsbPresentation, identify, open as open_touch};
use asperity_host::device::usb::scan::scan;
use asperity_host::device::usb::{Access, DeviceKind, Ids, UsbError};
use asperity_host::device::{Device as _, DeviceError};
use asperity_host::session_log::{
    Conditions, Encoder, Entry, SessionLog, TextureInfo, render_again,
};
use asperity_runtime::{Config, Flags, HostTexture, Renderer, State, math::norm};
use asperity_virtual_usb::falcon::{Falcon, Quirks, image};
use asperity_virtual_usb::touch::{Firmware, Touch};
use asperity_virtual_usb::transfer_fault::Rates;
use asperity_virtual_usb::usbip::server::Server;
use asperity_virtual_usb::{AnyDevice, Port, Socket};

/// Names the bridge; `.ci/check-usb` sets it.
const BRIDGE: &str = "ASPERITY_USB_BRIDGE";
/// Time for what a machine without other work does in a second or two.
const PATIENCE: Duration = Duration::from_secs(120);
/// Environment variable with what a test passes to its child.
const TOLD: &str = "ASPERITY_USB_CHILD";

/// A device that is served until it goes out of scope.
struct Served {
    server: Arc<Server>,
    address: SocketAddr,
    socket: Socket<AnyDevice>,
}

impl Served {
    fn new(port: Port<AnyDevice>) -> Self {
        let listener = TcpListener::bind("127.0.0.1:0").expect("a port");
        let address = listener.local_addr().expect("its address");
        let socket = Socket::new(port);
        let server = Server::new([socket.clone()]);
        let running = server.clone();
        std::thread::spawn(move || running.run(&listener).expect("it serves"));
        Self {
            server,
            address,
            socket,
        }
    }

    /// Runs a test of this program as a child that sees the device.
    fn child(&self, name: &str, told: &str, flags: &[&str]) -> Output {
        child(&self.address.port().to_string(), "1-1", name, told, flags)
    }

    fn motor_stats(&self) -> asperity_virtual_usb::falcon::MotorStats {
        match &self.socket.port().device {
            AnyDevice::Falcon(falcon) => falcon.grip.motor_stats(),
            AnyDevice::Touch(_) => panic!("no Falcon"),
        }
    }
}

impl Drop for Served {
    fn drop(&mut self) {
        self.server.stop();
    }
}

fn child(port: &str, bus_id: &str, name: &str, told: &str, flags: &[&str]) -> Output {
    let bridge = std::env::var(BRIDGE).expect("the bridge; run .ci/check-usb");
    let this = std::env::current_exe().expect("this program");
    let mut command = Command::new("umockdev-wrapper");
    command.arg(bridge).args(flags).args([port, bus_id]);
    if flags.contains(&"--deny") {
        command.args([
            "setpriv",
            "--reuid=65534",
            "--regid=65534",
            "--clear-groups",
        ]);
    }
    command
        .arg(this)
        .args(["--ignored", "--exact", "--nocapture", name]);
    let output = command.env(TOLD, told).output().expect("umockdev-wrapper");
    eprint!("{}", String::from_utf8_lossy(&output.stderr));
    print!("{}", String::from_utf8_lossy(&output.stdout));
    assert!(output.status.success(), "{name}: {}", output.status);
    output
}

fn told() -> String {
    std::env::var(TOLD).expect("a child of another test")
}

fn running() -> AnyDevice {
    AnyDevice::Falcon(Box::new(Falcon::running().paced_by_commands(1e-3)))
}

#[test]
#[ignore = "needs umockdev: run .ci/check-usb"]
fn over_usb_a_firmware_gets_in_and_positions_come() {
    let quirks = Quirks {
        deaf: 1,
        wrong_echoes: 1,
        ..Quirks::default()
    };
    let device = Falcon::new(quirks).paced_by_commands(1e-3);
    let served = Served::new(Port::new(AnyDevice::Falcon(Box::new(device))));
    let file = tempfile::NamedTempFile::new().expect("a file");
    std::fs::write(file.path(), image::image(8000)).expect("its bytes");
    let uri = format!("falcon:VF0001?firmware={}&tries=4", file.path().display());
    served.child("child_homes_and_pushes", &uri, &[]);
    let stats = served.motor_stats();
    assert!((stats.largest_force_n - 2.0).abs() < 0.2, "{stats:?}");
    assert!(
        stats.unhomed_forces == 0 && stats.largest_step <= 1536,
        "{stats:?}"
    );
}

#[test]
#[ignore = "a child"]
fn child_homes_and_pushes() {
    let mut falcon = on_usb::open(&told().parse().expect("a name")).expect("a Falcon");
    assert_eq!(falcon.description().serial.as_deref(), Some("VF0001"));
    let begun = Instant::now();
    let mut fresh = 0;
    while fresh < 300 {
        assert!(begun.elapsed() < PATIENCE, "{:?}", falcon.counts());
        match falcon.read() {
            Ok(reading) => {
                fresh += u32::from(reading.fresh);
                falcon
                    .write([0.0, 0.0, 2.0])
                    .or_else(stale)
                    .expect("a force");
            }
            Err(DeviceError::NotCalibrated | DeviceError::TimedOut) => {
                falcon.write([0.0; 3]).or_else(stale).expect("a command");
            }
            Err(fault) => panic!("{fault}"),
        }
        std::thread::sleep(Duration::from_millis(1));
    }
    println!(
        "{:.1} s, {:?}",
        begun.elapsed().as_secs_f64(),
        falcon.counts()
    );
}

/// On a busy machine answers come late, which is no failure here.
fn stale(fault: DeviceError) -> Result<(), DeviceError> {
    if fault == DeviceError::TimedOut {
        Ok(())
    } else {
        Err(fault)
    }
}

#[test]
#[ignore = "needs umockdev: run .ci/check-usb"]
fn over_usb_no_fault_of_the_bus_makes_a_force_beyond_the_limits() {
    let ticks = std::env::var("ASPERITY_USB_TICKS").unwrap_or_else(|_| "3000".into());
    let served = Served::new(Port::with_faults(running(), Rates::mixed(0.01), 5));
    served.child("child_feels_a_texture", &ticks, &[]);
    let counts = served.socket.port().counts();
    let stats = served.motor_stats();
    println!("device: {counts:?}; {stats:?}");
    assert!(
        stats.largest_step <= 1536 && stats.largest_count <= 4096,
        "{stats:?}"
    );
    assert!(
        stats.unhomed_forces == 0 && stats.pushes_at_first == 0,
        "{stats:?}"
    );
    // Torques for 3.3 N where the grip was measured push up to a fifth more where it is by the
    // time that a transfer that timed out is repeated.
    assert!(stats.largest_force_n < 3.3 * 1.2, "{stats:?}");
    let faults: u64 = counts.of.iter().sum();
    assert!(faults > 0 && stats.pushed_s > 0.0, "{counts:?}; {stats:?}");
}

#[test]
#[ignore = "a child"]
fn child_feels_a_texture() {
    let bytes = include_bytes!("../../../runtime/tests/data/builtin-v1.asp");
    let mut texture = Box::new(HostTexture::new());
    let asset = Asset::parse(bytes).expect("the built-in texture");
    texture
        .load(&asset, Config::default().servo_rate_hz)
        .expect("it loads");
    let falcon = on_usb::open(&"falcon:".parse().expect("a name")).expect("a Falcon");
    let config = Config::default();
    let conditions = Conditions {
        program: "test".into(),
        device: "falcon:".into(),
        texture: Some(TextureInfo::of("built in", bytes)),
        scene: None,
        seed: 1,
        config: config.clone(),
    };
    let (peak_n, slew_n) = (
        config.limits.peak_n,
        config.limits.slew_n_s / config.servo_rate_hz,
    );
    let renderer = Renderer::new(&config).expect("a configuration");
    let mut state = State::new(conditions.seed);
    let mut encoder = Encoder::new(Vec::new(), &conditions).expect("a vector");
    // The hand strokes and taps around the place where it is at first.
    let paced = Paced::begin(falcon, 0.0, PATIENCE).expect("a position");
    let mut device = Supervised::new(paced, &config, Plausible::default());
    let (mut contact, mut largest_n, mut held_n) = (0, 0.0, [0.0; 3]);
    let ticks: u64 = told().parse().expect("ticks");
    for _ in 0..ticks {
        let sample = device.read(1).sample;
        let output = renderer.tick(&texture, &mut state, &sample);
        let entry = Entry::new(sample, &output);
        encoder.push(&entry).expect("a vector takes all");
        contact += u32::from(output.flags.contains(Flags::CONTACT));
        let written = device.write(output.force_n);
        let step_n: [f32; 3] = std::array::from_fn(|axis| device.held_n()[axis] - held_n[axis]);
        held_n = device.held_n();
        largest_n = f32::max(largest_n, norm(held_n));
        // A device without power holds no force.
        let is_step = norm(step_n) <= slew_n * (1.0 + 1e-5);
        assert!(is_step || written == Err(DeviceError::Disconnected));
        assert!(norm(output.force_n) <= peak_n * (1.0 + 1e-5));
        if device.wants_recovery() {
            let begun = Instant::now();
            while let Err(fault) = device.recover() {
                assert!(begun.elapsed() < PATIENCE, "{fault}");
                std::thread::sleep(Duration::from_millis(20));
            }
        }
    }
    let tally = device.tally();
    println!("{tally:#?}\n{contact} in contact, at most {largest_n} N");
    let (file, _) = encoder.finish(0).expect("a vector takes all");
    let recording = SessionLog::read(&mut &file[..]).expect("a recording");
    let again = render_again(&recording, |_| Some(bytes.to_vec())).expect("rendered");
    println!("rendered again: {again:?}");
    assert!(again.is_same() && again.compared == ticks);
    // A busy machine makes more ticks stale than the faults do.
    let fresh = ticks - tally.stale - tally.read_faults;
    assert!(fresh > ticks / 10 && contact > 0, "{tally:?}");
}

#[test]
#[ignore = "needs umockdev: run .ci/check-usb"]
fn over_usb_a_touch_is_identified_and_nothing_is_sent_to_it() {
    for (firmware, face) in [
        (Firmware::Serial, UsbPresentation::Serial),
        (Firmware::Hid, UsbPresentation::Hid),
        (Firmware::First, UsbPresentation::Other),
    ] {
        let served = Served::new(Port::new(AnyDevice::Touch(Touch::new(firmware))));
        served.child("child_identifies_a_touch", &format!("{face:?}"), &[]);
        let port = served.socket.port();
        let AnyDevice::Touch(touch) = &port.device else {
            panic!("no Touch");
        };
        assert_eq!(
            (touch.guessed_bytes, touch.requests),
            (0, 0),
            "{firmware:?}"
        );
    }
}

#[test]
#[ignore = "a child"]
fn child_identifies_a_touch() {
    let ids = Ids::built_in().expect("the list");
    let found = identify(&ids, "").expect("a Touch");
    assert_eq!(
        (found.kind, &found.access),
        (Some(DeviceKind::Touch), &Access::Ready)
    );
    assert_eq!(found.serial.as_deref(), Some("VT0001"));
    assert_eq!(format!("{:?}", UsbPresentation::of(&found)), told());
    let error = open_touch(&ids, "").expect_err("it is not opened");
    assert!(matches!(error, UsbError::Proprietary { .. }), "{error}");
    assert!(error.remedy().contains("openhaptics:"));
}

#[test]
#[ignore = "needs umockdev: run .ci/check-usb"]
fn over_usb_what_cannot_be_used_is_told_with_its_remedy() {
    child("0", "none", "child_finds_nothing", "", &[]);
    let served = Served::new(Port::new(running()));
    served.child("child_is_refused", "in use", &["--busy"]);
    served.child("child_is_refused", "may not open", &["--deny"]);
}

#[test]
#[ignore = "a child"]
fn child_finds_nothing() {
    let found = scan(&Ids::built_in().expect("the list")).expect("USB");
    assert!(found.iter().all(|found| found.kind.is_none()), "{found:?}");
    assert_eq!(found.len(), 1, "an unknown device");
    let error = on_usb::open(&"falcon:".parse().expect("a name"))
        .err()
        .expect("none");
    assert!(
        error.to_string().contains("no Novint Falcon is plugged in"),
        "{error}"
    );
    assert!(error.remedy().contains("--ids"));
}

#[test]
#[ignore = "a child"]
fn child_is_refused() {
    let error = on_usb::open(&"falcon:".parse().expect("a name"))
        .err()
        .expect("none");
    assert!(error.to_string().contains(&told()), "{error}");
    assert!(error.to_string().contains("/dev/bus/usb/001/"), "{error}");
    let remedy = error.remedy();
    let expected = if told() == "in use" {
        "lsof"
    } else {
        "70-asperity.rules"
    };
    assert!(remedy.contains(expected), "{remedy}");
}

#[test]
#[ignore = "needs umockdev: run .ci/check-usb"]
fn over_usb_stalls_short_transfers_and_time_outs_are_told_apart() {
    for (n, name) in ["stalled", "short", "timed out"].iter().enumerate() {
        let mut rates = Rates::default();
        rates.of[n] = 0.05;
        let served = Served::new(Port::with_faults(running(), rates, 9));
        served.child("child_counts_faults", name, &[]);
        assert!(served.socket.port().counts().of[n] > 0);
    }
}

#[test]
#[ignore = "a child"]
fn child_counts_faults() {
    let mut falcon = on_usb::open(&"falcon:".parse().expect("a name")).expect("a Falcon");
    let of = |counts: LinkCounts| match told().as_str() {
        "stalled" => counts.stalled,
        "short" => counts.short,
        "timed out" => counts.timed_out,
        other => panic!("{other}"),
    };
    let begun = Instant::now();
    let counts = loop {
        let _ = falcon.read();
        let _ = falcon.write([0.0; 3]);
        std::thread::sleep(Duration::from_millis(1));
        let counts = falcon.counts();
        if of(counts) > 2 && counts.received > 50 {
            break counts;
        }
        assert!(begun.elapsed() < PATIENCE, "{}: {counts:?}", told());
    };
    println!("{}: {counts:?}", told());
    assert_eq!(counts.failed, 0, "{counts:?}");
}
