// Made by tools/make_c_bindings.py, from punctura.h.
#![allow(dead_code)]

use std::os::raw::{c_char, c_void};

pub const ABI: i32 = 1;
pub const OK: i32 = 0;
pub const BAD_ARGUMENT: i32 = 1;
pub const BAD_SCENE: i32 = 2;
pub const BAD_STATE: i32 = 3;
pub const NO_PEEK: i32 = 4;
pub const NO_NUMBER: i32 = 5;
pub const NO_MEMORY: i32 = 6;
pub const NOT_BUILT: i32 = 7;
pub const INTERNAL: i32 = 8;

#[repr(C)]
pub struct Scene {
    _opaque: [u8; 0],
}

#[repr(C)]
pub struct Insertion {
    _opaque: [u8; 0],
}

#[repr(C)]
pub struct Servo {
    _opaque: [u8; 0],
}

/// One membrane in a tick.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct MembraneTick {
    pub(crate) struct_size: usize,
    /// 0 outside, 1 sticking, 2 sliding_in, 3 sliding_out, 4 barred
    pub phase: i32,
    /// m, of the band
    pub depth: f64,
    /// N, along the needle
    pub axial_force: f64,
    /// lower, upper: the band, N
    pub lower: f64,
    pub upper: f64,
    /// m
    pub proxy: [f64; 3],
    /// of the needle at entry, valid while inside
    pub direction: [f64; 3],
}

/// The reading of the device in a tick. punctura_sample_init() gives a healthy sample with the axis (0, -1, 0).
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct Sample {
    pub(crate) struct_size: usize,
    /// number of the reading: an equal number is the same reading
    pub sequence: u64,
    /// start of the tick, s, on a clock that never goes back, and goes on while the computer sleeps: on Linux CLOCK_BOOTTIME
    pub time: f64,
    /// of the tip, m
    pub position: [f64; 3],
    /// direction of the needle, of length 1
    pub axis: [f64; 3],
    /// one bit for each button
    pub buttons: u32,
    /// 0: the device reports a fault
    pub is_healthy: i32,
    /// 1 is the maker's danger limit; 0 if it is not reported
    pub motor_temperature: f64,
    /// depth of the thumb on the plunger, m
    pub thumb: f64,
}

/// The record of a tick.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct Record {
    pub(crate) struct_size: usize,
    pub tick: u64,
    /// 0 disarmed, 1 waiting, 2 active, 3 faulted
    pub state: i32,
    /// 0: none. punctura_fault_text() says what to do
    pub fault: i32,
    /// 0 none, 1 ramp, 2 peak, 3 continuous, 4 temperature
    pub limit: i32,
    pub membrane_count: u32,
    /// the conditioned position, m
    pub tip: [f64; 3],
    /// N, without scale and limits
    pub model_force: [f64; 3],
    /// N, for the device
    pub force: [f64; 3],
    pub force_scale: f64,
    /// the largest force that all limits permit in this tick, N
    pub ceiling: f64,
    /// N, for the device under the thumb, before its own limits
    pub thumb_force: f64,
    /// plunger, plunger_force, pressure, left: m, N, Pa, m^3; NaN without a syringe
    pub plunger: f64,
    pub plunger_force: f64,
    pub pressure: f64,
    pub left: f64,
}

extern "C" {
    pub fn punctura_supports_abi(abi: i32) -> i32;
    pub fn punctura_status_text(status: i32) -> *const c_char;
    pub fn punctura_last_error() -> *const c_char;
    pub fn punctura_scene_from_toml(text: *const c_char, size: usize, scene: *mut *mut Scene) -> i32;
    pub fn punctura_scene_from_values(text: *const c_char, size: usize, scene: *mut *mut Scene) -> i32;
    pub fn punctura_scene_copy(scene: *const Scene, copy: *mut *mut Scene) -> i32;
    pub fn punctura_scene_free(scene: *mut Scene);
    pub fn punctura_scene_set(scene: *mut Scene, path: *const c_char, value: f64) -> i32;
    pub fn punctura_scene_get(scene: *const Scene, path: *const c_char, value: *mut f64) -> i32;
    pub fn punctura_scene_set_word(scene: *mut Scene, path: *const c_char, word: *const c_char) -> i32;
    pub fn punctura_scene_unusual(scene: *const Scene) -> *const c_char;
    pub fn punctura_insertion_new(scene: *const Scene, insertion: *mut *mut Insertion) -> i32;
    pub fn punctura_insertion_free(insertion: *mut Insertion);
    pub fn punctura_insertion_reset(insertion: *mut Insertion) -> i32;
    pub fn punctura_insertion_step(insertion: *mut Insertion, position: *const f64, axis: *const f64, force: *mut f64) -> i32;
    pub fn punctura_insertion_peek(insertion: *mut Insertion, position: *const f64, axis: *const f64, force: *mut f64) -> i32;
    pub fn punctura_insertion_commit(insertion: *mut Insertion) -> i32;
    pub fn punctura_insertion_membrane_count(insertion: *const Insertion) -> i32;
    pub fn punctura_insertion_membrane(insertion: *const Insertion, membrane: i32, tick: *mut MembraneTick) -> i32;
    pub fn punctura_insertion_state_size(insertion: *const Insertion) -> usize;
    pub fn punctura_insertion_save(insertion: *const Insertion, state: *mut c_void, size: usize) -> i32;
    pub fn punctura_insertion_restore(insertion: *mut Insertion, state: *const c_void, size: usize) -> i32;
    pub fn punctura_sample_init(sample: *mut Sample, size: usize) -> i32;
    pub fn punctura_fault_text(fault: i32) -> *const c_char;
    pub fn punctura_servo_new(scene: *const Scene, limits: *const c_void, servo: *mut *mut Servo) -> i32;
    pub fn punctura_servo_free(servo: *mut Servo);
    pub fn punctura_servo_arm(servo: *mut Servo) -> i32;
    pub fn punctura_servo_disarm(servo: *mut Servo) -> i32;
    pub fn punctura_servo_reset(servo: *mut Servo) -> i32;
    pub fn punctura_servo_step(servo: *mut Servo, sample: *const Sample, record: *mut Record) -> i32;
}
