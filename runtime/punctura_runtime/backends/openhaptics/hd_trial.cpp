#include "punctura_runtime/backends/openhaptics/hd_session.hpp"

#include <atomic>
#include <chrono>
#include <cmath>
#include <thread>

#include "punctura/model/decimal.hpp"
#include "punctura_runtime/backends/openhaptics/hd_errors.hpp"

namespace punctura::hd {

namespace {

using State = BackendStatus::State;

/// Shared by the scheduler's thread and the thread that waits for it.
struct Counting : Work {
  Counting(const Session& session, double duration, std::int64_t (*clock)() noexcept)
      : hd(session.hd()),
        handle(session.handle()),
        tells_calibration(session.tells_calibration()),
        duration_ns(static_cast<std::int64_t>(duration * 1e9)),
        now_ns(clock) {}

  const Interface& hd;
  DeviceHandle handle;
  bool tells_calibration;
  std::int64_t duration_ns;
  std::int64_t (*now_ns)() noexcept;

  std::int64_t first = 0, last = 0;
  std::uint64_t ticks = 0;
  std::uint32_t calibration = calibration_ok;
  int renewals = 0;
  ErrorInfo error{success, 0, no_device};
  Warnings warnings{};
  std::atomic<bool> given_up{false};

  bool call() noexcept {
    if (given_up.load(std::memory_order_relaxed)) return false;
    last = now_ns();
    if (ticks++ == 0) first = last;
    hd.begin_frame(handle);
    // A calibration may take some time to show: check it every 32 ticks, renew it four times at most.
    if (ticks % 32 == 1 && tells_calibration) {
      calibration = hd.check_calibration();
      if (calibration == calibration_needs_update && renewals < 4) {
        ++renewals;
        hd.update_calibration(hd.check_calibration_style());
      }
    }
    hd.end_frame(handle);  // a frame without a force sends zero
    error = take_errors(hd, warnings);
    return error.code == success && last - first < duration_ns;
  }
};

std::string hertz(double rate) { return decimal_text(rate, 6) + " Hz"; }

double run_once(const Lent<Counting>& counting, double patience) {
  Counting& c = *counting;
  const Interface& hd = c.hd;
  const OperationHandle operation = schedule(hd, counting);
  hd.start_scheduler();
  const auto until = std::chrono::steady_clock::now() + std::chrono::duration<double>(patience);
  while (!c.left.load(std::memory_order_acquire) && std::chrono::steady_clock::now() < until)
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  const bool over = c.left.load(std::memory_order_acquire);
  c.given_up = true;
  hd.stop_scheduler();
  hd.unschedule(operation);
  const ErrorInfo after = take_errors(hd);
  if (!over) {
    const std::string why = after.code != success && after.code != bad_handle ? " " + describe(after) + "." : "";
    throw Refusal(State::fault, "The HD scheduler does not call: check the device's power and cable." + why);
  }
  if (c.error.code != success) throw Refusal(State::fault, "The device does not run. " + describe(c.error) + ".");
  return static_cast<double>(c.ticks - 1) * 1e9 / static_cast<double>(c.last - c.first);
}

/// Requests the rate; if the library refuses it, 1000 Hz, which every device has.
void set_rate(const Interface& hd, double wanted, Trial& trial) {
  trial.set = static_cast<unsigned long>(std::lround(std::fmin(wanted, 1e5)));
  hd.set_scheduler_rate(trial.set);
  if (take_errors(hd).code == success) return trial.statements.push_back("rate: asked for " + hertz(wanted));
  trial.set = 1000;
  hd.set_scheduler_rate(trial.set);
  take_errors(hd);
  trial.statements.push_back("rate: asked for " + hertz(wanted) + ", refused by this device, so 1000 Hz instead");
}

}  // namespace

void require_calibration(const Interface& hd, std::uint32_t status) {
  if (status != calibration_needs_manual_input) return;
  throw Refusal(State::needs_calibration, "The device does not know where its stylus is: " +
                                              how_to_calibrate(hd.check_calibration_style()) + ".");
}

Trial try_out(const Session& session, double wanted_rate, double duration, double patience,
              std::int64_t (*now_ns)() noexcept) {
  const Interface& hd = session.hd();
  Trial trial{};
  set_rate(hd, wanted_rate, trial);
  int reported = 0;
  hd.get_integers(update_rate, &reported);
  if (take_errors(hd).code != success) reported = 0;

  // The rate counts for the whole run, so measure again if the computer was busy.
  int renewals = 0;
  for (int attempt = 0; attempt < 3; ++attempt) {
    const Lent<Counting> counting(new Counting(session, duration, now_ns));
    trial.rate = run_once(counting, duration + patience);
    require_calibration(hd, counting->calibration);
    renewals += counting->renewals;
    if (reported > 0 && std::abs(trial.rate - reported) < 0.02 * reported) break;
  }
  if (!(trial.rate >= 100))
    throw Refusal(State::fault, "The HD scheduler calls at " + hertz(trial.rate) + ": too slow for touch.");
  trial.statements.back() += "; the library says " + hertz(reported) + ", measured " + hertz(trial.rate);
  if (renewals > 0) trial.statements.push_back("calibration: renewed by the library");
  return trial;
}

}  // namespace punctura::hd
