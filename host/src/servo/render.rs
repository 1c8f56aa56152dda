//! Renderers for a servo loop: sample in, output out.

use asperity_runtime::{
    Config, Counters, Output, Player, Renderer, Sample, Scene, SceneState, State, Texture,
};

/// Maps a sample to an output, once per servo period.
pub trait Render {
    /// Renders a tick. It neither allocates, locks nor prints.
    fn tick(&mut self, sample: &Sample) -> Output;

    /// Returns the renderer's configuration: rate and limits of the force.
    fn config(&self) -> &Config;

    /// Returns the counters since the start.
    fn counters(&self) -> Counters;

    /// Returns the number of texture exchanges.
    fn exchanges(&self) -> u32 {
        0
    }
}

/// A texture that may be exchanged for another while the loop runs.
pub struct SwappableTexture<'r, 'q, 'a> {
    /// The renderer.
    pub renderer: &'r Renderer,
    /// The servo's half of the exchange.
    pub player: Player<'q, 'a>,
    exchanges: u32,
}

impl<'r, 'q, 'a> SwappableTexture<'r, 'q, 'a> {
    /// Renders the texture of a player.
    #[must_use]
    pub fn new(renderer: &'r Renderer, player: Player<'q, 'a>) -> Self {
        Self {
            renderer,
            player,
            exchanges: 0,
        }
    }
}

impl Render for SwappableTexture<'_, '_, '_> {
    fn tick(&mut self, sample: &Sample) -> Output {
        let before = std::ptr::from_ref(self.player.texture());
        let output = self.renderer.tick_player(&mut self.player, sample);
        // An exchange is one of slots, so the texture lies elsewhere after it.
        let changed = before != std::ptr::from_ref(self.player.texture());
        self.exchanges += u32::from(changed);
        output
    }

    fn config(&self) -> &Config {
        self.renderer.config()
    }

    fn exchanges(&self) -> u32 {
        self.exchanges
    }

    fn counters(&self) -> Counters {
        *self.player.state().counters()
    }
}

/// A scene of several surfaces.
pub struct SceneRender<'r, 'a, const N: usize> {
    /// The renderer.
    pub renderer: &'r Renderer,
    /// The scene.
    pub scene: &'r Scene<'a, N>,
    /// Everything that changes from tick to tick.
    pub state: SceneState,
}

impl<const N: usize> Render for SceneRender<'_, '_, N> {
    fn tick(&mut self, sample: &Sample) -> Output {
        self.renderer
            .tick_scene(self.scene, &mut self.state, sample)
    }

    fn config(&self) -> &Config {
        self.renderer.config()
    }

    fn counters(&self) -> Counters {
        *self.state.state().counters()
    }
}

/// A fixed texture.
pub struct SingleTexture<'r> {
    /// The renderer.
    pub renderer: &'r Renderer,
    /// The texture.
    pub texture: &'r Texture,
    /// Everything that changes from tick to tick.
    pub state: State,
}

impl Render for SingleTexture<'_> {
    fn tick(&mut self, sample: &Sample) -> Output {
        self.renderer.tick(self.texture, &mut self.state, sample)
    }

    fn config(&self) -> &Config {
        self.renderer.config()
    }

    fn counters(&self) -> Counters {
        *self.state.counters()
    }
}
