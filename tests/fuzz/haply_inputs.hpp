// Inputs for the parsers of the Inverse Service's messages: tests make them from seeds, libFuzzer from its corpus.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <string>
#include <string_view>

#include "punctura/lab/plant/noise.hpp"
#include "punctura_runtime/backends/haply/frames.hpp"
#include "punctura_runtime/backends/haply/service.hpp"
#include "punctura_runtime/backends/haply/state.hpp"
#include "punctura_runtime/backends/haply/websocket.hpp"

namespace punctura::test {

/// Reads a message as text. The values must be valid, and a second reading must give the same.
inline void read_text(std::string_view text) {
  haply::State state;
  if (!haply::read_state(text, state)) return;
  for (std::size_t i = 0; i < state.arm_count; ++i) {
    const haply::Arm& arm = state.arms[i];
    for (const auto& vector : {arm.position, arm.force})
      for (double value : vector.value_or(haply::Vector{}))
        if (!std::isfinite(value)) std::abort();
    std::array<char, 512> out;
    const std::size_t size =
        haply::write_force(arm.id.view(), haply::ForceKey::vector, arm.position.value_or(haply::Vector{}), out);
    haply::State again;
    if (!haply::read_state({out.data(), size}, again) || again.find(arm.id.view()) == nullptr) std::abort();
  }
  if (!state.has_grip) return;
  if (const auto axis = haply::pointing(*state.grip.orientation))
    if (!(std::abs(std::hypot((*axis)[0], (*axis)[1], (*axis)[2]) - 1) < 1e-3)) std::abort();
}

/// The first byte selects the way: the text of a message, a server's answer, or frames in pieces of that size.
inline void read_anything(std::string_view input) {
  if (input.empty()) return;
  const auto how = static_cast<unsigned char>(input[0]);
  input.remove_prefix(1);
  if (how == 0) return read_text(input);
  if (how == 1) {
    haply::upgrade_refusal(input);
    haply::find_version(input);
    haply::parse_url(input);
    return;
  }
  haply::FrameReader reader(4096);
  while (!input.empty()) {
    const auto space = reader.space();
    if (space.empty()) std::abort();  // it must always have room for what comes
    const std::size_t n = std::min({static_cast<std::size_t>(how), space.size(), input.size()});
    std::ranges::copy(input.substr(0, n), space.begin());
    reader.filled(n);
    input.remove_prefix(n);
    for (std::string_view payload;;) {
      const haply::Event event = reader.next(payload);
      if (event == haply::Event::more) break;
      if (event == haply::Event::broken || event == haply::Event::too_big) return;
      if (event == haply::Event::text) read_text(payload);
    }
  }
}

/// A valid message, whole or framed, with some bytes changed, removed or doubled.
inline std::string spoilt_input(Noise& noise) {
  const auto below = [&](std::size_t n) { return static_cast<std::size_t>(noise.uniform() * static_cast<double>(n)); };
  std::string text =
      R"({"session_id":7,"inverse3":[{"device_id":"049D","state":{"cursor_position":{"x":0.0,"y":-1.2e-1,"z":0.15},)"
      R"("current_cursor_force":{"x":0,"y":0,"z":1.5}},"status":{"calibrated":true,"in_use":false}}],)"
      R"("wireless_verse_grip":[{"device_id":"1102","state":{"orientation":{"w":1,"x":0,"y":0,"z":0},)"
      R"("buttons":{"a":true}}}]})";
  const std::size_t how = below(4) == 0 ? 0 : 2 + below(200);
  if (how != 0) {
    const std::size_t cut = below(text.size());
    const auto frame = [](int first, const std::string& payload) {
      std::string head{static_cast<char>(first), '\x7e'};
      head += static_cast<char>(payload.size() >> 8);
      head += static_cast<char>(payload.size() & 0xff);
      return (payload.size() < 126 ? head.substr(0, 1) + static_cast<char>(payload.size()) : head) + payload;
    };
    text = frame(0x01, text.substr(0, cut)) + frame(0x89, "?") + frame(0x80, text.substr(cut)) + frame(0x81, text);
  }
  for (std::size_t changes = below(6); changes > 0; --changes) {
    const std::size_t at = below(text.size()), n = below(12);
    switch (below(4)) {
      case 0: text[at] = static_cast<char>(below(256)); break;
      case 1: text.erase(at, n); break;
      case 2: text.insert(at, text.substr(below(text.size()), n)); break;
      default: text[at] = "{}[]\",:\\-e0"[below(11)];
    }
  }
  return static_cast<char>(how) + text;
}

}  // namespace punctura::test
