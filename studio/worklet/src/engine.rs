//! Events in, frames out: hand, runtime and upsampler together.

use crate::{
    clock::Clock,
    hand::{Hand, Pointer, RATE_HZ},
    press::{Press, Under},
    session::Session,
    status::Status,
    upsample::{FACTOR, Upsampler},
};

/// Frames that one call gives at most.
pub const MAX_FRAMES: usize = 384;
/// Ticks that one call takes at most: the first frame may be the last of a tick.
pub const MAX_TICKS: usize = MAX_FRAMES / FACTOR + 1;
/// Frames a second.
const FRAME_HZ: f64 = RATE_HZ as f64 * FACTOR as f64;

/// Output of [`Engine::process`].
#[derive(Debug, Clone)]
pub struct Block {
    /// Ticks rendered.
    pub ticks: usize,
    /// The hand in each tick, mm.
    pub positions_mm: [[f32; 3]; MAX_TICKS],
    /// [`Tick::columns`](crate::session::Tick::columns) of each tick.
    pub columns: [[f32; 9]; MAX_TICKS],
    /// [`Tick::flags`](crate::session::Tick::flags) of each tick.
    pub flags: [u32; MAX_TICKS],
    /// Acceleration at 48 kHz, m/s².
    pub frames: [f32; MAX_FRAMES],
}

impl Block {
    /// An empty block.
    pub const EMPTY: Self = Self {
        ticks: 0,
        positions_mm: [[0.0; 3]; MAX_TICKS],
        columns: [[0.0; 9]; MAX_TICKS],
        flags: [0; MAX_TICKS],
        frames: [0.0; MAX_FRAMES],
    };
}

/// Events in, frames out. Without a session it is silent and renders no tick.
pub struct Engine<'q, 'a> {
    hand: Hand,
    press: Press,
    /// Load of the last tick, N.
    load_n: f32,
    clock: Clock,
    upsampler: Upsampler,
    /// The phase of the next frame.
    phase: usize,
    session: Option<Session<'q, 'a>>,
}

impl<'q, 'a> Engine<'q, 'a> {
    /// Silence, under a [`Hand::new`] that plays events `delay_s` late.
    #[must_use]
    pub const fn new(delay_s: f64) -> Self {
        Self {
            hand: Hand::new(delay_s),
            press: Press::new(),
            load_n: 0.0,
            clock: Clock::new(),
            upsampler: Upsampler::new(),
            phase: 0,
            session: None,
        }
    }

    /// Starts a session, or ends the one that plays. Its first tick is that of the next frame; the
    /// hand stays where it is.
    pub fn set_session(&mut self, session: Option<Session<'q, 'a>>) {
        self.session = session;
        self.upsampler = Upsampler::new();
        self.phase = 0;
    }

    /// The session that plays.
    #[must_use]
    pub const fn session(&self) -> Option<&Session<'q, 'a>> {
        self.session.as_ref()
    }

    /// The session that plays.
    pub const fn session_mut(&mut self) -> Option<&mut Session<'q, 'a>> {
        self.session.as_mut()
    }

    /// From an event that arrives as fast as any to its sound, s: hand and upsampler, without the
    /// filters of the runtime.
    #[must_use]
    pub fn latency_s(&self) -> f64 {
        self.hand.latency_s() + crate::upsample::DELAY_TICKS as f64 / f64::from(RATE_HZ)
    }

    /// Takes events of the page's clock, in their order, which arrived together at the audio time
    /// `now_s`, s.
    ///
    /// # Errors
    /// [`Status::Event`] if any of them is not valid; none is taken then.
    pub fn post(&mut self, events: &[Pointer], now_s: f64) -> Result<(), Status> {
        if !now_s.is_finite() || !events.iter().all(Pointer::is_valid) {
            return Err(Status::Event);
        }
        if let Some(last) = events.last() {
            self.clock.observe(now_s, last.time_s);
        }
        for event in events {
            let time_s = self.clock.audio_s(event.time_s);
            self.hand.post(Pointer { time_s, ..*event });
        }
        Ok(())
    }

    /// Renders `frames` of audio from the audio time `now_s` on, s, at most [`MAX_FRAMES`].
    pub fn process(&mut self, frames: usize, now_s: f64, block: &mut Block) {
        block.ticks = 0;
        let frames = block.frames.iter_mut().take(frames);
        let Some(session) = &mut self.session else {
            frames.for_each(|frame| *frame = 0.0);
            return;
        };
        for (n, frame) in frames.enumerate() {
            if self.phase == 0 {
                let hand_mm = self.hand.step(now_s + n as f64 / FRAME_HZ);
                let under = session.gives_way().then(|| Under {
                    stiffness_n_m: session.stiffness_n_m(),
                    load_n: self.load_n,
                });
                let position_mm = self.press.step(hand_mm, under);
                let tick = session.tick(position_mm);
                self.load_n = tick.columns[2];
                self.upsampler.push(tick.acceleration_m_s2);
                block.positions_mm[block.ticks] = position_mm;
                block.columns[block.ticks] = tick.columns;
                block.flags[block.ticks] = tick.flags;
                block.ticks += 1;
            }
            *frame = self.upsampler.frame(self.phase);
            self.phase = (self.phase + 1) % FACTOR;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{session, upsample::DELAY_TICKS};
    use asperity_runtime::{Exchange, HostTexture, Renderer, Sample, State};

    const ASSET: &[u8] = include_bytes!("../../../runtime/tests/data/builtin-v1.asp");

    fn loaded() -> Box<HostTexture> {
        let mut slot = Box::new(HostTexture::EMPTY);
        slot.load_haptic(ASSET, RATE_HZ).unwrap();
        slot
    }

    /// A stroke at 120 mm/s after a tap, as a pointer of 125 Hz posts it; with two swaps on the way
    /// to the same texture where `swaps`.
    fn play(swaps: bool) -> (Vec<[f32; 3]>, Vec<session::Tick>, Vec<f32>) {
        let (mut playing, mut spare) = (loaded(), [loaded(), loaded()]);
        let mut exchange = Exchange::new();
        let [one, two] = &mut spare;
        let session = Session::start(&mut exchange, &mut playing, [one, two], 5).unwrap();
        let mut engine = Engine::new(0.02);
        engine.set_session(Some(session));
        let mut block = Box::new(Block::EMPTY);
        let (mut positions, mut ticks, mut audio) = (Vec::new(), Vec::new(), Vec::new());
        let mut next = 0;
        for n in 0..400 {
            let now_s = 3.0 + f64::from(n * 128) / 48_000.0;
            while f64::from(next) * 0.008 <= now_s - 3.0 {
                let time_s = f64::from(next) * 0.008;
                let z = if next < 5 { 1.0 } else { -1.5 };
                let event = Pointer {
                    time_s,
                    position_mm: [120.0 * time_s, 0.0, z],
                    stroke: 1.0,
                };
                assert_eq!(engine.post(&[event], now_s), Ok(()));
                next += 1;
            }
            if swaps && (n == 200 || n == 260) {
                engine.session_mut().unwrap().swap(ASSET).unwrap();
            }
            engine.process(128, now_s, &mut block);
            assert!((42..=43).contains(&block.ticks));
            for k in 0..block.ticks {
                positions.push(block.positions_mm[k]);
                ticks.push(session::Tick {
                    columns: block.columns[k],
                    flags: block.flags[k],
                    acceleration_m_s2: block.columns[k][3] + block.columns[k][4] / 0.05,
                });
            }
            audio.extend_from_slice(&block.frames[..128]);
        }
        assert_eq!(engine.session().unwrap().swaps(), if swaps { 2 } else { 0 });
        (positions, ticks, audio)
    }

    #[test]
    fn ticks_have_the_bits_of_the_plain_runtime_and_frames_are_their_sum() {
        let (positions, ticks, audio) = play(false);
        assert_eq!((ticks.len(), audio.len()), (400 * 128 / 3 + 1, 400 * 128));
        let renderer = Renderer::new(&session::config()).unwrap();
        let (slot, mut state) = (loaded(), State::new(5));
        let (mut taps, mut loudest) = (0, 0.0_f32);
        for (n, (position, tick)) in positions.iter().zip(&ticks).enumerate() {
            let position_m = position.map(|mm| (f64::from(mm) / 1000.0) as f32);
            let output = renderer.tick(&slot, &mut state, &Sample::at(position_m));
            assert_eq!(tick.columns[3].to_bits(), output.vib_m_s2.to_bits(), "{n}");
            assert_eq!(
                tick.columns[8].to_bits(),
                output.force_n[2].to_bits(),
                "{n}"
            );
            assert_eq!(tick.flags, u32::from(output.flags.bits()));
            taps += tick.flags >> 1 & 1;
            loudest = loudest.max(output.vib_m_s2.abs());
            if let Some(frame) = audio.get(3 * (n + DELAY_TICKS)) {
                assert_eq!(frame.to_bits(), tick.acceleration_m_s2.to_bits(), "{n}");
            }
        }
        assert_eq!(taps, 1);
        assert!(loudest > 0.5, "{loudest}");
    }

    /// The runtime takes a swap to the same texture for none.
    #[test]
    fn a_swap_keeps_hand_and_noise() {
        assert_eq!(play(true), play(false));
    }

    #[test]
    fn without_a_session_there_is_silence_and_no_tick() {
        let mut engine = Engine::new(0.02);
        let mut block = Box::new(Block {
            ticks: 9,
            frames: [1.0; MAX_FRAMES],
            ..Block::EMPTY
        });
        engine.process(128, 0.0, &mut block);
        assert_eq!(
            (block.ticks, block.frames[..128].iter().sum()),
            (0, 0.0_f32)
        );
    }

    #[test]
    fn one_event_that_is_not_a_number_refuses_all_that_came_with_it() {
        let mut engine = Engine::new(0.02);
        let good = Pointer {
            time_s: 0.0,
            position_mm: [0.0; 3],
            stroke: 1.0,
        };
        let bad = Pointer {
            position_mm: [0.0, f64::NAN, 0.0],
            ..good
        };
        assert_eq!(engine.post(&[good, bad], 0.0), Err(Status::Event));
        assert_eq!(engine.post(&[good], f64::NAN), Err(Status::Event));
        assert_eq!(engine.post(&[good, good], 0.0), Ok(()));
    }
}
