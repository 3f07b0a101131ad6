// The tables of a TOML file as JSON, as they are written: the page's editor shows a scene file in its own keys.
#define TOML_EXCEPTIONS 0
#include <toml++/toml.h>

#include <string>
#include <string_view>

#include "json.hpp"

namespace punctura::live {

namespace {

void write(Json& json, const toml::node& node) {
  if (const auto* table = node.as_table()) {
    json.open('{');
    for (const auto& [key, value] : *table) {
      json.key(key.str());
      write(json, value);
    }
    json.close('}');
  } else if (const auto* array = node.as_array()) {
    json.open('[');
    for (const auto& value : *array) write(json, value);
    json.close(']');
  } else if (const auto* word = node.as_string()) {
    json.value(std::string_view(word->get()));
  } else if (const auto* whole = node.as_integer()) {
    json.value(whole->get());
  } else if (const auto* number = node.as_floating_point()) {
    json.value(number->get());
  } else if (const auto* flag = node.as_boolean()) {
    json.value(flag->get());
  } else {
    json.null();  // a date or a time: no scene has one
  }
}

}  // namespace

/// Empty if the text is not TOML.
std::string tables_of(std::string_view text) {
  const toml::parse_result file = toml::parse(text);
  if (!file) return "";
  Json json;
  write(json, file.table());
  return json.text();
}

}  // namespace punctura::live
