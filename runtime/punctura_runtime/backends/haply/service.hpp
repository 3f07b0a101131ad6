// A connection to the Inverse Service.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>

#include "punctura_runtime/backends/haply/state.hpp"
#include "punctura_runtime/backends/haply/websocket.hpp"

namespace punctura::haply {

struct Version {
  int major = 0, minor = 0;
  std::string text() const { return std::to_string(major) + "." + std::to_string(minor); }
  bool operator==(const Version&) const = default;
};

/// Finds the version in the answer to GET /version: the first number with a point after the word "version", or the
/// first in the text.
std::optional<Version> find_version(std::string_view body);
ForceKey force_key(const Version& version);

/// A connection to the service, and one of its devices. The service sends one message for each that it receives.
class Service {
 public:
  /// Connects and reads the list of devices. Gives no force and configures nothing. Returns an error message, or
  /// nothing.
  std::string connect(const Url& url);

  const State& state() const noexcept { return state_; }  ///< the last answer
  const std::optional<Version>& version() const noexcept { return version_; }

  /// Selects a device (empty: the first) and determines the format of the force, with forces too small to feel: up to
  /// 0.05 N for a few milliseconds. Returns an error message, or nothing.
  std::string begin(std::string_view device);
  const Name& device() const noexcept { return device_; }
  ForceKey key() const noexcept { return key_; }
  double echo() const noexcept { return echo_; }  ///< the share of a requested force that the service reports

  /// Sends a force (N, finite, in the service's axes) and receives the answer, which is then state().
  Received exchange(const Vector& force, std::int64_t timeout_ns) noexcept;
  /// The last answer was not JSON.
  bool garbled() const noexcept { return garbled_; }
  std::string_view close_reason() const noexcept { return socket_.close_reason(); }

  /// Sends zero force and closes the connection. Allowed at any time, also twice.
  void leave() noexcept;
  bool is_open() const noexcept { return socket_.is_open(); }

 private:
  std::string hello();
  std::optional<double> echoed(double force);
  Received take(std::int64_t deadline) noexcept;
  std::string trouble(Received how) const;

  WebSocket socket_;
  State state_;
  Name device_;
  std::optional<Version> version_;
  ForceKey key_ = ForceKey::vector;
  double echo_ = 1;
  bool garbled_ = false;
  std::array<char, 512> out_{};
};

}  // namespace punctura::haply
