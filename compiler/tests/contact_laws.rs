//! Contact laws of prompts: which materials give way, and how that feels as the runtime renders it.

mod hand;

use crate::prompts::{PROMPTS, compiled};
use asperity::{
    driver,
    edit_memory::{Latents, Sliders},
    emit::{lower::lower, raise::raise},
    learned::{contact, friction},
    library::Change,
    model::{ContactLaw, TextureModel},
    sources::{
        Tools,
        latents::{Edit, LatentEditor, MixOptions, MixPreview},
        prompt::Options,
    },
    views::inspect::Document,
};
use asperity_formats::Asset;
use hand::{drag_of_speed, fast_drag, load, lost, measure, print, pull};
use rayon::prelude::*;
use std::collections::HashMap;

fn texture(prompt: &str) -> TextureModel {
    TextureModel {
        name: prompt.to_owned(),
        ..PROMPTS.texture(prompt).unwrap()
    }
}

fn law(prompt: &str) -> ContactLaw {
    let law = texture(prompt).contact;
    law.unwrap_or_else(|| panic!("{prompt} does not give way"))
}

/// Claim: the table has 65 materials by the model's names and six by their own, each with a law that an asset can hold as it is and a
/// source for each part; a material by its own name has its own law, and one that is not in the table has none.
#[test]
fn the_table_obeys_the_rules_and_a_name_has_its_own_law() {
    let description = PROMPTS.model().description();
    let table: HashMap<&str, &contact::Material> = contact::materials()
        .map(|material| (material.name.as_str(), material))
        .collect();
    assert_eq!(table.len(), 71);
    let found = (description.anchors.par_iter()).filter(|anchor| {
        let own = table
            .get(anchor.name.as_str())
            .map(|material| &material.law);
        let at = contact::at(&anchor.z, description);
        assert_eq!(at.as_ref(), own, "{}", anchor.name);
        let named = texture(&anchor.name).contact;
        assert_eq!(named.as_ref(), own, "{}", anchor.name);
        own.is_some()
    });
    let found = found.count();
    // The others are known by name alone.
    assert_eq!(found, 65);
    for name in [
        "oil",
        "water",
        "whipped cream",
        "toothpaste",
        "set honey",
        "glue",
    ] {
        assert_eq!(law(name), table[name].law, "{name}");
    }
    let mut built = asperity::sources::builtin::texture();
    for (name, material) in table {
        let law = &material.law;
        assert!((1..=6).contains(&law.spring.len()), "{name}");
        assert!(
            law.spring.iter().all(|point| point.depth_mm <= 60.0),
            "{name}"
        );
        let relaxing = law.relaxation.map_or(0.0, |part| part.stiffness_n_m);
        let sticking = law.adhesion.map_or(0.0, |part| part.stiffness_n_m);
        let together = law.steepest_n_m().unwrap() + relaxing + sticking;
        assert!(together <= 900.0 + 1e-6, "{name}: {together}");
        assert!(
            material.mu.is_none_or(|mu| (0.0..0.3).contains(&mu)),
            "{name}"
        );
        let parts = serde_json::to_value(law).unwrap();
        let parts: Vec<&String> = parts.as_object().unwrap().keys().collect();
        let stated = material.from.keys().filter(|part| *part != "mu").count();
        assert_eq!(stated, parts.len(), "{name}");
        assert!(
            parts.iter().all(|part| !material.from[*part].is_empty()),
            "{name}"
        );
        assert_eq!(material.mu.is_some(), material.from.contains_key("mu"));
        contact::set(&mut built, Some(law.clone()));
        let bytes = lower(&built, None).unwrap().bytes;
        let raised = raise(&Asset::parse(&bytes).unwrap());
        assert!(raised.contact.is_some(), "{name}");
    }
}

/// Claim: what does not give way has no law, nor another wall than its neighbours'.
#[test]
fn what_does_not_give_way_stays_as_it_was() {
    let description = PROMPTS.model().description();
    for prompt in [
        "steel plate",
        "sandpaper",
        "oak",
        "very rough sandpaper",
        "sticky steel plate",
    ] {
        let texture = texture(prompt);
        assert_eq!(texture.contact, None, "{prompt}");
        let bytes = lower(&texture, None).unwrap().bytes;
        let asset = Asset::parse(&bytes).unwrap();
        assert_eq!(asset.contact(), None, "{prompt}");
        let json = serde_json::to_value(Document::of(&asset)).unwrap();
        assert_eq!(json.get("contact"), None);
        let z = PROMPTS
            .meaning(&PROMPTS.project(prompt).unwrap())
            .unwrap()
            .z;
        let near = friction::neighbours(&z, &description.anchors, description.friction);
        let stiffness_n_m = friction::stiffness_n_m(&near, &description.anchors);
        assert_eq!(texture.wall.stiffness_n_m, stiffness_n_m, "{prompt}");
    }
    for prompt in ["honey", "dry sand", "memory foam", "fruit jelly", "snow"] {
        let (law, texture) = (law(prompt), texture(prompt));
        assert_eq!(
            Some(texture.wall.stiffness_n_m),
            law.stiffness_n_m(),
            "{prompt}"
        );
        let damped = law.damping_s_m > 0.0 && texture.wall.damping_n_s_m > 0.0;
        assert!(!damped, "{prompt}");
    }
}

/// Claim: prompts differ in the orders of `orders.tsv` (a measure, a prompt with more of it, one with less) by a fifth at
/// least, from the bytes of their assets through the runtime.
#[test]
fn materials_give_way_as_they_do() {
    let orders: Vec<Vec<&str>> = include_str!("contact_laws/orders.tsv")
        .lines()
        .map(|line| line.split('\t').collect())
        .collect();
    let wrong: Vec<String> = orders
        .par_iter()
        .filter_map(|order| {
            let &[name, more, less] = &order[..] else {
                panic!("{order:?}")
            };
            let measure = measure(name).unwrap_or_else(|| panic!("no measure {name}"));
            let (more_of, less_of) = (measure(more), measure(less));
            let holds = more_of > 1.2 * less_of.max(0.0) + 1e-6;
            (!holds).then(|| format!("{name}: {more} {more_of:.3}, {less} {less_of:.3}"))
        })
        .collect();
    assert!(
        wrong.is_empty(),
        "{} of {}: {wrong:#?}",
        wrong.len(),
        orders.len()
    );
    let steel = "steel plate";
    assert!(pull(steel) == 0.0 && print(steel).abs() < 0.03 && lost(steel).abs() < 0.05);
    // As hard to drag at any speed.
    for prompt in ["dry sand", steel] {
        assert!((drag_of_speed(prompt) - 1.0).abs() < 0.1, "{prompt}");
    }
    // It comes back: not at once, and slower than other foam.
    assert!(print("memory foam") > 3.0 * print("upholstery foam").max(0.1));
}

/// Claim: forces lie within those that were published, or within 1.5 times where there is one value. Stresses are taken
/// on the disc of 15 mm: 1 kPa is 0.177 N, and an elastic half space 20 N/m a kPa.
#[test]
fn forces_are_as_published() {
    let sand = "Agarwal, Goldman and Kamrin 2023 (3D-RFT); Brzinski et al. 2013; bearing capacity";
    let loads = [
        // Depth, mm; range, N.
        (
            "fruit jelly",
            4.0,
            1.02,
            1.02,
            "E 12.8 kPa at 11:1, arXiv 2512.20502",
        ),
        (
            "fruit jelly",
            2.0,
            0.24,
            1.23,
            "G 2.0-10.2 kPa, gelatin of 3-7 %, Nguyen et al. 2014",
        ),
        (
            "marshmallow",
            3.0,
            0.53,
            1.8,
            "E 30 kPa, a column to a half space, Pestka 2008",
        ),
        ("dry sand", 10.0, 0.6, 3.9, sand),
        ("glass beads", 10.0, 0.37, 1.13, sand),
        ("rice", 10.0, 0.32, 1.5, sand),
        ("granulated sugar", 10.0, 0.83, 2.1, sand),
        (
            "snow",
            5.0,
            0.17,
            0.44,
            "hand hardness of fist to four fingers, 1-2.5 kPa",
        ),
        (
            "upholstery foam",
            20.0,
            0.44,
            2.6,
            "CLD 2.5-5 kPa at 40 %, edge of a small disc 1 to 3",
        ),
        (
            "memory foam",
            9.35,
            0.24,
            1.2,
            "IFD 10-16 lb at 25 %, edge of a small disc 1 to 3",
        ),
    ];
    let ratios = [
        // Two depths, mm; range of the ratio of their loads.
        (
            "dry sand",
            10.0,
            5.0,
            2.0,
            2.0,
            "proportional to depth, Li, Zhang and Goldman 2013",
        ),
        (
            "rice",
            12.0,
            4.0,
            3.0,
            3.0,
            "proportional to depth, Li, Zhang and Goldman 2013",
        ),
        (
            "upholstery foam",
            32.5,
            12.5,
            1.5,
            2.6,
            "65 % over 25 %, DIN 53577",
        ),
        (
            "faux fur",
            22.0,
            18.0,
            12.7,
            12.7,
            "pressure of fibres as 1/V^3, van Wyk 1946",
        ),
    ];
    let within = |found: f64, low: f64, high: f64, of: &str| {
        let factor = if low == high { 1.5 } else { 1.0 };
        assert!(
            (low / factor..=high * factor).contains(&found),
            "{of}: {found:.3}"
        );
    };
    for (prompt, depth_mm, low, high, source) in loads {
        within(
            load(prompt, depth_mm),
            low,
            high,
            &format!("{prompt}, {source}"),
        );
    }
    for (prompt, deep_mm, mm, low, high, source) in ratios {
        let ratio = load(prompt, deep_mm) / load(prompt, mm);
        within(ratio, low, high, &format!("{prompt}, {source}"));
    }
    let viscosity = "2-20 Pa s at 20-25 C in 1 mm below the disc, Juszczak and Fortuna 2006";
    within(fast_drag("honey"), 0.07, 0.7, viscosity);
}

/// Claim: words move the law of what is named, as far as they are stressed; denied ones and those of a name do not.
#[test]
fn words_move_a_law() {
    // What carries the load is slippery, and its words say how much so.
    let mu = |prompt: &str| texture(prompt).friction.mu;
    assert!(mu("syrup") < 0.1 && mu("sticky syrup") > 1.1 * mu("syrup"));
    let adhesion = |prompt: &str| law(prompt).adhesion;
    assert_eq!(adhesion("honey, not sticky"), adhesion("honey"));
    assert!(adhesion("less sticky honey").unwrap().pull_n < adhesion("honey").unwrap().pull_n);
    assert!(adhesion("sticky memory foam").is_some() && adhesion("memory foam").is_none());
    for (name, same) in [
        ("wet sand", "wet sand"),
        ("packed snow", "trodden snow"),
        ("sand", "dry sand"),
    ] {
        assert_eq!(law(name), law(same), "{name}");
    }
}

/// Claim: words of an edit move a law, an edit taken back brings it back, and a comparison says so.
#[test]
fn words_of_an_edit_move_a_law() {
    let editor = LatentEditor::new(&PROMPTS);
    let options = MixOptions {
        preview: MixPreview::None,
        ..MixOptions::default()
    };
    let changed = |bytes: &[u8], edit: Option<Edit>| {
        let asset = Asset::parse(bytes).unwrap();
        let mix = editor.change(&asset, edit.as_ref(), &options).unwrap();
        let tools = Tools::of(&PROMPTS);
        driver::compile(&mix.source, &mix.request, &tools)
            .unwrap()
            .lowered
            .bytes
    };
    let law = |bytes: &[u8]| raise(&Asset::parse(bytes).unwrap()).contact.unwrap();
    let words = |text: &str| Some(Edit::Words(text.to_owned()));
    let honey = compiled("honey");
    // Words of the contact alone, beside others, and in a row.
    let runnier = changed(&honey, words("runnier"));
    let viscous = |bytes: &[u8]| law(bytes).drag.unwrap().viscous_n_s_m2;
    assert!(viscous(&runnier) < 0.3 * viscous(&honey));
    let stickier = changed(&runnier, words("rougher and much stickier"));
    let pull_n = |bytes: &[u8]| law(bytes).adhesion.unwrap().pull_n;
    assert!(pull_n(&stickier) > 2.0 * pull_n(&runnier));
    assert!((viscous(&stickier) / viscous(&runnier) - 1.0).abs() < 0.01);
    let back = changed(&changed(&stickier, None), None);
    assert!((viscous(&back) / viscous(&honey) - 1.0).abs() < 0.01);
    let apart = |old: &[u8], new: &[u8]| {
        Change::between(&Asset::parse(old).unwrap(), &Asset::parse(new).unwrap()).unwrap()
    };
    let change = apart(&honey, &stickier);
    // More pull needs a deeper film.
    assert_eq!(change.contact, ["adhesion", "drag", "relaxation", "spring"]);
    let (soft, firm) = (compiled("soft foam"), compiled("firm foam"));
    let change = apart(&soft, &firm);
    assert!(
        change.felt.contains(&"soft") && change.depth_mm.is_some(),
        "{change:?}"
    );
    assert!(change.to_string().contains("depth under 1 N"), "{change}");
    assert_eq!(
        apart(&compiled("oak"), &compiled("steel plate")).depth_mm,
        None
    );
}

/// Claim: a law stays with the taps and the wall that it belongs to, through rates, edits, blends and compositions.
#[test]
fn mixtures_and_edits_keep_the_law() {
    let (honey, oak) = (compiled("sticky honey"), compiled("oak"));
    let (honey, oak) = (Asset::parse(&honey).unwrap(), Asset::parse(&oak).unwrap());
    let own = raise(&honey).contact.unwrap();
    assert!((own.adhesion.unwrap().pull_n - 0.3).abs() < 1e-6);
    let document = Document::of(&honey);
    let json = serde_json::to_value(&document).unwrap();
    for path in [
        "/contact/spring/0/depth_mm",
        "/contact/drag/viscous_n_s_m2",
        "/contact/lowered/stiffness_n_m",
        "/contact/lowered/relaxation_n_m",
    ] {
        assert!(json.pointer(path).is_some(), "{path}");
    }
    assert_eq!(document.wall.stiffness_n_m, own.stiffness_n_m().unwrap());
    let editor = LatentEditor::new(&PROMPTS);
    let options = MixOptions {
        preview: MixPreview::None,
        ..MixOptions::default()
    };
    let made = |mix: asperity::sources::latents::Mix| {
        let tools = Tools::of(&PROMPTS);
        driver::compile(&mix.source, &mix.request, &tools)
            .unwrap()
            .texture
    };
    let near = |found: Option<ContactLaw>, what: &str| {
        let (found, own) = (found.expect(what), own.clone());
        let apart = (found.depth_mm(1.0, 0.0) - own.depth_mm(1.0, 0.0)).abs();
        assert!(
            apart < 0.01 && found.adhesion == own.adhesion,
            "{what}: {found:?}"
        );
    };
    let rougher = Edit::Steps(Sliders {
        rougher: 10.0,
        ..Sliders::default()
    });
    near(
        made(editor.change(&honey, Some(&rougher), &options).unwrap()).contact,
        "rougher",
    );
    near(
        made(editor.blend(&honey, &oak, 0.2, &options).unwrap()).contact,
        "blend",
    );
    assert_eq!(
        made(editor.blend(&honey, &oak, 0.8, &options).unwrap()).contact,
        None
    );
    near(
        made(editor.compose(&honey, &oak, None, &options).unwrap()).contact,
        "tap",
    );
    let slid = made(editor.compose(&oak, &honey, None, &options).unwrap());
    assert_eq!(slid.contact, None);
    // Coulomb's part of honey by itself, which no film replaces on oak.
    assert!(slid.friction.mu > 0.2, "{}", slid.friction.mu);
    let latents = Latents::whole(
        PROMPTS
            .meaning(&PROMPTS.project("honey").unwrap())
            .unwrap()
            .z,
    );
    assert_eq!(
        editor.texture(&latents).unwrap().contact,
        Some(law("honey"))
    );
    let seeded = Options {
        seed: 3,
        ..Options::default().without_preview()
    };
    let mud = PROMPTS.compile("mud", &seeded).unwrap().texture.contact;
    assert_eq!(mud, Some(law("mud")));
    assert_eq!(texture("boiled sweet").contact, None);
    let mut faster = Options::default().without_preview();
    faster.request.rate_hz = Some(1500.0);
    let faster = PROMPTS.compile("honey", &faster).unwrap().lowered.bytes;
    assert!(raise(&Asset::parse(&faster).unwrap()).contact.is_some());
}
