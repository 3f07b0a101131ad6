#include "punctura_runtime/backends/openhaptics/openhaptics.hpp"

#include <chrono>

#include "punctura/model/decimal.hpp"
#include "punctura_runtime/backends/openhaptics/hd_errors.hpp"
#include "punctura_runtime/backends/openhaptics/hd_interface.hpp"
#include "punctura_runtime/backends/openhaptics/hd_session.hpp"
#include "punctura_runtime/backends/polled_device.hpp"

namespace punctura {

namespace {

const hd::Interface& loaded(const std::string& library) {
  const hd::Loaded result = hd::load(library);
  if (!result.functions) throw Refusal(result.state, result.detail);
  return *result.functions;
}

/// Waits for the scheduler's thread. Bounded, in case it hangs.
template <typename Condition>
bool soon(std::chrono::milliseconds patience, Condition&& condition) noexcept {
  const auto until = std::chrono::steady_clock::now() + patience;
  while (!condition()) {
    if (std::chrono::steady_clock::now() >= until) return false;
    std::this_thread::sleep_for(std::chrono::microseconds(200));
  }
  return true;
}

constexpr std::chrono::milliseconds first_call{1000}, last_call{250}, leaving{1000};

}  // namespace

OpenHapticsDevice::OpenHapticsDevice(const OpenHapticsOptions& options)
    : options_(options),
      session_(loaded(options.library), options.device, options.keep_device),
      hd_(session_.hd()),
      trial_(hd::try_out(session_, options.rate, options.trial, options.patience, options.now_ns)),
      info_(session_.info()) {
  info_.rate = trial_.rate;
  lend();
}

void OpenHapticsDevice::lend() {
  lent_.emplace_back(new hd::Ticking(session_, options_.now_ns));
  ticking_ = lent_.back().get();
}

void OpenHapticsDevice::start(Tick tick) {
  const std::lock_guard lock(control_);
  refuse_second_loop(running_);
  if (!ticking().left) lend();  // a call of the run before may still come
  ticking().begin(tick);

  hd_.make_current_device(session_.handle());
  hd::take_errors(hd_);
  hd_.enable(hd::force_output);
  operation_ = hd::schedule(hd_, lent_.back());
  hd_.set_scheduler_rate(trial_.set);  // in case the library has lost it since the trial
  const hd::ErrorInfo refusal = hd::take_errors(hd_);
  if (refusal.code == hd::success) {
    hd_.start_scheduler();
    running_ = true;
    if (soon(first_call, [&] { return ticking().ticks != 0; })) return;
  }
  halt();
  throw DeviceError(refusal.code == hd::success
                        ? "The HD scheduler does not call: check the device's power and cable, then open it again."
                        : "The device does not start. " + hd::describe(refusal) + ".");
}

void OpenHapticsDevice::stop() noexcept {
  if (running_ && ticking().thread.load() == std::this_thread::get_id() && ticking().inside) {
    ticking().stop_soon();  // called by the tick itself: the next stop() from another thread does the rest
    return;
  }
  const std::lock_guard lock(control_);
  if (running_) halt();
}

/// The scheduler's last frame for this device sends zero force.
void OpenHapticsDevice::halt() noexcept {
  ticking().end();
  soon(last_call, [&] { return ticking().left.load(); });
  hd_.stop_scheduler();
  hd_.unschedule(operation_);
  soon(leaving, [&] { return !ticking().inside; });
  if (!ticking().ended.exchange(true))
    ticking().zero_frame();  // the scheduler did not call any more; once it is stopped, this thread may send a frame
  hd_.disable(hd::force_output);
  hd::take_errors(hd_, ticking().warnings);
  running_ = false;
}

std::string OpenHapticsDevice::trouble() const {
  using Ending = hd::Ticking::Ending;
  switch (ticking().ending.load()) {
    case Ending::none: break;
    case Ending::error:
      return "Ticks have ended. " + hd::describe({ticking().error_code, ticking().error_internal, session_.handle()}) +
             ".";
    case Ending::calibration:
      return "Ticks have ended: the device does not know any more where its stylus is. "
             "Stop, then calibrate and open it again.";
  }
  const double silent = static_cast<double>(options_.now_ns() - ticking().last_call) * 1e-9;
  if (!running_ || silent < 0.1) return {};
  return "The HD scheduler has not called for " + decimal_text(silent, 2) +
         " s: switch the device off if it pulls, then stop.";
}

std::vector<std::string> OpenHapticsDevice::statements() const {
  std::vector<std::string> all{"device: opened as \"" + session_.name() + "\""};
  all.insert(all.end(), trial_.statements.begin(), trial_.statements.end());
  all.emplace_back("thread: the HD library's own, with the priority and the processors that the library gave it");
  for (std::uint32_t i = 0; i < ticking().warnings.counts.size(); ++i)
    if (const auto count = ticking().warnings.counts[i].load(); count > 0)
      all.push_back("warned " + std::to_string(count) + " times: " + hd::describe({hd::warm_motors + i, 0, 0}));
  all.emplace_back("this back-end: tested against simulated libraries only");
  return all;
}

namespace {

constexpr const char* name = "openhaptics";

bool keep_device() {
  const std::string value = environment("PUNCTURA_HD_KEEP_DEVICE");
  return !value.empty() && value != "0";
}

BackendStatus status() {
  const hd::Loaded loaded = hd::load();
  if (!loaded.functions) return {name, loaded.state, loaded.detail, {}};
  try {
    const hd::Session session(*loaded.functions, "", keep_device());
    const DeviceInfo& info = session.info();
    if (session.tells_calibration()) hd::require_calibration(session.hd(), session.hd().check_calibration());
    return {
        name,
        BackendStatus::State::available,
        info.model + (info.serial.empty() ? "" : ", serial number " + info.serial) + ", through " + loaded.path + ".",
        {session.name()}};
  } catch (const Refusal& refused) {
    return {name, refused.state, refused.what() + std::string(" (Library: ") + loaded.path + ".)", {}};
  }
}

std::shared_ptr<Device> open(const OpenOptions& how) {
  OpenHapticsOptions options{how};
  options.keep_device = keep_device();
  return std::make_shared<OpenHapticsDevice>(options);
}

}  // namespace

const Backend backends::openhaptics{name, &status, &open};

}  // namespace punctura
