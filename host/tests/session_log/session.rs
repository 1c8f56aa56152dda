//! A session with everything in it: strokes, taps, bad samples, an exchange of textures.

use std::io::Write;
use std::sync::{Arc, Mutex};

use asperity_formats::{Asset, Library};
use asperity_host::device::DeviceError;
use asperity_host::session_log::{
    Conditions, Encoder, Entry, SessionLog, SessionLogError, TextureInfo,
};
use asperity_runtime::{Config, Exchange, HostTexture, Renderer, Sample};

pub(crate) const BUILTIN: &[u8] = include_bytes!("../../../runtime/tests/data/builtin-v1.asp");
pub(crate) const LIBRARY: &[u8] = include_bytes!("../../../runtime/tests/data/textures.aspl");
pub(crate) const SEED: u64 = 3;

/// A texture of the library that serves 1 kHz.
pub(crate) fn other() -> &'static [u8] {
    let library = Library::parse(LIBRARY).expect("a library");
    let mut slot = Box::new(HostTexture::new());
    (0..library.index().len())
        .map(|index| library.bytes(index).expect("an asset"))
        .find(|bytes| {
            *bytes != BUILTIN
                && slot
                    .load(&Asset::parse(bytes).expect("an asset"), 1000.0)
                    .is_ok()
        })
        .expect("one at 1 kHz")
}

pub(crate) fn conditions() -> Conditions {
    Conditions {
        program: "test 1.0".into(),
        device: "null:".into(),
        texture: Some(TextureInfo::of("built in", BUILTIN)),
        scene: None,
        seed: SEED,
        config: Config::default(),
    }
}

/// A stroke at some depth, with taps, and with samples of every bad kind.
pub(crate) fn sample(n: usize) -> Sample {
    let t_s = n as f32 * 1e-3;
    let z = if n % 700 < 60 {
        0.004 - 1e-4 * (n % 700) as f32
    } else {
        -0.002
    };
    let position_m = [
        0.03 * libm::sinf(6.0 * t_s),
        0.01 * libm::cosf(2.0 * t_s),
        z,
    ];
    match n % 997 {
        500..504 => Sample::STALE,
        504 => Sample {
            position_m,
            elapsed_ticks: 5,
        },
        700 => Sample::at([f32::NAN, 0.0, 0.0]),
        _ => Sample::at(position_m),
    }
}

/// Ticks of which the second texture begins in one.
pub(crate) fn entries(count: usize) -> Vec<Entry> {
    let renderer = Renderer::new(&Config::default()).expect("a configuration");
    let mut slots = [(); 3].map(|()| Box::new(HostTexture::new()));
    let [playing, one, two] = &mut slots;
    playing
        .load(&Asset::parse(BUILTIN).expect("an asset"), 1000.0)
        .expect("it fits");
    let mut exchange = Exchange::new();
    let (mut preparer, mut player) = exchange.split(playing, [one, two], SEED);
    let mut playing = std::ptr::from_ref(player.texture());
    let mut entries = Vec::new();
    for n in 0..count {
        if n == 1234 {
            preparer
                .prepare(&Asset::parse(other()).expect("an asset"), 1000.0)
                .expect("a slot");
        }
        let sample = sample(n);
        let output = renderer.tick_player(&mut player, &sample);
        let now = std::ptr::from_ref(player.texture());
        entries.push(Entry {
            buttons: (n / 300) as u32,
            read_fault: (sample.elapsed_ticks == 0).then_some(DeviceError::Stalled),
            next_texture: now != playing,
            ..Entry::new(sample, &output)
        });
        playing = now;
    }
    entries
}

pub(crate) fn file(entries: &[Entry]) -> Vec<u8> {
    let mut encoder = Encoder::new(Vec::new(), &conditions()).expect("a vector takes all");
    encoder
        .announce(&TextureInfo::of("other", other()))
        .expect("a vector takes all");
    entries
        .iter()
        .for_each(|entry| encoder.push(entry).expect("a vector takes all"));
    encoder.finish(0).expect("a vector takes all").0
}

pub(crate) fn read(bytes: &[u8]) -> Result<SessionLog, SessionLogError> {
    SessionLog::read(&mut &*bytes)
}

pub(crate) fn asset(texture: &TextureInfo) -> Option<Vec<u8>> {
    [BUILTIN, other()]
        .into_iter()
        .find(|bytes| texture.is(bytes))
        .map(<[u8]>::to_vec)
}

/// A file that a thread writes and a test reads.
#[derive(Clone, Default)]
pub(crate) struct Shared(pub(crate) Arc<Mutex<Vec<u8>>>);

impl Write for Shared {
    fn write(&mut self, bytes: &[u8]) -> std::io::Result<usize> {
        self.0.lock().expect("no panic").extend_from_slice(bytes);
        Ok(bytes.len())
    }

    fn flush(&mut self) -> std::io::Result<()> {
        Ok(())
    }
}
