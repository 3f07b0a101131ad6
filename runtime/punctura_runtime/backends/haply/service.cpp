#include "punctura_runtime/backends/haply/service.hpp"

#include <charconv>
#include <cmath>

#include "punctura_runtime/os/os.hpp"

namespace punctura::haply {

namespace {

constexpr std::int64_t ms = 1'000'000;
constexpr std::int64_t patience = 1000 * ms;  ///< ns: timeout of each step before the first tick

/// "3.5" at the start of a text.
std::optional<Version> version_at(std::string_view text) {
  Version version;
  const char* const end = text.data() + text.size();
  const auto [point, error] = std::from_chars(text.data(), end, version.major);
  if (error != std::errc() || point == end || *point != '.') return {};
  if (std::from_chars(point + 1, end, version.minor).ec != std::errc()) return {};
  return version;
}

}  // namespace

std::optional<Version> find_version(std::string_view body) {
  const std::size_t word = body.find("version");
  if (word != std::string_view::npos) body.remove_prefix(word);
  constexpr std::string_view digits = "0123456789";
  while (!body.empty()) {
    const std::size_t first = body.find_first_of(digits);
    if (first == std::string_view::npos) return {};
    body.remove_prefix(first);
    if (const auto version = version_at(body)) return version;
    const std::size_t past = body.find_first_not_of(digits);
    body.remove_prefix(past == std::string_view::npos ? body.size() : past);
  }
  return {};
}

ForceKey force_key(const Version& version) {
  const bool new_one = version.major > 3 || (version.major == 3 && version.minor >= 5);
  return new_one ? ForceKey::vector : ForceKey::values;
}

std::string Service::trouble(Received how) const {
  std::string words = garbled_ ? "a message was not JSON" : describe(how);
  if (!close_reason().empty()) words += " (\"" + std::string(close_reason()) + "\")";
  return words;
}

std::string Service::connect(const Url& url) {
  leave();
  std::string error;
  version_ = find_version(http_get(url, "/version", os::now_ns() + patience, error));
  error = socket_.open(url, os::now_ns() + patience);
  if (!error.empty()) return error;
  const Received how = take(os::now_ns() + patience);
  if (how == Received::message) return {};
  socket_.close();
  return "it sent no list of its devices: " + trouble(how);
}

std::string Service::begin(std::string_view device) {
  const Arm* arm = state_.find(device);
  if (!arm || arm->id.empty()) {
    if (!arm && !device.empty()) return "it has no Inverse3 called '" + std::string(device) + "'";
    return arm ? "its Inverse3 has no usable device_id" : "it has no Inverse3: plug one in";
  }
  device_ = arm->id;
  std::string error = hello();
  if (!error.empty()) return error;

  // Without a known version, the echo shows which format the service takes.
  const ForceKey candidates[] = {version_ ? force_key(*version_) : ForceKey::vector, ForceKey::values};
  const std::size_t count = version_ ? 1 : 2;
  for (std::size_t i = 0; i < count; ++i) {
    key_ = candidates[i];
    for (const double force : {0.001, 0.01, 0.05}) {
      const auto echo = echoed(force);
      const Received quiet = exchange({0, 0, 0}, patience);
      if (quiet != Received::message) return "while its force was checked: " + trouble(quiet);
      if (!echo) continue;
      echo_ = *echo;
      return {};
    }
  }
  std::string form = "neither \"vector\" nor \"values\"";
  if (count == 1) form.assign("\"").append(name(key_)).append("\"");
  const std::string which = version_ ? "version " + version_->text() : "unknown version";
  return "it (" + which + ") did not take a force by " + form + ": current_cursor_force in its answers " +
         (state_.find(device_.view()) && state_.find(device_.view())->force ? "stayed 0" : "is missing") +
         ". Forces may not arrive: update the Inverse Service";
}

/// Introduces Punctura to the service. Versions before 3.5 are not known to accept that; there a command is the first
/// message.
std::string Service::hello() {
  if (!version_ || force_key(*version_) != ForceKey::vector) return {};
  const std::string text = R"({"session":{"configure":{"profile":{"name":"org.punctura","required_version":">=3.5"},)"
                           R"("basis":{"permutation":"XYZ"}}},"inverse3":[{"device_id":")" +
                           std::string(device_.view()) +
                           R"(","configure":{"preset":{"preset":"arm_front_centered"}}}]})";
  Received how = Received::failed;
  if (socket_.send(text, os::now_ns() + patience)) how = take(os::now_ns() + patience);
  return how == Received::message ? "" : "after the first message: " + trouble(how);
}

/// Requests an upward force, up to ten times, until an answer shows some of it. Returns the share that it shows.
std::optional<double> Service::echoed(double force) {
  for (int i = 0; i < 10; ++i) {
    if (exchange({0, 0, force}, patience) != Received::message) return {};
    const Arm* arm = state_.find(device_.view());
    if (!arm || !arm->force) continue;
    const Vector& f = *arm->force;
    const double share = std::hypot(f[0], f[1], f[2]) / force;
    if (share > 0.05) return share;
  }
  return {};
}

Received Service::take(std::int64_t deadline) noexcept {
  std::string_view text;
  const Received how = socket_.receive(text, deadline);
  garbled_ = how == Received::message && !read_state(text, state_);
  return garbled_ ? Received::broken : how;
}

Received Service::exchange(const Vector& force, std::int64_t timeout_ns) noexcept {
  const std::int64_t deadline = os::now_ns() + timeout_ns;
  const std::size_t size = write_force(device_.view(), key_, force, out_);
  if (!socket_.send({out_.data(), size}, deadline)) {
    std::string_view text;  // the service may have sent a close frame before
    garbled_ = false;
    return socket_.receive(text, os::now_ns()) == Received::closed ? Received::closed : Received::failed;
  }
  return take(deadline);
}

void Service::leave() noexcept {
  if (!socket_.is_open()) return;
  if (!device_.empty()) {
    const std::size_t size = write_force(device_.view(), key_, {0, 0, 0}, out_);
    // Wait for the answer: a connection that is closed earlier may discard the unread command.
    if (socket_.send({out_.data(), size}, os::now_ns() + 2 * ms)) take(os::now_ns() + 5 * ms);
  }
  socket_.close();
}

}  // namespace punctura::haply
