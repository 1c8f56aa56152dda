//! The Falcon's driver on a virtual Falcon in the same program: firmware, homing, forces, faults.

use std::time::{Duration, Instant};

use asperity_host::device::falcon::firmware::FirmwareError;
use asperity_host::device::falcon::settings::Settings;
use asperity_host::device::falcon::{Falcon, OpenError};
use asperity_host::device::{Device as _, DeviceError, Reading};
use asperity_virtual_usb::falcon::{Falcon as Virtual, Quirks, image};
use asperity_virtual_usb::transfer_fault::Rates;
use asperity_virtual_usb::{Port, Socket};

use crate::in_process::InProcessOpener;

fn open(socket: &Socket<Virtual>, settings: Settings) -> Result<Falcon, OpenError> {
    Falcon::open(Box::new(InProcessOpener(socket.clone())), settings)
}

fn with_firmware(file: &tempfile::NamedTempFile, tries: u32) -> Settings {
    Settings {
        firmware: Some(file.path().into()),
        tries,
        ..Settings::default()
    }
}

fn file(bytes: &[u8]) -> tempfile::NamedTempFile {
    let file = tempfile::NamedTempFile::new().expect("a file");
    std::fs::write(file.path(), bytes).expect("its bytes");
    file
}

/// A running Falcon whose commands last a millisecond each, open and homed.
fn homed() -> (Socket<Virtual>, Falcon) {
    let socket = Socket::new(Port::new(Virtual::running().paced_by_commands(1e-3)));
    let mut falcon = open(&socket, Settings::default()).expect("a Falcon");
    until_read(&mut falcon, 10_000);
    (socket, falcon)
}

/// Commands no force until a position comes, as a loop does a thousand times a second.
fn until_read(falcon: &mut Falcon, most: u32) -> Reading {
    for _ in 0..most {
        let _ = falcon.write([0.0; 3]);
        std::thread::sleep(Duration::from_micros(300));
        match falcon.read() {
            Ok(reading) if reading.fresh => return reading,
            Err(DeviceError::Disconnected) => drop(falcon.recover()),
            _ => {}
        }
    }
    panic!(
        "no position; homed {:#b}, {:?}",
        falcon.homed(),
        falcon.counts()
    );
}

#[test]
fn a_firmware_gets_in_whatever_the_handshake_and_the_echo_do() {
    let firmware = file(&image::image(8000));
    for quirks in [
        Quirks::default(),
        Quirks {
            leading_zero: true,
            ..Quirks::default()
        },
        Quirks {
            deaf: 2,
            wrong_echoes: 2,
            lost_echoes: 1,
            leading_zero: true,
        },
    ] {
        let socket = Socket::new(Port::new(Virtual::new(quirks)));
        let falcon = open(&socket, with_firmware(&firmware, 6));
        let falcon = falcon.unwrap_or_else(|error| panic!("{quirks:?}: {error}"));
        assert!(socket.port().device.is_running());
        assert_eq!(falcon.description().serial.as_deref(), Some("VF0001"));
        assert!(!falcon.description().unconfirmed.is_empty());
    }
}

#[test]
fn what_keeps_a_firmware_out_is_said() {
    let right = file(&image::image(8000));
    let error = |quirks, settings| {
        let socket = Socket::new(Port::new(Virtual::new(quirks)));
        let error = open(&socket, settings).err().expect("no firmware runs");
        assert!(!socket.port().device.is_running());
        assert!(!error.remedy().is_empty());
        error
    };
    let none = error(Quirks::default(), Settings::default());
    assert!(matches!(none, OpenError::NoFirmware), "{none}");
    assert!(none.remedy().contains("firmware=FILE"));

    let wrong = Quirks {
        wrong_echoes: 9,
        ..Quirks::default()
    };
    let differs = error(wrong, with_firmware(&right, 2));
    let OpenError::Firmware(FirmwareError::EchoDiffers { offset, sent, got }) = differs else {
        panic!("{differs}");
    };
    assert_eq!((offset, got), (2999, sent ^ 0x10));

    let lost = Quirks {
        lost_echoes: 9,
        ..Quirks::default()
    };
    let ends = error(lost, with_firmware(&right, 1));
    assert!(
        matches!(ends, OpenError::Firmware(FirmwareError::EchoEnds(2999))),
        "{ends}"
    );

    let deaf = Quirks {
        deaf: 1000,
        ..Quirks::default()
    };
    let deaf = error(deaf, with_firmware(&right, 1));
    assert!(
        matches!(deaf, OpenError::Firmware(FirmwareError::NoHandshake)),
        "{deaf}"
    );

    // Whatever is no firmware of the device is taken, and then nothing runs.
    let other = file(&vec![0x55; 8000]);
    let other = error(Quirks::default(), with_firmware(&other, 1));
    assert!(
        matches!(other, OpenError::Firmware(FirmwareError::Silent)),
        "{other}"
    );
}

#[test]
fn positions_come_after_homing_and_are_those_of_the_grip() {
    let socket = Socket::new(Port::new(Virtual::running().paced_by_commands(1e-3)));
    let mut falcon = open(&socket, Settings::default()).expect("a Falcon");
    let mut unhomed = 0;
    for _ in 0..20 {
        falcon.write([0.0; 3]).expect("a command");
        std::thread::sleep(Duration::from_millis(1));
        unhomed += u32::from(falcon.read() == Err(DeviceError::NotCalibrated));
    }
    assert!(unhomed > 0, "no position before homing");
    assert_eq!(
        falcon.write([0.0, 0.0, 1.0]),
        Err(DeviceError::NotCalibrated)
    );
    until_read(&mut falcon, 10_000);
    assert_eq!(falcon.homed(), 0b111);
    // The hand holds still, so that the position is the same when it is compared.
    socket.port().device.grip.busy = false;
    for _ in 0..1000 {
        falcon.write([0.0; 3]).expect("a command");
        std::thread::sleep(Duration::from_micros(400));
        let _ = falcon.read();
    }
    let reading = until_read(&mut falcon, 100);
    let truth = socket.port().device.grip.position_m();
    for n in 0..3 {
        let error = f64::from(reading.position_m[n]) - truth[n];
        assert!(error.abs() < 1.5e-4, "{reading:?} and {truth:?}");
    }
    assert_eq!(socket.port().device.grip.motor_stats().unhomed_forces, 0);
}

#[test]
fn a_force_arrives_in_size_and_direction_and_ends_with_the_device() {
    let (socket, mut falcon) = homed();
    socket.port().device.grip.busy = false;
    for _ in 0..500 {
        falcon.write([0.0, 0.0, 2.0]).expect("a force");
        std::thread::sleep(Duration::from_micros(400));
        let _ = falcon.read();
    }
    let port = socket.port();
    let stats = port.device.grip.motor_stats();
    let moved_m = port.device.grip.position_m()[2];
    drop(port);
    assert!((stats.largest_force_n - 2.0).abs() < 0.05, "{stats:?}");
    // 2 N against 200 N/m.
    assert!(moved_m > 0.006 && moved_m < 0.015, "{moved_m} m");
    let before = stats.commands;
    drop(falcon);
    let stats = socket.port().device.grip.motor_stats();
    assert!(stats.commands > before, "the motors were brought to zero");
    assert!(stats.largest_step <= i32::from(Settings::default().motor_step));
    assert_eq!(socket.port().device.grip.motors(), [0; 3]);
}

#[test]
fn forces_beyond_the_limits_and_no_numbers_are_cut() {
    let (socket, mut falcon) = homed();
    for n in 0..300 {
        let force = match n % 3 {
            0 => [0.0, 0.0, 1000.0],
            1 => [f32::NAN, 0.0, 5.0],
            _ => [-1000.0, f32::MAX, 0.0],
        };
        let _ = falcon.write(force);
        std::thread::sleep(Duration::from_micros(300));
        let _ = falcon.read();
    }
    drop(falcon);
    let stats = socket.port().device.grip.motor_stats();
    assert!(
        stats.largest_force_n > 4.0 && stats.largest_force_n < 8.9 * 1.03,
        "{stats:?}"
    );
    assert!(
        stats.largest_count <= 4096 && stats.largest_step <= 1536,
        "{stats:?}"
    );
}

#[test]
fn a_silent_servo_thread_leaves_no_force() {
    let (socket, mut falcon) = homed();
    for _ in 0..100 {
        let _ = falcon.write([0.0, 0.0, 3.0]);
        std::thread::sleep(Duration::from_micros(300));
        let _ = falcon.read();
    }
    assert_ne!(socket.port().device.grip.motors(), [0; 3]);
    // Nothing is written any more.
    std::thread::sleep(Duration::from_millis(300));
    assert_eq!(socket.port().device.grip.motors(), [0; 3]);
    assert!(falcon.counts().servo_silent >= 1, "{:?}", falcon.counts());
}

#[test]
fn a_reading_without_an_answer_between_is_stale() {
    let (_socket, mut falcon) = homed();
    let _ = falcon.read();
    let readings: Vec<Reading> = (0..1000).filter_map(|_| falcon.read().ok()).collect();
    let stale = readings.iter().filter(|reading| !reading.fresh).count();
    assert!(stale > 900, "{stale} of {} are stale", readings.len());
    for pair in readings.windows(2) {
        assert!(pair[1].fresh || pair[1].position_m == pair[0].position_m);
    }
}

#[test]
fn an_unplugged_device_is_told_at_once_and_taken_up_again() {
    let (socket, mut falcon) = homed();
    socket.port().unplug(f64::INFINITY);
    std::thread::sleep(Duration::from_millis(50));
    assert_eq!(falcon.read(), Err(DeviceError::Disconnected));
    assert_eq!(
        falcon.write([0.0, 0.0, 1.0]),
        Err(DeviceError::Disconnected)
    );
    assert_eq!(
        falcon.recover(),
        Err(DeviceError::Disconnected),
        "it is still away"
    );
    socket.port().unplug(0.0);
    socket.port().advance(1e-3);
    let begun = Instant::now();
    while falcon.recover().is_err() {
        assert!(
            begun.elapsed() < Duration::from_secs(10),
            "it does not come back"
        );
    }
    // Its zeros were kept: the power supply is its own.
    assert!(until_read(&mut falcon, 1000).fresh);
    assert_eq!(socket.port().device.grip.motor_stats().unhomed_forces, 0);
}

#[test]
fn an_endpoint_that_stalled_while_it_was_opened_does_not_keep_it_away() {
    let stalls = Rates {
        of: [1.0, 0.0, 0.0, 0.0],
        away_s: 0.0,
    };
    let socket = Socket::new(Port::with_faults(Virtual::running(), stalls, 1));
    assert!(open(&socket, Settings::default()).is_err());
    socket.port().set_rates(Rates::default());
    open(&socket, Settings::default()).expect("a Falcon");
}

#[test]
fn a_device_that_lost_its_power_is_loaded_and_homed_again() {
    let firmware = file(&image::image(4000));
    let device = Virtual::new(Quirks::default()).paced_by_commands(1e-3);
    let socket = Socket::new(Port::new(device));
    let mut falcon = open(&socket, with_firmware(&firmware, 3)).expect("a Falcon");
    until_read(&mut falcon, 10_000);
    socket.port().device.lose_power();
    std::thread::sleep(Duration::from_millis(300));
    assert_eq!(falcon.read(), Err(DeviceError::TimedOut));
    let begun = Instant::now();
    loop {
        match falcon.recover() {
            Ok(()) => break,
            Err(DeviceError::NotCalibrated) => assert!(socket.port().device.is_running()),
            Err(_) => {}
        }
        assert!(
            begun.elapsed() < Duration::from_secs(30),
            "it does not come back"
        );
    }
    assert_eq!(socket.port().device.grip.motor_stats().unhomed_forces, 0);
}

#[test]
fn whatever_the_bus_loses_no_force_and_no_step_is_beyond_its_limit() {
    let device = Virtual::running().paced_by_commands(1e-3);
    let rates = Rates {
        away_s: 0.02,
        ..Rates::mixed(0.05)
    };
    let socket = Socket::new(Port::with_faults(device, Rates::default(), 3));
    let mut falcon = open(&socket, Settings::default()).expect("a Falcon");
    until_read(&mut falcon, 10_000);
    socket.port().set_rates(rates);
    let (mut fresh, mut faults) = (0, 0);
    for n in 0..4000_u32 {
        match falcon.read() {
            Ok(reading) => {
                fresh += u32::from(reading.fresh);
                let size = (n % 7) as f32 - 3.0;
                let _ = falcon.write([size, -size, size]);
            }
            Err(fault) => {
                faults += 1;
                if matches!(fault, DeviceError::Disconnected | DeviceError::TimedOut) {
                    let _ = falcon.recover();
                }
                let _ = falcon.write([0.0; 3]);
            }
        }
        std::thread::sleep(Duration::from_micros(300));
    }
    let counts = socket.port().counts();
    let stats = socket.port().device.grip.motor_stats();
    let all = format!(
        "{fresh} fresh, {faults} faults; {counts:?}; {stats:?}; {:?}",
        falcon.counts()
    );
    assert!(
        counts.of.iter().all(|count| *count > 0),
        "each fault came: {all}"
    );
    assert!(fresh > 200 && faults > 0, "{all}");
    // A force of (3, −3, 3) N has 5.2 N. It is made for where the grip was at the newest answer that
    // came through; where it is by then, the same torques push a little harder.
    assert!(stats.largest_meant_n < 5.2 * 1.01, "{all}");
    assert!(stats.largest_force_n < 5.2 * 1.05, "{all}");
    assert!(
        stats.largest_step <= 1536 && stats.unhomed_forces == 0,
        "{all}"
    );
}
