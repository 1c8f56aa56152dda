//! The text of `docs/figures.md`: what stands around the pictures, with the numbers of the model.

use asperity::{
    model::{
        TextureModel,
        attributes::{self, Attributes},
    },
    passes::reduce::Fidelity,
    pipeline::Pipeline,
    sources::latents::Explanation,
};
use std::fmt::Write as _;

/// Contents of the page.
pub(crate) struct Page<'a> {
    pub(crate) three: &'a [TextureModel],
    /// The same prompts with what each of their words did.
    pub(crate) explained: &'a [(&'a str, Explanation)],
    /// A blend: one end, the middle, the other end.
    pub(crate) blend: &'a [TextureModel],
}

impl Page<'_> {
    /// Returns the largest changes of level (dB) and centroid (Hz) under `--fidelity auto`.
    fn moved_by_reduction(&self) -> (f64, f64) {
        let mut most = (0.0_f64, 0.0_f64);
        for texture in self.three.iter().chain(self.blend) {
            let kept = Pipeline::default().reduce(texture, Fidelity::Auto).texture;
            let [whole, kept] = [texture, &kept].map(attributes::of);
            let moved = |of: fn(&Attributes) -> Option<f64>| {
                let pair = of(&whole).zip(of(&kept));
                pair.map_or(0.0, |(whole, kept)| (whole - kept).abs())
            };
            most.0 = most.0.max(moved(|a| a.rough_db));
            most.1 = most.1.max(moved(|a| a.sharp_hz)).max(moved(|a| a.hard_hz));
        }
        most
    }

    /// The page as Markdown.
    pub(crate) fn text(&self) -> String {
        let mut words = String::new();
        for (prompt, explanation) in self.explained {
            let _ = write!(words, "{prompt}\n{}\n", explanation.text());
        }
        let (level_db, centroid_hz) = self.moved_by_reduction();
        format!(
            "# Figures

`cargo run --release -p asperity --example draw_figures` writes this page and its pictures. The textures are
those of the shipped model, which was trained on a synthetic corpus; nothing was measured on a device.
The tables state the attributes of the textures as decoded. `--fidelity auto`, the default of `compile`, moves
them by at most {level_db:.1} dB and {centroid_hz:.0} Hz.

Each column is a texture: its preview, the spectra of its interior models in the colour of their speed, and its taps
in the colour of their impact speed. All columns of a picture have the same axes.

## Three prompts

![Three prompts](images/three-prompts.png)

{three}
The paper reports the order abrasive, cork, foam in spectral sharpness and excitation. Here the order by level is
{by_level};
by centroid it is
{by_centroid}.

## Which word did what

`asperity compile PROMPT -o FILE.asp --explain` prints for each of the three prompts by how many steps of the sliders
each word moved each attribute. The prompt is read again without the word, in the mean over which of the other words are
there; 100 steps lie between the 5 % and the 95 % quantile of the model's materials.

```text
{words}```

## Halfway between two textures

![Towel, midpoint, whiteboard](images/midpoint.png)

{blend}
The one in the middle is `asperity blend towel.asp whiteboard.asp -t 0.5`: it is decoded from the mean of the two
latents. No word names it, so its preview follows its neighbours in the latent space.

## Thirty prompts

The contact sheet stands in [`preview.md`](preview.md).
",
            three = table(self.three),
            blend = table(self.blend),
            words = words.trim_end_matches('\n').to_owned() + "\n",
            by_level = order(self.three, |a| a.rough_db),
            by_centroid = order(self.three, |a| a.sharp_hz),
        )
    }
}

/// A row a texture, a column an attribute.
fn table(textures: &[TextureModel]) -> String {
    let mut text = String::from(
        "| texture | level, dB | centroid, Hz | centroid of the fastest tap, Hz | μ |\n\
         |---|---:|---:|---:|---:|\n",
    );
    let number = |value: Option<f64>, digits: usize| {
        value.map_or("none".to_owned(), |value| format!("{value:.digits$}"))
    };
    for texture in textures {
        let a = attributes::of(texture);
        // Writing to a string cannot fail.
        let _ = writeln!(
            text,
            "| {} | {} | {} | {} | {:.2} |",
            texture.name,
            number(a.rough_db, 1),
            number(a.sharp_hz, 0),
            number(a.hard_hz, 0),
            a.mu
        );
    }
    text
}

/// The textures by an attribute, the largest first.
fn order(textures: &[TextureModel], of: fn(&Attributes) -> Option<f64>) -> String {
    let mut all: Vec<(f64, &str)> = textures
        .iter()
        .map(|texture| {
            let value = of(&attributes::of(texture)).unwrap_or(f64::NEG_INFINITY);
            (value, texture.name.as_str())
        })
        .collect();
    all.sort_by(|a, b| b.0.total_cmp(&a.0));
    let names: Vec<String> = all.iter().map(|(_, name)| format!("“{name}”")).collect();
    names.join(", ")
}
