#include "punctura_runtime/backends/simulated.hpp"

#include "punctura_runtime/loop/pacer.hpp"

namespace punctura {

namespace {

Desired desired_at(SimulatedDevice::Motion& motion, double time) noexcept {
  return std::visit([time](auto& m) { return m.at(time); }, motion);
}

}  // namespace

SimulatedDevice::SimulatedDevice(Motion motion, const SimulatedOptions& options)
    : options_(options),
      motion_(std::move(motion)),
      plant_(options.dynamics, options.hand, 1 / options.rate, options.seed),
      wish_{to_array(desired_at(motion_, 0).position), options.axis, 0},
      wishes_(wish_) {
  info_ = {"simulated", "PHANTOM Omni, simulated", "", true, 1, options.dynamics.max_force, Omni::continuous_force};
  info_.encoder_step = options.dynamics.encoder_step;
  info_.rate = options.rate;
  plant_.place(to_vector(wish_.target));
}

void SimulatedDevice::start(Tick tick) {
  thread_.refuse_second_loop();
  finished_ = false;
  missed_ = 0;
  thread_.start(options_.real_time ? std::optional(options_.realtime.at_rate(options_.rate)) : std::nullopt,
                [this, tick] { run(tick); });
}

void SimulatedDevice::stop() noexcept { thread_.stop(); }

std::vector<std::string> SimulatedDevice::statements() const {
  std::vector<std::string> all;
  os::add_words(thread_.realtime(), all);
  return all;
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

void SimulatedDevice::run(Tick tick) noexcept {
  Pacer<> pacer(options_.rate);
  const std::int64_t start = os::now_ns();
  for (std::uint64_t k = 0; !thread_.stopping() && (options_.ticks == 0 || k < options_.ticks); ++k) {
    if (options_.real_time) {
      missed_.fetch_add(pacer.wait(), std::memory_order_relaxed);
      one_tick(tick, k, static_cast<double>(os::now_ns() - start) * 1e-9);
    } else {
      one_tick(tick, k, static_cast<double>(k) / options_.rate);
    }
  }
  plant_.step(Vector3d::Zero(), {plant_.tip(), Vector3d::Zero()});
  last_force_.write([](std::array<double, 3>& to) { to = {0, 0, 0}; });
  finished_ = true;
}

void SimulatedDevice::one_tick(Tick tick, std::uint64_t k, double time) noexcept {
  const Wish& wish = wishes_.read();
  if (Target* target = std::get_if<Target>(&motion_)) target->move_to(to_vector(wish.target));
  // The hand moves on the plant's own time, so that a late tick does not make it jump.
  const Desired desired = desired_at(motion_, static_cast<double>(k) / options_.rate);

  DeviceSample sample{k, time, to_array(plant_.measured()), wish.axis, wish.buttons, true};
  if (auto* how = spoiler_.exchange(nullptr)) how(sample);
  const Tick::Force force = tick(sample);
  last_force_.write([&](std::array<double, 3>& to) { to = force; });
  plant_.step(to_vector(force), desired);
}

}  // namespace punctura
