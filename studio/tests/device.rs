//! A device behind the server: a page sees its ticks, loses those that it is too slow for, and has textures played.

use crate::client::{SHARED, Site};
use asperity::{emit::lower::lower, sources::builtin};
use asperity_studio::{Limits, LiveDevice, LiveStatus, LiveTick, Studio};
use serde_json::{Value, json};
use std::{ops::Range, thread, time::Duration};

fn site(device: &LiveDevice) -> Site {
    Site::of(
        Studio::new(None, None).with_device(device.clone()),
        Limits::default(),
    )
}

fn ticks(numbers: Range<u64>) -> Vec<LiveTick> {
    let tick = |tick| LiveTick {
        tick,
        depth_mm: tick as f32,
        ..LiveTick::default()
    };
    numbers.map(tick).collect()
}

/// The builtin texture, opened: its name on the server, and its bytes.
fn opened(site: &Site) -> (Value, Vec<u8>) {
    let asset = lower(&builtin::texture(), None).expect("an asset").bytes;
    let answer = site.post("api/open?name=x.asp", &asset);
    assert_eq!(answer.status, 200, "{answer:?}");
    let texture = answer.json();
    // One texture, as it is or beside a library.
    let texture = texture.get("texture").unwrap_or(&texture);
    (texture["id"].clone(), asset)
}

#[test]
fn a_page_follows_the_loop_and_a_slow_one_loses_ticks_not_the_loop() {
    let device = LiveDevice::new("sim", 250, true);
    let site = site(&device);
    assert_eq!(
        site.get("api/about.json").json()["device"],
        json!({ "name": "sim", "rate_hz": 250, "swaps": true })
    );
    let status = LiveStatus {
        playing: "cork".into(),
        missed: 3,
        ..LiveStatus::default()
    };
    device.publish(&ticks(0..10), &status);
    device.say("period 7: stalled");
    let news = site.get("api/device/ticks").json();
    assert_eq!(news["playing"], "cork");
    assert_eq!(news["missed"], 3);
    assert_eq!(news["said"], json!([[0, "period 7: stalled"]]));
    assert_eq!(news["ticks"]["runs"][0]["columns"][9], 1.0, "the second");
    let next = news["next"].as_u64().expect("a number");

    // A page that does not ask: nothing waits for it, and a second is kept.
    let late = device.clone();
    let publisher = thread::spawn(move || {
        for n in 0..1000 {
            late.publish(&ticks(10 + 10 * n..20 + 10 * n), &LiveStatus::default());
        }
    });
    publisher.join().expect("it never waits");
    let news = site.get(&format!("api/device/ticks?after={next}")).json();
    assert_eq!(news["lost"], 10_000 - 250);
    assert_eq!(news["ticks"]["runs"][0]["first"], 10_010 - 250);

    // One that asks before there is anything gets it when it comes.
    let next = news["next"].as_u64().expect("a number");
    let later = device.clone();
    let publisher = thread::spawn(move || {
        thread::sleep(Duration::from_millis(50));
        later.publish(&ticks(10_010..10_012), &LiveStatus::default());
    });
    let news = site.get(&format!("api/device/ticks?after={next}")).json();
    publisher.join().expect("it publishes");
    assert_eq!(news["ticks"]["runs"][0]["flags"], json!([0, 0]));
    assert_eq!(news["ended"], false);
    device.end();
    let news = site.get(&format!("api/device/ticks?after={next}")).json();
    assert_eq!(news["ended"], true);
}

#[test]
fn a_texture_is_handed_to_the_loop_once_and_the_last_one_counts() {
    let device = LiveDevice::new("sim", 1000, true);
    let site = site(&device);
    let (id, asset) = opened(&site);
    let play = |id: &Value| {
        site.post(
            "api/device/play",
            json!({ "texture": id }).to_string().as_bytes(),
        )
    };
    for _ in 0..2 {
        let answer = play(&id);
        assert_eq!(answer.status, 200, "{answer:?}");
    }
    let wanted = device.wanted().expect("a texture");
    assert_eq!(*wanted.asset, *asset);
    assert!(device.wanted().is_none());
    assert_eq!(play(&"0123".into()).status, 404);
    assert!(device.wanted().is_none());
}

#[test]
fn what_a_device_cannot_do_is_said() {
    let scene = LiveDevice::new("sim", 1000, false);
    let site = site(&scene);
    let (id, _) = opened(&site);
    let body = json!({ "texture": id }).to_string();
    let refused = site.post("api/device/play", body.as_bytes());
    assert_eq!(refused.status, 422);
    let error = refused.json();
    assert!(
        error["error"]
            .as_str()
            .is_some_and(|text| text.contains("scene"))
    );
    for query in ["?after=", "?after=-1", "?after=1&after=2", "?before=1"] {
        let refused = site.get(&format!("api/device/ticks{query}"));
        assert_eq!(refused.status, 400, "{query}");
    }
    assert_eq!(site.get("api/device/play").status, 405);
    assert_eq!(site.post("api/device/ticks", b"").status, 405);
    // Without the networks, prompts are refused with a remedy.
    let refused = site.post("api/compile", br#"{"prompt": "cork"}"#);
    assert_eq!(refused.status, 422);
    // And where no device is.
    assert_eq!(SHARED.get("api/device/ticks").status, 404);
    assert_eq!(SHARED.get("api/about.json").json()["device"], Value::Null);
}
