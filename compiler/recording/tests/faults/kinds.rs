//! The kinds of fault of `docs/recording-faults.md`, each made in a clean recording.

use super::damage::{clip, clock, edit, instead, lose, spike, unit};
use super::take::{Layout, Random, Take};
use std::fs;

/// Expected finding: its file, its channels and its words.
pub(super) struct Expected {
    pub(super) file: &'static str,
    pub(super) channels: Vec<String>,
    pub(super) words: Vec<String>,
}

pub(super) fn of_file(file: &'static str, words: &[&str]) -> Expected {
    Expected {
        file,
        channels: Vec::new(),
        words: words.iter().map(|word| (*word).to_owned()).collect(),
    }
}

pub(super) fn of_channels(file: &'static str, channels: &[&str], words: &[&str]) -> Expected {
    Expected {
        channels: channels
            .iter()
            .map(|channel| (*channel).to_owned())
            .collect(),
        ..of_file(file, words)
    }
}

type Make = fn(&mut Random, &mut Take) -> Expected;

/// Name, the layouts in which it can be, and how it is made.
pub(super) const KINDS: [(&str, &[Layout], Make); 44] = {
    use Layout::{Npy, Several, Single, Wav};
    const ANY: &[Layout] = &[Single, Several, Wav, Npy];
    const CSV: &[Layout] = &[Single, Several];
    [
        ("clock-ms-as-s", &[Several], |r, t| clock(r, t, "s", 1e3)),
        ("clock-s-as-ms", &[Several], |r, t| clock(r, t, "ms", 1.0)),
        ("clock-us-as-ms", &[Single], |r, t| clock(r, t, "ms", 1e6)),
        ("clock-ns-as-us", &[Single], |r, t| clock(r, t, "us", 1e9)),
        ("rate-beside-clock", CSV, |r, t| {
            let file = r.below(t.files.len());
            t.files[file].stated_hz =
                Some(t.files[file].rate_hz * r.pick(&[0.5, 0.8, 0.96, 1.05, 2.0]));
            of_file(
                "recording.toml",
                &["rate_hz says", "the clock says", "a factor of"],
            )
        }),
        ("rate-instead-of-clock", CSV, |r, t| {
            let file = r.below(t.files.len());
            let file = &mut t.files[file];
            file.uses_clock = false;
            file.stated_hz = Some(file.rate_hz * r.pick(&[0.5, 0.625, 1.25, 2.0]));
            let column = file.clock_name().replace('"', "");
            let mut expected =
                of_file(file.name, &["rate_hz says", "is a clock of", "a factor of"]);
            expected.words.push(format!("{column:?}"));
            expected
        }),
        ("clock-stands-still", CSV, |r, t| {
            let file = r.below(t.files.len());
            let file = &mut t.files[file];
            (file.clock_unit, file.clock_written) = ("s", 1.0);
            file.stamps
                .iter_mut()
                .for_each(|stamp| *stamp += 1.732_34e9);
            file.stamp = |stamp| format!("{stamp:.5e}");
            of_file(file.name, &["clock that does not move"])
        }),
        ("clock-wraps", CSV, |r, t| {
            let file = r.below(t.files.len());
            let file = &mut t.files[file];
            (file.clock_unit, file.clock_written) = ("us", 1e6);
            let wrap = f64::from(u32::MAX) / 1e6;
            let begin = wrap - r.within(1.0, 4.0);
            file.stamps
                .iter_mut()
                .for_each(|stamp| *stamp = (*stamp + begin) % wrap);
            file.stamp = |stamp| format!("{stamp:.0}");
            of_file(file.name, &["the clock goes from"])
        }),
        ("gaps", CSV, |r, t| {
            let file = r.below(t.files.len());
            for _ in 0..2 + r.below(4) {
                let length = r.within(0.01, 0.2);
                lose(r, t, file, length);
            }
            of_file(t.files[file].name, &["drop-outs", "gaps"])
        }),
        ("long-gap", CSV, |r, t| {
            let file = r.below(t.files.len());
            let length = r.within(2.0, 3.0);
            lose(r, t, file, length);
            of_file(t.files[file].name, &["the clock jumps by"])
        }),
        ("jitter", CSV, |r, t| {
            let file = r.below(t.files.len());
            let file = &mut t.files[file];
            let (mut stall, mut last) = ((0.0, 0.0), 0.0);
            for stamp in &mut file.stamps {
                if *stamp >= stall.1 {
                    stall = (*stamp, *stamp + r.within(0.005, 0.03));
                }
                // What waits comes at once, 20 µs apart.
                last = stall.1.max(last + 2e-5);
                *stamp = last;
            }
            of_file(file.name, &["jitters"])
        }),
        ("dead-sensor", ANY, |_, t| {
            let file = t.file("acceleration").name;
            for axis in ["x", "y", "z"] {
                t.column("acceleration", axis).values.fill(0.0);
            }
            let all = ["acceleration x", "acceleration y", "acceleration z"];
            of_channels(file, &all, &["dead", "one value"])
        }),
        ("dead-axis", ANY, |r, t| {
            let file = t.file("acceleration").name;
            let column = t.column("acceleration", r.pick(&["x", "y", "z"]));
            let value = r.pick(&[0.0, 20.0, -9.8, 5.3]);
            column.values.fill(value);
            of_channels(file, &[&column.label()], &["dead", "one value"])
        }),
        ("dead-force", ANY, |r, t| {
            let value = r.pick(&[0.0, 0.3, 1.0, 8.38]);
            t.column("force", "z").values.fill(value);
            of_channels(t.file("force").name, &["force z"], &["dead", "one value"])
        }),
        ("dead-position", ANY, |r, t| {
            let value = r.pick(&[0.0, 0.005, 0.12]);
            for axis in ["x", "y", "z"] {
                t.column("position", axis).values.fill(value);
            }
            let all = ["position x", "position y", "position z"];
            of_channels(t.file("position").name, &all, &["dead", "one value"])
        }),
        ("dies-midway", ANY, |r, t| {
            let quantity = r.pick(&["acceleration", "force", "position"]);
            let axes: &[&str] = match quantity {
                "acceleration" => r.pick(&[&["x"], &["y"], &["z"], &["x", "y", "z"]]),
                "force" => &["z"],
                _ => &["x", "y", "z"],
            };
            let (from, zero) = (r.within(0.4, 0.7), r.below(2) == 0);
            for axis in axes {
                let values = &mut t.column(quantity, axis).values;
                let from = (from * values.len() as f64) as usize;
                let held = if zero { 0.0 } else { values[from] };
                values[from..].fill(held);
            }
            let labels: Vec<String> = axes
                .iter()
                .map(|axis| format!("{quantity} {axis}"))
                .collect();
            let labels: Vec<&str> = labels.iter().map(String::as_str).collect();
            of_channels(t.file(quantity).name, &labels, &["drop-outs"])
        }),
        ("copied-axis", ANY, |r, t| {
            let (from, to) = r.pick(&[("x", "y"), ("x", "z"), ("y", "z")]);
            let values = t.column("acceleration", from).values.clone();
            t.column("acceleration", to).values = values;
            let file = t.file("acceleration").name;
            let mut expected =
                of_channels(file, &[&format!("acceleration {to}")], &["mislabelled"]);
            expected.words.push(format!("acceleration {from}"));
            expected
        }),
        (
            "counter-as-channel",
            &[Layout::Several, Layout::Npy, Layout::Single],
            |r, t| {
                let rate_hz = t.file("position").rate_hz;
                let step = r.pick(&[1.0, 1.0 / rate_hz, 1e3 / rate_hz]);
                let column = t.column("position", "x");
                let written = column.written;
                for (n, value) in column.values.iter_mut().enumerate() {
                    *value = step * n as f64 / written;
                }
                of_channels(
                    t.file("position").name,
                    &["position x"],
                    &["mislabelled: it counts"],
                )
            },
        ),
        ("clipped-acceleration", ANY, |r, t| {
            let file = t.file("acceleration").name;
            let column = t.column("acceleration", r.pick(&["x", "y", "z"]));
            let part = r.within(0.45, 0.7);
            clip(&mut column.values, part, true);
            of_channels(file, &[&column.label()], &["clipping"])
        }),
        ("clipped-force", ANY, |r, t| {
            let part = r.within(0.45, 0.7);
            clip(&mut t.column("force", "z").values, part, false);
            of_channels(t.file("force").name, &["force z"], &["clipping"])
        }),
        (
            "missing-values",
            &[Layout::Single, Layout::Several, Layout::Npy],
            |r, t| {
                let quantity = r.pick(&["acceleration", "force", "position"]);
                let axis = r.pick(&["x", "y", "z"]);
                for _ in 0..1 + r.below(5) {
                    let values = &mut t.column(quantity, axis).values;
                    let (start, length) = (r.below(values.len() - 60), 1 + r.below(50));
                    values[start..start + length].fill(f64::NAN);
                }
                of_channels(
                    t.file(quantity).name,
                    &[&format!("{quantity} {axis}")],
                    &["drop-outs", "missing"],
                )
            },
        ),
        (
            "held-values",
            &[Layout::Several, Layout::Wav, Layout::Npy],
            |r, t| {
                let quantity = r.pick(&["acceleration", "force", "position"]);
                let file = t.file(quantity);
                let zero = r.below(2) == 0;
                for _ in 0..6 {
                    let start = r.below(file.stamps.len() * 9 / 10);
                    let length = (r.within(0.02, 0.06) * file.rate_hz) as usize;
                    for column in &mut file.columns {
                        let held = if zero { 0.0 } else { column.values[start] };
                        column.values[start..start + length].fill(held);
                    }
                }
                of_file(file.name, &["drop-outs", "held"])
            },
        ),
        ("spikes-position", ANY, |r, t| {
            let axis = r.pick(&["x", "y", "z"]);
            spike(r, t.column("position", axis), 0.05, 0.5);
            of_channels(
                t.file("position").name,
                &[&format!("position {axis}")],
                &["impossible"],
            )
        }),
        ("spikes-force", ANY, |r, t| {
            spike(r, t.column("force", "z"), 10.0, 200.0);
            of_channels(t.file("force").name, &["force z"], &["impossible"])
        }),
        ("hum", ANY, |r, t| {
            let (mains_hz, size) = (r.pick(&[50.0, 60.0]), r.within(0.3, 2.0));
            let axis = r.pick(&["x", "y", "z"]);
            let file = t.file("acceleration");
            let rate_hz = file.rate_hz;
            let column = t.column("acceleration", axis);
            for (n, value) in column.values.iter_mut().enumerate() {
                *value += size * (std::f64::consts::TAU * mains_hz * n as f64 / rate_hz).sin();
            }
            of_channels(
                t.file("acceleration").name,
                &[&format!("acceleration {axis}")],
                &["hum"],
            )
        }),
        ("g-as-m/s²", ANY, |_, t| {
            unit(t, "acceleration", "m/s^2", 1.0 / 9.806_65, "9.80")
        }),
        ("m/s²-as-g", &[Single, Several, Npy], |_, t| {
            unit(t, "acceleration", "g", 1.0, "9.80")
        }),
        ("mg-as-g", &[Single, Several, Npy], |_, t| {
            unit(t, "acceleration", "g", 1e3 / 9.806_65, "1000.0")
        }),
        ("mN-as-N", ANY, |_, t| unit(t, "force", "N", 1e3, "1000.0")),
        ("mm-as-m", ANY, |_, t| {
            unit(t, "position", "m", 1e3, "1000.0")
        }),
        ("misaligned", &[Several, Wav, Npy], |r, t| {
            let late_s = r.within(0.015, 0.05) * r.pick(&[-1.0, 1.0]);
            let quantity = if t.layout == Wav {
                "force"
            } else {
                r.pick(&["force", "position"])
            };
            let file = t.file(quantity);
            file.stamps.iter_mut().for_each(|stamp| *stamp += late_s);
            of_file(file.name, &["misaligned"])
        }),
        ("no-contact", ANY, |r, t| {
            for axis in ["x", "y", "z"] {
                let bias = r.within(-0.04, 0.04);
                for value in &mut t.column("force", axis).values {
                    *value = bias + 0.003 * r.noise();
                }
            }
            of_channels(
                "",
                &["force z"],
                &["the tool touches the surface for 0.0 s"],
            )
        }),
        ("wav-cut", &[Wav], |r, t| {
            let part = r.within(0.6, 0.95);
            t.after.push(Box::new(move |folder| {
                let path = folder.join("accel.wav");
                let bytes = fs::read(&path).expect("written");
                fs::write(path, &bytes[..(part * bytes.len() as f64) as usize]).expect("written");
            }));
            of_file("accel.wav", &["is cut"])
        }),
        ("wav-no-length", &[Wav], |r, t| {
            let (length, has_chunk) = (
                r.pick(&[0_u32, u32::MAX, 0x7fff_f000]),
                t.files[0].has_chunk,
            );
            t.after.push(Box::new(move |folder| {
                let path = folder.join("accel.wav");
                let mut bytes = fs::read(&path).expect("written");
                let at = if has_chunk { 56 } else { 40 };
                bytes[at..at + 4].copy_from_slice(&length.to_le_bytes());
                fs::write(path, bytes).expect("written");
            }));
            of_file("accel.wav", &["states no length"])
        }),
        ("csv-cut", CSV, |r, t| {
            edit(r, t, |r, lines| {
                let last = lines.pop().unwrap_or_default();
                let end = last.find([',', ';', '\t']).unwrap_or(1);
                lines.push(last[..end - r.below(2)].to_owned());
                ("is cut".into(), lines.len())
            })
        }),
        ("csv-garbage", CSV, |r, t| {
            edit(r, t, |r, lines| {
                let at = 100 + r.below(lines.len() - 200);
                lines.insert(at, "\u{fffd}".repeat(10 + r.below(200)));
                (format!(":{}: ", at + 1), 0)
            })
        }),
        ("csv-short-row", CSV, |r, t| {
            edit(r, t, |r, lines| {
                let at = 100 + r.below(lines.len() - 200);
                let cut = lines[at].rfind([',', ';', '\t']).unwrap_or(0);
                lines[at].truncate(cut);
                (format!(":{}: ", at + 1), 0)
            })
        }),
        ("csv-no-header", CSV, |r, t| {
            edit(r, t, |_, lines| {
                lines.remove(0);
                ("no header".into(), 0)
            })
        }),
        ("csv-duplicate-column", CSV, |r, t| {
            edit(r, t, |_, lines| {
                let delimiter = lines[1]
                    .chars()
                    .find(|c| matches!(c, ',' | ';' | '\t'))
                    .unwrap_or(',');
                let name = lines[0]
                    .rsplit(delimiter)
                    .next()
                    .unwrap_or_default()
                    .to_owned();
                for (n, line) in lines.iter_mut().enumerate() {
                    line.push(delimiter);
                    line.push_str(if n == 0 { &name } else { "0" });
                }
                ("2 times".into(), 0)
            })
        }),
        ("csv-utf16", CSV, |r, t| {
            let name = t.files[r.below(t.files.len())].name;
            t.after.push(Box::new(move |folder| {
                let text = fs::read_to_string(folder.join(name)).expect("written");
                let words = std::iter::once(0xfeff).chain(text.encode_utf16());
                fs::write(
                    folder.join(name),
                    words.flat_map(u16::to_le_bytes).collect::<Vec<_>>(),
                )
                .expect("written");
            }));
            of_file(name, &["UTF-16"])
        }),
        ("npy-fortran", &[Npy], |_, t| {
            t.after.push(Box::new(|folder| {
                let mut bytes = fs::read(folder.join("force.npy")).expect("written");
                let at = bytes
                    .windows(5)
                    .position(|word| word == b"False")
                    .expect("a header");
                bytes[at..at + 5].copy_from_slice(b"True ");
                fs::write(folder.join("force.npy"), bytes).expect("written");
            }));
            of_file("force.npy", &["Fortran order"])
        }),
        ("npy-cut", &[Npy], |r, t| {
            let part = r.within(0.2, 0.98);
            t.after.push(Box::new(move |folder| {
                let bytes = fs::read(folder.join("force.npy")).expect("written");
                let length = (part * bytes.len() as f64) as usize;
                fs::write(folder.join("force.npy"), &bytes[..length]).expect("written");
            }));
            of_file("force.npy", &["is cut", "ends before row"])
        }),
        ("lfs-pointer", ANY, |r, t| {
            let pointer = format!(
                "version https://git-lfs.github.com/spec/v1\noid sha256:{:064x}\nsize {}\n",
                r.below(usize::MAX),
                r.below(1_000_000)
            );
            instead(r, t, pointer, &["Git LFS pointer", "git lfs pull"])
        }),
        ("empty-file", ANY, |r, t| {
            instead(r, t, String::new(), &["is empty"])
        }),
    ]
};
