//! A folder of made-up materials. Their names are HaTT's, so that they have captions; nothing else
//! is.

use crate::hatt::HattOptions;
use asperity::signal::{lsf, spectrum::squared_magnitude};
use std::{
    f64::consts::PI,
    fmt::Write as _,
    fs,
    path::{Path, PathBuf},
    sync::atomic::{AtomicU32, Ordering},
};

/// The paper's augmentation of a folder.
pub(super) fn options(folder: impl Into<PathBuf>) -> HattOptions {
    HattOptions {
        folder: folder.into(),
        instances: 20,
        first_instance: 0,
        seed: 1,
    }
}

/// A texture whose level is a power law, on measured places of its own.
pub(super) struct MadeUp {
    pub name: &'static str,
    /// Exponents of speed and force.
    pub growth: (f64, f64),
    /// RMS at 100 mm/s and 1 N, dB re 1 m/s².
    pub level_db: f64,
    /// True if the shape changes with speed.
    pub bends: bool,
    /// Right and upper border, mm/s and N.
    pub corner: (f64, f64),
}

pub(super) const MADE_UP: [MadeUp; 3] = [
    MadeUp {
        name: "Wood",
        growth: (0.9, 0.3),
        level_db: 2.0,
        bends: false,
        corner: (200.0, 4.0),
    },
    MadeUp {
        name: "Cork",
        growth: (0.4, 0.1),
        level_db: -5.0,
        bends: true,
        corner: (220.0, 3.0),
    },
    MadeUp {
        name: "Denim",
        growth: (1.3, -0.1),
        level_db: -9.0,
        bends: true,
        corner: (180.0, 2.0),
    },
];

impl MadeUp {
    pub(super) fn level_db(&self, speed_mm_s: f64, force_n: f64) -> f64 {
        let (speed, force) = self.growth;
        self.level_db
            + speed * 20.0 * libm::log10(speed_mm_s / 100.0)
            + force * 20.0 * libm::log10(force_n)
    }

    /// LSFs of an AR(6) at a speed.
    pub(super) fn lsf_rad(&self, speed_mm_s: f64) -> [f64; 6] {
        let bend = if self.bends {
            0.4 * speed_mm_s / 250.0
        } else {
            0.2
        };
        std::array::from_fn(|k| {
            let place = (k as f64 + 1.0) / 7.0;
            (place + bend * place * (1.0 - place)) * PI
        })
    }

    /// The file: a lattice of 5 × 4 places, its outer ones on the border; numerator
    /// 1 + z⁻¹.
    pub(super) fn xml(&self) -> String {
        let (width, height) = self.corner;
        let places: Vec<(f64, f64)> = (0..20)
            .map(|n| (f64::from(n % 5) / 4.0, f64::from(n / 5) / 3.0))
            // Inner rows are skewed, so that no two materials share a place.
            .map(|(x, y)| {
                (
                    x * width,
                    if y < 0.5 { y * (0.6 + 0.4 * x) } else { y } * height,
                )
            })
            .collect();
        let mut triangles = Vec::new();
        for row in 0..3 {
            for column in 0..4 {
                let at = 5 * row + column + 1;
                triangles.push([at, at + 1, at + 5]);
                triangles.push([at + 1, at + 6, at + 5]);
            }
        }
        let list = |name: &str, values: &[f64]| {
            let values: String = values
                .iter()
                .map(|v| format!("<value>{v:.17}</value>"))
                .collect();
            format!("<{name}>{values}</{name}>\n")
        };
        let mut text = format!(
            "<modelSet><material>{}</material><AccelUnits>m/s^2</AccelUnits>\
             <SpeedUnits>mm/s</SpeedUnits><ForceUnits>N</ForceUnits>\
             <SampleRate>1000</SampleRate><mu>0.4</mu><numMod>{}</numMod><numTri>{}</numTri>\
             <maxSpeed>{width}</maxSpeed><maxForce>{height}</maxForce>\
             <numARCoeff>6</numARCoeff><numMACoeff>1</numMACoeff>\n",
            self.name,
            places.len(),
            triangles.len(),
        );
        text += &list("speedList", &places.iter().map(|p| p.0).collect::<Vec<_>>());
        text += &list("forceList", &places.iter().map(|p| p.1).collect::<Vec<_>>());
        for triangle in triangles {
            text += &list("tri", &triangle.map(f64::from));
        }
        for (index, &(speed, force)) in places.iter().enumerate() {
            let lsf_rad = self.lsf_rad(speed);
            let monic = lsf::to_polynomial(&lsf_rad);
            let silent = speed == 0.0 || force == 0.0;
            let variance = if silent {
                0.0
            } else {
                libm::exp10(self.level_db(speed, force) / 10.0) / power(&monic)
            };
            let _ = write!(text, "<model><modNum>{}</modNum>", index + 1);
            text += &list("ARcoeff", &monic);
            text += &list("ARlsf", &lsf_rad);
            text += "<MAcoeff><value>1</value><value>1</value></MAcoeff>\
                     <MAlsf><value>3.141593</value></MAlsf>\n";
            let _ = writeln!(
                text,
                "<var>{variance:.17}</var><gain>1</gain><speedMod>{speed:.17}</speedMod>\
                 <forceMod>{force:.17}</forceMod></model>"
            );
        }
        text + "</modelSet>\n"
    }
}

/// Mean over frequency of |1 + e^{−jω}|²/|A|².
fn power(monic: &[f64]) -> f64 {
    const POINTS: usize = 4000;
    (0..POINTS)
        .map(|n| (n as f64 + 0.5) * PI / POINTS as f64)
        .map(|omega| (2.0 + 2.0 * omega.cos()) / squared_magnitude(monic, omega))
        .sum::<f64>()
        / POINTS as f64
}

/// A folder that is removed with the test.
pub(super) struct Folder(pub PathBuf);

impl Folder {
    pub(super) fn empty() -> Self {
        static COUNT: AtomicU32 = AtomicU32::new(0);
        let number = COUNT.fetch_add(1, Ordering::Relaxed);
        let name = format!("asperity-corpus-hatt-{}-{number}", std::process::id());
        let path = std::env::temp_dir().join(name);
        fs::create_dir_all(&path).unwrap();
        Self(path)
    }

    pub(super) fn of(materials: &[MadeUp]) -> Self {
        let folder = Self::empty();
        for material in materials {
            folder.write(material.name, &material.xml());
        }
        folder
    }

    pub(super) fn write(&self, name: &str, text: &str) {
        fs::write(self.file(name), text).unwrap();
    }

    pub(super) fn file(&self, name: &str) -> PathBuf {
        self.0.join(Path::new(&format!("Models_{name}.xml")))
    }
}

impl Drop for Folder {
    fn drop(&mut self) {
        let _ = fs::remove_dir_all(&self.0);
    }
}
