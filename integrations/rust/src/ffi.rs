//! The functions of punctura.h that the crate uses.

use std::os::raw::{c_char, c_void};

pub const ABI: i32 = 1;
pub const OK: i32 = 0;
/// Statuses of ticks, which keep no text: the last error is an older one.
pub const NO_PEEK: i32 = 4;
pub const NO_NUMBER: i32 = 5;

pub type Scene = c_void;
pub type Insertion = c_void;
pub type Servo = c_void;

#[repr(C)]
pub struct MembraneTick {
    pub struct_size: usize,
    pub phase: i32,
    pub depth: f64,
    pub axial_force: f64,
    pub lower: f64,
    pub upper: f64,
    pub proxy: [f64; 3],
    pub direction: [f64; 3],
}

/// The reading of a device in a tick. See `Sample::healthy`.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct Sample {
    pub(crate) struct_size: usize,
    pub sequence: u64,
    pub time: f64,
    pub position: [f64; 3],
    pub axis: [f64; 3],
    pub buttons: u32,
    pub is_healthy: i32,
    pub motor_temperature: f64,
    pub thumb: f64,
}

/// The record of a tick of a servo.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct Record {
    pub(crate) struct_size: usize,
    pub tick: u64,
    pub state: i32,
    pub fault: i32,
    pub limit: i32,
    pub membrane_count: u32,
    pub tip: [f64; 3],
    pub model_force: [f64; 3],
    pub force: [f64; 3],
    pub force_scale: f64,
    pub ceiling: f64,
    pub thumb_force: f64,
    pub plunger: f64,
    pub plunger_force: f64,
    pub pressure: f64,
    pub left: f64,
}

extern "C" {
    pub fn punctura_supports_abi(abi: i32) -> i32;
    pub fn punctura_last_error() -> *const c_char;
    pub fn punctura_status_text(status: i32) -> *const c_char;
    pub fn punctura_fault_text(fault: i32) -> *const c_char;

    pub fn punctura_scene_from_toml(text: *const c_char, size: usize, scene: *mut *mut Scene) -> i32;
    pub fn punctura_scene_from_values(text: *const c_char, size: usize, scene: *mut *mut Scene) -> i32;
    pub fn punctura_scene_copy(scene: *const Scene, copy: *mut *mut Scene) -> i32;
    pub fn punctura_scene_free(scene: *mut Scene);
    pub fn punctura_scene_set(scene: *mut Scene, path: *const c_char, value: f64) -> i32;
    pub fn punctura_scene_get(scene: *const Scene, path: *const c_char, value: *mut f64) -> i32;
    pub fn punctura_scene_unusual(scene: *const Scene) -> *const c_char;
    pub fn punctura_scene_set_word(scene: *mut Scene, path: *const c_char, word: *const c_char) -> i32;

    pub fn punctura_insertion_new(scene: *const Scene, insertion: *mut *mut Insertion) -> i32;
    pub fn punctura_insertion_free(insertion: *mut Insertion);
    pub fn punctura_insertion_reset(insertion: *mut Insertion) -> i32;
    pub fn punctura_insertion_step(i: *mut Insertion, position: *const f64, axis: *const f64, force: *mut f64) -> i32;
    pub fn punctura_insertion_peek(i: *mut Insertion, position: *const f64, axis: *const f64, force: *mut f64) -> i32;
    pub fn punctura_insertion_commit(insertion: *mut Insertion) -> i32;
    pub fn punctura_insertion_membrane_count(insertion: *const Insertion) -> i32;
    pub fn punctura_insertion_membrane(insertion: *const Insertion, membrane: i32, tick: *mut MembraneTick) -> i32;
    pub fn punctura_insertion_state_size(insertion: *const Insertion) -> usize;
    pub fn punctura_insertion_save(insertion: *const Insertion, state: *mut u8, size: usize) -> i32;
    pub fn punctura_insertion_restore(insertion: *mut Insertion, state: *const u8, size: usize) -> i32;

    pub fn punctura_sample_init(sample: *mut Sample, size: usize) -> i32;
    pub fn punctura_servo_new(scene: *const Scene, limits: *const c_void, servo: *mut *mut Servo) -> i32;
    pub fn punctura_servo_free(servo: *mut Servo);
    pub fn punctura_servo_arm(servo: *mut Servo) -> i32;
    pub fn punctura_servo_disarm(servo: *mut Servo) -> i32;
    pub fn punctura_servo_reset(servo: *mut Servo) -> i32;
    pub fn punctura_servo_step(servo: *mut Servo, sample: *const Sample, record: *mut Record) -> i32;
}
