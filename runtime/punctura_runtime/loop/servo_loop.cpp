#include "punctura_runtime/loop/servo_loop.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstring>
#include <thread>

#include "punctura_runtime/loop/motor_rest.hpp"

namespace punctura {

void copy(const Snapshot& from, Snapshot& to) noexcept {
  std::memcpy(static_cast<void*>(&to), &from, used_bytes(from.membrane_count));
}

namespace {

/// All loops of this program. No loop is destroyed while the lock is held.
struct Loops {
  std::mutex mutex;
  std::vector<ServoLoop*> loops;
};
Loops& all_loops() {
  static auto& all = *new Loops;  // never destroyed
  return all;
}

}  // namespace

ServoLoop::ServoLoop(std::shared_ptr<Device> device, Scene scene, LoopSettings settings)
    : device_(std::move(device)),
      scene_(std::move(scene)),
      force_scale_(1),
      settings_(settings),
      period_(1 / device_->info().rate),
      placer_(settings.placement),
      placed_(settings.placement != Placement{}) {
  if (auto problems = check(settings.placement); !problems.empty()) throw SceneError(std::move(problems));
  if (settings.thumb && &settings.thumb->device() == device_.get())
    throw std::invalid_argument("the thumb needs a device of its own, not the needle's");
  settings_.limits = tightened(settings_.limits, device_->info());
  step_ = built(scene_, settings_.model);
  force_scale_ = step_->guard().force_scale();
  scene_.servo.rate = device_->info().rate;
  history_.resize(settings_.history);
  auto& [mutex, loops] = all_loops();
  const std::lock_guard lock(mutex);
  loops.push_back(this);
}

ServoLoop::~ServoLoop() {
  stop();
  {
    auto& [mutex, loops] = all_loops();
    const std::lock_guard lock(mutex);  // waits for a stop_all() that may be using this loop
    std::erase(loops, this);
  }
}

std::unique_ptr<AnyStep> ServoLoop::built(const Scene& scene, const StepMaker& model) const {
  Scene at_rate = scene;
  at_rate.servo.rate = device_->info().rate;
  return model(at_rate, settings_.gate, settings_.limits);
}

Scene ServoLoop::copy_scene() const {
  const std::lock_guard lock(between_ticks_);
  return scene_;
}

std::size_t ServoLoop::room() const {
  const std::lock_guard lock(between_ticks_);
  const auto wanted = static_cast<std::size_t>(listening_s * device_->info().rate);
  return std::min(wanted, SnapshotRing::most_snapshots(scene_.membranes.size()));
}

SnapshotRing& ServoLoop::listen(std::size_t capacity) {
  if (running_) throw std::logic_error("listen() must come before start()");
  const std::lock_guard lock(between_ticks_);
  listeners_.push_back(std::make_unique<SnapshotRing>(capacity, scene_.membranes.size()));
  return *listeners_.back();
}

void ServoLoop::start(double duration) {
  if (!(duration >= 0)) throw std::invalid_argument("duration must be 0 s or more");
  const std::lock_guard one(starting_or_stopping_);
  if (settings_.now_ns() >= ends_at_) halt();  // the run is over, and its end has not been noticed yet
  {
    const std::lock_guard lock(between_ticks_);
    if (running_) return;
    running_ = true;
    last_begin_ = 0;
    step_->guard().set_spent(rested());
    rest_counted_ = false;
    if (ticks_ != 0 && step_->guard().fault() == Fault::none)
      ask(reset_bit);  // do not take the motion since the last run for one of this run
    over_ = false;
    silent_s_ = thumb_silent_s_ = 0;
    halting_ = withdrawn_ = false;
    held_square_ = 0;
    ends_at_ = duration < 1e9 ? settings_.now_ns() + static_cast<std::int64_t>(duration * 1e9) : never_;
  }
  const std::uint64_t ticks = ticks_, thumb_ticks = settings_.thumb ? settings_.thumb->ticks() : 0;
  try {
    watch_.start([this] { return look(); });
    if (settings_.thumb) {
      settings_.thumb->start();
      thumb_runs_ = true;
    }
    device_->start({&ServoLoop::call, this, settings_.limits.max_force});
    const std::int64_t now = settings_.now_ns();  // a device may take long to start: that is no silence
    ticks_watch_.begin(ticks, now);
    thumb_watch_.begin(thumb_ticks, now);
  } catch (...) {
    stop_thumb();
    end_run();
    throw;
  }
}

void ServoLoop::stop() noexcept {
  const std::lock_guard one(starting_or_stopping_);
  watch_.stop();
  halt();
}

void ServoLoop::run(double duration) {
  arm();
  start(duration);
  const auto faulted = [this] { return frozen_ && (asked_ & reset_bit) == 0; };
  while (!over_ && !faulted() && !device_->finished()) std::this_thread::sleep_for(std::chrono::milliseconds(10));
  stop();
}

void ServoLoop::stop_all() noexcept {
  auto& [mutex, loops] = all_loops();
  const std::lock_guard lock(mutex);
  for (ServoLoop* loop : loops)
    if (loop->running_) loop->pause();
  for (ServoLoop* loop : loops) loop->stop();
}

/// Takes a new scene, between two ticks or while the loop does not run.
void ServoLoop::take() noexcept {
  if (AnyStep* next = handover_.take()) {
    next->resume(*step_);
    handover_.retire(step_.release());
    step_.reset(next);
  }
}

void ServoLoop::reset() noexcept {
  const std::lock_guard lock(readers_);  // nobody reads the history while a reset lets it continue
  ask(reset_bit);
}

void ServoLoop::exchange(Scene scene) {
  auto step = built(scene, settings_.model);
  offer(std::move(step), std::move(scene));
}

void ServoLoop::exchange(Scene scene, StepMaker model) {
  auto step = built(scene, model);
  settings_.model = std::move(model);
  offer(std::move(step), std::move(scene));
}

/// The next tick takes this step of a scene.
void ServoLoop::offer(std::unique_ptr<AnyStep> step, Scene scene) {
  scene.servo.rate = device_->info().rate;
  {
    const std::lock_guard lock(between_ticks_);
    scene_ = std::move(scene);
    force_scale_ = step->guard().force_scale();
    handover_.offer(std::move(step));
    if (!running_) take();
  }
  // Takes a few ticks at most. Without the lock, so that stop() need not wait; bounded, in case the device no longer
  // ticks.
  for (int i = 0; i < 200 && handover_.pending(); ++i) std::this_thread::sleep_for(std::chrono::milliseconds(1));
  const std::lock_guard lock(between_ticks_);
  handover_.collect();
}

LoopReport ServoLoop::report() const noexcept {
  return {ticks_.load(),
          late_.load(),
          period_times_.counts(),
          compute_times_.counts(),
          period_times_.largest_ns(),
          compute_times_.largest_ns()};
}

Snapshot ServoLoop::latest() {
  const std::lock_guard lock(readers_);
  return latest_.read();
}

std::vector<Snapshot> ServoLoop::fault_history() {
  const std::lock_guard lock(readers_);
  std::vector<Snapshot> all;
  // In this order: a tick that does a reset clears `frozen_` before it clears the request.
  if ((asked_.load(std::memory_order_acquire) & reset_bit) != 0 || !frozen_.load(std::memory_order_acquire)) return all;
  const std::uint64_t kept = std::min<std::uint64_t>(remembered_, history_.size());
  for (std::uint64_t i = remembered_ - kept; i < remembered_; ++i) all.push_back(history_[i % history_.size()]);
  return all;
}

Tick::Force ServoLoop::call(void* self, const DeviceSample& sample) noexcept {
  return static_cast<ServoLoop*>(self)->tick(sample);
}

Tick::Force ServoLoop::tick(const DeviceSample& sample) noexcept {
  const std::int64_t begin = settings_.now_ns();
  if (begin >= ends_at_) return after_the_end(begin);
  take();
  obey();

  DeviceSample in_scene = placed_ ? placer_.to_scene(sample) : sample;
  in_scene.thumb = thumb_depth(sample);
  if (settings_.thumb) in_scene.thumb_felt = settings_.thumb->force();
  const Snapshot& snapshot = step_->step(in_scene);
  if (halting_) {
    withdrawn_ = true;
    last_begin_ = begin;                                  // until then the step has counted the force before
    if (snapshot.fault == Fault::none) return {0, 0, 0};  // no record of a force that the hand never gets
  }
  if (settings_.thumb)
    settings_.thumb->give(step_->guard().thumb_force(),
                          snapshot.state == ServoState::active && step_->guard().syringe().has_value());
  remember(snapshot);
  latest_.write([&](Snapshot& to) { copy(snapshot, to); });
  for (auto& ring : listeners_) ring->push(snapshot);

  if (last_begin_ != 0) {
    const std::int64_t period = begin - last_begin_;
    period_times_.add(period);
    if (static_cast<double>(period) * 1e-9 > 1.5 * period_) late_.fetch_add(1, std::memory_order_relaxed);
  }
  last_begin_ = begin;
  if (!withdrawn_) held_square_ = to_vector(snapshot.force).squaredNorm();
  ticks_.fetch_add(1, std::memory_order_relaxed);
  const Tick::Force force = placed_ ? placer_.to_device(snapshot.force) : snapshot.force;
  compute_times_.add(settings_.now_ns() - begin);
  return force;
}

/// A tick after the duration: no force, no record, until the device has stopped.
Tick::Force ServoLoop::after_the_end(std::int64_t now) noexcept {
  if (last_begin_ != 0) step_->guard().end(static_cast<double>(now - last_begin_) * 1e-9);
  last_begin_ = 0;
  if (settings_.thumb) settings_.thumb->give(0, false);
  return {0, 0, 0};
}

/// The depth of the thumb on the plunger in this tick, m.
double ServoLoop::thumb_depth(const DeviceSample& sample) noexcept {
  if (!step_->guard().syringe()) return 0;
  if (settings_.thumb) return settings_.thumb->depth();
  const double wanted = wanted_thumb_.load(std::memory_order_relaxed);
  if (std::isnan(wanted)) return sample.thumb;
  if (step_->guard().fault() == Fault::none)
    simulated_thumb_ = Thumb{}.step(simulated_thumb_, wanted, step_->guard().syringe()->plunger.force(), period_);
  return simulated_thumb_;
}

void ServoLoop::obey() noexcept {
  const std::uint32_t asked = asked_.load(std::memory_order_acquire);
  if (asked == 0) return;
  if (asked & reset_bit)
    frozen_.store(false, std::memory_order_relaxed);  // before the request is cleared: see fault_history()
  asked_.fetch_and(~asked, std::memory_order_acq_rel);
  if (asked & reset_bit) {
    step_->reset();
    if (settings_.thumb) settings_.thumb->reset();
    simulated_thumb_ = 0;  // the reset fills the syringe
    remembered_ = 0;
  }
  if (asked & arm_bit) step_->guard().arm();
  if (asked & pause_bit) step_->guard().disarm();
}

void ServoLoop::remember(const Snapshot& snapshot) noexcept {
  if (history_.empty() || frozen_.load(std::memory_order_relaxed)) return;
  copy(snapshot, history_[remembered_ % history_.size()]);
  ++remembered_;
  if (snapshot.fault != Fault::none) frozen_.store(true, std::memory_order_release);
}

}  // namespace punctura
