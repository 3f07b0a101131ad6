// A simulated Inverse Service with a simulated Inverse3 in a simulated hand, in the test's own process.
//
// It behaves like the real service: after connecting it sends one inventory, then exactly one state for each message. A
// force lasts for one period only, so the device is idle if the client stops sending. Each message advances the time by
// one period; no clock is read.
#pragma once

#include <atomic>
#include <functional>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "punctura/lab/plant/motion.hpp"
#include "punctura/lab/plant/plant.hpp"
#include "runtime/support/listener.hpp"

namespace punctura::test {

struct FakeSettings {
  std::string version = "3.5.2";     ///< the answer of /version; empty: 404
  std::string takes = "vector";      ///< the only accepted key of set_cursor_force
  bool closes_on_wrong_key = false;  ///< instead of leaving the force at zero
  bool grip = true;
  double gives = 1;  ///< the share of a force that its echo shows
  std::string id = "049D";
  std::string status = R"("calibrated":true,"in_use":false,"power_supply":true,"ready":true)";
  std::string inventory;  ///< replaces the real one if not empty
  Strokes strokes{{0, 5e-3, 0}, {0, -10e-3, 0}, 1, 1.0, 0.6, 0.0};
  std::uint64_t seed = 7;
};

/// A failure that replaces the answer to one message, and lasts from then on.
enum class Mishap {
  none,
  removed,
  closes,
  silent,
  malformed,
  oversized,
  masked,
  cut_off,
  no_position,
  no_power,
  no_grip
};

/// How answers are split into frames and packets.
enum class Travel { whole, byte_by_byte, in_fragments, with_pings };

class HaplyFake {
 public:
  explicit HaplyFake(FakeSettings settings = {});
  ~HaplyFake();

  std::string url() const { return "ws://127.0.0.1:" + std::to_string(listener_.port()); }
  void begin();                                 ///< the hand's motion starts with the next message
  void happen(Mishap what, std::size_t after);  ///< after this many messages from begin() on
  void travel(Travel how) { travel_ = how; }
  std::function<void()> on_message;  ///< called before each answer; set it before the first message

  /// The force on the plant in each period from begin() on, N, in Punctura's axes, and the period of the
  /// failure.
  std::vector<std::array<double, 3>> forces();
  std::size_t mishap_at();
  std::vector<std::string> messages();  ///< the first ones of the last connection, up to 16
  bool client_left() const { return left_; }

 private:
  void serve(os::Socket client);
  void speak(os::Socket& client);
  bool answer(os::Socket& client, const std::string& message);
  bool send(os::Socket& client, const std::string& text);
  std::array<double, 3> wanted(const std::string& message) const;
  std::string state(bool with_config) const;
  bool mishap(os::Socket& client);
  void pass(const std::array<double, 3>& force);

  FakeSettings settings_;
  Listener listener_;
  Plant plant_;
  StrokesMotion motion_;
  std::array<double, 3> echo_{};
  std::mutex mutex_;
  std::vector<std::array<double, 3>> forces_;
  std::vector<std::string> messages_;
  std::atomic<bool> stop_{false}, begun_{false}, left_{false};
  std::atomic<Travel> travel_{Travel::whole};
  std::atomic<Mishap> mishap_{Mishap::none};
  std::atomic<std::size_t> after_{0}, mishap_at_{0};
  bool first_ = true, spoilt_ = false;
  std::uint64_t tick_ = 0;
  std::thread thread_;
};

}  // namespace punctura::test
