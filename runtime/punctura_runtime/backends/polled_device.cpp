#include "punctura_runtime/backends/polled_device.hpp"

#include <future>
#include <system_error>
#include <utility>

namespace punctura {

void PolledDevice::start(Tick tick) {
  refuse_second_loop(thread_.joinable());
  sample_ = {0, 0, {0, 0, 0}, {0, -1, 0}, 0, true};
  begin();
  stopping_ = finished_ = false;
  missed_ = 0;
  at_ = At::device;
  std::promise<std::string> prepared;
  std::future<std::string> error = prepared.get_future();
  try {
    thread_ = std::thread([this, tick, prepared = std::move(prepared)]() mutable noexcept {
      realtime_.clear();
      if (pacing_.real_time) realtime_ = os::make_realtime(pacing_.realtime.at_rate(info_.rate));
      std::string why_not = prepare();
      const bool ready = why_not.empty();
      prepared.set_value(std::move(why_not));
      if (ready) run(tick);
      at_ = At::over;
    });
  } catch (const std::system_error& why) {
    throw DeviceError(std::string("no thread for the device's ticks: ") + why.what());
  }
  if (const std::string why_not = error.get(); !why_not.empty()) {
    PolledDevice::stop();
    throw DeviceError(why_not);
  }
}

/// If the model hangs in a tick, the device gets zero force without it, also if the thread was late and enters the tick
/// only now. stop() then waits for the tick, whose loop and device must live as long.
void PolledDevice::stop() noexcept {
  stopping_ = true;
  if (!thread_.joinable()) return;
  const auto until = std::chrono::steady_clock::now() + patience;
  while (at_ != At::over) {
    std::this_thread::sleep_for(std::chrono::microseconds(200));
    At in_tick = At::tick;
    if (std::chrono::steady_clock::now() >= until && at_.compare_exchange_strong(in_tick, At::lost)) {
      end();
      break;
    }
  }
  thread_.join();
}

double PolledDevice::now() const noexcept {
  return pacing_.real_time ? static_cast<double>(pacing_.clock.now() - start_ns_) * 1e-9
                           : static_cast<double>(count_) / info_.rate;
}

void PolledDevice::run(Tick tick) noexcept {
  Pacer<> pacer(info_.rate, pacing_.clock);
  start_ns_ = pacing_.clock.now();
  Next next = Next::tick;
  for (count_ = 0; !stopping_; ++count_) {
    if (pacing_.waits) missed_.fetch_add(pacer.wait(), std::memory_order_relaxed);
    if (stopping_) break;
    if (next = read(); next != Next::tick || stopping_) break;
    at_ = At::tick;
    Tick::Force force = tick(sample_);
    if (At in_tick = At::tick; !at_.compare_exchange_strong(in_tick, At::device)) return;  // stop() has ended it
    if (!sample_.healthy) force = {0, 0, 0};
    if (next = write(force); next != Next::tick) break;
  }
  end();  // zero force before anything else
  if (next == Next::trouble) {
    sample_.healthy = false;
    tick(sample_);
  }
  finished_ = next != Next::tick;
}

}  // namespace punctura
