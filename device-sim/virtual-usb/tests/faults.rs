//! Every fault on the Falcon's driver, on a virtual Falcon in this program.

use std::time::Duration;

use asperity_formats::Asset;
use asperity_host::device::falcon::Falcon;
use asperity_host::device::falcon::settings::Settings;
use asperity_host::device::fault_injection::InjectedFault;
use asperity_host::device::fault_injection::trial::{Paced, Trial};
use asperity_runtime::{Config, HostTexture};
use asperity_virtual_usb::falcon::Falcon as Virtual;
use asperity_virtual_usb::{Port, Socket};

use crate::in_process::InProcessOpener;

/// The driver's own threads make no two runs alike, but the promises hold in each. The surface lies
/// so high that the force is at its peak, whatever the virtual hand does.
#[test]
fn every_fault_on_the_falcon_over_virtual_usb() {
    let bytes = include_bytes!("../../../runtime/tests/data/builtin-v1.asp");
    let asset = Asset::parse(bytes).expect("the built-in texture");
    let config = Config::default();
    let mut texture = Box::new(HostTexture::new());
    texture.load(&asset, config.servo_rate_hz).expect("it fits");
    let slew_n = config.limits.slew_n_s / config.servo_rate_hz;
    let socket = Socket::new(Port::new(Virtual::running().paced_by_commands(1e-3)));
    let opener = Box::new(InProcessOpener(socket.clone()));
    let falcon = Falcon::open(opener, Settings::default()).expect("a Falcon");
    let mut falcon = Paced::begin(falcon, 0.04, Duration::from_secs(60)).expect("a position");
    let trial = Trial {
        texture: &texture,
        config: &config,
        warm_up: 200,
        seed: 11,
    };
    for kind in InjectedFault::ALL {
        // On a busy machine transfers time out by themselves.
        let mut rows = (0..5).map(|_| {
            trial
                .run(&mut falcon, kind, |_| ())
                .expect("a configuration")
        });
        let row = rows.find(|row| row.disturbed == 0);
        let row = row.expect("five trials in which the link timed out by itself");
        println!("{}: {row:?}", kind.name());
        assert_eq!(
            row.broken(kind, config.limits.peak_n, slew_n),
            None,
            "{}: {row:?}",
            kind.name()
        );
        assert!(row.before_n > 3.0, "{}: {row:?}", kind.name());
    }
    let stats = socket.port().device.grip.motor_stats();
    assert!(
        stats.unhomed_forces == 0 && stats.largest_step <= 1536,
        "{stats:?}"
    );
}
