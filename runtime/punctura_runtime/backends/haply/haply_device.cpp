#include "punctura_runtime/backends/haply/haply_device.hpp"

#include <cmath>

#include "punctura_runtime/backends/haply/state.hpp"

namespace punctura::haply {

namespace {

std::int64_t ns(double seconds) noexcept { return static_cast<std::int64_t>(seconds * 1e9); }

}  // namespace

HaplyDevice::HaplyDevice(HaplyOptions options) : options_(std::move(options)) {
  const auto url = parse_url(options_.url);
  if (!url)
    throw DeviceError("'" + options_.url + "' is not an address of the Inverse Service, such as ws://localhost:10001");
  url_ = *url;
  open();
  info_.backend = "haply";
  info_.model = "Inverse3";
  info_.serial = service_.device().view();
  options_.device = info_.serial;  // a later start() uses the same arm or fails
  info_.has_orientation = service_.state().has_grip;
  info_.button_count = info_.has_orientation ? 3 : 0;
  info_.max_force = options_.max_force;
  fastest_ = options_.real_time ? measured_rate() : options_.rate;
  pacing_ = {options_.real_time, options_.real_time && fastest_ > options_.rate, options_.realtime};
  info_.rate = std::min(options_.rate, fastest_);
}

void HaplyDevice::open() {
  const std::string where = "The Inverse Service at " + url_.text() + ": ";
  std::string error = service_.connect(url_);
  if (!error.empty()) throw DeviceError(where + error + ". Install and start it, or set PUNCTURA_INVERSE_URL");
  const Arm* arm = service_.state().find(options_.device);
  was_in_use_ = arm && arm->in_use.value_or(false);
  error = service_.begin(options_.device);
  if (!error.empty()) {
    service_.leave();
    throw DeviceError(where + error);
  }
}

/// Round trips a second, without force, if each message is sent as soon as the last answer is there.
double HaplyDevice::measured_rate() {
  const std::int64_t begin = options_.now_ns();
  std::int64_t passed = 0;
  int n = 0;
  for (; n < 400 && (n < 20 || passed < ns(0.4)); passed = options_.now_ns() - begin, ++n) {
    const Received how = service_.exchange({0, 0, 0}, ns(1));
    if (how != Received::message)
      throw DeviceError("The Inverse Service at " + url_.text() + ": while its rate was measured, " + describe(how));
  }
  passed = options_.now_ns() - begin;
  return passed > 0 ? n * 1e9 / static_cast<double>(passed) : not_given;
}

void HaplyDevice::begin() {
  // The service may have closed an idle connection.
  if (!service_.is_open() || service_.exchange({0, 0, 0}, ns(1)) != Received::message) {
    open();
    if (service_.exchange({0, 0, 0}, ns(1)) != Received::message)
      throw DeviceError("The Inverse Service at " + url_.text() + " no longer answers");
  }
  trouble_ = found_ = Trouble::none;
  gripless_ = 0;
  force_ = {0, 0, 0};
}

void HaplyDevice::stop() noexcept {
  PolledDevice::stop();
  service_.leave();
}

HaplyDevice::Next HaplyDevice::read() noexcept {
  found_ = count() == 0 ? Trouble::none : exchange();  // begin() has received the first answer
  if (found_ == Trouble::none) found_ = take();
  sample_.sequence = count();
  sample_.time = now();
  return found_ == Trouble::none ? Next::tick : Next::trouble;
}

HaplyDevice::Next HaplyDevice::write(const Tick::Force& force) noexcept {
  force_ = force;
  return Next::tick;
}

void HaplyDevice::end() noexcept {
  service_.leave();
  trouble_ = found_;
}

/// Sends the force of the last tick and receives the next reading.
HaplyDevice::Trouble HaplyDevice::exchange() noexcept {
  switch (service_.exchange(theirs(force_), ns(options_.stale))) {
    case Received::message: return Trouble::none;
    case Received::timeout: return Trouble::no_answer;
    case Received::closed: return Trouble::closed;
    case Received::broken: return service_.garbled() ? Trouble::not_json : Trouble::broken;
    case Received::too_big: return Trouble::too_big;
    case Received::failed: break;
  }
  return Trouble::failed;
}

HaplyDevice::Trouble HaplyDevice::take() noexcept {
  const State& state = service_.state();
  const Arm* arm = state.find(service_.device().view());
  if (!arm) return Trouble::gone;
  if (!arm->position) return Trouble::no_position;
  if (!arm->calibrated.value_or(true) || !arm->power_supply.value_or(true)) return Trouble::unready;
  sample_.position = ours(*arm->position);

  // Without a grip, no button counts as held, so that a dead-man button is released. The last direction is kept for
  // no_grip seconds.
  const auto axis = state.has_grip ? pointing(*state.grip.orientation) : std::nullopt;
  sample_.buttons = state.has_grip ? state.grip.buttons : 0;
  if (axis) sample_.axis = *axis;
  gripless_ = axis ? 0 : gripless_ + 1;
  const bool lost = info_.has_orientation && static_cast<double>(gripless_) > options_.no_grip * info_.rate;
  return lost ? Trouble::no_grip : Trouble::none;
}

std::string HaplyDevice::trouble() const {
  const auto service = [this](const std::string& what) { return "The Inverse Service at " + url_.text() + " " + what; };
  const std::string device = "The Inverse3 " + info_.serial + " ";
  switch (trouble_.load()) {
    case Trouble::none: return {};
    case Trouble::no_answer:
      return service("did not answer within " + std::to_string(std::lround(options_.stale * 1e3)) + " ms.");
    case Trouble::closed: {
      const std::string reason(service_.close_reason());
      return service("closed the connection" + (reason.empty() ? "." : ": \"" + reason + "\"."));
    }
    case Trouble::not_json: return service("sent a message that is not JSON.");
    case Trouble::broken: return service("violates the WebSocket protocol.");
    case Trouble::too_big: return service("sent a message that is too long.");
    case Trouble::failed: return service("is no longer reachable: the connection failed.");
    case Trouble::gone: return device + "is no longer in the service's list: check its cable.";
    case Trouble::no_position: return device + "reports no position: check it in Haply's program.";
    case Trouble::unready: return device + "has lost its calibration or its power supply: check it in Haply's program.";
    case Trouble::no_grip: return "The grip is no longer in the service's list: switch it on and pair it again.";
  }
  return {};
}

std::vector<std::string> HaplyDevice::statements() const {
  const auto whole = [](double value) { return std::to_string(std::lround(value)); };
  std::vector<std::string> all{"haply: tested against a simulated service only"};
  if (options_.real_time)
    all.push_back(
        "the service answers " + whole(fastest_) + " times a second" +
        (pacing_.waits ? "; the rate is " + whole(info_.rate) + " Hz" : ", less than requested: that is the rate"));
  if (!info_.has_orientation) all.push_back("no VerseGrip: set direction = \"motion\" in the scene");
  if (was_in_use_)
    all.push_back(
        "the service reports that the Inverse3 is in use: the forces of several programs add up, so close the others");
  if (std::abs(service_.echo() - 1) > 0.05)
    all.push_back("the service gives " + whole(100 * service_.echo()) +
                  " % of the requested force: check its force scale and force gate");
  return with_priorities(std::move(all));
}

}  // namespace punctura::haply

namespace punctura {

BackendStatus haply::status_at(const std::string& text) {
  using State = BackendStatus::State;
  BackendStatus status{"haply", State::fault, "", {}};
  const auto is = [&](State state, const std::string& detail) {
    status.state = state;
    status.detail = detail;
    return status;
  };
  const auto url = parse_url(text);
  if (!url)
    return is(State::fault,
              "PUNCTURA_INVERSE_URL is '" + text + "', which is not an address such as ws://localhost:10001.");

  Service service;
  const std::string error = service.connect(*url);
  if (!error.empty())
    return is(State::library_not_found, "No Inverse Service at " + url->text() + " (" + error +
                                            "): install it from Haply and start it, or set PUNCTURA_INVERSE_URL.");
  const auto& found = service.state();
  const std::string which = "The Inverse Service at " + url->text() +
                            (service.version() ? ", version " + service.version()->text() : ", version unknown");
  for (std::size_t i = 0; i < found.arm_count; ++i) status.devices.emplace_back(found.arms[i].id.view());
  const Arm* first = found.find("");
  if (!first) return is(State::no_device, which + ", has no Inverse3: plug one in and switch it on.");
  if (!first->power_supply.value_or(true))
    return is(State::fault, "The Inverse3 has no power: connect its power supply.");
  if (!first->calibrated.value_or(true))
    return is(State::needs_calibration, "Calibrate the Inverse3 in Haply's program.");
  if (first->in_use.value_or(false))
    return is(State::in_use,
              "Another program may be using the Inverse3. The forces of several programs add up: close the others.");
  if (!first->ready.value_or(true)) return is(State::fault, "The Inverse3 is not ready: check it in Haply's program.");
  return is(State::available, which + (found.has_grip ? ", with a VerseGrip" : ", without a VerseGrip") +
                                  ". Tested against a simulated service only.");
}

namespace {

BackendStatus status() { return haply::status_at(haply::default_url()); }

std::shared_ptr<Device> open(const OpenOptions& how) {
  haply::HaplyOptions options{how};
  if (!how.library.empty())
    options.url = how.library;  // the maker's software is a service, which has an address instead of a path
  return std::make_shared<haply::HaplyDevice>(std::move(options));
}

}  // namespace

const Backend backends::haply{"haply", &status, &open};

}  // namespace punctura
