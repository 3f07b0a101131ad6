// A fake Force Dimension library: the functions for tests that it exports beside the maker's functions.
//
// They are plain C, so that a test loads them in the way in which the back-end loads the maker's. All vectors are in
// the device's axes: x to the user, y right, z up.
#pragma once

#include <cstdint>

namespace punctura::fake_drd {

/// The failures that a test can trigger at a given time.
enum Injected : int {
  unplug,         ///< every call fails from then on, the motors have no power
  press_button,   ///< force off by the device's own button
  let_go,         ///< force off by the dead-man switch
  switched_off,   ///< force off by another program
  lose_zero,      ///< back to reset: it needs calibration
  fault_inside,   ///< its controller reports a fault, and switches force off
  failing_read,   ///< one reading returns -1
  failing_write,  ///< one force returns -1
  failing_status,
  nan_position,  ///< from then on
  leap,          ///< the position is 250 mm off from then on
  freeze,        ///< readings are not new any more

};

/// The simulated device. Defaults: one omega.3, calibrated, not in use, with at most 12 N.
struct Settings {
  int devices = 1;  ///< those after the first are somebody else's
  int in_use = 0;   ///< 1: the first is somebody else's, too
  int system_type = 33;
  int wrist = 0;
  int calibrated = 1;
  int starts_forces = 1;        ///< 0: enabling force has no effect until its button is pressed
  int repeat_every = 0;         ///< every so many readings one is not new; 0 is never
  int old_force_off_cause = 0;  ///< left over from before
  double user_max_force = -1;   ///< N
  double motor_force = 12;      ///< N, at which the motors saturate
  double brake_speed = 1e9;     ///< m/s at which the device brakes
  double watchdog = 0.010;      ///< s without a force command after which forces go off
  double frame[3][3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  double encoder_step = 0.055e-3, friction = 0.26, tremor = 3e-5;  ///< of the plant: m, N, m rms
  double transfer = 0;                                             ///< s that a reading takes
};

/// The hand's strokes, as in punctura::Strokes, from a given time on.
struct Strokes {
  double start[3], end[3];
  int count;
  double duration, rest, variation;
  std::uint64_t seed;
};

/// The state of the simulated device.
struct Report {
  std::int64_t now;             ///< ns
  std::int64_t last_force;      ///< when the motors last gave any force, ns
  std::int64_t injected;        ///< when what was injected happened, ns; 0: not yet
  double force[3];              ///< what the motors give now, N
  double sent[3];               ///< the last command, N
  double position[3];           ///< of the tip, m
  std::uint64_t reads, writes;  ///< calls
  int force_on, open, calibrations;
  int switched_on_by_writer;  ///< force was switched on by the thread that gave the last command
  int touched_safety;         ///< calls that change velocity threshold, watchdog, brakes or expert mode
};

/// The exported functions, by their names in the library.
struct Control {
  void (*reset)(const Settings*);    ///< fake_drd_reset: everything anew, time at 1 s, closed
  void (*virtual_time)(int on);      ///< fake_drd_virtual_time: time goes by fake_drd_advance alone
  std::int64_t (*now)();             ///< fake_drd_now, ns
  void (*advance)(std::int64_t to);  ///< fake_drd_advance: the plant moves on to that time
  void (*strokes)(const Strokes*);   ///< fake_drd_strokes: the hand begins them now
  void (*target)(double x, double y, double z);
  void (*buttons)(unsigned mask);
  void (*inject)(int what, std::int64_t at);  ///< fake_drd_inject
  void (*report)(Report*);
};

}  // namespace punctura::fake_drd
