// The implementation of the fake: one device, one scheduler, one stack of errors. It may lock and allocate,
// unlike its callers.
#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <limits>
#include <mutex>
#include <thread>
#include <vector>

#include "fake_hd.h"
#include "punctura/lab/plant/motion.hpp"
#include "punctura/lab/plant/plant.hpp"

#ifdef _WIN32
#define EXPORT extern "C" __declspec(dllexport)
#else
#define EXPORT extern "C" __attribute__((visibility("default")))
#endif

namespace fake_hd {

using Operation = std::uint32_t (*)(void*);
inline constexpr std::uint32_t handle_given = 0x7FFF0003;

struct ErrorInfo {
  std::uint32_t code;
  int internal;
  std::uint32_t device;
};

/// The data of a tick.
struct Reading {
  std::array<double, 3> position{};    // mm
  std::array<double, 16> transform{};  // by columns
  int buttons = 0;
};

struct Scheduled {
  unsigned long handle;
  Operation operation;
  void* data;
  std::uint16_t priority;
};

struct Injected {
  int fault;
  unsigned value;
  unsigned long long first, ticks;
};

class Fake {
 public:
  static Fake& one();
  Fake();

  // fake_hd_control.cpp
  void reset(const fake_hd_settings& settings);
  void restart();

  // fake_hd_scheduler.cpp
  void start();
  void stop();
  unsigned long schedule(Operation operation, void* data, std::uint16_t priority);
  void unschedule(unsigned long handle);
  void synchronously(Operation operation, void* data);
  void set_rate(unsigned long hz);

  // fake_hd_frame.cpp
  void begin_frame(std::uint32_t device);
  void end_frame(std::uint32_t device);
  void set_force(const double* force);
  bool injected(int fault, unsigned* value = nullptr) const;
  void push(std::uint32_t code, int internal = 0);
  void misuse(std::uint32_t code);  // an error of the caller

  std::mutex state;              // for a moment only
  std::recursive_mutex calling;  // held while operations run
  fake_hd_settings settings{};
  std::string name;
  bool open = false, runs = false, force_output = false, frozen = false, unplugged = false, one_frame = true;
  std::uint32_t current = 0xFFFFFFFF;
  unsigned long rate = 1000;
  std::vector<ErrorInfo> errors;
  std::vector<Injected> faults;
  std::vector<fake_hd_record> records;
  unsigned long long misuses = 0;
  Reading reading, last;
  std::array<double, 3> wanted{}, held{};
  bool in_frame = false, framed = false;
  std::atomic<unsigned long long> tick{0}, spent{0};  // since restart; since reset
  std::atomic<long long> now{0};                      // ns
  std::vector<Scheduled> operations;

 private:
  void run();
  void one_tick(double seconds);
  void sense(const punctura::Desired& desired);
  void call_operations();
  void lay_out();
  double period() const;
  std::thread thread_;
  std::vector<Scheduled> called_;  // in this tick; reused, so that ticks allocate no memory
  std::atomic<bool> stopping_{false};
  // With an unsigned long of 64 bits the value does not fit into 32 bits, as in the real library.
  unsigned long next_ = std::numeric_limits<unsigned long>::max() / 0xFFFFFFFF;
  double laid_out_for_ = 0;  // s, the period of the plant
  std::vector<punctura::StrokesMotion> motion_;
  std::vector<punctura::Plant> plant_;
};

}  // namespace fake_hd
