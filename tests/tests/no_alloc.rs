//! The loader and the tick allocate nothing.

#![allow(unsafe_code, reason = "a global allocator cannot be had without")]

use asperity_formats::{Asset, Library, Numerator, library};
use asperity_runtime::{Capacities, Config, HostTexture, Renderer, Sample, State};
use asperity_tests::{
    texture::{TextureKind, random},
    trajectory::strokes,
};
use std::{
    alloc::{GlobalAlloc, Layout, System},
    cell::Cell,
};

/// The system's allocator, which counts the calls of each thread.
struct Counting;

thread_local! {
    static CALLS: Cell<u64> = const { Cell::new(0) };
}

fn count() {
    // This fails only while the thread ends.
    let _ = CALLS.try_with(|calls| calls.set(calls.get() + 1));
}

// SAFETY: every call is passed on unchanged to the system's allocator, which keeps the
// contract. Counting uses a thread-local without a destructor and does not allocate.
unsafe impl GlobalAlloc for Counting {
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        count();
        // SAFETY: the caller's promises are those of the system's allocator.
        unsafe { System.alloc(layout) }
    }

    unsafe fn dealloc(&self, pointer: *mut u8, layout: Layout) {
        count();
        // SAFETY: the caller's promises are those of the system's allocator.
        unsafe { System.dealloc(pointer, layout) }
    }
}

#[global_allocator]
static ALLOCATOR: Counting = Counting;

/// The result of `f`, and how often `f` allocated or freed.
fn calls_of<T>(f: impl FnOnce() -> T) -> (T, u64) {
    let before = CALLS.get();
    let result = f();
    (result, CALLS.get() - before)
}

#[test]
fn the_trap_works() {
    let (boxed, calls) = calls_of(|| std::hint::black_box(Box::new(7)));
    assert_eq!((*boxed, calls), (7, 1));
    assert_eq!(calls_of(|| std::hint::black_box(7)).1, 0);
}

#[test]
fn parsing_loading_and_ticking_allocate_nothing() {
    for numerator in [Numerator::None, Numerator::Nyquist, Numerator::Lsf] {
        let kind = TextureKind {
            ar_order: 20,
            ma_order: 18,
            numerator,
            lattice: (7, 6),
        };
        let bytes = random(1, kind).encode();
        let textures = [("random", bytes.as_slice())];
        let mut shelf = vec![0; library::encoded_len(&textures)];
        library::encode_library(&textures, &mut shelf).unwrap();
        let mut samples: Vec<_> = strokes(1, 5000).into_iter().map(Sample::at).collect();
        for (at, bad) in [(900, Sample::STALE), (2000, Sample::at([f32::NAN; 3]))] {
            samples[at..at + 5].fill(bad);
        }
        let mut slot = Box::new(HostTexture::new());

        let (parsed, calls) = calls_of(|| {
            let library = Library::parse(&shelf)?;
            let index = library.index().find("random").unwrap_or(9);
            library.asset(index).and_then(|_| Asset::parse(&bytes))
        });
        assert_eq!(calls, 0, "parsing");
        let asset = parsed.unwrap();

        let (loaded, calls) = calls_of(|| slot.load(&asset, 1000.0));
        loaded.unwrap();
        assert_eq!(calls, 0, "loading");

        let renderer = Renderer::new(&Config::default()).unwrap();
        let mut state = State::new(1);
        let (sum, calls) = calls_of(|| {
            samples
                .iter()
                .map(|sample| renderer.tick(&slot, &mut state, sample).force_n[2])
                .sum::<f32>()
        });
        assert!(sum.is_finite() && sum != 0.0);
        assert_eq!(calls, 0, "ticks");
        assert_eq!(calls_of(|| state.clone()).1, 0, "a copy of the state");
    }
}

#[test]
fn refusals_allocate_nothing_either() {
    let bytes = random(1, TextureKind::nyquist(20)).encode();
    let mut damaged = bytes.clone();
    let (refused, calls) = calls_of(|| {
        let mut refused = 0;
        for at in 0..damaged.len() {
            damaged[at] ^= 0x10;
            refused += usize::from(Asset::parse(&damaged).is_err());
            damaged[at] ^= 0x10;
        }
        refused
    });
    assert_eq!((refused, calls), (bytes.len(), 0));
    let mut small = Box::new(asperity_runtime::Texture::<Capacities<8, 8, 8, 8, 64>>::new());
    let asset = Asset::parse(&bytes).unwrap();
    let (result, calls) = calls_of(|| small.load(&asset, 1000.0));
    assert!(result.is_err());
    assert_eq!(calls, 0);
}
