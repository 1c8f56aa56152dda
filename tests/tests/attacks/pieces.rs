//! Attacks that are not left to chance: each was, or would be, a way to stop a command.

use super::{
    forge,
    programs::Program::{self, Compiler, Lab},
    seeds::{Seed, Seeds},
};
use asperity_diffusion::tiny;

/// As a target: the word of the line that is replaced, instead of a file.
pub(crate) const PROMPT: &str = "PROMPT";

/// An attack.
pub(crate) struct Piece {
    pub(crate) program: Program,
    pub(crate) line: &'static str,
    pub(crate) target: &'static str,
    pub(crate) told: &'static str,
    pub(crate) bytes: fn(&Seeds) -> Vec<u8>,
}

const fn piece(
    (program, line, target): (Program, &'static str, &'static str),
    told: &'static str,
    bytes: fn(&Seeds) -> Vec<u8>,
) -> Piece {
    Piece {
        program,
        line,
        target,
        told,
        bytes,
    }
}

type Line = (Program, &'static str, &'static str);
const HATT: Line = (Compiler, "import hatt in.xml -o out.asp", "in.xml");
const MODEL: Line = (Compiler, "import model in.json -o out.asp", "in.json");
const HAPTIC: Line = (
    Compiler,
    "import haptic in.haptic -o out.asp --no-preview",
    "in.haptic",
);
const AHAP: Line = (
    Compiler,
    "import ahap in.ahap -o out.asp --no-preview",
    "in.ahap",
);
const HJIF: Line = (
    Compiler,
    "import hjif in.hjif -o out.asp --no-preview",
    "in.hjif",
);
const BUILD: Line = (Compiler, "build in.toml -o out.aspl --no-cache", "in.toml");
const GRIP: Line = (Lab, "feel --seconds 1 --grip in.toml", "in.toml");
const DEVICE: Line = (Lab, "feel --seconds 1 --device in.toml", "in.toml");
const COUNTS: Line = (Lab, "pareto --quick --cortex-m in.csv --out out", "in.csv");
const TRAJECTORY: Line = (
    Compiler,
    "render good.asp --trajectory in.csv -o out.csv",
    "in.csv",
);
const INSPECT: Line = (Compiler, "inspect in.aspl --json", "in.aspl");
const RENDER: Line = (
    Compiler,
    "render in.aspl --trajectory stroke.csv -o out.csv",
    "in.aspl",
);
const DESCRIPTION: Line = (Compiler, "doctor --model model", "model/model.json");
const NETWORK: Line = (
    Compiler,
    "doctor --text-encoder clip:clip",
    "clip/model.onnx",
);

const PAINT: &str =
    "preview good.asp -o out.png --diffusion sd --diffusion-backend portable --steps 2";
const SCHEDULE: Line = (Compiler, PAINT, "sd/scheduler/scheduler_config.json");
const VOCABULARY: Line = (Compiler, PAINT, "sd/tokenizer/vocab.json");
const MERGES: Line = (Compiler, PAINT, "sd/tokenizer/merges.txt");
const UNET: Line = (Compiler, PAINT, "sd/unet/model.onnx");

const PROMPT_LINE: Line = (Compiler, "compile PROMPT -o out.asp --no-preview", PROMPT);

const SESSION: Line = (
    Lab,
    "servo good.asp --device replay:in.aspr --seconds 0.1 --policy other --no-lock",
    "in.aspr",
);
const INTERVALS: Line = (Lab, "jitter compare in.hlog good.hlog", "in.hlog");

pub(crate) const PIECES: [Piece; 57] = [
    piece(PROMPT_LINE, "one word of 120,000 letters", |_| {
        b"a".repeat(120_000)
    }),
    piece(PROMPT_LINE, "60,000 words", |_| b"a ".repeat(60_000)),
    piece(PROMPT_LINE, "60,000 combining marks", |_| {
        "\u{301}".repeat(60_000).into_bytes()
    }),
    piece(PROMPT_LINE, "bytes that are no text", |_| {
        b"cork \xff\xfe".to_vec()
    }),
    piece(PROMPT_LINE, "control characters", |_| {
        b"\x1b[31m\x07\r\n\x7f".to_vec()
    }),
    piece(HATT, "80,000 attributes", |_| attributes(80_000)),
    piece(HATT, "300,000 attributes", |_| attributes(300_000)),
    piece(HATT, "60,000 namespaces within each other", |_| {
        numbered(60_000, |n| format!("<e xmlns:n{n}='{n}'>"))
    }),
    piece(HATT, "5,000,000 elements within each other", |_| {
        b"<a>".repeat(5_000_000)
    }),
    piece(HATT, "1,000,000 elements beside each other", |_| {
        [
            b"<modelSet>",
            &b"<a/>".repeat(1_000_000)[..],
            b"</modelSet>",
        ]
        .concat()
    }),
    piece(HATT, "1,000,000 CDATA sections", |_| {
        [
            b"<modelSet>",
            &b"<![CDATA[x]]>".repeat(1_000_000)[..],
            b"</modelSet>",
        ]
        .concat()
    }),
    piece(HATT, "a billion laughs", |_| laughs()),
    piece(HATT, "1,000,000 character references", |_| {
        [
            b"<modelSet>",
            &b"&#65;".repeat(1_000_000)[..],
            b"</modelSet>",
        ]
        .concat()
    }),
    piece(HATT, "a name of 16,000,000 bytes", |_| {
        [b"<".as_slice(), &b"a".repeat(16_000_000), b"/>"].concat()
    }),
    piece(HATT, "1,000,000 values", |seeds| {
        replaced(
            seeds,
            Seed::Material,
            "<value>80</value>",
            &"<value>80</value>".repeat(800_000),
        )
    }),
    piece(RENDER, "a million textures and a scene", |seeds| {
        forge::library_of(1 << 20, seeds.bytes(Seed::Asset))
    }),
    piece(INSPECT, "a million textures", |seeds| {
        forge::library_of(1 << 20, seeds.bytes(Seed::Asset))
    }),
    piece(INSPECT, "a header that promises a million textures", |_| {
        let mut bytes = b"ASPL\x01\0\0\0".to_vec();
        bytes.extend((1_u32 << 20).to_le_bytes());
        bytes.extend((88_u32 << 20).to_le_bytes());
        bytes.resize(64, 0xff);
        bytes
    }),
    piece(MODEL, "arrays nested 8,000,000 deep", |_| {
        b"[".repeat(8_000_000)
    }),
    piece(MODEL, "objects nested 1,000,000 deep", |_| {
        b"{\"format\":".repeat(1_000_000)
    }),
    piece(MODEL, "a format of 5,000,000 arrays", |_| {
        [b"{\"format\": [", &b"[],".repeat(5_000_000)[..], b"[]]}"].concat()
    }),
    piece(MODEL, "a list of 8,000,000 numbers", |seeds| {
        replaced(
            seeds,
            Seed::Model,
            "\"lsf_rad\": [",
            &format!("\"lsf_rad\": [{}", "1,".repeat(7_500_000)),
        )
    }),
    piece(MODEL, "a number of 10,000,000 digits", |seeds| {
        replaced(
            seeds,
            Seed::Model,
            "\"mu\": ",
            &format!("\"mu\": {}", "1".repeat(10_000_000)),
        )
    }),
    piece(MODEL, "100,000 vertices", |seeds| {
        let vertex = "{\"speed_mm_s\":1,\"force_n\":1,\"kind\":\"edge\",\"sigma_m_s2\":0,\"lsf_rad\":[1,2]},";
        replaced(
            seeds,
            Seed::Model,
            "\"vertices\": [",
            &format!("\"vertices\": [{}", vertex.repeat(100_000)),
        )
    }),
    piece(BUILD, "arrays nested 1,000,000 deep", |_| {
        [b"a = ".as_slice(), &b"[".repeat(1_000_000)].concat()
    }),
    piece(BUILD, "a key of 500,000 parts", |_| {
        [&b"a.".repeat(500_000)[..], b"a = 1"].concat()
    }),
    piece(BUILD, "a table of 500,000 parts", |_| {
        [b"[".as_slice(), &b"a.".repeat(500_000), b"a]"].concat()
    }),
    piece(BUILD, "300 tables of 3,000 parts", |_| {
        numbered(300, |n| format!("[{}b{n}]\n", "a.".repeat(1500)))
    }),
    piece(BUILD, "20,000 textures", |_| {
        numbered(20_000, |n| {
            format!("[[texture]]\nname = 't{n}'\nasset = 'x'\n")
        })
    }),
    piece(
        BUILD,
        "20,000 textures and a surface that wears another",
        |_| {
            let mut bytes = numbered(15_000, |n| {
                format!("[[texture]]\nname = 't{n}'\nasset = 'x'\n")
            });
            bytes.extend(
                b"[[surface]]\ntexture = 'none'\nplane = {point_m=[0,0,0], normal=[0,0,1]}\n",
            );
            bytes
        },
    ),
    piece(BUILD, "50,000 surfaces", |_| {
        b"[[surface]]\ntexture = 'a'\n".repeat(35_000)
    }),
    piece(BUILD, "60,000 keys", |_| {
        numbered(60_000, |n| format!("k{n} = {n}\n"))
    }),
    piece(BUILD, "a string of 1,000,000 bytes", |_| {
        [b"a = '".as_slice(), &b"x".repeat(1_000_000), b"'"].concat()
    }),
    piece(GRIP, "a number of 1,000,000 digits", |_| {
        [b"mass_kg = ".as_slice(), &b"1".repeat(1_000_000)].concat()
    }),
    piece(GRIP, "100,000 unconfirmed names", |seeds| {
        replaced(
            seeds,
            Seed::Grip,
            "unconfirmed = [",
            &format!("unconfirmed = [{}", "'mass_kg',".repeat(90_000)),
        )
    }),
    piece(DEVICE, "2,000,000 bytes of comment", |_| {
        b"# 4567890\n".repeat(200_000)
    }),
    piece(TRAJECTORY, "a row of a million fields", |_| {
        [b"t_s,x_mm,y_mm,z_mm\n", &b"0,".repeat(1_000_000)[..]].concat()
    }),
    piece(TRAJECTORY, "a header of a million fields", |_| {
        b"t_s,".repeat(1_000_000)
    }),
    piece(TRAJECTORY, "a quotation that never ends", |_| {
        [
            b"t_s,x_mm,y_mm,z_mm\n\"",
            &b"0,0,0,0\n".repeat(1_000_000)[..],
        ]
        .concat()
    }),
    piece(COUNTS, "a row of 500,000 fields", |_| {
        b"factor,".repeat(140_000)
    }),
    piece(DESCRIPTION, "arrays nested 8,000,000 deep", |_| {
        b"[".repeat(8_000_000)
    }),
    piece(NETWORK, "20,000,000 empty nodes", |_| {
        let nodes = b"\x0a\0".repeat(20_000_000);
        let mut bytes = vec![0x3a];
        let mut len = nodes.len();
        while len >= 0x80 {
            bytes.push(len as u8 | 0x80);
            len >>= 7;
        }
        bytes.push(len as u8);
        bytes.extend(nodes);
        bytes
    }),
    piece(
        HAPTIC,
        "one envelope over 600 s with 100,000 points",
        |_| {
            let points = numbered(100_000, |n| {
                let t_s = 0.006 * n as f64;
                format!("{}{{\"time\":{t_s},\"amplitude\":0.5}}", comma(n))
            });
            [
                b"{\"version\":{\"major\":1,\"minor\":0,\"patch\":0},\"signals\":{\"continuous\":\
              {\"envelopes\":{\"amplitude\":[",
                &points[..],
                b"]}}}}",
            ]
            .concat()
        },
    ),
    piece(AHAP, "40,000 events of 30 s at once", |_| {
        let events = numbered(40_000, |n| {
            let comma = comma(n);
            format!(
                "{comma}{{\"Event\":{{\"Time\":0,\"EventType\":\"HapticContinuous\",\
                 \"EventDuration\":30,\"EventParameters\":[]}}}}"
            )
        });
        [b"{\"Version\":1,\"Pattern\":[", &events[..], b"]}"].concat()
    }),
    piece(
        AHAP,
        "20,000 transients under a curve of 50,000 points",
        |_| {
            let events = numbered(20_000, |n| {
                format!("{{\"Event\":{{\"Time\":{n}e-2,\"EventType\":\"HapticTransient\"}}}},")
            });
            let points = numbered(50_000, |n| {
                format!("{}{{\"Time\":{n}e-3,\"ParameterValue\":1}}", comma(n))
            });
            [
                b"{\"Version\":1,\"Pattern\":[",
                &events[..],
                b"{\"ParameterCurve\":{\"ParameterID\":\"HapticIntensityControl\",\"Time\":0,\
              \"ParameterCurveControlPoints\":[",
                &points[..],
                b"]}}]}",
            ]
            .concat()
        },
    ),
    piece(
        HJIF,
        "one effect of 5,000 keyframes that is referred to 50,000 times",
        |_| {
            let frames = numbered(5000, |n| {
                let comma = comma(n);
                format!("{comma}{{\"relative_position\":{n},\"amplitude_modulation\":0.1}}")
            });
            let effects = numbered(50_000, |n| {
                let comma = comma(n);
                format!("{comma}{{\"effect_type\":\"Reference\",\"id\":1,\"position\":0}}")
            });
            [
            b"{\"version\":\"2023\",\"profile\":\"Main\",\"level\":1,\"date\":\"\",\"description\":\"\",\
              \"perceptions\":[{\"id\":0,\"avatar_id\":0,\"description\":\"\",\
              \"perception_modality\":\"Vibrotactile\",\"effect_library\":[{\"id\":1,\
              \"effect_type\":\"Basis\",\"position\":0,\"keyframes\":[",
            &frames[..],
            b"]}],\"channels\":[{\"id\":0,\"description\":\"\",\"gain\":1,\"mixing_coefficient\":1,\
              \"body_part_mask\":0,\"bands\":[{\"band_type\":\"Curve\",\"curve_type\":\"Linear\",\
              \"lower_frequency_limit\":0,\"upper_frequency_limit\":500,\"effects\":[",
            &effects[..],
            b"]}]}]}]}",
        ]
        .concat()
        },
    ),
    piece(
        SCHEDULE,
        "100,000 trained steps that leave no picture",
        |_| b"{\"num_train_timesteps\": 100000, \"beta_schedule\": \"linear\"}".to_vec(),
    ),
    piece(SCHEDULE, "500,000 lists within each other", |_| {
        b"[".repeat(500_000)
    }),
    piece(VOCABULARY, "1,000,000 tokens", |_| {
        let tokens = numbered(1_000_000, |n| format!("{}\"{n}\":{n}", comma(n)));
        [b"{", &tokens[..], b"}"].concat()
    }),
    piece(MERGES, "1,000,000 merges", |_| b"c o\n".repeat(1_000_000)),
    piece(UNET, "a network that gives NaN", |_| {
        let options = tiny::Options {
            is_broken: true,
            ..tiny::Options::default()
        };
        part(&options, "unet/model.onnx")
    }),
    piece(UNET, "the UNet of a wider text encoder", |_| {
        let options = tiny::Options {
            unet_text_width: 1024,
            ..tiny::Options::default()
        };
        part(&options, "unet/model.onnx")
    }),
    piece(UNET, "the decoder instead of the UNet", |_| {
        part(&tiny::Options::default(), "vae_decoder/model.onnx")
    }),
    piece(SESSION, "32,000,000 ticks of two bytes", |seeds| {
        forge::session_of(seeds.bytes(Seed::Session), 64, 500_000)
    }),
    piece(SESSION, "a session at 1 GHz", |seeds| {
        let part: &[u8] = b"\"servo_rate_hz\":1000.0";
        let mut bytes = seeds.bytes(Seed::Session).to_vec();
        let at = bytes.windows(part.len()).position(|bytes| bytes == part);
        let end = at.expect("a rate") + part.len();
        bytes[end - 6..end].copy_from_slice(b"1e9   ");
        forge::sealed(bytes)
    }),
    piece(SESSION, "a block of 4 GB", |seeds| {
        let mut bytes = seeds.bytes(Seed::Session).to_vec();
        bytes[9..13].fill(0xff);
        bytes
    }),
    piece(INTERVALS, "a histogram that states 2 GB", |seeds| {
        // Base64: the length stands in five and a third letters after the cookie.
        replaced(seeds, Seed::Intervals, "HISTFAAAA", "HISTFH///")
    }),
];

/// A part of a tiny diffusion folder.
fn part(options: &tiny::Options, part: &str) -> Vec<u8> {
    let files = tiny::folder(options);
    let found = files.into_iter().find(|(name, _)| *name == part);
    found.expect("a part of the tiny folder").1
}

fn numbered(count: usize, one: impl Fn(usize) -> String) -> Vec<u8> {
    (0..count).map(one).collect::<String>().into_bytes()
}

/// Returns the separator before the `n`th entry of a list.
fn comma(n: usize) -> &'static str {
    if n == 0 { "" } else { "," }
}

fn attributes(count: usize) -> Vec<u8> {
    let inner = numbered(count, |n| format!(" a{n}=''"));
    [b"<modelSet", &inner[..], b"/>"].concat()
}

fn laughs() -> Vec<u8> {
    let entities = numbered(10, |n| {
        format!("<!ENTITY l{} \"{}\">", n + 1, format!("&l{n};").repeat(10))
    });
    [
        b"<!DOCTYPE modelSet [<!ENTITY l0 \"lol\">",
        &entities[..],
        b"]><modelSet>&l10;</modelSet>",
    ]
    .concat()
}

/// A valid input with a part of it replaced once.
fn replaced(seeds: &Seeds, seed: Seed, part: &str, by: &str) -> Vec<u8> {
    let text = String::from_utf8_lossy(seeds.bytes(seed)).into_owned();
    assert!(text.contains(part), "{part} in {seed:?}");
    text.replacen(part, by, 1).into_bytes()
}
