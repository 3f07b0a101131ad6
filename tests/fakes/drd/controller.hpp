// The simulated device behind the fake library: a controller with its rules, and a plant in a hand.
#pragma once

#include <cmath>
#include <cstdint>
#include <mutex>
#include <optional>
#include <thread>
#include <variant>

#include "fake_drd.hpp"
#include "punctura/lab/plant/motion.hpp"
#include "punctura/lab/plant/plant.hpp"

namespace punctura::fake_drd {

class Controller {
 public:
  static constexpr std::int64_t step_ns = 125'000;  ///< of the plant: 8 kHz
  static constexpr int id = 5;                      ///< of the open device

  Controller() { reset({}); }

  std::mutex mutex;  ///< the real library may be called from any thread

  void reset(const Settings& settings);
  void use_virtual_time(bool on);
  std::int64_t now();
  void advance(std::int64_t to);
  void begin(const Strokes& strokes);
  void move_to(const Vector3d& position);
  void inject(int what, std::int64_t at) { injected_ = what, inject_at_ = at, happened_ = 0; }

  /// The maker's calls and their return values; -1 sets `error`.
  int open(int index);
  int close(int device);
  bool wrong(int device);
  int read(double (&position)[3]);
  int write(const double (&force)[3]);
  int enable_force(bool on);
  int status(int* array);
  int calibrate();

  Settings settings;
  unsigned buttons = 0;
  bool is_open = false, safety_touched = false;
  int calibrations = 0;
  Report report();

  static thread_local int error;

 private:
  int fail(int code) {
    error = code;
    return -1;
  }
  bool once(int what);
  void force_off(int cause);
  void happen();
  void step();
  void wait(double seconds);
  void catch_up();

  bool virtual_ = false;
  std::int64_t time_ = 0, plant_time_ = 0, motion_start_ = 0, last_write_ = 0, last_force_ = 0;
  std::int64_t inject_at_ = 0, happened_ = 0, real_offset_ = 0;
  int injected_ = -1;
  bool plugged_ = true, force_on_ = false, braking_ = false, reset_mode_ = false, fault_ = false;
  int cause_ = 0, once_ = -1;
  bool nan_ = false, leap_ = false, frozen_ = false;
  std::uint64_t reads_ = 0, writes_ = 0;
  std::thread::id writer_, switcher_;
  Vector3d sent_ = Vector3d::Zero(), given_ = Vector3d::Zero(), reading_ = Vector3d::Zero();
  DeviceDynamics dynamics_{};
  std::optional<Plant> plant_;
  std::variant<Target, StrokesMotion> motion_{Target(Vector3d::Zero())};
};

/// The one device of this library.
Controller& controller();

}  // namespace punctura::fake_drd
