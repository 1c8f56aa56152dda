//! Lists as other writers write them, some of them damaged.

use asperity_tests::draw::Draw;
use std::collections::BTreeMap;

/// A list as written, and its damage.
pub(super) struct List {
    pub(super) file: &'static str,
    pub(super) text: String,
    pub(super) wanted: BTreeMap<String, String>,
    pub(super) damage: Option<&'static str>,
}

/// A prompt that spreadsheets have to quote now and then.
fn prompt(draw: &mut Draw) -> String {
    const WORDS: [&str; 8] = [
        "rough", "oak", "wet", "ice", "Käse", "2\" pipe", "木", "felt",
    ];
    let words: Vec<&str> = (0..1 + draw.below(4))
        .map(|_| WORDS[draw.below(8)])
        .collect();
    words.join([" ", ", ", "; "][draw.below(3)])
}

fn textures(draw: &mut Draw) -> Vec<(String, String)> {
    let count = 2 + draw.below(20);
    (0..count)
        .map(|n| (format!("t{n}"), prompt(draw)))
        .collect()
}

fn is(draw: &mut Draw) -> bool {
    draw.below(2) == 1
}

/// A cell, in quotes where it has to be, or now and then otherwise.
fn cell(text: &str, separator: char, draw: &mut Draw) -> String {
    let must = text.contains([separator, '"', '\n']);
    if must || draw.below(4) == 0 {
        format!("\"{}\"", text.replace('"', "\"\""))
    } else {
        text.to_owned()
    }
}

/// A CSV file with what spreadsheets put around a table.
pub(super) fn csv(draw: &mut Draw) -> List {
    let textures = textures(draw);
    let separator = [',', ';', '\t'][draw.below(3)];
    let end = ["\n", "\r\n", "\r"][draw.below(3)];
    let empty = draw.below(3);
    let s = separator.to_string();
    let tail = s.repeat(empty);
    let mut rows = vec![format!("name{s}prompt{s}seed{tail}")];
    for (name, prompt) in &textures {
        let name = cell(name, separator, draw);
        let prompt = cell(prompt, separator, draw);
        let seed = ["", "3"][draw.below(2)];
        rows.push(format!("{name}{s}{prompt}{s}{seed}{tail}"));
        if draw.below(4) == 0 {
            rows.push(format!("{s}{s}{tail}"));
        }
    }
    let at = 1 + draw.below(rows.len() - 1);
    let filled = |row: &String| !row.starts_with(separator);
    let at = (1..=at)
        .rev()
        .find(|&at| filled(&rows[at]))
        .expect("the first row is filled");
    let damage = match draw.below(14) {
        0 => {
            rows[at].insert(0, '"');
            // Of a cell that is in quotes, two quotes are an empty cell with text behind it.
            Some("an open quote")
        }
        1 => {
            rows[at] = format!("x{s}\"rough oak{s}");
            Some("an open quote in a later cell")
        }
        2 => {
            rows[at] = format!("x{s}\"rough oak");
            rows.insert(at + 1, format!("y{s}wet ice{s}5\""));
            Some("a quote that closes at the end of the next row")
        }
        3 => {
            rows[0] = format!("name{s}prompt{s}prompt{tail}");
            Some("a column twice")
        }
        4 => {
            rows[at] += &format!("{s}more");
            Some("a cell without a column")
        }
        5 => {
            rows[at] = "lonely".into();
            Some("a row of one cell")
        }
        6 => {
            rows[0] = format!("nome{s}prompt{s}seed{tail}");
            Some("a column that is not known")
        }
        7 => {
            rows.push(rows[at].clone());
            Some("a row twice")
        }
        8 => {
            rows.remove(0);
            Some("no header")
        }
        _ => None,
    };
    let blank = if is(draw) { end } else { "" };
    let mark = if is(draw) { "\u{feff}" } else { "" };
    let last = if is(draw) { end } else { "" };
    List {
        file: "list.csv",
        text: format!("{mark}{blank}{}{last}", rows.join(end)),
        wanted: textures.into_iter().collect(),
        damage,
    }
}

pub(super) fn json_lines(draw: &mut Draw) -> List {
    let textures = textures(draw);
    let end = ["\n", "\r\n", "\n\n"][draw.below(3)];
    let line = |(name, prompt): &(String, String)| {
        serde_json::json!({ "name": name, "prompt": prompt, "seed": 1 }).to_string()
    };
    let mut lines: Vec<String> = textures.iter().map(line).collect();
    let at = draw.below(lines.len());
    let damage = match draw.below(8) {
        0 => {
            lines[at].insert_str(1, "\"prompt\":\"ice\",");
            Some("a key twice")
        }
        1 => {
            lines[at].pop();
            Some("an object without an end")
        }
        2 => {
            let more = lines[at].clone();
            lines[at] += &more.replace("\"t", "\"u");
            Some("two objects in a line")
        }
        3 => {
            lines[at] = format!("[{}]", lines[at]);
            Some("a list")
        }
        _ => None,
    };
    let mark = if is(draw) { "\u{feff}" } else { "" };
    List {
        file: "list.jsonl",
        text: format!("{mark}{}{end}", lines.join(end)),
        wanted: textures.into_iter().collect(),
        damage,
    }
}

pub(super) fn toml(draw: &mut Draw) -> List {
    let textures = textures(draw);
    let mut tables: Vec<String> = textures
        .iter()
        .map(|(name, prompt)| format!("[[texture]]\nname = {name:?}\nprompt = {prompt:?}\n"))
        .collect();
    let at = draw.below(tables.len());
    let damage = match draw.below(8) {
        0 => {
            tables[at] += "prompt = \"ice\"\n";
            Some("a key twice")
        }
        1 => {
            tables[at] = tables[at].replace("[[texture]]\n", "");
            // Above the first table the keys are unknown, below another one they are there twice.
            Some("a table without its head")
        }
        2 => {
            tables[at] = tables[at].replace("[[texture]]", "[texture]");
            Some("single brackets")
        }
        3 => {
            tables[at] = tables[at].replacen("\"\n", "\n", 1);
            Some("a string without an end")
        }
        _ => None,
    };
    let mark = if is(draw) { "\u{feff}" } else { "" };
    let text = tables.concat();
    let text = if is(draw) {
        text.replace('\n', "\r\n")
    } else {
        text
    };
    List {
        file: "list.toml",
        text: format!("{mark}{text}"),
        wanted: textures.into_iter().collect(),
        damage,
    }
}
