// The part of Force Dimension's C interface that is used here, in our own declarations: names of functions, their types
// and their numbers are facts about the library, and nothing of its maker's is needed to build.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "punctura_runtime/backends/makers_library.hpp"

namespace punctura::force_dimension {

/// What most functions return. Below 0 is an error; all other values mean success, not 0 alone: see the two below.
inline constexpr int time_guard = 1;       ///< reading: asked again too soon, this is the sample before
inline constexpr int motor_saturated = 2;  ///< force: more than the motors have, scaled down in its direction

/// Of the thread that made the call, after it returned -1.
enum class ApiError : int {
  communication = 2,
  no_driver = 4,
  no_device = 5,
  timeout = 7,
  not_ready = 12,
  in_use = 20,
};

/// Places in the status array. Older libraries fill 16 of it, the present ones 17; 32 leaves room for newer ones.
inline constexpr std::size_t status_size = 32;
enum StatusIndex : std::size_t {
  status_reset = 3,  ///< 1: it does not know where it is until it is calibrated
  status_force = 5,  ///< 1: forces are on
  status_brake = 6,
  status_error = 9,             ///< 1: its controller reports a fault
  status_force_off_cause = 14,  ///< why forces went off the last time; it stays when they are on again
};

enum class ForceOffCause : int { none, button, velocity, watchdog, software, unplugged, dead_man };

/// The functions. A device's number is a `char` in every one; their own `bool` comes back in the low byte of a register
/// of which the rest means nothing, so it is taken as one byte here.
struct Api {
  int (*device_count)();     ///< all that are plugged in
  int (*available_count)();  ///< those that nobody has open
  int (*open)(char index);   ///< gives the device's number
  int (*close)(char id);
  int (*system_type)(char id);
  const char* (*system_name)(char id);
  int (*serial_number)(unsigned short* number, char id);
  void (*version)(int* major, int* minor, int* release, int* revision);
  unsigned char (*has_wrist)(char id);
  int (*status)(int* array, char id);
  int (*enable_force)(unsigned char on, char id);
  double (*max_force)(char id);  ///< N; below 0: its user has set none
  unsigned (*buttons)(char id);
  /// Position in m, orientation as rows of a rotation matrix.
  int (*read)(double* x, double* y, double* z, double (*frame)[3], char id);
  /// N, N m and N. Gravity compensation is part of this call, so it has to be made in every tick.
  int (*write)(double fx, double fy, double fz, double tx, double ty, double tz, double grip, char id);
  int (*last_error)();
  const char* (*error_text)(int error);

  // Of the robotics library alone; null where only the haptics library was found.
  int (*robot_open)(char index);
  int (*robot_close)(char id);
  int (*robot_auto_init)(char id);  ///< moves the arm by itself
};

struct Loaded : LoadedLibrary {
  Api api{};  ///< all functions, if it is `available`
};

/// named: a path; if empty, that of the environment variable PUNCTURA_DRD_LIBRARY; else where the maker's installer and
/// its users put it. The robotics library comes first: it holds all of the haptics library.
Loaded load(const std::string& named = {});

/// The files and names that are tried, in this order.
std::vector<std::string> candidates();
/// The folders in which files of such names are looked for, whether they exist or not.
std::vector<std::string> searched_folders();

}  // namespace punctura::force_dimension
