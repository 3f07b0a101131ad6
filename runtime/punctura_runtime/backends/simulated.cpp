#include "punctura_runtime/backends/simulated.hpp"

#include "punctura_runtime/backends/backend.hpp"

namespace punctura {

namespace {

Desired desired_at(SimulatedDevice::Motion& motion, double time) noexcept {
  return std::visit([time](auto& m) { return m.at(time); }, motion);
}

}  // namespace

SimulatedDevice::SimulatedDevice(Motion motion, const SimulatedOptions& options)
    : ticks_(options.ticks),
      motion_(std::move(motion)),
      plant_(options.dynamics, options.hand, 1 / options.rate, options.seed),
      wish_{to_array(desired_at(motion_, 0).position), options.axis, 0},
      wishes_(wish_) {
  info_ = {"simulated", "PHANTOM Omni, simulated", "", true, 1, options.dynamics.max_force, Omni::continuous_force};
  info_.encoder_step = options.dynamics.encoder_step;
  info_.rate = options.rate;
  pacing_ = {options.real_time, options.real_time, options.realtime};
  plant_.place(to_vector(wish_.target));
}

void SimulatedDevice::move_to(const std::array<double, 3>& position) noexcept {
  wish_.target = position;
  wishes_.write([this](Wish& to) { to = wish_; });
}

void SimulatedDevice::point(const std::array<double, 3>& axis, std::uint32_t buttons) noexcept {
  wish_.axis = axis;
  wish_.buttons = buttons;
  wishes_.write([this](Wish& to) { to = wish_; });
}

SimulatedDevice::Next SimulatedDevice::read() noexcept {
  if (ticks_ != 0 && count() == ticks_) return Next::end;
  const Wish& wish = wishes_.read();
  if (Target* target = std::get_if<Target>(&motion_)) target->move_to(to_vector(wish.target));
  // The hand moves on the plant's own time, so that a late tick does not make it jump.
  desired_ = desired_at(motion_, static_cast<double>(count()) / info_.rate);
  sample_ = {count(), now(), to_array(plant_.measured()), wish.axis, wish.buttons, true};
  if (auto* how = spoiler_.exchange(nullptr)) how(sample_);
  return Next::tick;
}

SimulatedDevice::Next SimulatedDevice::write(const Tick::Force& force) noexcept {
  last_force_.write([&](std::array<double, 3>& to) { to = force; });
  plant_.step(to_vector(force), desired_);
  return Next::tick;
}

void SimulatedDevice::end() noexcept {
  desired_ = {plant_.tip(), Vector3d::Zero()};
  write({0, 0, 0});
}

/// In the registry: always available; its hand follows a target.
namespace {

BackendStatus simulated_status() {
  return {"simulated", BackendStatus::State::available, "A simulated PHANTOM Omni: no hardware.", {"PHANTOM Omni"}};
}

std::shared_ptr<Device> open_simulated(const OpenOptions& how) {
  SimulatedOptions options;
  options.rate = how.rate;
  options.realtime = how.realtime;
  return std::make_shared<SimulatedDevice>(Target({0, 5e-3, 0}), options);
}

}  // namespace

const Backend backends::simulated{"simulated", &simulated_status, &open_simulated};

}  // namespace punctura
