//! Prepares a validated asset in a slot.

use super::{Texture, codes::to_cosines, needs::Needs};
use crate::{
    arithmetic::{Scalar as _, Zero as _},
    capacity::Capacity,
    coupling::Coupling,
    lanes::{GRID, settled},
    load_error::LoadError,
    math::rounds_to_nearest,
    model::{magnitude_range::MagnitudeRange, orders::Orders},
    quantity::{Quantity, unit::ExcitationLevel},
    render_arithmetic::RenderArithmetic,
    stage::{recursion::Recursion, upsample::Upsampler},
    update::plan::Plan,
};
use asperity_formats::{Asset, FormatError, Grid, Numerator, Taps, limits::MAX_ORDER};

impl<S: Capacity, A: RenderArithmetic> Texture<S, A> {
    /// Prepares a validated asset for a servo rate of 1, 2, 3, … 20 times the models' rate;
    /// allocates nothing. A slot that refuses keeps what it had.
    ///
    /// # Errors
    /// [`LoadError::Rounding`], [`LoadError::Capacity`], [`LoadError::Rate`] and, in fixed point,
    /// [`LoadError::Range`].
    pub fn load(&mut self, asset: &Asset<'_>, servo_rate_hz: f32) -> Result<(), LoadError> {
        self.load_untapped(asset, servo_rate_hz)?;
        self.taps.load(asset.taps(), servo_rate_hz);
        Ok(())
    }

    /// [`Texture::load`] of bytes, of which it checks what [`Asset::parse_haptic`] checks. It takes
    /// less stack, because no asset is held while the taps are converted.
    ///
    /// # Errors
    /// As [`Texture::load`], and [`LoadError::Format`].
    pub fn load_haptic(&mut self, bytes: &[u8], servo_rate_hz: f32) -> Result<(), LoadError> {
        self.load_with(|| Asset::parse_haptic(bytes), servo_rate_hz)
    }

    /// Loads what `parse` gives.
    pub(crate) fn load_with<'a>(
        &mut self,
        parse: impl FnOnce() -> Result<Asset<'a>, FormatError>,
        servo_rate_hz: f32,
    ) -> Result<(), LoadError> {
        let taps = self.load_all_but_taps(parse, servo_rate_hz)?;
        self.taps.load(&taps, servo_rate_hz);
        Ok(())
    }

    /// A function of its own, so that its stack is free again when the taps are converted.
    #[inline(never)]
    fn load_all_but_taps<'a>(
        &mut self,
        parse: impl FnOnce() -> Result<Asset<'a>, FormatError>,
        servo_rate_hz: f32,
    ) -> Result<Taps<'a>, LoadError> {
        // By reference: an asset that is moved takes its room twice.
        match &parse() {
            Ok(asset) => {
                self.load_untapped(asset, servo_rate_hz)?;
                Ok(*asset.taps())
            }
            Err(error) => Err((*error).into()),
        }
    }

    /// Loads all but the taps.
    fn load_untapped(&mut self, asset: &Asset<'_>, servo_rate_hz: f32) -> Result<(), LoadError> {
        let ticks = Self::check(asset, servo_rate_hz)?;
        self.upsampler = Upsampler::new(ticks, servo_rate_hz);
        self.prepare(asset, ticks);
        Ok(())
    }

    /// Checks that the slot can hold a texture; returns the ticks per sample of its models.
    #[inline(never)]
    fn check(asset: &Asset<'_>, servo_rate_hz: f32) -> Result<u8, LoadError> {
        if !rounds_to_nearest() {
            return Err(LoadError::Rounding);
        }
        let needs = Needs::of(asset, servo_rate_hz)?;
        needs.fit::<S>()?;
        A::check_asset(asset)?;
        check_magnitudes::<A>(asset.grid())?;
        Ok(needs.ticks_per_sample)
    }

    /// Prepares models, wall and clock.
    #[inline(never)]
    fn prepare(&mut self, asset: &Asset<'_>, ticks: u8) {
        let grid = asset.grid();
        // The checksums of all that is loaded, and the clock.
        self.id = asset.sections().fold(ticks.into(), |id: u32, section| {
            id.rotate_left(5) ^ section.crc32
        });
        self.coupling = Coupling::new(asset.coupling(), asset.friction().mu());
        self.law.load(asset.friction().law());
        self.contact
            .load(asset.contact(), self.upsampler.servo_rate_hz());
        self.gives_way = asset.contact().is_some();
        self.axis.load(asset.direction());
        self.has_axis = asset.direction().is_some();
        self.mu_varies = self.has_axis || asset.friction().law().is_some();
        self.recursion = Recursion::new(grid.ar_order(), grid.ma_order());
        self.load_models(grid);
        self.plan = Plan::new(&self.models, ticks);
    }

    #[inline(never)]
    fn load_models(&mut self, grid: &Grid<'_>) {
        let models = &mut self.models;
        models.orders = Orders::new(grid.ar_order(), grid.ma_order());
        models.b1 = if grid.numerator() == Numerator::Nyquist {
            Quantity::whole(1)
        } else {
            Quantity::ZERO
        };
        // No triangle has a corner in the rows behind the last vertex, so they may hold anything.
        let rows = &mut models.vertices;
        let rows = (rows.ar.as_mut().iter_mut())
            .zip(rows.ma.as_mut())
            .zip(rows.levels.as_mut());
        for (vertex, ((ar, ma), level)) in grid.vertices().zip(rows) {
            if let Some(model) = grid.model(usize::from(vertex.model)) {
                to_cosines::<A>(ar.as_mut(), model.stored_lsf());
                to_cosines::<A>(ma.as_mut(), model.stored_ma_lsf());
                *level = Quantity::<A, ExcitationLevel>::of(
                    settled(model.gain, GRID) * settled(vertex.sigma_m_s2, GRID),
                )
                .0;
            }
        }
        let corner = |v: u8| grid.place(usize::from(v)).unwrap_or_default();
        models.grid.load(
            grid.stored_triangles(),
            corner,
            grid.max_speed_mm_s(),
            grid.max_force_n(),
        );
    }
}

/// The largest range of a model's |A(e^jω)|, 100 dB. Unstable mixtures begin with models of a range of 10⁶, in f32 and
/// in fixed point (`tests/laws_lsf.rs`).
const WIDEST_RANGE: f32 = 1.0e5;

/// Checks that every mixture of a grid's models stays stable under rounding.
#[inline(never)]
fn check_magnitudes<A: RenderArithmetic>(grid: &Grid<'_>) -> Result<(), LoadError> {
    for (model, stored) in grid.models().enumerate() {
        let mut cosines = [A::Scalar::ZERO; MAX_ORDER];
        to_cosines::<A>(&mut cosines, stored.stored_lsf());
        let lines = cosines.map(|cosine| cosine.value());
        let range = MagnitudeRange::of(lines.get(..grid.ar_order()).unwrap_or_default());
        if range.ratio() > WIDEST_RANGE {
            return Err(LoadError::Conditioning {
                model,
                range: range.ratio(),
                most: WIDEST_RANGE,
            });
        }
        if range.most() > A::LARGEST_MAGNITUDE {
            return Err(LoadError::Range {
                field: "grid max |A|",
                value: range.most(),
                least: 1.0,
                most: A::LARGEST_MAGNITUDE,
            });
        }
    }
    Ok(())
}
