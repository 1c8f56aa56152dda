//! The schema and the example of `docs/data/` are those of the format.

use asperity::{
    model::{Adhesion, ContactLaw, Direction, Drag, Imprint, Numerator, Relaxation, SpringPoint},
    sources::{
        builtin,
        model_file::{from_json, to_json},
    },
};
use serde_json::{Value, json};

/// Every key of the schema is written by some model, and every key that is written is in it.
#[test]
fn the_schema_for_editors_has_the_keys_of_the_format() {
    fn compare(schema: &Value, documents: &[&Value], path: &str) {
        if let Some(properties) = schema["properties"].as_object() {
            assert_eq!(schema["additionalProperties"], json!(false), "{path}");
            for document in documents {
                for key in document.as_object().unwrap().keys() {
                    assert!(
                        properties.contains_key(key),
                        "{path}.{key} is not in the schema"
                    );
                }
                for key in schema["required"].as_array().unwrap() {
                    assert!(
                        document.get(key.as_str().unwrap()).is_some(),
                        "{path}.{key}"
                    );
                }
            }
            for (key, schema) in properties {
                let found: Vec<&Value> = documents.iter().filter_map(|d| d.get(key)).collect();
                assert!(!found.is_empty(), "{path}.{key} is written by no model");
                compare(schema, &found, &format!("{path}.{key}"));
            }
        } else if schema["items"].is_object() {
            let items: Vec<&Value> = documents
                .iter()
                .flat_map(|d| d.as_array().unwrap())
                .collect();
            compare(&schema["items"], &items, &format!("{path}[]"));
        }
    }
    let schema = include_str!("../../docs/data/model.schema.json");
    let schema: Value = serde_json::from_str(schema).unwrap();
    let mut prompted = builtin::texture();
    prompted.grid.numerator = Numerator::Lsf;
    for vertex in &mut prompted.grid.vertices {
        vertex.ma_lsf_rad = Some(vec![0.3, 1.1, 2.0]);
        vertex.gain = 0.1;
    }
    prompted.provenance.prompt = Some("grit".into());
    prompted.contact = Some(giving_way());
    prompted.direction = Some(Direction::NONE);
    let documents: Vec<Value> = [builtin::texture(), prompted]
        .iter()
        .map(|texture| serde_json::from_slice(&to_json(texture)).unwrap())
        .collect();
    compare(&schema, &documents.iter().collect::<Vec<_>>(), "");
    let example = include_str!("../../docs/data/corduroy.json");
    assert!(from_json(example.as_bytes()).is_ok());
}

/// A contact law with every part.
fn giving_way() -> ContactLaw {
    ContactLaw {
        spring: vec![SpringPoint {
            depth_mm: 4.0,
            force_n: 1.0,
        }],
        damping_s_m: 0.5,
        relaxation: Some(Relaxation {
            stiffness_n_m: 50.0,
            time_s: 0.3,
        }),
        imprint: Some(Imprint {
            yield_mm: 1.0,
            share: 0.5,
            heal: 0.1,
            recovery_s: 2.0,
        }),
        drag: Some(Drag {
            viscous_n_s_m2: 100.0,
            plough_n_m: 20.0,
        }),
        adhesion: Some(Adhesion {
            pull_n: 0.1,
            stiffness_n_m: 60.0,
        }),
    }
}
