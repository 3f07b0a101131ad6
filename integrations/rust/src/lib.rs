//! The force of a needle that goes through tissue membranes and comes out again, over libpunctura.
//!
//! All numbers are SI. `docs/c-abi.md` of the project explains the objects.
//!
//! ```no_run
//! # fn main() -> Result<(), punctura::Error> {
//! let scene = punctura::Scene::from_toml(&std::fs::read_to_string("scene.toml").unwrap())?;
//! let mut insertion = punctura::Insertion::new(&scene)?;
//! let force = insertion.step([0.0, -1e-3, 0.0], [0.0, -1.0, 0.0]);
//! # Ok(()) }
//! ```

mod ffi;

use std::ffi::{CStr, CString};
use std::fmt;
use std::mem::{size_of, MaybeUninit};
use std::os::raw::c_char;
use std::ptr::{null, null_mut};

pub use ffi::{Record, Sample};

/// Position (m), direction or force (N): x, y, z.
pub type Triple = [f64; 3];

/// A call failed. The text has one line for each problem, with the path of the value.
#[derive(Clone, Debug, PartialEq)]
pub struct Error {
    pub status: i32,
    pub text: String,
}

impl fmt::Display for Error {
    fn fmt(&self, to: &mut fmt::Formatter<'_>) -> fmt::Result {
        to.write_str(&self.text)
    }
}
impl std::error::Error for Error {}

fn text(from: *const c_char) -> String {
    // SAFETY: the library's texts end with 0 and live until the next error of this thread.
    unsafe { CStr::from_ptr(from) }.to_string_lossy().into_owned()
}

fn check(status: i32) -> Result<(), Error> {
    if status == ffi::OK {
        return Ok(());
    }
    // SAFETY: these functions take no pointer.
    let (kept, meaning) = unsafe { (text(ffi::punctura_last_error()), text(ffi::punctura_status_text(status))) };
    let older = status == ffi::NO_PEEK || status == ffi::NO_NUMBER || kept.is_empty();
    Err(Error { status, text: if older { meaning } else { kept } })
}

fn c(text: &str) -> Result<CString, Error> {
    CString::new(text).map_err(|_| Error { status: 1, text: format!("{text:?} has a 0 in it") })
}

macro_rules! handle {
    ($name:ident, $free:ident) => {
        // SAFETY: an object may move to another thread; only one thread may use it at a time.
        unsafe impl Send for $name {}
        impl Drop for $name {
            fn drop(&mut self) {
                // SAFETY: the pointer comes from the library and is freed once.
                unsafe { ffi::$free(self.0) }
            }
        }
    };
}

/// The description of a run.
pub struct Scene(*mut ffi::Scene);
handle!(Scene, punctura_scene_free);

impl Scene {
    /// From the text of a scene file.
    pub fn from_toml(text: &str) -> Result<Scene, Error> {
        Self::made(|to| unsafe { ffi::punctura_scene_from_toml(text.as_ptr().cast(), text.len(), to) })
    }
    /// From lines `path = value`, in SI units.
    pub fn from_values(text: &str) -> Result<Scene, Error> {
        Self::made(|to| unsafe { ffi::punctura_scene_from_values(text.as_ptr().cast(), text.len(), to) })
    }
    pub fn try_clone(&self) -> Result<Scene, Error> {
        Self::made(|to| unsafe { ffi::punctura_scene_copy(self.0, to) })
    }
    /// A number by its path, for example `membrane[0].friction`.
    pub fn get(&self, path: &str) -> Result<f64, Error> {
        let (path, mut value) = (c(path)?, 0.0);
        check(unsafe { ffi::punctura_scene_get(self.0, path.as_ptr(), &mut value) })?;
        Ok(value)
    }
    pub fn set(&mut self, path: &str, value: f64) -> Result<(), Error> {
        let path = c(path)?;
        check(unsafe { ffi::punctura_scene_set(self.0, path.as_ptr(), value) })
    }
    /// Numbers that are probably in a wrong unit, one line each; "" if there are none.
    pub fn unusual(&self) -> String {
        // SAFETY: the handle is a scene; the text is copied at once.
        text(unsafe { ffi::punctura_scene_unusual(self.0) })
    }
    /// Sets a word by its path, for example `servo.solver` to `paper`.
    pub fn set_word(&mut self, path: &str, word: &str) -> Result<(), Error> {
        let (path, word) = (c(path)?, c(word)?);
        check(unsafe { ffi::punctura_scene_set_word(self.0, path.as_ptr(), word.as_ptr()) })
    }

    fn made(make: impl FnOnce(*mut *mut ffi::Scene) -> i32) -> Result<Scene, Error> {
        if unsafe { ffi::punctura_supports_abi(ffi::ABI) } != 1 {
            return Err(Error { status: 1, text: "libpunctura and this crate do not fit together".into() });
        }
        let mut scene = null_mut();
        check(make(&mut scene))?;
        Ok(Scene(scene))
    }
}

/// Where the needle is in a membrane.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Membrane {
    /// 0 outside, 1 sticking, 2 sliding in, 3 sliding out, 4 barred.
    pub phase: i32,
    pub depth: f64,
    pub axial_force: f64,
    pub lower: f64,
    pub upper: f64,
}

/// The model of a scene. Its force is the model's, without limits.
pub struct Insertion(*mut ffi::Insertion);
handle!(Insertion, punctura_insertion_free);

impl Insertion {
    pub fn new(scene: &Scene) -> Result<Insertion, Error> {
        let mut made = null_mut();
        check(unsafe { ffi::punctura_insertion_new(scene.0, &mut made) })?;
        Ok(Insertion(made))
    }
    /// One tick. axis: of any length but 0. NaN if the input is not finite. Allocates no memory.
    pub fn step(&mut self, position: Triple, axis: Triple) -> Triple {
        let mut force = [f64::NAN; 3];
        unsafe { ffi::punctura_insertion_step(self.0, position.as_ptr(), axis.as_ptr(), force.as_mut_ptr()) };
        force
    }
    /// The force that `step` would give. Changes nothing until `commit`.
    pub fn peek(&mut self, position: Triple, axis: Triple) -> Triple {
        let mut force = [f64::NAN; 3];
        unsafe { ffi::punctura_insertion_peek(self.0, position.as_ptr(), axis.as_ptr(), force.as_mut_ptr()) };
        force
    }
    pub fn commit(&mut self) -> Result<(), Error> {
        check(unsafe { ffi::punctura_insertion_commit(self.0) })
    }
    pub fn reset(&mut self) {
        unsafe { ffi::punctura_insertion_reset(self.0) };
    }
    pub fn membranes(&self) -> usize {
        unsafe { ffi::punctura_insertion_membrane_count(self.0) as usize }
    }
    /// Panics if there is no such membrane.
    pub fn membrane(&self, i: usize) -> Membrane {
        assert!(i < self.membranes(), "membrane {i} of {}", self.membranes());
        let mut tick = MaybeUninit::<ffi::MembraneTick>::zeroed();
        // SAFETY: all fields are numbers, and struct_size is set before the call.
        let t = unsafe {
            (*tick.as_mut_ptr()).struct_size = size_of::<ffi::MembraneTick>();
            ffi::punctura_insertion_membrane(self.0, i as i32, tick.as_mut_ptr());
            tick.assume_init()
        };
        Membrane { phase: t.phase, depth: t.depth, axial_force: t.axial_force, lower: t.lower, upper: t.upper }
    }
    /// The complete state. `restore` continues from it with the same bits.
    pub fn state(&self) -> Result<Vec<u8>, Error> {
        let mut bytes = vec![0; unsafe { ffi::punctura_insertion_state_size(self.0) }];
        check(unsafe { ffi::punctura_insertion_save(self.0, bytes.as_mut_ptr().cast(), bytes.len()) })?;
        Ok(bytes)
    }
    pub fn restore(&mut self, state: &[u8]) -> Result<(), Error> {
        check(unsafe { ffi::punctura_insertion_restore(self.0, state.as_ptr().cast(), state.len()) })
    }
}

impl Sample {
    /// A sample without fault, at the origin, with the axis (0, -1, 0).
    pub fn healthy() -> Sample {
        let mut sample = MaybeUninit::<Sample>::zeroed();
        // SAFETY: the library fills the struct; zeros are numbers, too.
        unsafe {
            ffi::punctura_sample_init(sample.as_mut_ptr(), size_of::<Sample>());
            sample.assume_init()
        }
    }
}

/// The meaning of a fault in a record, and what to do.
pub fn fault_text(fault: i32) -> String {
    text(unsafe { ffi::punctura_fault_text(fault) })
}

/// The whole tick for a device: input gate, model, force limits. Default limits. `docs/safety.md`.
pub struct Servo(*mut ffi::Servo);
handle!(Servo, punctura_servo_free);

impl Servo {
    pub fn new(scene: &Scene) -> Result<Servo, Error> {
        let mut made = null_mut();
        check(unsafe { ffi::punctura_servo_new(scene.0, null(), &mut made) })?;
        Ok(Servo(made))
    }
    pub fn arm(&mut self) {
        unsafe { ffi::punctura_servo_arm(self.0) };
    }
    pub fn disarm(&mut self) {
        unsafe { ffi::punctura_servo_disarm(self.0) };
    }
    pub fn reset(&mut self) {
        unsafe { ffi::punctura_servo_reset(self.0) };
    }
    /// One tick. `record.force` is for the device. Allocates no memory.
    pub fn step(&mut self, sample: &Sample) -> Record {
        let mut record = MaybeUninit::<Record>::zeroed();
        // SAFETY: all fields are numbers, and struct_size is set before the call.
        unsafe {
            (*record.as_mut_ptr()).struct_size = size_of::<Record>();
            ffi::punctura_servo_step(self.0, sample, record.as_mut_ptr());
            record.assume_init()
        }
    }
}
