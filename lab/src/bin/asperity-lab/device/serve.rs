//! `asperity-lab device serve`: virtual devices over USB/IP.

use std::io::Read as _;
use std::net::{SocketAddr, TcpListener};
use std::path::PathBuf;
use std::thread;
use std::time::Duration;

use asperity_console::Console;
use asperity_io::diagnostic::{Failures, one};
use asperity_io::output::{Outputs, display};
use asperity_io::shown::counted;
use asperity_io::system;
use asperity_lab::servo_session::ServoSessionError;
use asperity_virtual_usb::falcon::{Falcon, Quirks, image};
use asperity_virtual_usb::touch::{Firmware, Touch};
use asperity_virtual_usb::transfer_fault::Rates;
use asperity_virtual_usb::usbip::server::Server;
use asperity_virtual_usb::{AnyDevice, Port, Socket};

use crate::error::Plain;
use crate::loop_options::within;

/// Serve virtual devices over USB/IP, so that Linux treats them as real ones
///
/// The virtual Falcon has a boot loader that waits for its own kind of firmware, a grip, and a hand
/// that homes it and then strokes and taps. The virtual Touch only identifies itself.
#[derive(Debug, clap::Args)]
#[command(after_help = "Examples:
  asperity-lab device serve falcon
  asperity-lab device serve falcon touch --listen 127.0.0.1:3240 --faults 0.01
  asperity-lab device serve --firmware-file virtual.bin

On the Linux machine that is to use the device, as root:
  modprobe vhci-hcd
  usbip attach --remote 127.0.0.1 --busid 1-1")]
pub(crate) struct Arguments {
    /// Devices to serve, in the order of their bus ids 1-1, 1-2 and so on
    #[arg(value_enum, required_unless_present = "firmware_file")]
    devices: Vec<Which>,
    /// Address to listen on; port 0 lets the system choose one
    #[arg(long, default_value = "127.0.0.1:3240", value_name = "ADDRESS")]
    listen: SocketAddr,
    /// Fraction of bulk transfers that fail: stalls, short transfers, time-outs, unplugging
    #[arg(long, default_value_t = 0.0, value_parser = within(0.0..=1.0, ""))]
    faults: f64,
    /// Seed of the faults
    #[arg(long, default_value_t = 1)]
    seed: u64,
    /// Stop after this many seconds instead of at Ctrl-C
    #[arg(long, value_name = "S", value_parser = within(0.1..=86_400.0, " s"))]
    seconds: Option<f64>,
    /// Stop when standard input ends
    #[arg(long, conflicts_with = "seconds")]
    until_eof: bool,
    /// Write a firmware that the virtual Falcon accepts; `-` is standard output
    #[arg(long, value_name = "FILE")]
    firmware_file: Option<PathBuf>,
}

/// A virtual device.
#[derive(Debug, Clone, Copy, clap::ValueEnum)]
enum Which {
    /// A Falcon that waits for its firmware
    Falcon,
    /// A Falcon whose firmware runs
    FalconRunning,
    /// A Touch with the serial firmware, 2988:0302
    Touch,
    /// A Touch with the HID firmware, 2988:0304
    TouchHid,
    /// A Touch of the first ids, 0301:2988
    TouchFirst,
}

fn device(which: Which) -> AnyDevice {
    match which {
        Which::Falcon => AnyDevice::Falcon(Box::new(Falcon::new(Quirks::default()))),
        Which::FalconRunning => AnyDevice::Falcon(Box::new(Falcon::running())),
        Which::Touch => AnyDevice::Touch(Touch::new(Firmware::Serial)),
        Which::TouchHid => AnyDevice::Touch(Touch::new(Firmware::Hid)),
        Which::TouchFirst => AnyDevice::Touch(Touch::new(Firmware::First)),
    }
}

pub(crate) fn run(arguments: &Arguments, console: Console) -> Result<(), Failures> {
    let mut outputs = Outputs::beside(std::iter::empty::<&PathBuf>());
    let file = arguments.firmware_file.as_deref();
    let opened = outputs.open_if(file).map_err(one)?;
    let console = console.beside(&outputs);
    if let (Some(opened), Some(path)) = (opened, file) {
        outputs.fill(opened, &image::image(8192)).map_err(one)?;
        outputs.commit().map_err(one)?;
        let text = format!(
            "{}: a firmware for the virtual Falcon only\n",
            display(path)
        );
        console.report(&text).map_err(one)?;
    }
    if arguments.devices.is_empty() {
        return Ok(());
    }
    let listen = |error: std::io::Error| {
        Plain::failure(
            format!("{}: {error}", arguments.listen),
            system::remedy(&error)
                .unwrap_or("choose another port with --listen, such as 127.0.0.1:0"),
        )
    };
    let listener = TcpListener::bind(arguments.listen).map_err(listen)?;
    let address = listener.local_addr().map_err(listen)?;
    if !address.ip().is_loopback() {
        console.warn("anyone who can reach this address can use the virtual devices");
    }
    let sockets: Vec<Socket<AnyDevice>> = arguments
        .devices
        .iter()
        .zip(arguments.seed..)
        .map(|(which, seed)| {
            let rates = Rates::mixed(arguments.faults);
            Socket::new(Port::with_faults(device(*which), rates, seed))
        })
        .collect();
    let mut text = format!("listening at {address}\n");
    for (n, which) in arguments.devices.iter().enumerate() {
        let n = n + 1;
        text += &format!(
            "1-{n}: {which:?}; attach it with `usbip --tcp-port {} attach --remote {} --busid 1-{n}`\n",
            address.port(),
            address.ip()
        );
    }
    console.text(&text).map_err(one)?;
    let server = Server::new(sockets.iter().cloned());
    if let Some(seconds) = arguments.seconds {
        let server = server.clone();
        alone(move || {
            thread::sleep(Duration::from_secs_f64(seconds));
            server.stop();
        })?;
    } else if arguments.until_eof {
        let server = server.clone();
        alone(move || {
            let mut stdin = std::io::stdin().lock();
            let mut ignored = [0; 1024];
            while matches!(stdin.read(&mut ignored), Ok(1..)) {}
            server.stop();
        })?;
    }
    server.run(&listener).map_err(listen)?;
    let mut text = String::new();
    for (n, socket) in sockets.iter().enumerate() {
        text += &format!("1-{}: {}\n", n + 1, summary(&socket.port()));
    }
    console.report(&text).map_err(one)
}

/// Does this on a thread of its own.
fn alone(work: impl FnOnce() + Send + 'static) -> Result<(), Failures> {
    let started = thread::Builder::new().spawn(work).map(drop);
    started.map_err(|error| one(ServoSessionError::Thread(error)))
}

/// Summarises the faults injected into a device and what the device felt.
fn summary(port: &Port<AnyDevice>) -> String {
    let counts = port.counts();
    let [stalls, short, lost, unplugged] = counts.of;
    let faults = format!(
        "{}: {stalls} stalled, {short} short, {lost} timed out, {unplugged} unplugged",
        counted(counts.transfers, "bulk transfer", "bulk transfers")
    );
    match &port.device {
        AnyDevice::Falcon(falcon) => {
            let stats = falcon.grip.motor_stats();
            format!(
                "{faults}; {}: at most {:.2} N, {} counts, and steps of {} counts; {} before homing, \
                 {} right after plugging in",
                counted(stats.commands, "command", "commands"),
                stats.largest_force_n,
                stats.largest_count,
                stats.largest_step,
                counted(stats.unhomed_forces, "force", "forces"),
                stats.pushes_at_first
            )
        }
        AnyDevice::Touch(touch) => format!(
            "{faults}; {} bytes sent to its endpoints, {} class or vendor requests",
            touch.guessed_bytes, touch.requests
        ),
    }
}
