//! Contact laws of prompts: which materials give way, and how that feels as the runtime renders it.

mod hand;

use crate::prompts::PROMPTS;
use asperity::{
    driver,
    edit_memory::{Latents, Sliders},
    emit::{lower::lower, raise::raise},
    learned::{contact, friction},
    model::{ContactLaw, TextureModel},
    sources::{
        Tools,
        latents::{Edit, LatentEditor, MixOptions, MixPreview},
        prompt::Options,
    },
    views::inspect::Document,
};
use asperity_formats::Asset;
use hand::{
    depth, drag_of_speed, fast_depth, fast_drag, held, late_print, lost, print, pull, slow_drag,
};
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

/// Claim: the table has the 65 materials by the model's names, each with a law that an asset can hold as it is and a
/// source for each part; a material by its own name has its own law, and one that is not in the table has none.
#[test]
fn the_table_obeys_the_rules_and_a_name_has_its_own_law() {
    let description = PROMPTS.model().description();
    let table: HashMap<&str, &contact::Material> = contact::materials()
        .map(|material| (material.name.as_str(), material))
        .collect();
    assert_eq!(table.len(), 65);
    let mut found = 0;
    for anchor in &description.anchors {
        let own = table.get(anchor.name.as_str());
        assert_eq!(
            contact::at(&anchor.z, description).as_ref(),
            own.map(|material| &material.law),
            "{}",
            anchor.name
        );
        found += usize::from(own.is_some());
    }
    assert_eq!(found, table.len(), "every name is a material of the model");
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

/// Claim: what does not give way has neither a law nor the version of one, nor another wall than its neighbours'.
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
        assert!(asset.version() < 3, "{prompt}");
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

/// Claim: prompts differ in these orders by a fifth at least, from the bytes of their assets through the runtime.
#[test]
fn materials_give_way_as_they_do() {
    type Measure = fn(&str) -> f64;
    let orders: [(&str, Measure, &[&str]); 13] = [
        (
            "depth",
            depth,
            &[
                "feather pillow",
                "memory foam",
                "upholstery foam",
                "steel plate",
            ],
        ),
        ("depth", depth, &["fruit jelly", "steel plate"]),
        ("depth", depth, &["snow", "dry sand", "wet sand"]),
        (
            "depth",
            depth,
            &["shag rug", "cut-pile carpet", "ribbed rubber mat"],
        ),
        ("fast depth", fast_depth, &["memory foam", "yoga mat"]),
        (
            "lost",
            lost,
            &["dry sand", "memory foam", "fruit jelly", "steel plate"],
        ),
        (
            "pull",
            pull,
            &["sticky tape", "honey", "fruit jelly", "dry sand"],
        ),
        ("slow drag", slow_drag, &["wet sand", "slime"]),
        ("fast drag", fast_drag, &["honey", "slime", "wet soap"]),
        ("drag of speed", drag_of_speed, &["honey", "dry sand"]),
        ("print", print, &["snow", "dry sand", "wet sand"]),
        ("late print", late_print, &["dry sand", "memory foam"]),
        ("held", held, &["steel plate", "bread dough"]),
    ];
    let mut pairs = 0;
    for (what, measure, prompts) in orders {
        let found: Vec<f64> = prompts.iter().map(|prompt| measure(prompt)).collect();
        for n in 1..found.len() {
            let more = found[n - 1] > 1.2 * found[n].max(0.0) + 1e-6;
            assert!(more, "{what}: {prompts:?} {found:.3?}");
            pairs += 1;
        }
    }
    assert!(pairs >= 20, "{pairs}");
    let steel = "steel plate";
    assert!(pull(steel) == 0.0 && print(steel).abs() < 0.03 && lost(steel).abs() < 0.05);
    // As hard to drag at any speed.
    for prompt in ["dry sand", steel] {
        assert!((drag_of_speed(prompt) - 1.0).abs() < 0.1, "{prompt}");
    }
    // It comes back: not at once, and slower than other foam.
    assert!(print("memory foam") > 3.0 * print("upholstery foam").max(0.1));
}

/// Claim: words move the law of what is named, as far as they are stressed; denied ones and those of a name do not.
#[test]
fn words_move_a_law() {
    let more = |measure: fn(&str) -> f64, a: &str, b: &str| {
        let found = (measure(a), measure(b));
        assert!(found.0 > 1.2 * found.1, "{a} and {b}: {found:?}");
    };
    more(pull, "sticky honey", "honey");
    more(pull, "very sticky honey", "sticky honey");
    more(pull, "gooey mud", "mud");
    more(fast_drag, "honey", "runny honey");
    more(depth, "snow", "packed snow");
    more(depth, "powdery snow", "snow");
    more(depth, "snow", "crusty snow");
    more(depth, "upholstery foam", "stiff upholstery foam");
    more(depth, "squishy foam", "foam");
    more(depth, "very soft foam", "soft foam");
    more(lost, "memory foam", "springy memory foam");
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

/// Claim: a law stays with the taps and the wall that it belongs to, through rates, edits, blends and compositions.
#[test]
fn mixtures_and_edits_keep_the_law() {
    let compiled = |prompt: &str| {
        let options = Options::default().without_preview();
        PROMPTS.compile(prompt, &options).unwrap().lowered.bytes
    };
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
