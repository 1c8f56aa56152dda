//! The importer against generated files: what it keeps, and what it refuses. Nothing
//! here comes from HaTT.

use super::*;
use crate::{
    driver::{self, Compiled, Failure},
    emit::raise::raise,
    pipeline::Request,
    sources::Tools,
};
use asperity_formats::Asset;
use asperity_texture::{
    model::{Numerator, VertexKind},
    signal::lsf,
};
use std::{fmt::Write as _, fs, path::Path};

/// A material of four corners and a centre, orders as asked for.
fn xml(ar_order: usize, ma_order: usize) -> String {
    let positions = [
        (0.0, 0.0),
        (200.0, 0.0),
        (200.0, 4.0),
        (0.0, 4.0),
        (80.0, 1.5),
    ];
    let triangles = [[1, 2, 5], [2, 3, 5], [3, 4, 5], [4, 1, 5]];
    let mut text = String::from(
        "<?xml version=\"1.0\" encoding=\"utf-8\"?>\n<modelSet texture=\"0\">\n\
         <material>Test Board</material>\n<AccelUnits>m/s^2</AccelUnits>\n\
         <SpeedUnits>mm/s</SpeedUnits>\n<ForceUnits>N</ForceUnits>\n\
         <SampleRate>1000</SampleRate>\n<mu>0.4</mu>\n<numMod>5</numMod>\n\
         <numTri>4</numTri>\n<maxSpeed>200</maxSpeed>\n<maxForce>4</maxForce>\n",
    );
    let list = |name: &str, values: &[f64], digits: usize| {
        let mut text = format!("<{name}>\n");
        for value in values {
            let _ = writeln!(text, "<value>{value:.digits$}</value>");
        }
        text + &format!("</{name}>\n")
    };
    text += &list("speedList", &positions.map(|p| p.0), 6);
    text += &list("forceList", &positions.map(|p| p.1), 6);
    for triangle in triangles {
        text += &list("tri", &triangle.map(f64::from), 0);
    }
    let _ = write!(
        text,
        "<numARCoeff>{ar_order}</numARCoeff>\n<numMACoeff>{ma_order}</numMACoeff>\n"
    );
    let frequencies = |order: usize, bend: f64| -> Vec<f64> {
        (1..=order)
            .map(|k| {
                let place = k as f64 / (order + 1) as f64;
                (place + bend * place * (1.0 - place)) * std::f64::consts::PI
            })
            .collect()
    };
    for (index, (speed, force)) in positions.iter().enumerate() {
        let bend = 0.1 * index as f64;
        let (ar, ma) = (frequencies(ar_order, bend), frequencies(ma_order, -bend));
        let _ = writeln!(text, "<model>\n<modNum>{}</modNum>", index + 1);
        text += &list("ARcoeff", &lsf::to_polynomial(&ar), 17);
        text += &list("ARlsf", &ar, 6);
        text += &list("MAcoeff", &lsf::to_polynomial(&ma), 17);
        text += &list("MAlsf", &ma, 6);
        let variance = if *speed == 0.0 || *force == 0.0 {
            0.0
        } else {
            0.01
        };
        let _ = writeln!(
            text,
            "<var>{variance}</var>\n<gain>3.5</gain>\n<speedMod>{speed}</speedMod>\n\
             <forceMod>{force}</forceMod>\n</model>"
        );
    }
    text + "</modelSet>\n"
}

fn import(file: &Path) -> Result<Compiled, Failure> {
    driver::compile(&Hatt::new(file), &Request::default(), &Tools::default())
}

fn import_text(text: &str) -> Result<Compiled, Failure> {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("Models_Test Board.xml");
    fs::write(&file, text).unwrap();
    import(&file)
}

fn refusal(text: &str) -> String {
    let error = match import_text(text) {
        Err(error) => error,
        Ok(_) => panic!("accepted: {text}"),
    };
    assert!(!error.remedy().is_empty());
    error.to_string()
}

#[test]
fn any_orders_import_within_a_hundredth_of_a_decibel() {
    for (ar, ma) in [
        (1, 0),
        (2, 1),
        (14, 12),
        (19, 17),
        (20, 18),
        (23, 24),
        (24, 0),
        (24, 24),
    ] {
        let imported = import_text(&xml(ar, ma)).unwrap();
        let compared = imported.compared.unwrap();
        assert!(compared.error.max_db < 0.02, "{}", imported.text());
        assert_eq!(compared.count, 2);
        assert_eq!(imported.found::<Recomputed>().unwrap().0, 0, "{ar}, {ma}");
        let asset = Asset::parse(&imported.lowered.bytes).unwrap();
        let texture = raise(&asset);
        assert_eq!(texture.grid.order, ar);
        let expected = if ma > 0 {
            Numerator::Lsf
        } else {
            Numerator::None
        };
        assert_eq!(texture.grid.numerator, expected);
        assert_eq!(
            texture.grid.triangles,
            [[0, 1, 4], [1, 2, 4], [2, 3, 4], [3, 0, 4]]
        );
        let kinds: Vec<VertexKind> = texture.grid.vertices.iter().map(|v| v.kind).collect();
        let edge = VertexKind::Edge;
        assert_eq!(kinds, [edge, edge, edge, edge, VertexKind::Interior]);
        assert!(texture.provenance.taps_synthetic);
        assert_eq!(texture.friction.anchors[0].name, "Test Board");
    }
}

#[test]
fn the_same_file_gives_the_same_bytes_on_any_number_of_threads() {
    let folder = tempfile::tempdir().unwrap();
    let materials: Vec<_> = (0..6)
        .map(|k| {
            let file = folder.path().join(format!("{k}.xml"));
            let text = xml(10 + k, k).replace("Test Board", &format!("Board {k}"));
            fs::write(&file, text).unwrap();
            Hatt::new(file)
        })
        .collect();
    let on_threads = |count: usize| -> Vec<Vec<u8>> {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(count).build();
        let results = pool.unwrap().install(|| {
            driver::compile_all(&materials, &Request::default(), &Tools::default(), || ())
        });
        let bytes = results.into_iter().map(|r| r.unwrap().lowered.bytes);
        bytes.collect()
    };
    assert_eq!(on_threads(1), on_threads(4));
    let files = super::files(folder.path()).unwrap();
    assert!(files.iter().eq(materials.iter().map(|m| &m.file)));
}

#[test]
fn wrong_frequencies_are_computed_again_and_counted() {
    let good = xml(8, 6);
    let from = good.find("<ARlsf>").unwrap();
    let to = from + good[from..].find("</ARlsf>").unwrap();
    let shifted: String = good[from..to].replace("<value>0.", "<value>0.1");
    let imported = import_text(&[&good[..from], &shifted, &good[to..]].concat()).unwrap();
    assert_eq!(imported.found::<Recomputed>().unwrap().0, 1);
    assert!(imported.compared.unwrap().error.max_db < 0.02);
}

#[test]
fn every_malformed_field_is_refused_with_its_line() {
    let good = xml(4, 2);
    for (from, to, expected) in [
        ("<mu>0.4</mu>", "", "<mu> is missing"),
        (
            "<mu>0.4</mu>",
            "<mu>0.4</mu><mu>0.4</mu>",
            "<mu> appears twice",
        ),
        (
            "<mu>0.4</mu>",
            "<mu>slippery</mu>",
            "mu = \"slippery\" is not a number",
        ),
        ("<mu>0.4</mu>", "<mu>NaN</mu>", "mu = NaN, must be 0 to 10"),
        ("<mu>0.4</mu>", "<mu>-0.1</mu>", "mu = -0.1, must be"),
        ("<mu>0.4</mu>", "<mu>1e999</mu>", "mu = inf, must be"),
        ("<SampleRate>1000", "<SampleRate>0", "SampleRate = 0"),
        (
            "<material>Test Board",
            "<material>",
            "material = \"\": empty",
        ),
        ("m/s^2", "g", "AccelUnits = \"g\""),
        (
            "<numMod>5",
            "<numMod>6",
            "speedList: 5 found, 6 expected from numMod",
        ),
        (
            "<numMod>5",
            "<numMod>0",
            "numMod = 0, must be a whole number from 3",
        ),
        ("<numMod>5", "<numMod>5.5", "numMod = 5.5"),
        (
            "<numTri>4",
            "<numTri>3",
            "tri: 4 found, 3 expected from numTri",
        ),
        ("<maxForce>4", "<maxForce>0", "maxForce = 0"),
        (
            "<maxForce>4",
            "<maxForce>3",
            "forceList[2] = 4, must be 0 to 3",
        ),
        ("<numARCoeff>4", "<numARCoeff>25", "numARCoeff = 25"),
        (
            "<numARCoeff>4",
            "<numARCoeff>5",
            "model 1 ARcoeff: 5 found, 6 expected",
        ),
        (
            "<modNum>3",
            "<modNum>4",
            "model 3 modNum = 4, but its place",
        ),
        (
            "<speedMod>80",
            "<speedMod>81",
            "model 5 speedMod = 81, but speedList[4] = 80",
        ),
        ("<gain>3.5", "<gain>0", "model 1 gain = 0"),
        ("<var>0.01", "<var>-0.01", "model 3 var = -0.01"),
        ("<var>0.01", "<var>", "model 3 var = \"\" is not a number"),
        (
            "<value>1</value>\n<value>2</value>\n<value>5</value>",
            "<value>1</value>\n<value>9</value>\n<value>5</value>",
            "tri 1[1] = 9, must be a model number",
        ),
        (
            "<value>1</value>\n<value>2</value>\n<value>5</value>",
            "<value>1</value>\n<value>1</value>\n<value>5</value>",
            "tri 1[1] = 1, must be another",
        ),
        (
            "<value>1</value>\n<value>2</value>\n<value>5</value>",
            "<value>1</value>\n<value>2</value>\n<value>3</value>",
            "overlaps",
        ),
        (
            "<value>1.00000000000000000</value>",
            "<value>2.0</value>",
            "model 1 ARcoeff[0] = 2",
        ),
        ("</modelSet>", "", "not well-formed"),
        (
            "<modelSet texture=\"0\">",
            "<modelSet texture=\"0\"><!-- <model> -->",
            "",
        ),
    ] {
        assert!(good.contains(from), "{from}");
        let text = good.replacen(from, to, 1);
        if expected.is_empty() {
            assert!(import_text(&text).is_ok());
            continue;
        }
        let message = refusal(&text);
        assert!(message.contains(expected), "{to}: {message}");
        assert!(message.contains("Models_Test Board.xml"), "{message}");
    }
    let message = refusal(&good.replacen("<mu>0.4", "<mu>x", 1));
    assert!(message.contains("Test Board.xml:8:"), "{message}");
}

#[test]
fn files_of_another_kind_are_refused() {
    for (text, expected) in [
        ("", "the file is empty"),
        ("speed,force\n1,2\n", "not well-formed"),
        ("<svg></svg>", "root element is <svg>"),
        ("<modelSet></modelSet>", "<AccelUnits> is missing"),
        (
            "<!DOCTYPE x [<!ENTITY a \"aaaa\">]><modelSet>&a;</modelSet>",
            "declares a document type",
        ),
        ("<modelSet>&undefined;</modelSet>", "not well-formed"),
    ] {
        let message = refusal(text);
        assert!(message.contains(expected), "{text}: {message}");
    }
    let good = xml(4, 2);
    let without = &good[..good.find("<model>").unwrap()];
    let message = refusal(&format!("{without}</modelSet>"));
    assert!(message.contains("has no <model>"), "{message}");
    // Deeper than any recursion may follow.
    let deep = format!("{}{}", "<a>".repeat(200_000), "</a>".repeat(200_000));
    assert!(refusal(&deep).contains("nested deeper than 64"));
    let missing = import(Path::new("no such file.xml")).unwrap_err();
    assert!(missing.to_string().contains("cannot read it"));
}

#[test]
fn bytes_that_are_no_text_and_files_without_end_are_refused() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("a.xml");
    fs::write(&file, [0x3c, 0xff, 0xfe]).unwrap();
    assert!(
        import(&file)
            .unwrap_err()
            .to_string()
            .contains("byte 1 is not UTF-8")
    );
    assert!(files(&folder.path().join("none")).is_err());
    fs::remove_file(&file).unwrap();
    let empty = files(folder.path()).unwrap_err().to_string();
    assert!(empty.contains("has no .xml file"), "{empty}");
    #[cfg(target_os = "linux")]
    {
        let endless = import(Path::new("/dev/zero")).unwrap_err().to_string();
        assert!(endless.contains("a device or a socket"), "{endless}");
    }
}

/// The parser alone takes 20 s for the first and 2 GB for the second.
#[test]
fn what_takes_quadratic_time_or_memory_is_refused_with_its_line() {
    let good = xml(4, 2);
    let attributes: String = (0..80_000).map(|n| format!(" a{n}=''")).collect();
    let many = good.replacen("<numMod>", &format!("<numMod{attributes}>"), 1);
    let message = refusal(&many);
    assert!(message.contains("more than 64 attributes"), "{message}");
    let line = 1 + good[..good.find("<numMod>").unwrap()].matches('\n').count();
    assert!(message.contains(&format!(":{line}:")), "{message}");
    let spaces: String = (0..60_000)
        .map(|n| format!("<e xmlns:n{n}='{n}'>"))
        .collect();
    assert!(refusal(&spaces).contains("namespaces are declared"));
}

#[test]
fn two_files_of_one_material_are_refused() {
    let folder = tempfile::tempdir().unwrap();
    for name in ["a.xml", "b.xml"] {
        fs::write(folder.path().join(name), xml(4, 2)).unwrap();
    }
    let files = files(folder.path()).unwrap().into_iter();
    let materials: Vec<Hatt> = files.map(Hatt::new).collect();
    let tools = Tools::default();
    let mut results = driver::compile_all(&materials, &Request::default(), &tools, || ());
    refuse_namesakes(&materials, &mut results);
    assert!(results[0].is_ok());
    let message = results[1].as_ref().unwrap_err().to_string();
    assert!(message.contains("\"Test Board\" is also in"), "{message}");
}

#[test]
fn slivers_and_twin_vertices_are_accepted() {
    // The centre vertex once more, in no triangle, and a sliver along the lower border.
    let good = xml(4, 2);
    let twin = good
        .replacen("<numMod>5", "<numMod>6", 1)
        .replacen(
            "<value>80.000000</value>",
            "<value>80.000000</value><value>80.0</value>",
            1,
        )
        .replacen(
            "<value>1.500000</value>",
            "<value>1.500000</value><value>1.5</value>",
            1,
        );
    let at = good.rfind("<model>").unwrap();
    let model = good[at..good.len() - "</modelSet>\n".len()].replacen("<modNum>5", "<modNum>6", 1);
    let twin = twin.replacen("</modelSet>", &format!("{model}</modelSet>"), 1);
    assert_eq!(import_text(&twin).unwrap().texture.grid.vertices.len(), 6);

    let sliver = good
        .replace("<value>80.000000</value>", "<value>80.001000</value>")
        .replace("<speedMod>80", "<speedMod>80.001")
        .replace("<value>1.500000</value>", "<value>0.000002</value>")
        .replace("<forceMod>1.5", "<forceMod>0.000002");
    let texture = import_text(&sliver).unwrap().texture;
    assert_eq!(texture.grid.triangles.len(), 4);
}
