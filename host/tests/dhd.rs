//! The DHD back end against a library of our own that exports the same functions.

use crate::fakes::Fake;
use asperity_host::device::dhd::Dhd;
use asperity_host::device::vendor_library::{LibraryError, VendorError};
use asperity_host::device::{Device, DeviceError, Uri};

#[test]
fn a_session_begins_and_ends_in_order_and_speaks_the_world_frame() {
    let fake = Fake::new("dhd", &[]);
    fake.set("fake_buttons", 5);
    let mut device = Dhd::open(&fake.uri("dhd", "4321")).expect("a device");
    let described = device.description();
    assert_eq!(described.name, "Force Dimension omega.3");
    assert_eq!(described.serial.as_deref(), Some("4321"));
    assert_eq!(described.peak_force_n, 8.0);
    let reading = device.read().expect("read");
    assert_eq!(
        reading.position_m,
        [0.02, -0.01, 0.03],
        "x right, y away, z up"
    );
    assert!(reading.fresh && reading.buttons == 5);
    device.write([1.0, 2.0, 3.0]).expect("write");
    assert_eq!(fake.force_n(), [-2.0, 1.0, 3.0]);
    drop(device);
    assert_eq!(
        fake.calls(),
        [
            "open:4321",
            "force_on",
            "zero",
            "zero",
            "force_off",
            "close"
        ]
    );
    assert_eq!((fake.force_n(), fake.get("fake_is_open")), ([0.0; 3], 0));
}

#[test]
fn a_panic_releases_the_device() {
    let fake = Fake::new("dhd", &[]);
    let uri = fake.uri("dhd", "");
    let panicked = std::thread::spawn(move || {
        let mut device = Dhd::open(&uri).expect("a device");
        device.write([1.0, 0.0, 0.0]).expect("write");
        panic!("on purpose");
    })
    .join();
    assert!(panicked.is_err());
    assert_eq!((fake.force_n(), fake.get("fake_is_open")), ([0.0; 3], 0));
    assert_eq!(
        fake.calls(),
        ["open", "force_on", "zero", "zero", "force_off", "close"]
    );
}

#[test]
fn results_that_are_neither_good_nor_bad_are_understood() {
    let fake = Fake::new("dhd", &[]);
    let mut device = Dhd::open(&fake.uri("dhd", "")).expect("a device");
    fake.set("fake_guarded", 1);
    assert!(
        !device.read().expect("read").fresh,
        "the time guard gave the last position"
    );
    fake.set("fake_saturated", 1);
    device
        .write([1.0, 0.0, 0.0])
        .expect("a shortened force is a success");
}

#[test]
fn errors_in_a_period_are_typed_and_a_lost_device_comes_back() {
    let fake = Fake::new("dhd", &[]);
    let mut device = Dhd::open(&fake.uri("dhd", "")).expect("a device");
    for (code, fault) in [
        (7, DeviceError::TimedOut),
        (3, DeviceError::TimedOut),
        (12, DeviceError::NotCalibrated),
        (18, DeviceError::Vendor(18)),
    ] {
        fake.set("fake_read_error", code);
        assert_eq!(device.read(), Err(fault));
    }
    fake.set("fake_read_error", 0);
    device.read().expect("read");

    let write_error = |code: i32, cause: i32| {
        fake.function::<extern "C" fn(i32, i32)>("fake_write_error")(code, cause)
    };
    write_error(19, 2);
    assert_eq!(
        device.write([0.0; 3]),
        Err(DeviceError::ForceExceeded),
        "forces off since it was too fast"
    );
    write_error(0, 0);
    device.recover().expect("forces on again");
    device.write([0.0; 3]).expect("write");

    fake.set("fake_read_error", 2);
    fake.set("fake_open_error", 5);
    assert_eq!(device.read(), Err(DeviceError::Disconnected));
    assert_eq!(device.write([0.0; 3]), Err(DeviceError::Disconnected));
    assert_eq!(
        device.recover(),
        Err(DeviceError::Disconnected),
        "still away"
    );
    fake.set("fake_read_error", 0);
    fake.set("fake_open_error", 0);
    device.recover().expect("back");
    assert!(device.read().expect("read").fresh);
}

#[test]
fn errors_of_opening_say_what_to_do() {
    let fake = Fake::new("dhd", &[]);
    let uri = fake.uri("dhd", "");
    for (code, words) in [
        (20, "in use"),
        (5, "no device found"),
        (4, "cannot be opened"),
        (14, "not configured"),
        (12, "not calibrated"),
        (11, "some error"),
    ] {
        fake.set("fake_open_error", code);
        let error = Dhd::open(&uri).expect_err(words);
        assert!(error.to_string().contains(words), "{error}");
        assert!(!error.remedy().is_empty());
    }
    fake.set("fake_open_error", 0);
    fake.set("fake_calibrated", 0);
    let error = Dhd::open(&uri).expect_err("not calibrated");
    assert!(
        matches!(error, VendorError::NotCalibrated { .. }),
        "{error}"
    );
    assert_eq!(
        fake.get("fake_is_open"),
        0,
        "a device that cannot be used is closed"
    );

    for text in [
        "dhd:abc",
        "dhd:70000",
        "dhd:?peak=0",
        "dhd:?peak=nan",
        "dhd:?peek=1",
    ] {
        let uri: Uri = text.parse().expect(text);
        let error = Dhd::open(&uri).expect_err(text);
        assert!(
            matches!(error, VendorError::Setting { .. } | VendorError::Uri(_)),
            "{error}"
        );
    }
    let missing: Uri = "dhd:?lib=/nowhere/libdhd.so".parse().expect("a URI");
    let error = Dhd::open(&missing).expect_err("no file");
    assert!(
        matches!(error, VendorError::Library(LibraryError::NoFile { .. })),
        "{error}"
    );
}
