//! The session on every scene that the cost model is fitted to, one after the other.
#![no_std]
#![no_main]

use asperity_firmware::{mark_begin, mark_end, print};
use asperity_runtime::{Output, Renderer, Sample, SceneState};
use asperity_session::{CostScene, CostSlot, SCENE_BYTES, SCENE_CASES, renderer, run_scene};
use cortex_m_semihosting::debug;

#[inline(never)]
fn tick(
    renderer: &Renderer,
    scene: &CostScene<'_>,
    state: &mut SceneState,
    sample: &Sample,
) -> Output {
    renderer.tick_scene(scene, state, sample)
}

#[cortex_m_rt::entry]
fn main() -> ! {
    static mut SLOTS: [CostSlot; 2] = [const { CostSlot::new() }; 2];
    static mut BYTES: [u8; SCENE_BYTES] = [0; SCENE_BYTES];
    for (index, case) in SCENE_CASES.iter().enumerate() {
        let (Ok(scene), Ok(renderer)) = (case.load(BYTES, SLOTS), renderer()) else {
            print::line("scene-refused", index as u64);
            debug::exit(debug::EXIT_FAILURE);
            break;
        };
        run_scene(&scene, &renderer, |renderer, scene, state, sample| {
            mark_begin();
            let output = tick(renderer, scene, state, sample);
            mark_end();
            output
        });
    }
    debug::exit(debug::EXIT_SUCCESS);
    loop {
        cortex_m::asm::wfi();
    }
}
