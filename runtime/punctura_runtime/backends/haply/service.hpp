// The Inverse Service: found, understood, and spoken to. What is wrong is said in words.
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

/// From what GET /version answers: the first number with a point after the word "version", or the first at all.
std::optional<Version> find_version(std::string_view body);
ForceKey force_key(const Version& version);

/// A connection to the service, with one of its devices chosen. It sends one message for each that it receives.
class Service {
 public:
  /// Connects and reads the inventory. Gives no force and configures nothing. Empty when that went well, else what is wrong.
  std::string connect(const Url& url);

  const State& state() const noexcept { return state_; }  ///< what came last
  const std::optional<Version>& version() const noexcept { return version_; }

  /// Chooses a device (empty: the first), tells the service who we are, and finds out how it wants its force, by forces that
  /// nobody feels: up to 0.05 N for a few milliseconds. Empty when that went well, else what is wrong.
  std::string begin(std::string_view device);
  const Name& device() const noexcept { return device_; }
  ForceKey key() const noexcept { return key_; }
  double echo() const noexcept { return echo_; }  ///< the share of a force asked for that the service says it gives

  /// One message, with a force (N, finite, the service's axes), and its answer, which is then state().
  Received exchange(const Vector& force, std::int64_t timeout_ns) noexcept;
  /// The service's last words were not JSON.
  bool garbled() const noexcept { return garbled_; }
  std::string_view close_reason() const noexcept { return socket_.close_reason(); }

  /// Zero force, goodbye. Safe at any time, and twice.
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
