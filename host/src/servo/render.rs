//! What answers a sample with a force.

use asperity_runtime::{
    Config, Counters, Output, Player, Renderer, Sample, Scene, SceneState, State, Texture,
};

/// Answers one sample with one output, once in a servo period.
pub trait Render {
    /// One tick. It neither allocates, locks nor prints.
    fn tick(&mut self, sample: &Sample) -> Output;

    /// What the renderer was told: rate and limits of the force.
    fn config(&self) -> &Config;

    /// What happened since the start.
    fn counters(&self) -> Counters;

    /// How often another texture has begun to play.
    fn exchanges(&self) -> u32 {
        0
    }
}

/// One texture, which may be exchanged for another while the loop runs.
pub struct SwappableTexture<'r, 'q, 'a> {
    /// The renderer.
    pub renderer: &'r Renderer,
    /// The servo's half of the exchange.
    pub player: Player<'q, 'a>,
    exchanges: u32,
}

impl<'r, 'q, 'a> SwappableTexture<'r, 'q, 'a> {
    /// What a player plays.
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

/// One texture that stays.
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
