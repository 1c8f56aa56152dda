//! The OpenHaptics back end against a library of our own that exports the same functions: loading,
//! order of the calls, threads and errors are real.

use std::time::{Duration, Instant};

use crate::fakes::{Fake, alone, build};
use asperity_host::device::openhaptics::OpenHaptics;
use asperity_host::device::vendor_library::{LibraryError, VendorError};
use asperity_host::device::{Device, DeviceError, Reading, Uri};

/// Reads until a reading fulfils a condition.
fn read_until(
    device: &mut OpenHaptics,
    wanted: impl Fn(&Result<Reading, DeviceError>) -> bool,
) -> Result<Reading, DeviceError> {
    let until = Instant::now() + Duration::from_secs(60);
    loop {
        let read = device.read();
        if wanted(&read) {
            return read;
        }
        assert!(Instant::now() < until, "still {read:?}");
        std::thread::sleep(Duration::from_millis(1));
    }
}

fn wait(what: &str, mut done: impl FnMut() -> bool) {
    let until = Instant::now() + Duration::from_secs(60);
    while !done() {
        assert!(Instant::now() < until, "{what}");
        std::thread::sleep(Duration::from_millis(1));
    }
}

#[test]
fn a_session_begins_and_ends_in_order_and_speaks_the_world_frame() {
    let _alone = alone();
    let fake = Fake::new("hd", &[]);
    fake.place([10.0, 20.0, 30.0]);
    fake.set("fake_buttons", 2);
    let mut device = OpenHaptics::open(&fake.uri("openhaptics", "")).expect("a device");
    let described = device.description().clone();
    assert_eq!(described.name, "3D Systems Touch");
    assert_eq!(described.serial.as_deref(), Some("A1B2"));
    assert_eq!(
        (described.peak_force_n, described.continuous_force_n),
        (3.3, 0.88)
    );
    assert!(!described.unconfirmed.is_empty());

    let first =
        read_until(&mut device, |read| read.is_ok_and(|reading| reading.fresh)).expect("read");
    assert_eq!(
        first.position_m,
        [0.010, -0.030, 0.020],
        "x right, y away, z up"
    );
    assert_eq!(first.buttons, 2);
    wait("the force arrives", || {
        device.write([0.1, 0.2, 0.3]).expect("write");
        let force = fake.force_n();
        (force[0] - 0.1).abs() + (force[1] - 0.3).abs() + (force[2] + 0.2).abs() < 1e-6
    });
    device.write([0.1, 0.2, 0.3]).expect("write");
    read_until(&mut device, |read| {
        read.is_ok_and(|reading| reading.fresh && reading.position_m != first.position_m)
    })
    .expect("it moves");
    drop(device);

    assert_eq!(
        fake.calls(),
        [
            "init:default",
            "current",
            "enable_force",
            "schedule",
            "start_scheduler", //
            "current",
            "stop_scheduler",
            "unschedule",
            "disable_force",
            "disable_device",
        ]
    );
    assert_eq!(
        fake.force_n(),
        [0.0; 3],
        "the force was zero before the scheduler stopped"
    );
    assert_eq!(
        fake.get("fake_out_of_frame"),
        0,
        "every value was taken within a frame"
    );
}

#[test]
fn a_large_force_is_released_by_small_steps_on_drop_and_after_a_panic() {
    let _alone = alone();
    let fake = Fake::new("hd", &[]);
    let uri = fake.uri("openhaptics", "Right Device");
    let panicked = std::thread::scope(|scope| {
        let panicking = scope.spawn(|| {
            let mut device = OpenHaptics::open(&uri).expect("a device");
            // Up by steps, as the runtime's limiter gives them.
            for n in 1..=15 {
                let force = 0.2 * n as f32;
                wait("the force arrives", || {
                    device.write([force, 0.0, 0.0]).is_ok() && fake.force_n()[0] == f64::from(force)
                });
            }
            panic!("on purpose");
        });
        panicking.join()
    });
    assert!(panicked.is_err());
    assert_eq!(fake.force_n(), [0.0; 3]);
    assert!(
        fake.number("fake_largest_step") <= 0.25 + 1e-6,
        "{}",
        fake.number("fake_largest_step")
    );
    assert_eq!(fake.get("fake_is_open"), 0);
    let calls = fake.calls();
    assert_eq!(
        calls[0], "init:Right",
        "the name as it was written: {calls:?}"
    );
    assert_eq!(calls.last().map(String::as_str), Some("disable_device"));
    drop(OpenHaptics::open(&uri).expect("it can be opened again"));
}

#[test]
fn a_servo_loop_that_hangs_leaves_no_force_behind() {
    let _alone = alone();
    let fake = Fake::new("hd", &[]);
    let mut device = OpenHaptics::open(&fake.uri("openhaptics", "")).expect("a device");
    device.write([0.0, 0.0, 1.0]).expect("write");
    wait("the force arrives", || {
        fake.number("fake_largest_force") == 1.0
    });
    wait("the force goes", || fake.force_n() == [0.0; 3]);
    drop(device);
}

#[test]
fn errors_in_a_period_are_typed_and_go_away_with_their_cause() {
    let _alone = alone();
    let fake = Fake::new("hd", &[]);
    let mut device = OpenHaptics::open(&fake.uri("openhaptics", "")).expect("a device");
    for (code, fault) in [
        (0x0200, DeviceError::WarmMotors),
        (0x0201, DeviceError::ForceExceeded),
        (0x0202, DeviceError::ForceExceeded),
        (0x0203, DeviceError::ForceExceeded),
        (0x0304, DeviceError::TimedOut),
        (0x0500, DeviceError::Vendor(0x0500)),
    ] {
        fake.set("fake_persistent", code);
        assert_eq!(
            read_until(&mut device, |read| *read == Err(fault)),
            Err(fault)
        );
        fake.set("fake_persistent", 0);
        device.recover().expect("back");
        read_until(&mut device, |read| read.is_ok_and(|reading| reading.fresh))
            .expect("fresh again");
    }
}

#[test]
fn a_lost_device_stays_lost_until_it_recovers() {
    let _alone = alone();
    let fake = Fake::new("hd", &[]);
    let mut device = OpenHaptics::open(&fake.uri("openhaptics", "")).expect("a device");
    fake.set("fake_persistent", 0x0302);
    fake.set("fake_init_error", 0x0302);
    read_until(&mut device, |read| *read == Err(DeviceError::Disconnected)).expect_err("lost");
    assert_eq!(device.write([0.0; 3]), Err(DeviceError::Disconnected));
    assert_eq!(
        device.recover(),
        Err(DeviceError::Disconnected),
        "still away"
    );
    assert_eq!(device.read(), Err(DeviceError::Disconnected));
    fake.set("fake_persistent", 0);
    fake.set("fake_init_error", 0);
    device.recover().expect("back");
    read_until(&mut device, |read| read.is_ok_and(|reading| reading.fresh)).expect("fresh again");
    device.write([0.0; 3]).expect("write");
}

#[test]
fn a_scheduler_that_stands_still_times_out() {
    let _alone = alone();
    let fake = Fake::new("hd", &[]);
    let mut device = OpenHaptics::open(&fake.uri("openhaptics", "")).expect("a device");
    fake.set("fake_freeze", 1);
    read_until(&mut device, |read| *read == Err(DeviceError::TimedOut)).expect_err("frozen");
    fake.set("fake_freeze", 0);
    device.recover().expect("back");
    read_until(&mut device, |read| read.is_ok_and(|reading| reading.fresh)).expect("fresh again");
}

#[test]
fn errors_of_opening_say_what_to_do() {
    let _alone = alone();
    let fake = Fake::new("hd", &[]);
    let uri = fake.uri("openhaptics", "");
    for (code, words) in [
        (0x0301, "in use"),
        (0x0302, "HD_COMM_ERROR"),
        (0x0303, "not configured"),
        (0x0200, "too warm"),
        (0x0600, "some error"),
    ] {
        fake.set("fake_init_error", code);
        let error = OpenHaptics::open(&uri).expect_err(words);
        assert!(error.to_string().contains(words), "{error}");
        assert!(!error.remedy().is_empty());
    }
    fake.set("fake_init_error", 0);

    let calibration = |code: u32, manual: i32| {
        fake.function::<extern "C" fn(u32, i32)>("fake_calibration")(code, manual)
    };
    calibration(0x5001, 0);
    drop(OpenHaptics::open(&uri).expect("it calibrates itself"));
    assert!(fake.calls().contains(&"calibrate:inkwell".into()));
    calibration(0x5002, 1);
    let error = OpenHaptics::open(&uri).expect_err("by hand");
    assert!(
        matches!(error, VendorError::NotCalibrated { .. }) && error.remedy().contains("inkwell"),
        "{error}"
    );
    assert_eq!(
        fake.get("fake_is_open"),
        0,
        "a device that cannot be used is released"
    );
    calibration(0x5000, 0);

    fake.set("fake_freeze", 1);
    let error = OpenHaptics::open(&uri).expect_err("frozen");
    assert!(error.to_string().contains("scheduler"), "{error}");
    fake.set("fake_freeze", 0);

    let one = OpenHaptics::open(&uri).expect("free");
    let error = OpenHaptics::open(&uri).expect_err("taken");
    assert!(matches!(error, VendorError::InUse { .. }), "{error}");
    drop(one);
    drop(OpenHaptics::open(&uri).expect("free again"));
}

#[test]
fn libraries_that_cannot_be_used_are_told_apart() {
    let _alone = alone();
    let open = |text: String| {
        let uri: Uri = text.parse().expect("a URI");
        match OpenHaptics::open(&uri).expect_err("no library") {
            VendorError::Library(error) => error,
            other => panic!("{other}"),
        }
    };
    let error = open("openhaptics:?lib=/nowhere/libHD.so".into());
    assert!(matches!(error, LibraryError::NoFile { .. }), "{error}");
    // Nobody who runs the tests has installed this product, as long as the variable is not set.
    if std::env::var_os("ASPERITY_OPENHAPTICS").is_none() {
        let error = open("openhaptics:".into());
        assert!(matches!(error, LibraryError::NotFound { .. }), "{error}");
        assert!(
            error.remedy().contains("ASPERITY_OPENHAPTICS"),
            "{}",
            error.remedy()
        );
    }
    let script = format!("{}/tests/openhaptics.rs", env!("CARGO_MANIFEST_DIR"));
    if cfg!(target_os = "linux") {
        let error = open(format!("openhaptics:?lib={script}"));
        assert!(matches!(error, LibraryError::NotALibrary { .. }), "{error}");
    }
    let (path, folder) = build("hd", &["-DWITHOUT_hdGetError"]);
    let error = open(format!("openhaptics:?lib={}", path.display()));
    assert!(
        matches!(
            error,
            LibraryError::Symbol {
                symbol: "hdGetError",
                ..
            }
        ),
        "{error}"
    );
    if cfg!(target_os = "linux") {
        let mut bytes = std::fs::read(&path).expect("the library");
        // Byte 18 of an ELF file names the machine: 243 is RISC-V, which this is not.
        bytes[18..20].copy_from_slice(&243_u16.to_le_bytes());
        let foreign = folder.path().join("foreign.so");
        std::fs::write(&foreign, &bytes).expect("written");
        let error = open(format!("openhaptics:?lib={}", foreign.display()));
        assert!(
            matches!(&error, LibraryError::Architecture { built_for, .. } if built_for == "riscv64"),
            "{error}"
        );
        // The system's loader would crash on this one.
        let cut = folder.path().join("cut.so");
        std::fs::write(&cut, &std::fs::read(&path).expect("the library")[..4096]).expect("written");
        let error = open(format!("openhaptics:?lib={}", cut.display()));
        assert!(matches!(error, LibraryError::NotALibrary { .. }), "{error}");
        // A library that needs another one, which is gone.
        let (other, _other_folder) = build("dhd", &[]);
        let needs = other.display().to_string();
        let (path, _folder) = build("hd", &["-Wl,--no-as-needed", &needs]);
        std::fs::remove_file(&other).expect("removed");
        let error = open(format!("openhaptics:?lib={}", path.display()));
        assert!(matches!(error, LibraryError::Load { .. }), "{error}");
        assert!(
            error.to_string().contains("libdhd.so") && error.remedy().contains("ldd"),
            "{error}"
        );
    }
}
