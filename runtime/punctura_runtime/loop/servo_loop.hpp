// Runs a servo step on a device.
#pragma once

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <limits>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "punctura/device/device.hpp"
#include "punctura/device/placement.hpp"
#include "punctura/syringe/plunger.hpp"
#include "punctura_runtime/loop/histogram.hpp"
#include "punctura_runtime/loop/step_maker.hpp"
#include "punctura_runtime/loop/thumb_loop.hpp"
#include "punctura_runtime/loop/watch_thread.hpp"
#include "punctura_runtime/os/os.hpp"
#include "punctura_runtime/ring/handover.hpp"
#include "punctura_runtime/ring/snapshot_ring.hpp"

namespace punctura {

struct LoopSettings {
  GateLimits gate{};
  ForceLimits limits{};
  Placement placement{};
  std::size_t history = 1000;                      ///< snapshots kept before a fault
  std::shared_ptr<ThumbLoop> thumb{};              ///< a second device, which holds the plunger of the scene's syringe
  std::int64_t (*now_ns)() noexcept = os::now_ns;  ///< tests replace it
  StepMaker model{};                               ///< the scene's, or any other
};

/// Statistics of a loop, over all its runs.
struct LoopReport {
  std::uint64_t ticks = 0;
  std::uint64_t late = 0;       ///< ticks that came more than half a period late
  Histogram::Counts period{};   ///< from the start of one tick to the start of the next, ns
  Histogram::Counts compute{};  ///< from the start of a tick to its end, ns
  std::uint64_t largest_period_ns = 0, largest_compute_ns = 0;
};

/// Copies a snapshot without its unused membranes.
void copy(const Snapshot& from, Snapshot& to) noexcept;

/// Starts, arms, pauses, resets and stops a run, and changes its scene. The ticks run on the device's thread.
///
/// A run also ends by itself: after its duration, or when ticks cease. In both cases a thread of the loop stops the
/// device; and from the end of the duration on the ticks themselves give no force.
///
/// A tick takes commands and a new scene, and never takes a lock: snapshots go to rings that drop rather than wait,
/// durations to histograms of atomics.
///
/// Threads: all calls are allowed from any thread at the same time, with these exceptions. listen() must come before
/// start(), on the same thread. exchange() changes what scene() and model() refer to: call them on one thread;
/// copy_scene() can be called on any. stop() waits for a running start(), never for an exchange(). While the loop is
/// destroyed, only stop_all() may be running.
class ServoLoop {
 public:
  /// The period is the device's, not the scene's. The device's force ratings tighten the limits. Throws SceneError.
  ServoLoop(std::shared_ptr<Device> device, Scene scene, LoopSettings settings = {});
  ~ServoLoop();
  ServoLoop(const ServoLoop&) = delete;
  ServoLoop& operator=(const ServoLoop&) = delete;

  static constexpr double listening_s = 8;  ///< default length of a ring, if most_bytes allows

  /// The default capacity of a ring, in ticks of the present scene.
  std::size_t room() const;

  /// Before start(). Gives a ring that gets every tick's snapshot. Its capacity is in snapshots of the present scene,
  /// and at most SnapshotRing::most_bytes.
  SnapshotRing& listen(std::size_t capacity);
  SnapshotRing& listen() { return listen(room()); }

  static constexpr double endless = std::numeric_limits<double>::infinity();
  void start(double duration = endless);  ///< disarmed; duration: s. Throws DeviceError, invalid_argument
  void stop() noexcept;                   ///< zero force, then no more ticks
  /// Arms, starts, waits until the run is over, the device ends or a fault is latched, and stops. Throws as start().
  void run(double duration = endless);
  bool running() const noexcept { return running_; }
  /// Whether the last start()'s run has ended by itself. Its device may still be stopping.
  bool over() const noexcept { return over_; }
  /// Why ticks that ceased have ended the run, for the user; otherwise empty.
  std::string silence() const;
  /// Stops all loops at the end of the program. First their next ticks give no force: one that cannot be stopped leaves
  /// no other one with force.
  static void stop_all() noexcept;

  void arm() noexcept { ask(arm_bit); }      ///< force from the moment when the tip is outside tissue
  void pause() noexcept { ask(pause_bit); }  ///< no force; ticks continue
  void reset() noexcept;                     ///< clears a fault; disarmed

  /// A simulated thumb pushes the plunger with this force, N, from 0 to strongest_thumb. Without a call, the thumb is
  /// that of the sample. With a thumb device, it is that of the device, and this call has no effect.
  void push_plunger(double force) noexcept {
    wanted_thumb_.store(force > 0 ? std::min(force, strongest_thumb) : 0.0, std::memory_order_relaxed);
  }

  /// Changes the scene, also while running: builds it here; the next tick takes it and fades it in. Throws SceneError
  /// and then changes nothing. model: from now on; without it, the present one stays.
  void exchange(Scene scene);
  void exchange(Scene scene, StepMaker model);

  Device& device() noexcept { return *device_; }
  ThumbLoop* thumb() noexcept { return settings_.thumb.get(); }
  const Scene& scene() const noexcept { return scene_; }
  const GateLimits& gate() const noexcept { return settings_.gate; }
  const ForceLimits& limits() const noexcept { return settings_.limits; }
  const StepMaker& model() const noexcept { return settings_.model; }
  Scene copy_scene() const;
  double force_scale() const noexcept { return force_scale_; }  ///< of scene(): how much of the model's force is given
  /// The force budget that the motors have spent by the next start(), N^2 s: see ForceBudget. Not while the loop runs.
  double spent();
  LoopReport report() const noexcept;
  Snapshot latest();                      ///< of the last tick
  std::vector<Snapshot> fault_history();  ///< the snapshots up to the latched fault, oldest first; empty without one

 private:
  static Tick::Force call(void* self, const DeviceSample& sample) noexcept;
  Tick::Force tick(const DeviceSample& sample) noexcept;
  bool look() noexcept;
  void halt() noexcept;
  void end_run() noexcept;
  double spent_with_the_last_force(double now) noexcept;
  Tick::Force after_the_end(std::int64_t now) noexcept;
  void stop_thumb() noexcept;
  double rested();
  double seconds() const noexcept { return static_cast<double>(settings_.now_ns()) * 1e-9; }
  double thumb_depth(const DeviceSample& sample) noexcept;
  void take() noexcept;
  void obey() noexcept;
  void offer(std::unique_ptr<AnyStep> step, Scene scene);
  void remember(const Snapshot& snapshot) noexcept;
  void ask(std::uint32_t bit) noexcept { asked_.fetch_or(bit, std::memory_order_release); }
  std::unique_ptr<AnyStep> built(const Scene& scene, const StepMaker& model) const;

  static constexpr std::uint32_t arm_bit = 1, pause_bit = 2, reset_bit = 4;
  static constexpr std::int64_t never_ = std::numeric_limits<std::int64_t>::max();

  std::shared_ptr<Device> device_;
  Scene scene_;
  std::atomic<double> force_scale_;
  LoopSettings settings_;
  double period_;
  Placer placer_;
  bool placed_;  ///< false for the default placement: samples and forces then pass unchanged
  std::atomic<bool> running_{false};
  bool thumb_runs_ = false;           ///< this loop has started the thumb's device
  bool rest_counted_ = false;         ///< the time since the last run has been counted as rest
  std::atomic<bool> halting_{false};  ///< the device is being stopped: no force of a tick counts from now on

  // Used by the ticking thread; between runs, by the holder of between_ticks_.
  std::unique_ptr<AnyStep> step_;
  std::int64_t last_begin_ = 0;
  std::vector<Snapshot> history_;
  std::uint64_t remembered_ = 0;
  double simulated_thumb_ = 0;  ///< m
  double held_square_ = 0;      ///< the square of the last force that a tick gave before halting_, N^2
  bool withdrawn_ = false;      ///< a tick returned after halting_: its force was not given

  // Shared between threads.
  std::int64_t ends_at_ = never_;  ///< ns; set before the first tick
  std::atomic<bool> over_{false};
  std::atomic<double> silent_s_{0}, thumb_silent_s_{0};  ///< what ended the run; 0: it did not
  std::atomic<std::uint32_t> asked_{0};
  std::atomic<double> wanted_thumb_{not_given};  ///< N; NaN: no simulated thumb
  std::atomic<bool> frozen_{false};              ///< a fault is latched: history_ is no longer written
  std::atomic<std::uint64_t> ticks_{0}, late_{0};
  Handover<AnyStep> handover_;
  TripleBuffer<Snapshot> latest_;
  std::vector<std::unique_ptr<SnapshotRing>> listeners_;
  Histogram period_times_, compute_times_;
  std::mutex starting_or_stopping_;   ///< held while the device starts or stops, which may take long
  mutable std::mutex between_ticks_;  ///< guards running_ and the offer of scenes; held for a short time only
  std::mutex readers_;                ///< guards readers against each other; not used by the tick

  // Used by look().
  TickWatch ticks_watch_, thumb_watch_;
  WatchThread watch_;  ///< last: it ends before all that it uses
};

}  // namespace punctura
