//! A sentence becomes a force: prompt → asset → slot → stroke.
//!
//! The compiler and its model are in the binary. The asset never touches a file here; a program
//! that ships textures writes the bytes to one and embeds or maps it.

use asperity::{
    learned::inference::Backend,
    sources::prompt::{CompiledPrompt, Options, PromptCompiler},
};
use asperity_formats::Asset;
use asperity_runtime::{Config, HostTexture, Renderer, Sample, State};
use std::error::Error;

const PROMPT: &str = "rough abrasive sheet with gritty particles";
/// Ticks of a row that is printed.
const ROW: usize = 100;

fn main() -> Result<(), Box<dyn Error>> {
    // Author time: some tens of milliseconds a prompt, once the model is loaded. The portable
    // back end gives the same bytes on every machine.
    let prompt_compiler = PromptCompiler::embedded(&Backend::Portable)?;
    let options = Options::default().without_preview();
    let compiled = prompt_compiler.compile(PROMPT, &options);
    let compiled = compiled.map_err(|failure| failure as Box<dyn Error>)?;
    let bytes = &compiled.lowered.bytes;
    println!("{PROMPT:?}: {} bytes", bytes.len());
    let found: Option<&CompiledPrompt> = compiled.found();
    for near in found.into_iter().flat_map(|found| &found.nearest).take(3) {
        println!("  near {}, {:.0} %", near.name, 100.0 * near.weight);
    }

    // Load time: all distrust of the bytes ends in `parse`, and nothing allocates.
    let config = Config::default();
    let renderer = Renderer::new(&config)?;
    let mut texture = Box::new(HostTexture::new());
    texture.load(&Asset::parse(bytes)?, config.servo_rate_hz)?;

    // The tick, once a servo period. The same asset, seed and samples give the same bits.
    let mut state = State::new(1);
    println!(
        "\n{:>5} {:>7} {:>7} {:>9} {:>9}",
        "ms", "mm/s", "normal", "friction", "vibration"
    );
    println!(
        "{:>5} {:>7} {:>7} {:>9} {:>9}",
        "", "", "N", "N", "m/s² RMS"
    );
    let samples = stroke();
    for (row, ticks) in samples.chunks(ROW).enumerate() {
        let mut squares = 0.0;
        let mut last = None;
        for sample in ticks {
            let output = renderer.tick(&texture, &mut state, sample);
            squares += output.vib_m_s2 * output.vib_m_s2;
            last = Some(output);
        }
        let Some(output) = last else { continue };
        let rms_m_s2 = (squares / ticks.len() as f32).sqrt();
        println!(
            "{:>5} {:>7.1} {:>7.3} {:>9.3} {rms_m_s2:>9.3} {}",
            (row + 1) * ROW,
            output.speed_mm_s,
            output.normal_force_n,
            output.friction_n,
            "#".repeat((2.0 * rms_m_s2) as usize)
        );
    }
    let counters = state.counters();
    println!("\n{} ticks, {} taps", counters.ticks, counters.taps);
    Ok(())
}

/// Down onto the plane z = 0 at 40 mm/s, 2 mm into it, then along x, faster and faster.
fn stroke() -> Vec<Sample> {
    let down = (0..100).map(|n| [0.0, 0.0, 2.0e-3 - 4.0e-5 * n as f32]);
    // x = a t²/2 with a = 0.2 m/s²: 180 mm/s after 0.9 s.
    let along = (0..900).map(|n| [1.0e-7 * (n * n) as f32, 0.0, -2.0e-3]);
    down.chain(along).map(Sample::at).collect()
}
