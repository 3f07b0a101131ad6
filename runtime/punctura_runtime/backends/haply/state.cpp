#include "punctura_runtime/backends/haply/state.hpp"

#include <algorithm>

#include "punctura/model/decimal.hpp"
#include "punctura_runtime/backends/haply/json.hpp"

namespace punctura::haply {

Name::Name(std::string_view text) noexcept {
  const bool plain = std::ranges::all_of(text, [](char c) { return '!' <= c && c <= '~' && c != '\\' && c != '"'; });
  if (text.size() > text_.size() || !plain) return;
  std::ranges::copy(text, text_.begin());
  size_ = text.size();
}

const Arm* State::find(std::string_view id) const noexcept {
  for (std::size_t i = 0; i < arm_count; ++i)
    if (id.empty() || arms[i].id.view() == id) return &arms[i];
  return nullptr;
}

namespace {

/// {"x": 1, "y": 2, "z": 3}: all of the components, or nothing.
template <std::size_t N>
std::optional<std::array<double, N>> letters(JsonReader& json, std::string_view names) noexcept {
  std::array<std::optional<double>, N> found;
  json.object([&](std::string_view key) {
    if (const std::size_t at = names.find(key); key.size() == 1 && at < N) found[at] = json.number();
  });
  std::array<double, N> all;
  for (std::size_t i = 0; i < N; ++i) {
    if (!found[i]) return {};
    all[i] = *found[i];
  }
  return all;
}

Name id(JsonReader& json) noexcept { return Name(json.string().value_or("")); }

void read_arm(JsonReader& json, Arm& arm) noexcept {
  arm = {};
  json.object([&](std::string_view key) {
    if (key == "device_id") arm.id = id(json);
    if (key == "state")
      json.object([&](std::string_view field) {
        if (field == "cursor_position") arm.position = letters<3>(json, "xyz");
        if (field == "current_cursor_force") arm.force = letters<3>(json, "xyz");
      });
    if (key == "status")
      json.object([&](std::string_view field) {
        if (field == "calibrated") arm.calibrated = json.boolean();
        if (field == "in_use") arm.in_use = json.boolean();
        if (field == "power_supply") arm.power_supply = json.boolean();
        if (field == "ready") arm.ready = json.boolean();
      });
  });
}

void read_grip(JsonReader& json, Grip& grip) noexcept {
  grip = {};
  const auto press = [&](unsigned bit) {
    if (json.boolean().value_or(false)) grip.buttons |= 1u << bit;
  };
  json.object([&](std::string_view key) {
    if (key == "device_id") grip.id = id(json);
    if (key == "state")
      json.object([&](std::string_view field) {
        if (field == "orientation") grip.orientation = letters<4>(json, "wxyz");
        if (field == "button") press(0);
        if (field == "buttons")
          json.object([&](std::string_view button) {
            if (button == "a") press(0);
            if (button == "b") press(1);
            if (button == "c") press(2);
          });
      });
    if (key == "status")
      json.object([&](std::string_view field) {
        if (field == "connected") grip.connected = json.boolean().value_or(true);
      });
  });
}

}  // namespace

bool read_state(std::string_view text, State& state) noexcept {
  state.arm_count = 0;
  state.has_grip = false;
  JsonReader json(text);
  const bool object = json.object([&](std::string_view key) {
    if (key == "inverse3")
      json.array([&] {
        if (state.arm_count < state.arms.size()) read_arm(json, state.arms[state.arm_count++]);
      });
    if (key == "wireless_verse_grip" || key == "verse_grip")
      json.array([&] {
        if (state.has_grip) return;
        read_grip(json, state.grip);
        state.has_grip = state.grip.connected && state.grip.orientation.has_value();
      });
  });
  return object && json.whole();
}

std::size_t write_force(std::string_view id, ForceKey key, const Vector& force, std::span<char> out) noexcept {
  std::size_t n = 0;
  const auto put = [&](std::string_view text) {
    std::ranges::copy(text, out.begin() + static_cast<std::ptrdiff_t>(n));
    n += text.size();
  };
  put(R"({"inverse3":[{"device_id":")");
  put(id);
  put(R"(","commands":{"set_cursor_force":{")");
  put(name(key));
  put(R"(":{"x":)");
  n += write_decimal(force[0], out.subspan(n));
  put(R"(,"y":)");
  n += write_decimal(force[1], out.subspan(n));
  put(R"(,"z":)");
  n += write_decimal(force[2], out.subspan(n));
  put("}}}}]}");
  return n;
}

}  // namespace punctura::haply
