// A scene on a device: the servo step, tick after tick, and what other threads may ask of it.
#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <mutex>
#include <vector>

#include "punctura/device/device.hpp"
#include "punctura/device/placement.hpp"
#include "punctura/scene/build.hpp"
#include "punctura_runtime/loop/histogram.hpp"
#include "punctura_runtime/os/os.hpp"
#include "punctura_runtime/ring/handover.hpp"
#include "punctura_runtime/ring/latest.hpp"
#include "punctura_runtime/ring/snapshot_ring.hpp"

namespace punctura {

struct LoopSettings {
  GateLimits gate{};
  ForceLimits limits{};
  Placement placement{};
  std::size_t history = 1000;                      ///< snapshots kept for a fault
  std::int64_t (*now_ns)() noexcept = os::now_ns;  ///< tests put a clock of their own here
};

/// What a loop has done so far.
struct LoopReport {
  std::uint64_t ticks = 0;
  std::uint64_t late = 0;       ///< ticks that came more than half a period late
  Histogram::Counts period{};   ///< from one tick's begin to the next's, ns
  Histogram::Counts compute{};  ///< from a tick's begin to its end, ns
  std::uint64_t largest_period_ns = 0, largest_compute_ns = 0;
};

/// Copies a snapshot without the membranes that it does not have.
void copy(const Snapshot& from, Snapshot& to) noexcept;

/// Start, arm, pause, reset, stop, and a new scene; the ticks come on the device's thread.
///
/// A tick takes commands and a new scene between two steps, and pays for nothing else: records go to rings that lose rather than
/// wait, durations to histograms of atomics. It never takes a lock.
///
/// Threads: every call may come from any thread while others call too, except these. listen() comes before start(), from the thread
/// that starts. What scene() refers to is changed by exchange(): call both from one thread. stop() waits for a start() that is under
/// way, never for an exchange(). Nothing but stop_all() may still be under way when the loop is destroyed.
class ServoLoop {
 public:
  /// The period is that of the device, whatever rate the scene asks for; a device's own force ratings tighten the limits. Throws SceneError.
  ServoLoop(std::shared_ptr<Device> device, Scene scene, LoopSettings settings = {});
  ~ServoLoop();
  ServoLoop(const ServoLoop&) = delete;
  ServoLoop& operator=(const ServoLoop&) = delete;

  static constexpr double listening_s = 8;  ///< of ticks that a ring has room for, where most_bytes suffices

  /// How many ticks of the present scene a ring has room for where nobody asks for another number.
  std::size_t room() const noexcept;

  /// Before start(): every tick's snapshot goes into this ring, which has room for that many of the present scene, or for as many
  /// as SnapshotRing::most_bytes hold.
  SnapshotRing& listen(std::size_t capacity);
  SnapshotRing& listen() { return listen(room()); }

  void start();          ///< ticks come, disarmed. Throws DeviceError
  void stop() noexcept;  ///< zero force, then no tick any more
  bool running() const noexcept { return running_; }
  static void stop_all() noexcept;  ///< every loop of this program: for its end, whoever still holds them

  void arm() noexcept { ask(arm_bit); }      ///< force, once the tip is outside tissue
  void pause() noexcept { ask(pause_bit); }  ///< no force; ticks go on
  void reset() noexcept;                     ///< leaves a fault; disarmed

  /// A scene changed while running: built here, taken between two ticks, faded in. Throws SceneError, and then nothing has changed.
  void exchange(Scene scene);

  Device& device() noexcept { return *device_; }
  const Scene& scene() const noexcept { return scene_; }
  const GateLimits& gate() const noexcept { return settings_.gate; }
  const ForceLimits& limits() const noexcept { return settings_.limits; }
  /// What the device's motors have given when the next start() begins, N^2 s: see ForceBudget. Not while the loop runs.
  double spent();
  LoopReport report() const noexcept;
  Snapshot latest();  ///< the last tick's
  std::vector<Snapshot>
  fault_history();  ///< the last snapshots up to the fault that is latched, oldest first; empty without one

 private:
  static Tick::Force call(void* self, const DeviceSample& sample) noexcept;
  Tick::Force tick(const DeviceSample& sample) noexcept;
  void end_run() noexcept;
  double rested();
  double seconds() const noexcept { return static_cast<double>(settings_.now_ns()) * 1e-9; }
  void take() noexcept;
  void obey() noexcept;
  void remember(const Snapshot& snapshot) noexcept;
  void ask(std::uint32_t bit) noexcept { asked_.fetch_or(bit, std::memory_order_release); }
  std::unique_ptr<ServoStep> built(const Scene& scene) const;

  static constexpr std::uint32_t arm_bit = 1, pause_bit = 2, reset_bit = 4;

  std::shared_ptr<Device> device_;
  Scene scene_;
  LoopSettings settings_;
  double period_;
  Placer placer_;
  bool placed_;  ///< a placement other than the default: without one, samples and forces pass to the last bit
  std::atomic<bool> running_{false};
  bool rest_counted_ = false;  ///< the time since the last run; start() begins with what spent() has said

  // Of the ticking thread; while none ticks, of whoever has between_ticks_.
  ServoStep* step_;
  std::int64_t last_begin_ = 0;
  std::vector<Snapshot> history_;
  std::uint64_t remembered_ = 0;

  // Between the threads.
  std::atomic<std::uint32_t> asked_{0};
  std::atomic<bool> frozen_{false};  ///< a fault is latched: history_ is not written any more
  std::atomic<std::uint64_t> ticks_{0}, late_{0};
  Handover<ServoStep> handover_;
  Latest<Snapshot> latest_;
  std::vector<std::unique_ptr<SnapshotRing>> listeners_;
  Histogram period_times_, compute_times_;
  std::mutex starting_or_stopping_;  ///< held while the device starts or stops, which may take long
  std::mutex between_ticks_;         ///< running_ changes under it, and scenes are offered; held for a moment only
  std::mutex readers_;               ///< of those who ask, never of the tick
};

}  // namespace punctura
