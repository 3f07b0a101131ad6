#include "punctura_runtime/loop/thumb_loop.hpp"

#include <stdexcept>
#include <string>

#include "punctura/scene/check.hpp"
#include "punctura_runtime/loop/motor_rest.hpp"

namespace punctura {

namespace {

ThumbSettings checked(ThumbSettings settings, const DeviceInfo& info) {
  if (const double length = settings.direction.stableNorm(); !(length > 0 && std::isfinite(length)))
    throw std::invalid_argument("thumb direction must be three finite numbers, not all 0");
  settings.direction = settings.direction.stableNormalized();
  settings.limits = tightened(settings.limits, info);
  if (const auto problems = check(settings.gate, settings.limits); !problems.empty())
    throw std::invalid_argument("thumb " + problems[0].path + " " + problems[0].reason);
  return settings;
}

}  // namespace

ThumbLoop::ThumbLoop(std::shared_ptr<Device> device, const ThumbSettings& settings)
    : device_(std::move(device)),
      settings_(checked(settings, device_->info())),
      step_(settings_.direction, 1 / device_->info().rate, settings_.gate, settings_.limits) {}

ThumbLoop::~ThumbLoop() { stop(); }

void ThumbLoop::start() {
  if (running_.exchange(true)) throw DeviceError("the thumb's device runs in another loop: stop that one first");
  last_tick_ = last_given_ = never;
  active_ = false;
  reset();
  step_.set_spent(rested(*device_, settings_.limits, static_cast<double>(settings_.now_ns()) * 1e-9));
  try {
    device_->start({&ThumbLoop::call, this, settings_.limits.max_force});
  } catch (...) {
    running_ = false;
    throw;
  }
}

void ThumbLoop::stop() noexcept {
  if (!running_) return;
  active_ = false;
  device_->stop();
  running_ = false;
  const std::int64_t now = settings_.now_ns(), last = last_tick_.load();
  if (last != never) step_.end(static_cast<double>(now - last) * 1e-9);
  keep_spent(*device_, step_.spent(), static_cast<double>(now) * 1e-9);
  felt_ = 0;
}

void ThumbLoop::reset() noexcept {
  reset_at_.store(settings_.now_ns(), std::memory_order_relaxed);
  resets_.fetch_add(1, std::memory_order_release);
}

bool ThumbLoop::recent(const std::atomic<std::int64_t>& last) const noexcept {
  const std::int64_t then = last.load(std::memory_order_acquire);
  return then != never && static_cast<double>(settings_.now_ns() - then) * 1e-9 <= settings_.gate.deadline;
}

double ThumbLoop::depth() const noexcept {
  if (resets_.load(std::memory_order_acquire) !=
      resets_done_.load(std::memory_order_acquire))  // no tick since then: a driver may take a moment to its first one
    return settings_.now_ns() - reset_at_.load(std::memory_order_relaxed) <= first_tick_ns ? 0 : not_given;
  if (fault() != Fault::none) return not_given;
  if (!recent(last_tick_)) return not_given;
  return depth_.load(std::memory_order_relaxed);
}

void ThumbLoop::give(double force, bool active) noexcept {
  plunger_force_.store(force, std::memory_order_relaxed);
  active_.store(active, std::memory_order_relaxed);
  last_given_.store(settings_.now_ns(), std::memory_order_release);
}

Tick::Force ThumbLoop::call(void* self, const DeviceSample& sample) noexcept {
  return static_cast<ThumbLoop*>(self)->tick(sample);
}

Tick::Force ThumbLoop::tick(const DeviceSample& sample) noexcept {
  const std::uint32_t resets = resets_.load(std::memory_order_acquire);
  if (resets != resets_done_.load(std::memory_order_relaxed)) step_.reset();
  const bool active = recent(last_given_) && active_.load(std::memory_order_relaxed);
  const Vector3d force = step_.step(sample, active ? plunger_force_.load(std::memory_order_relaxed) : 0, active);
  depth_.store(step_.depth(), std::memory_order_relaxed);
  fault_.store(step_.fault(), std::memory_order_release);
  felt_.store(settings_.direction.dot(force), std::memory_order_relaxed);
  ticks_.fetch_add(1, std::memory_order_relaxed);
  last_tick_.store(settings_.now_ns(), std::memory_order_release);
  resets_done_.store(resets, std::memory_order_release);  // last: from now on depth() is this tick's
  return to_array(force);
}

}  // namespace punctura
