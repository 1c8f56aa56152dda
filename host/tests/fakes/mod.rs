//! Vendor libraries of our own, built by the C compiler of this machine.
#![allow(
    unsafe_code,
    reason = "the tests steer a library of our own through its functions"
)]
#![allow(dead_code, reason = "each test uses a part of this")]

use std::ffi::{CStr, c_char};
use std::path::PathBuf;
use std::process::Command;
use std::sync::{Mutex, MutexGuard, PoisonError};

use asperity_host::device::Uri;

/// A fake library in a folder of its own, so that its global variables are its own too.
pub(crate) struct Fake {
    library: libloading::Library,
    pub(crate) path: PathBuf,
    _folder: tempfile::TempDir,
}

/// Builds `tests/fake/NAME.c` with more options of the compiler. A C compiler is a prerequisite of the tests.
pub(crate) fn build(name: &str, options: &[&str]) -> (PathBuf, tempfile::TempDir) {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join(format!("lib{name}.so"));
    // Tests of other packages use this file too.
    let root = PathBuf::from(env!("CARGO_MANIFEST_DIR"));
    let source = root
        .ancestors()
        .map(|folder| folder.join(format!("host/tests/fake/{name}.c")))
        .find(|source| source.exists())
        .expect("a file of this repository");
    let compiler = std::env::var("CC").unwrap_or_else(|_| "cc".into());
    let ran = Command::new(&compiler)
        .args(["-shared", "-fPIC", "-O1", "-Wall", "-Werror", "-o"])
        .arg(&path)
        .arg(source)
        .args(options)
        .args(["-lpthread", "-lm"])
        .output();
    let output = ran.unwrap_or_else(|error| {
        panic!("no C compiler `{compiler}` ({error}); install one, or set CC to name another")
    });
    let said = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{compiler}: {said}");
    (path, folder)
}

impl Fake {
    pub(crate) fn new(name: &str, options: &[&str]) -> Self {
        let (path, folder) = build(name, options);
        // SAFETY: our own library, without constructors.
        let library = unsafe { libloading::Library::new(&path) }.expect("our own library");
        Self {
            library,
            path,
            _folder: folder,
        }
    }

    /// A function that steers the fake, of the type that `tests/fake/` gives it.
    pub(crate) fn function<F: Copy>(&self, name: &str) -> F {
        // SAFETY: the callers below, and each test, name the types of `tests/fake/`.
        *unsafe { self.library.get::<F>(name) }.expect(name)
    }

    pub(crate) fn set(&self, name: &str, value: u32) {
        self.function::<extern "C" fn(u32)>(name)(value);
    }

    pub(crate) fn get(&self, name: &str) -> i32 {
        self.function::<extern "C" fn() -> i32>(name)()
    }

    pub(crate) fn number(&self, name: &str) -> f64 {
        self.function::<extern "C" fn() -> f64>(name)()
    }

    pub(crate) fn place(&self, [x, y, z]: [f64; 3]) {
        self.function::<extern "C" fn(f64, f64, f64)>("fake_place")(x, y, z);
    }

    pub(crate) fn force_n(&self) -> [f64; 3] {
        let force = self.function::<extern "C" fn(i32) -> f64>("fake_force");
        [0, 1, 2].map(|axis| force(axis))
    }

    /// Names of the calls so far.
    pub(crate) fn calls(&self) -> Vec<String> {
        let text = self.function::<extern "C" fn() -> *const c_char>("fake_calls")();
        // SAFETY: the log ends with a zero.
        let text = unsafe { CStr::from_ptr(text) }.to_str().expect("ASCII");
        text.split_whitespace().map(str::to_owned).collect()
    }

    pub(crate) fn uri(&self, scheme: &str, which: &str) -> Uri {
        format!("{scheme}:{which}?lib={}", self.path.display())
            .parse()
            .expect("a URI")
    }
}

/// A process has one OpenHaptics session, so its tests run one after the other.
pub(crate) fn alone() -> MutexGuard<'static, ()> {
    static ALONE: Mutex<()> = Mutex::new(());
    ALONE.lock().unwrap_or_else(PoisonError::into_inner)
}
