// The binary frame of ticks that the studio's page reads. python/punctura/studio/wire/frames.py has its layout.
#pragma once

#include <array>
#include <cstdint>
#include <cstring>
#include <span>
#include <string_view>
#include <type_traits>
#include <vector>

#include "punctura/servo/tick_table.hpp"

namespace punctura::live {

/// The ticks of one run and one scene, one after the other, as a frame. other: 3 numbers a tick, or empty.
inline void write_frame(std::span<const Snapshot> ticks, std::uint32_t run, std::span<const float> other,
                        std::vector<std::byte>& frame) {
  frame.clear();
  const auto put = [&](const auto& value) {
    const std::size_t at = frame.size();
    frame.resize(at + sizeof value);
    std::memcpy(frame.data() + at, &value, sizeof value);
  };
  constexpr std::uint32_t magic = 0x32544e50, has_other = 1;  // "PNT2"
  const Snapshot& first = ticks.front();
  put(magic);
  put(static_cast<std::uint32_t>(ticks.size()));
  put(first.membrane_count);
  put(other.empty() ? 0U : has_other);
  put(first.tick);
  put(first.sample.time);
  put(run);
  put(std::uint32_t{0});  // no snapshot is lost between this code and the page

  // All ticks of the fields that are numbers, or of those that are words.
  const auto put_fields = [&]<bool words>(std::bool_constant<words>) {
    for_each_field(tick_table, [&](const auto& field, auto) {
      using Field = std::remove_cvref_t<decltype(field)>;
      const auto put_value = [&]<typename Value>(const Value& value) {
        if constexpr (std::is_enum_v<Value> == words) {
          if constexpr (std::is_same_v<Value, std::array<double, 3>>)
            for (const double x : value) put(static_cast<float>(x));
          else if constexpr (words)
            put(static_cast<std::uint8_t>(value));
          else
            put(static_cast<float>(value));
        }
      };
      if (!(field.use & use_page)) return;
      for (const Snapshot& s : ticks) {
        if constexpr (Field::per_membrane)
          for (std::size_t i = 0; i < s.membrane_count; ++i) put_value(field.get(s.membranes[i]));
        else if constexpr (std::is_same_v<typename Field::Value, double>)
          // Times count from the first tick, so that a float keeps them to a nanosecond.
          put_value(field.get(s) - (std::string_view(field.name) == "time" ? first.sample.time : 0));
        else
          put_value(field.get(s));
      }
    });
  };
  put_fields(std::false_type{});
  for (const float x : other) put(x);
  put_fields(std::true_type{});
}

}  // namespace punctura::live
