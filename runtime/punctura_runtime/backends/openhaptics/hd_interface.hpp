// The C interface of the HD library of OpenHaptics, as far as we call it: our own declarations and names. The numbers
// are facts of that interface, known to hold for its versions 3.0 and 3.4. 64-bit only: there is one calling convention
// there.
#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "punctura_runtime/backends/makers_library.hpp"

namespace punctura::hd {

using DeviceHandle = std::uint32_t;
using OperationHandle = unsigned long;  // 8 bytes on 64-bit Linux and macOS, 4 on Windows: never keep it in fewer
using Operation = std::uint32_t (*)(void*);

inline constexpr DeviceHandle no_device = 0xFFFFFFFF;
inline constexpr std::uint32_t done = 0, again = 1;       ///< what an operation returns
inline constexpr std::uint16_t highest_priority = 65535;  ///< of operations within a scheduler tick

/// Given back by value.
struct ErrorInfo {
  std::uint32_t code;
  int internal;
  DeviceHandle device;
};
static_assert(sizeof(ErrorInfo) == 12);

/// Those that the code tells apart; hd_errors.cpp has all.
enum Error : std::uint32_t {
  success = 0x000,
  bad_handle = 0x104,
  warm_motors = 0x200,
  exceeded_max_velocity = 0x203,
  device_fault = 0x300,
  device_already_initiated = 0x301,
  invalid_license = 0x600,
};

enum Quantity : std::uint32_t {
  current_buttons = 0x2000,               ///< int, bits 0 to 3
  current_position = 0x2050,              ///< 3 double, mm
  current_transform = 0x2052,             ///< 16 double, by columns, translation in mm
  model_type = 0x2501,                    ///< string
  driver_version = 0x2502,                ///< string
  vendor = 0x2503,                        ///< string
  serial_number = 0x2504,                 ///< string
  input_dof = 0x2553,                     ///< int
  update_rate = 0x2600,                   ///< int, Hz
  nominal_max_stiffness = 0x2602,         ///< double, N/mm
  nominal_max_force = 0x2603,             ///< double, N
  nominal_max_continuous_force = 0x2604,  ///< double, N
  motor_temperature = 0x2605,             ///< up to 6 double, 0 to 1
  current_force = 0x2700,                 ///< 3 double, N; inside a frame only
};

inline constexpr std::uint32_t force_output = 0x4000;

enum Calibration : std::uint32_t {
  calibration_ok = 0x5000,
  calibration_needs_update = 0x5001,
  calibration_needs_manual_input = 0x5002,
};
enum CalibrationStyle : std::uint32_t { encoder_reset = 1, automatic = 2, inkwell = 4 };

/// The functions, found at run time.
struct Interface {
  DeviceHandle (*init_device)(const char* name);  ///< nullptr is the default device
  void (*disable_device)(DeviceHandle);
  void (*make_current_device)(DeviceHandle);
  void (*begin_frame)(DeviceHandle);
  void (*end_frame)(DeviceHandle);
  ErrorInfo (*get_error)();
  void (*enable)(std::uint32_t);
  void (*disable)(std::uint32_t);
  void (*get_integers)(std::uint32_t, int*);
  void (*get_doubles)(std::uint32_t, double*);
  void (*set_doubles)(std::uint32_t, const double*);
  const char* (*get_string)(std::uint32_t);
  std::uint32_t (*check_calibration)();
  std::uint32_t (*check_calibration_style)();
  void (*update_calibration)(std::uint32_t);
  void (*start_scheduler)();
  void (*stop_scheduler)();
  void (*set_scheduler_rate)(unsigned long hz);
  OperationHandle (*schedule)(Operation, void*, std::uint16_t priority);
  void (*unschedule)(OperationHandle);
};

/// The object of an operation. `bool call()` is called in each tick, until it returns false.
struct Work {
  std::atomic<bool> left{true};  ///< the scheduler's thread will not use it any more
};

/// Frees a Work if the scheduler has left it. Otherwise it stays for ever: a call that hangs in the driver may go on
/// later, and none of the library's functions waits for it.
struct FreeIfLeft {
  template <typename T>
  void operator()(T* work) const {
    if (work->left.load(std::memory_order_acquire)) return delete work;
    static auto& mutex = *new std::mutex;
    static auto& kept = *new std::vector<const Work*>;  // still reachable, for tools that look for leaks
    const std::lock_guard lock(mutex);
    kept.push_back(work);
  }
};
template <typename T>
using Lent = std::unique_ptr<T, FreeIfLeft>;

/// The operation itself.
template <typename T>
std::uint32_t call_work(void* lent) {
  T* const work = static_cast<T*>(lent);
  if (work->call()) return again;
  work->left.store(true, std::memory_order_release);  // last: it may be freed from now on
  return done;
}

template <typename T>
OperationHandle schedule(const Interface& hd, const Lent<T>& work) {
  work->left = false;
  return hd.schedule(&call_work<T>, work.get(), highest_priority);
}

/// Where the library is looked for when nobody names one, in this order.
std::vector<std::string> usual_places();

struct Loaded : LoadedLibrary {
  const Interface* functions =
      nullptr;  ///< valid for the rest of the process, one for each path; nullptr unless `available`
};

/// named: a path; if empty, that of the environment variable PUNCTURA_HD_LIBRARY; else the usual places.
Loaded load(const std::string& named = {});

}  // namespace punctura::hd
