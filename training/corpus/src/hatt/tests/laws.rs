use super::made_up::{Folder, MADE_UP, options};
use crate::{BINS, Corpus, Instance, hatt::*};
use asperity::signal::{
    lsf,
    spectrum::{ArmaModel, log_spectral_distance_db},
};
use std::collections::BTreeSet;

fn load_made_up(change: impl FnOnce(&mut HattOptions)) -> Corpus {
    let folder = Folder::of(&MADE_UP);
    let mut own = options(&folder.0);
    change(&mut own);
    load(&own).unwrap()
}

fn refusal(folder: &Folder) -> String {
    load(&options(&folder.0)).unwrap_err().to_string()
}

/// Asserts that every bin is a stable filter of finite level.
fn assert_sound(instance: &Instance, whose: &str) {
    for (lsf_rad, level_db) in instance.lsf_rad.iter().zip(instance.level_db) {
        assert!(
            lsf::is_ordered(&lsf_rad.map(f64::from)),
            "{whose}: {lsf_rad:?}"
        );
        assert!(level_db.is_finite(), "{whose}: {level_db}");
    }
    assert!(
        instance.taps_m_s2.iter().flatten().all(|a| a.is_finite()),
        "{whose}"
    );
}

#[test]
fn every_instance_is_ordered_and_finite() {
    let corpus = load_made_up(|_| {});
    assert_eq!(corpus.materials.len(), MADE_UP.len());
    assert!(corpus.taps_synthetic);
    for material in &corpus.materials {
        assert_eq!(material.instances.len(), 20);
        assert!(material.rating.is_none() && !material.training.is_empty());
        for instance in material.instances.iter().chain([&material.prototype]) {
            assert_sound(instance, &material.name);
        }
    }
}

#[test]
fn a_power_law_of_level_holds_at_every_centroid_of_every_instance() {
    // Also where a bin lies far outside the material's own grid.
    let corpus = load_made_up(|_| {});
    for made_up in &MADE_UP {
        let material = corpus
            .materials
            .iter()
            .find(|m| m.name == made_up.name)
            .unwrap();
        for instance in material.instances.iter().chain([&material.prototype]) {
            for (bin, level_db) in corpus.grid.bins.iter().zip(instance.level_db) {
                let expected = made_up.level_db(bin.speed_mm_s, bin.force_n);
                assert!(
                    (f64::from(level_db) - expected).abs() < 1e-3,
                    "{}: {bin:?}",
                    made_up.name
                );
            }
        }
    }
}

#[test]
fn a_shape_within_reach_of_the_form_is_recovered() {
    // AR(6) under 1 + z⁻¹ is an AR(21) under 1 + z⁻¹; "Wood" has one for all places.
    let corpus = load_made_up(|_| {});
    let wood = corpus.materials.iter().find(|m| m.name == "Wood").unwrap();
    let all_pole = |a| ArmaModel {
        sample_rate_hz: 1000.0,
        a,
        b: vec![1.0],
        level_m_s2: 1.0,
    };
    let truth = all_pole(lsf::to_polynomial(&MADE_UP[0].lsf_rad(100.0)));
    for instance in wood.instances.iter().chain([&wood.prototype]) {
        for lsf_rad in &instance.lsf_rad {
            let found = all_pole(lsf::to_polynomial(&lsf_rad.map(f64::from)));
            let distance_db = log_spectral_distance_db(&truth, &found);
            assert!(distance_db < 0.02, "{distance_db}");
        }
    }
}

#[test]
fn bins_ascend_by_force_then_speed_inside_the_borders() {
    let grid = load_made_up(|_| {}).grid;
    assert_eq!(grid.bins.len(), BINS);
    let order: Vec<(f64, f64)> = grid
        .bins
        .iter()
        .map(|b| (b.force_n, b.speed_mm_s))
        .collect();
    assert!(order.windows(2).all(|pair| pair[0] < pair[1]), "{order:?}");
    for bin in &grid.bins {
        assert!(
            (0.0..grid.max_speed_mm_s).contains(&bin.speed_mm_s),
            "{bin:?}"
        );
        assert!((0.0..grid.max_force_n).contains(&bin.force_n), "{bin:?}");
    }
    // The largest measured place, not the border of a material, and little more.
    assert!((grid.max_speed_mm_s / (0.75 * 220.0) - 1.02).abs() < 1e-9);
}

#[test]
fn an_instance_depends_on_seed_and_number_alone() {
    let instances = |first, count, seed| -> Vec<Instance> {
        let corpus = load_made_up(|options| {
            (options.first_instance, options.instances, options.seed) = (first, count, seed);
        });
        corpus.materials[0].instances.clone()
    };
    let all = instances(0, 40, 1);
    assert_eq!(all[..20], instances(0, 20, 1));
    assert_eq!(all[20..], instances(20, 20, 1));
    assert_ne!(all[..20], instances(0, 20, 2));
    assert_ne!(all[..20], all[20..]);
}

#[test]
fn another_seed_leaves_grid_and_prototypes() {
    let (x, y) = (
        load_made_up(|_| {}),
        load_made_up(|options| options.seed = 9),
    );
    assert_eq!(x.grid, y.grid);
    assert_eq!(x.crc32, y.crc32);
    for (x, y) in x.materials.iter().zip(&y.materials) {
        assert_eq!(x.prototype, y.prototype);
    }
}

#[test]
fn the_thread_count_changes_nothing() {
    let on_threads = |count| {
        let pool = rayon::ThreadPoolBuilder::new()
            .num_threads(count)
            .build()
            .unwrap();
        let corpus = pool.install(|| load_made_up(|_| {}));
        let instances: Vec<_> = corpus.materials.into_iter().map(|m| m.instances).collect();
        (corpus.crc32, corpus.grid, instances)
    };
    assert_eq!(on_threads(1), on_threads(4));
}

#[test]
fn taps_are_mixed_by_the_share_and_harder_ones_peak_higher() {
    let mixed = load_made_up(|_| {});
    for (index, material) in mixed.materials.iter().enumerate() {
        let others: Vec<&Instance> = (0..3)
            .filter(|other| *other != index)
            .map(|other| &mixed.materials[other].prototype)
            .collect();
        for instance in &material.instances {
            let near = others.iter().any(|other| {
                let own = material.prototype.taps_m_s2.iter().flatten();
                let theirs = other.taps_m_s2.iter().flatten();
                let mut found = instance.taps_m_s2.iter().flatten();
                own.zip(theirs).all(|(own, theirs)| {
                    let expected = 0.95 * own + 0.05 * theirs;
                    found.next().is_some_and(|a| (a - expected).abs() <= 1e-4)
                })
            });
            assert!(near, "{}", material.name);
        }
    }
    let stiffness = |name: &str| {
        mixed
            .materials
            .iter()
            .find(|m| m.name == name)
            .unwrap()
            .stiffness_n_m
    };
    assert!(stiffness("Wood") > stiffness("Cork") && stiffness("Cork") > stiffness("Denim"));
}

#[test]
fn the_committed_captions_keep_their_rules() {
    let captions = captions::all().unwrap();
    assert_eq!(captions.len(), 100);
    let mut seen = BTreeSet::new();
    for entry in captions.values() {
        assert!(
            entry.training.len() >= 5 && entry.held_out.len() >= 2,
            "{}",
            entry.name
        );
        for text in entry
            .training
            .iter()
            .map(|c| &c.text)
            .chain(&entry.held_out)
        {
            assert!(
                seen.insert(text.to_lowercase()),
                "{}: {text:?} again",
                entry.name
            );
        }
    }
}

#[test]
fn refusals_name_the_file_and_what_is_wrong_with_it() {
    let folder = Folder::empty();
    assert!(refusal(&folder).contains("has no .xml file"));
    let missing = load(&options("no such folder")).unwrap_err().to_string();
    assert!(
        missing.contains("no such folder: cannot read it"),
        "{missing}"
    );

    folder.write("Wood", &MADE_UP[0].xml());
    let message = refusal(&folder);
    assert!(
        message.contains("6 places of sounding models, at least 18"),
        "{message}"
    );
    assert!(
        message.contains(&folder.0.display().to_string()),
        "{message}"
    );

    for (from, to, expected) in [
        (
            "<material>Wood",
            "<material>Moon Rock",
            "no captions for material \"Moon Rock\" of",
        ),
        (
            "<SampleRate>1000",
            "<SampleRate>2000",
            "SampleRate = 2000, must be 1000 Hz",
        ),
        ("<mu>0.4", "<mu>x", "mu = \"x\" is not a number"),
        ("<var>0.", "<var>0.0</var><!--", ""),
    ] {
        let text = if expected.is_empty() {
            // Silence everywhere.
            MADE_UP[0]
                .xml()
                .replace(from, to)
                .replace("</var><gain>", "--><gain>")
        } else {
            MADE_UP[0].xml().replacen(from, to, 1)
        };
        folder.write("Wood", &text);
        let message = refusal(&folder);
        assert!(message.contains(expected), "{message}");
        assert!(message.contains("Models_Wood.xml"), "{message}");
    }

    let twice = Folder::of(&MADE_UP);
    twice.write("Wood again", &MADE_UP[0].xml());
    let message = refusal(&twice);
    assert!(
        message.contains("material \"Wood\" is also in"),
        "{message}"
    );
}
