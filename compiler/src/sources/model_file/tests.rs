//! Contents of a model file: preserved fields, optional fields, refusals.

use super::*;
use crate::{
    driver,
    passes::reduce::Fidelity,
    pipeline::Request,
    sources::{SourceOutput, Tools, builtin},
};
use asperity_io::{diagnostic::Fault, input::InputKind};
use asperity_texture::model::{FrictionLaw, LawPoint, Numerator, TextureModel, defaults, mesh};
use serde_json::{Value, json};

/// The model as a file keeps it: what belongs to an asset is left out.
fn kept(mut texture: TextureModel) -> TextureModel {
    texture.provenance.fidelity.clear();
    texture.provenance.lsf_error_db = 0.0;
    texture
}

/// The built-in texture with a numerator of its own at every vertex.
fn with_numerator() -> TextureModel {
    let mut texture = builtin::texture();
    texture.grid.numerator = Numerator::Lsf;
    for (index, vertex) in texture.grid.vertices.iter_mut().enumerate() {
        let bend = 0.001 * index as f64;
        vertex.ma_lsf_rad = Some(vec![0.3 + bend, 1.1, 2.0 + bend]);
        vertex.gain = 0.1 + 0.7 * bend;
    }
    texture
}

fn document() -> Value {
    serde_json::from_slice(&to_json(&builtin::texture())).unwrap()
}

fn from(document: &Value) -> Result<TextureModel, Fault> {
    from_json(&serde_json::to_vec(document).unwrap())
}

/// A model is refused with this field and a text that names what is wrong.
fn refused(document: &Value, field: &str, says: &str) {
    let fault = from(document).unwrap_err();
    assert_eq!(fault.field, field, "{fault}");
    assert!(fault.what.contains(says), "{says:?} not in {fault}");
}

/// The built-in texture with friction that depends on speed.
fn with_law() -> TextureModel {
    let mut texture = builtin::texture();
    let point = |speed_mm_s, factor| LawPoint { speed_mm_s, factor };
    texture.friction.law = Some(FrictionLaw {
        points: vec![point(20.0, 1.5), point(60.0, 1.0), point(200.0, 0.6)],
    });
    texture
}

#[test]
fn a_law_of_friction_is_checked_and_absent_where_there_is_none() {
    assert_eq!(document()["friction"].get("law"), None);
    let with = |change: &dyn Fn(&mut Value)| {
        let mut document: Value = serde_json::from_slice(&to_json(&with_law())).unwrap();
        change(&mut document["friction"]["law"]);
        document
    };
    let point = json!({"speed_mm_s": 300.0, "factor": 1.0});
    refused(&with(&|law| *law = json!([])), "friction.law", "0");
    refused(&with(&|law| *law = json!([point])), "friction.law", "1");
    refused(
        &with(&|law| *law = Value::Array(vec![point.clone(); 9])),
        "friction.law",
        "9",
    );
    for (key, value) in [
        ("speed_mm_s", json!(20.0)),
        ("speed_mm_s", json!(20.03)),
        ("speed_mm_s", json!(-1.0)),
        ("speed_mm_s", json!(4096.0)),
        ("factor", json!(-0.1)),
        ("factor", json!(8.0)),
    ] {
        let field = format!("friction.law[1].{key}");
        refused(&with(&|law| law[1][key] = value.clone()), &field, "from");
    }
    refused(
        &with(&|law| law[0]["factor"] = Value::Null),
        "friction.law[0].factor",
        "f64",
    );
    refused(
        &with(&|law| law[0]["mu"] = json!(1.0)),
        "friction.law[0].mu",
        "unknown field",
    );
}

#[test]
fn a_model_reads_back_to_the_bit() {
    for texture in [builtin::texture(), with_numerator(), with_law()] {
        let back = from_json(&to_json(&texture)).unwrap();
        assert_eq!(back, kept(texture));
    }
}

#[test]
fn a_model_read_back_gives_the_same_bytes_at_every_setting() {
    for fidelity in [Fidelity::Full, Fidelity::Auto, Fidelity::Order(6)] {
        for rate_hz in [None, Some(1500.0)] {
            let request = Request {
                rate_hz,
                fidelity,
                ..Request::default()
            };
            let compile = |texture| {
                let source = SourceOutput::new(texture);
                driver::compile(&source, &request, &Tools::default()).unwrap()
            };
            let direct = compile(builtin::texture());
            // What is emitted is the whole texture, already at the wanted rate.
            let again = compile(from_json(&to_json(&direct.whole)).unwrap());
            assert_eq!(again.lowered.bytes, direct.lowered.bytes, "{request:?}");
        }
    }
}

#[test]
fn what_a_file_leaves_out_is_triangulated_or_set_to_a_default() {
    let mut small = document();
    let top = small.as_object_mut().unwrap();
    for key in ["taps", "wall", "gains", "provenance"] {
        top.remove(key).unwrap();
    }
    top["grid"]
        .as_object_mut()
        .unwrap()
        .remove("triangles")
        .unwrap();
    top["friction"]
        .as_object_mut()
        .unwrap()
        .remove("anchors")
        .unwrap();
    let texture = from(&small).unwrap();
    assert_eq!(mesh::check(&texture.grid), Ok(()));
    assert_eq!(
        (texture.wall, texture.gains),
        (defaults::wall(), defaults::gains())
    );
    assert!(texture.taps.traces.is_empty() && texture.friction.anchors.is_empty());
    assert!(texture.provenance.notes.contains("unconfirmed"));
    let source = SourceOutput::new(texture);
    driver::compile(&source, &Request::default(), &Tools::default()).unwrap();
}

#[test]
fn a_file_has_one_line_a_vertex_a_triangle_and_a_trace() {
    let texture = builtin::texture();
    let text = String::from_utf8(to_json(&texture)).unwrap();
    let rows = |starts: fn(&str) -> bool| text.lines().filter(|l| starts(l.trim_start())).count();
    let vertices = rows(|line| line.starts_with("{\"speed_mm_s\""));
    assert_eq!(vertices, texture.grid.vertices.len());
    let traces = rows(|line| line.starts_with("{\"speed_m_s\""));
    assert_eq!(traces, texture.taps.traces.len());
    let triangles = rows(|line| line.starts_with('[') && line.contains(", "));
    assert_eq!(triangles, texture.grid.triangles.len());
}

#[test]
fn other_files_and_versions_are_told_apart() {
    refused(&json!({}), "format", "absent");
    refused(&json!({"format": "glTF", "version": 1}), "format", "glTF");
    refused(&json!({"format": FORMAT}), "version", "absent");
    for version in [json!(2), json!("1"), json!(1.5), json!(-1)] {
        let mut later = document();
        later["version"] = version;
        refused(&later, "version", "version 1");
    }
    for text in [
        "",
        "[]",
        "null",
        "{\"format\": \"asperity-model\"",
        "ASPT\u{1}",
    ] {
        assert!(from_json(text.as_bytes()).is_err(), "{text:?}");
    }
    let deep = "[".repeat(100_000);
    assert!(from_json(deep.as_bytes()).is_err());
    let mut trailing = to_json(&builtin::texture());
    trailing.extend(b"{}");
    let fault = from_json(&trailing).unwrap_err();
    assert!(fault.what.contains("trailing"), "{fault}");
}

#[test]
fn keys_and_types_are_named_by_their_path() {
    let mut unknown = document();
    unknown["grid"]["vertices"][3]["colour"] = json!("red");
    refused(
        &unknown,
        "grid.vertices[3].colour",
        "unknown field `colour`",
    );
    let mut unit = document();
    let gains = unit["gains"].as_object_mut().unwrap();
    let mass = gains.remove("effective_mass_kg").unwrap();
    gains.insert("effective_mass_g".into(), mass);
    refused(&unit, "gains.effective_mass_g", "unknown field");
    let mut missing = document();
    missing["grid"]["vertices"][2]
        .as_object_mut()
        .unwrap()
        .remove("sigma_m_s2");
    refused(&missing, "grid.vertices[2]", "missing field `sigma_m_s2`");
    let mut text = document();
    text["grid"]["vertices"][1]["lsf_rad"][2] = json!("0.3");
    refused(&text, "grid.vertices[1].lsf_rad[2]", "expected f64");
    let mut null = document();
    null["grid"]["vertices"][1]["sigma_m_s2"] = Value::Null;
    refused(&null, "grid.vertices[1].sigma_m_s2", "expected f64");
    let mut negative = document();
    negative["grid"]["triangles"][0][0] = json!(-1);
    refused(&negative, "grid.triangles[0][0]", "expected usize");
    let mut kind = document();
    kind["grid"]["vertices"][0]["kind"] = json!("corner");
    refused(&kind, "grid.vertices[0].kind", "unknown variant `corner`");
}

#[test]
fn numbers_that_are_none_are_refused() {
    let text = String::from_utf8(to_json(&builtin::texture())).unwrap();
    for number in ["1e999", "NaN", "Infinity", "-Infinity", "0x10", "01"] {
        let hostile = text.replacen("\"mu\": 0.72", &format!("\"mu\": {number}"), 1);
        assert_ne!(hostile, text);
        assert!(from_json(hostile.as_bytes()).is_err(), "{number}");
    }
}

#[test]
fn values_lists_and_orders_are_checked() {
    type Change = fn(&mut Value);
    let cases: [(Change, &str, &str); 24] = [
        (|d| d["name"] = json!(""), "name", "1 to 64 bytes"),
        (|d| d["name"] = json!("a\u{7}"), "name", "control"),
        (
            |d| d["grid"]["sample_rate_hz"] = json!(1),
            "grid.sample_rate_hz",
            "from 100 to 200000",
        ),
        (
            |d| d["grid"]["vertices"] = json!([]),
            "grid.vertices",
            "3 to 64",
        ),
        (
            |d| d["grid"]["vertices"][0]["lsf_rad"] = json!([]),
            "grid.vertices[0].lsf_rad",
            "1 to 24",
        ),
        (
            |d| d["grid"]["vertices"][4]["lsf_rad"] = json!([1.0]),
            "grid.vertices[4].lsf_rad",
            "20 as at vertex 0",
        ),
        (
            |d| d["grid"]["vertices"][4]["lsf_rad"][19] = json!(200.0),
            "grid.vertices[4].lsf_rad[19]",
            "below π",
        ),
        (
            |d| d["grid"]["vertices"][4]["lsf_rad"][0] = json!(0.0),
            "grid.vertices[4].lsf_rad[0]",
            "above 0",
        ),
        (
            |d| d["grid"]["vertices"][4]["lsf_rad"][3] = json!(0.0001),
            "grid.vertices[4].lsf_rad[3]",
            "not above",
        ),
        (
            |d| d["grid"]["vertices"][4]["speed_mm_s"] = json!(-1),
            "grid.vertices[4].speed_mm_s",
            "from 0 to 10000",
        ),
        (
            |d| d["grid"]["vertices"][4]["force_n"] = json!(1e300),
            "grid.vertices[4].force_n",
            "from 0 to 1000",
        ),
        (
            |d| d["grid"]["vertices"][4]["sigma_m_s2"] = json!(1e5),
            "grid.vertices[4].sigma_m_s2",
            "from 0 to 10000",
        ),
        (
            |d| d["grid"]["vertices"][4]["gain"] = json!(2),
            "grid.vertices[4].gain",
            "not \"lsf\"",
        ),
        (
            |d| d["grid"]["vertices"][4]["ma_lsf_rad"] = json!([1.0]),
            "grid.vertices[4].ma_lsf_rad",
            "not \"lsf\"",
        ),
        (
            |d| d["grid"]["numerator"] = json!("lsf"),
            "grid.vertices[0].ma_lsf_rad",
            "1 to 24",
        ),
        (
            |d| d["grid"]["triangles"][0][0] = json!(1000),
            "grid.triangles",
            "vertex 1000",
        ),
        (
            |d| d["grid"]["triangles"] = json!([[0, 1, 2]]),
            "grid.triangles",
            "edge",
        ),
        (
            |d| d["taps"]["traces"][1]["speed_m_s"] = json!(0.001),
            "taps.traces[1].speed_m_s",
            "not above",
        ),
        (
            |d| d["taps"]["traces"][0]["speed_m_s"] = json!(0),
            "taps.traces[0].speed_m_s",
            "above 0",
        ),
        (
            |d| d["taps"]["traces"][1]["accel_m_s2"] = json!([1.0]),
            "taps.traces[1].accel_m_s2",
            "100 as in trace 0",
        ),
        (
            |d| d["taps"]["traces"][1]["accel_m_s2"][7] = json!(1e9),
            "taps.traces[1].accel_m_s2[7]",
            "from -1000000",
        ),
        (
            |d| d["friction"]["anchors"][0]["weight"] = json!(1.5),
            "friction.anchors[0].weight",
            "from 0 to 1",
        ),
        (
            |d| d["wall"]["stiffness_n_m"] = json!(0),
            "wall.stiffness_n_m",
            "above 0",
        ),
        (
            |d| d["gains"]["f_max_n"] = json!(-3.3),
            "gains.f_max_n",
            "above 0",
        ),
    ];
    for (change, field, says) in cases {
        let mut changed = document();
        change(&mut changed);
        refused(&changed, field, says);
    }
    let mut long = document();
    long["provenance"]["notes"] = json!("x".repeat(1_000_000));
    refused(&long, "provenance.notes", "1000000 bytes");
    let mut line = document();
    let grid = line["grid"].as_object_mut().unwrap();
    grid.remove("triangles").unwrap();
    for vertex in grid["vertices"].as_array_mut().unwrap() {
        vertex["force_n"] = json!(0);
    }
    refused(&line, "grid.vertices", "one line");
    // Without its corners a grid cannot be triangulated to a rectangle.
    let mut cornerless = document();
    let grid = cornerless["grid"].as_object_mut().unwrap();
    grid.remove("triangles").unwrap();
    grid["vertices"].as_array_mut().unwrap().truncate(18);
    let fault = from(&cornerless).unwrap_err();
    assert_eq!(fault.field, "grid.vertices", "{fault}");
}

#[test]
fn two_vertices_at_one_place_are_refused_by_name() {
    let mut twins = document();
    let vertices = twins["grid"]["vertices"].as_array_mut().unwrap();
    let mut twin = vertices[2].clone();
    twin["sigma_m_s2"] = json!(0.5);
    vertices.push(twin);
    let field = format!("grid.vertices[{}]", vertices.len() - 1);
    refused(&twins, &field, "as grid.vertices[2] does");
    // Also where the file leaves the triangles to the program.
    twins["grid"].as_object_mut().unwrap().remove("triangles");
    refused(&twins, &field, "as grid.vertices[2] does");
}

#[test]
fn a_file_too_large_for_any_model_is_not_read_to_its_end() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("giant.json");
    // No bytes on the disk.
    std::fs::File::create(&file)
        .unwrap()
        .set_len(1 << 40)
        .unwrap();
    let fault = read(&file).unwrap_err();
    assert!(fault.what.contains("the limit for a model"), "{fault}");
}

#[test]
fn a_byte_order_mark_is_no_fault_and_deep_nesting_is_one() {
    let marked = [b"\xef\xbb\xbf", &to_json(&builtin::texture())[..]].concat();
    assert_eq!(kept(from_json(&marked).unwrap()), kept(builtin::texture()));
    let deep = format!("{{\"format\": {}", "[".repeat(1_000_000));
    let fault = from_json(deep.as_bytes()).unwrap_err();
    assert!(fault.what.contains("recursion limit"), "{fault}");
}

/// Texts of the length that a file may have, and the notes on defaults, fit an asset.
#[test]
fn the_longest_provenance_fits_an_asset() {
    let mut long = document();
    let top = long.as_object_mut().unwrap();
    top.remove("wall").unwrap();
    top.remove("gains").unwrap();
    for key in ["generator", "source", "prompt", "notes"] {
        top["provenance"][key] = json!("ä".repeat(1536));
    }
    let texture = from(&long).unwrap();
    let source = SourceOutput::new(texture);
    let compiled = driver::compile(&source, &Request::default(), &Tools::default());
    assert!(compiled.is_ok(), "{compiled:?}");
}

/// The largest model that an asset can hold fits a file with room to spare.
#[test]
fn the_largest_model_fits_a_file() {
    use asperity_formats::limits::{MAX_ORDER, MAX_TAP_SAMPLES, MAX_TAPS, MAX_VERTICES};
    let number = 25;
    let bytes = MAX_VERTICES * (2 * MAX_ORDER + 8) * number + MAX_TAPS * MAX_TAP_SAMPLES * number;
    assert!(10 * bytes as u64 <= InputKind::Model.max_bytes(), "{bytes}");
}

/// Claim: speeds in m/s, forces in mN or kN and levels far below what is felt are noted; those of a hand are not.
#[test]
fn numbers_that_no_hand_has_are_noted() {
    let doubts = |speed: f64, force: f64, sigma: f64| -> Vec<String> {
        let mut texture = builtin::texture();
        for vertex in &mut texture.grid.vertices {
            vertex.speed_mm_s *= speed;
            vertex.force_n *= force;
            vertex.sigma_m_s2 *= sigma;
            vertex.gain *= sigma;
        }
        super::scale::doubts(&texture)
    };
    for (speed, force, sigma) in [(1.0, 1.0, 1.0), (0.1, 0.1, 1.0), (5.0, 10.0, 10.0)] {
        assert_eq!(doubts(speed, force, sigma), [""; 0]);
    }
    for (speed, force, sigma, named) in [
        (1e-3, 1.0, 1.0, "speed_mm_s"),
        (100.0, 1.0, 1.0, "speed_mm_s"),
        (1.0, 1e-3, 1.0, "force_n"),
        (1.0, 1e3, 1.0, "force_n"),
        (1.0, 1.0, 1e-4, "sigma_m_s2"),
    ] {
        let told = doubts(speed, force, sigma);
        assert!(told.len() == 1 && told[0].contains(named), "{told:?}");
    }
}
