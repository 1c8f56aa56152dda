//! A reader that was written from `SPEC.md` alone. It shares no code with the crate and
//! trusts its input.

use super::span;

/// The contents of an asset, as plain numbers.
#[derive(Debug, Clone, PartialEq)]
pub struct Plain {
    pub name: String,
    pub grid_rate_hz: f32,
    pub numerator: u8,
    /// LSFs (rad), MA LSFs (rad), gain.
    pub models: Vec<(Vec<f64>, Vec<f64>, f64)>,
    /// Speed, force, σ, model, kind.
    pub vertices: Vec<(f32, f32, f64, u8, u8)>,
    pub triangles: Vec<[u8; 3]>,
    pub tap_rate_hz: f32,
    /// Impact speed and accelerations.
    pub traces: Vec<(f32, Vec<f64>)>,
    pub mu: f32,
    pub anchors: Vec<(String, f32, f32)>,
    /// Speed (mm/s) and factor.
    pub law: Vec<(f64, f64)>,
    pub coupling: [f32; 5],
    /// The numbers of the contact law, in their order, and depth and shape of its spring, m.
    pub contact: Option<PlainContact>,
    /// Axis, ratios of power and speed, ratios of μ towards the axis and against it.
    pub direction: Option<[f32; 7]>,
    pub provenance: Option<PlainProvenance>,
    pub preview_png: Option<Vec<u8>>,
}

/// Numbers and spring of a contact law.
pub type PlainContact = ([f32; 11], Vec<(f64, f64)>);

/// The provenance section.
#[derive(Debug, Clone, PartialEq)]
pub struct PlainProvenance {
    pub generator: String,
    pub source: String,
    pub source_crc32: u64,
    pub prompt: Option<String>,
    pub seed: u64,
    pub fidelity: String,
    pub taps_synthetic: bool,
    pub lsf_error_db: f32,
    pub notes: String,
}

struct Cursor<'a>(&'a [u8]);

impl<'a> Cursor<'a> {
    fn take(&mut self, count: usize) -> &'a [u8] {
        let (head, tail) = self.0.split_at(count);
        self.0 = tail;
        head
    }
    fn u8(&mut self) -> u8 {
        self.take(1)[0]
    }
    fn u16(&mut self) -> u16 {
        let low = self.u8();
        u16::from(low) + 256 * u16::from(self.u8())
    }
    fn f32(&mut self) -> f32 {
        let low = u32::from(self.u16());
        f32::from_bits(low + 65536 * u32::from(self.u16()))
    }
    /// binary16: sign, five bits of exponent, ten of fraction.
    fn f16(&mut self) -> f64 {
        let bits = self.u16();
        let fraction = f64::from(bits & 1023) / 1024.0;
        let magnitude = match i32::from(bits >> 10 & 31) {
            0 => fraction * 2.0_f64.powi(-14),
            31 => f64::NAN,
            exponent => (1.0 + fraction) * 2.0_f64.powi(exponent - 15),
        };
        if bits >> 15 == 1 {
            -magnitude
        } else {
            magnitude
        }
    }
    fn lsf(&mut self, order: u8) -> Vec<f64> {
        (0..order)
            .map(|_| std::f64::consts::PI * f64::from(self.u16()) / 65536.0)
            .collect()
    }
    fn text(&mut self, len: usize) -> String {
        String::from_utf8(self.take(len).to_vec()).unwrap()
    }
    fn varint(&mut self) -> u64 {
        let mut value = 0;
        for shift in (0..).step_by(7) {
            let byte = self.u8();
            value |= u64::from(byte & 127) << shift;
            if byte < 128 {
                break;
            }
        }
        value
    }
    fn postcard_text(&mut self) -> String {
        let len = self.varint() as usize;
        self.text(len)
    }
}

/// Reads an asset.
pub fn read(asset: &[u8]) -> Plain {
    let body = |section| {
        let (start, len) = span(asset, section);
        Cursor(&asset[start..start + len])
    };
    let behind = |tag: &[u8; 4]| {
        (5..usize::from(asset[6]))
            .find(|section| &asset[20 + 12 * section..][..4] == tag)
            .map(body)
    };
    let mut name = body(0);
    let mut grid = body(1);
    let grid_rate_hz = grid.f32();
    let (numerator, ar_order, ma_order) = (grid.u8(), grid.u8(), grid.u8());
    let (models, vertices, triangles) = (grid.u8(), grid.u8(), grid.u8());
    grid.u16();
    let models = (0..models)
        .map(|_| {
            let (ar, ma) = (grid.lsf(ar_order), grid.lsf(ma_order));
            (ar, ma, if numerator == 2 { grid.f16() } else { 1.0 })
        })
        .collect();
    let vertices = (0..vertices)
        .map(|_| (grid.f32(), grid.f32(), grid.f16(), grid.u8(), grid.u8()))
        .collect();
    let triangles = (0..triangles)
        .map(|_| [grid.u8(), grid.u8(), grid.u8()])
        .collect();
    let mut taps = body(2);
    let tap_rate_hz = taps.f32();
    let count = taps.u8();
    taps.u8();
    let samples = usize::from(taps.u16());
    let traces = (0..count)
        .map(|_| {
            let (speed_m_s, peak) = (taps.f32(), f64::from(taps.f32()));
            let packed = taps.take((3 * samples).div_ceil(2));
            let sample = |n: usize| {
                // Sample n starts at bit 12·n, low bits first.
                let code = (0..12).fold(0_i32, |code, bit| {
                    let at = 12 * n + bit;
                    code | i32::from(packed[at / 8] >> (at % 8) & 1) << bit
                });
                let code = if code >= 2048 { code - 4096 } else { code };
                f64::from(code) * peak / 2047.0
            };
            (speed_m_s, (0..samples).map(sample).collect())
        })
        .collect();
    let mut friction = body(3);
    let mu = friction.f32();
    let anchors = (0..friction.u8())
        .map(|_| {
            let (mu, weight, len) = (friction.f32(), friction.f32(), friction.u8());
            (friction.text(usize::from(len)), mu, weight)
        })
        .collect();
    // The law follows in version 2, and may follow in version 3.
    let law = asset[4] == 2 || asset[4] == 3 && !friction.0.is_empty();
    let points = if law { friction.u8() } else { 0 };
    let law = (0..points)
        .map(|_| {
            (
                f64::from(friction.u16()) / 16.0,
                f64::from(friction.u16()) / 8192.0,
            )
        })
        .collect();
    let mut surface = body(4);
    Plain {
        name: name.text(name.0.len()),
        grid_rate_hz,
        numerator,
        models,
        vertices,
        triangles,
        tap_rate_hz,
        traces,
        mu,
        anchors,
        law,
        coupling: std::array::from_fn(|_| surface.f32()),
        contact: behind(b"CONT").map(|mut contact| {
            let numbers = std::array::from_fn(|_| contact.f32());
            let micrometres = |contact: &mut Cursor<'_>| f64::from(contact.u16()) / 1e6;
            let spring = (0..contact.u8())
                .map(|_| (micrometres(&mut contact), micrometres(&mut contact)))
                .collect();
            (numbers, spring)
        }),
        direction: behind(b"AXIS").map(|mut axis| std::array::from_fn(|_| axis.f32())),
        provenance: behind(b"prov").map(|mut prov| PlainProvenance {
            generator: prov.postcard_text(),
            source: prov.postcard_text(),
            source_crc32: prov.varint(),
            prompt: (prov.u8() == 1).then(|| prov.postcard_text()),
            seed: prov.varint(),
            fidelity: prov.postcard_text(),
            taps_synthetic: prov.u8() == 1,
            lsf_error_db: prov.f32(),
            notes: prov.postcard_text(),
        }),
        preview_png: behind(b"prev").map(|png| png.0.to_vec()),
    }
}
