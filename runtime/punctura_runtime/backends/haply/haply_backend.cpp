// The Inverse3 in the registry.
#include "punctura_runtime/backends/haply/haply_backend.hpp"
#include "punctura_runtime/backends/haply/haply_device.hpp"

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
