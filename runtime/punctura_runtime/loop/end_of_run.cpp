// How a run of a ServoLoop ends, and what its motors have given by then.
#include "punctura/model/decimal.hpp"
#include "punctura_runtime/loop/motor_rest.hpp"
#include "punctura_runtime/loop/servo_loop.hpp"

namespace punctura {

/// From the watching thread. False if there is nothing more to watch.
bool ServoLoop::look() noexcept {
  const std::unique_lock one(starting_or_stopping_, std::try_to_lock);
  if (!one) return true;  // start() or stop() is at work, and may be waiting for this thread
  if (!running_) return false;
  const std::int64_t now = settings_.now_ns();
  silent_s_ = ticks_watch_.silent(ticks_, now, device_->longest_silence(), settings_.gate.deadline);
  if (ThumbLoop* thumb = settings_.thumb.get())
    thumb_silent_s_ =
        thumb_watch_.silent(thumb->ticks(), now, thumb->device().longest_silence(), thumb->gate().deadline);
  if (now < ends_at_ && silent_s_ == 0 && thumb_silent_s_ == 0) return true;
  over_ = true;  // first: a driver's stop may never return
  halt();
  return false;
}

std::string ServoLoop::silence() const {
  const double needle = silent_s_, thumb = thumb_silent_s_;
  if (!over_ || (needle == 0 && thumb == 0)) return {};
  return std::string(needle != 0 ? "the device's" : "the second device's") + " ticks have ceased, for " +
         decimal_text(needle != 0 ? needle : thumb, 2) +
         " s, and the run is stopped: should the device still pull, switch it off";
}

void ServoLoop::halt() noexcept {
  if (!running_) return;
  ask(pause_bit);
  halting_ = true;
  if (silent_s_ != 0) stop_thumb();  // first: the needle's stop waits for a tick that may never return
  device_->stop();
  stop_thumb();
  asked_.fetch_and(~(arm_bit | pause_bit));  // requests of the run that has ended
  end_run();
}

void ServoLoop::stop_thumb() noexcept {
  if (thumb_runs_) settings_.thumb->stop();
  thumb_runs_ = false;
}

/// After the last tick. Takes a scene that no tick has taken.
void ServoLoop::end_run() noexcept {
  const std::lock_guard lock(between_ticks_);
  running_ = false;
  const double now = seconds();
  keep_spent(*device_, spent_with_the_last_force(now), now);
  handover_.collect();
  take();
}

/// The device has held the last force that it got until now. If it gets zero force earlier, too much is counted.
double ServoLoop::spent_with_the_last_force(double now) noexcept {
  auto& guard = step_->guard();
  if (last_begin_ == 0) return guard.spent();
  const double held = now - static_cast<double>(last_begin_) * 1e-9;
  guard.end(withdrawn_ ? 0 : held);
  if (!withdrawn_) return guard.spent();
  ForceBudget budget(settings_.limits.continuous_time, settings_.limits.continuous_force);
  budget.set_spent(guard.spent());
  budget.spend(held_square_, held);
  return budget.spent();
}

double ServoLoop::spent() {
  const std::lock_guard lock(between_ticks_);
  return rested();
}

/// The time since the last run on this device counts as rest, until the first call. So a recorder that asks before
/// start() gets the value with which the run begins.
double ServoLoop::rested() {
  if (rest_counted_) return kept_spent(*device_);
  rest_counted_ = true;
  return punctura::rested(*device_, settings_.limits, seconds());
}

}  // namespace punctura
