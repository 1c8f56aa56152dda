//! The session on every scene that the cost model is fitted to, on the host; the plugin counts
//! in QEMU's user mode.

use asperity_runtime::{Output, Renderer, Sample, SceneState};
use asperity_session::{CostScene, CostSlot, SCENE_BYTES, SCENE_CASES, renderer, run_scene};
use std::{error::Error, hint::black_box};

/// First instruction that does not count as the tick's; the plugin knows its name.
#[allow(unsafe_code, reason = "the plugin finds the marker by its symbol")]
#[unsafe(no_mangle)]
#[inline(never)]
extern "C" fn mark_begin() {
    black_box(1_u8);
}

/// First instruction after the tick. Its body differs, or the two would be merged.
#[allow(unsafe_code, reason = "the plugin finds the marker by its symbol")]
#[unsafe(no_mangle)]
#[inline(never)]
extern "C" fn mark_end() {
    black_box(2_u16);
}

#[inline(never)]
fn tick(
    renderer: &Renderer,
    scene: &CostScene<'_>,
    state: &mut SceneState,
    sample: &Sample,
) -> Output {
    renderer.tick_scene(scene, state, sample)
}

fn main() -> Result<(), Box<dyn Error>> {
    let mut slots = Box::new([const { CostSlot::new() }; 2]);
    let mut bytes = vec![0; SCENE_BYTES];
    for case in &SCENE_CASES {
        let scene = case
            .load(&mut bytes, &mut slots)
            .map_err(|error| format!("{case:?}: {error:?}"))?;
        run_scene(&scene, &renderer()?, |renderer, scene, state, sample| {
            mark_begin();
            let output = tick(renderer, scene, state, sample);
            mark_end();
            black_box(output)
        });
    }
    Ok(())
}
