// The table of a tick's fields.
#include "punctura/servo/tick_table.hpp"

#include <doctest/doctest.h>

#include <set>
#include <string>
#include <utility>

#include "punctura/lab/plant/experiment.hpp"

using namespace punctura;

TEST_CASE("every field has a name and a column of its own, a description, and the place for its components") {
  std::set<std::string> names, columns;
  for_each_field(experiment_table, [&](const auto& field, auto) {
    CAPTURE(field.name);
    CHECK(names.insert(field.name).second);
    CHECK(columns.insert(field.column).second);
    CHECK(std::string(field.help).size() > 5);
    using F = std::remove_cvref_t<decltype(field)>;
    const std::string column = field.column;
    const bool is_vector = std::is_same_v<typename F::Value, std::array<double, 3>>;
    CHECK((column.find("{a}") != std::string::npos) == is_vector);
    CHECK((column.find("{i}") != std::string::npos) == F::per_membrane);
    // The page gets numbers as float32: a wide integer would lose digits.
    if (field.use & use_page)
      CHECK((std::is_floating_point_v<typename F::Value> || std::is_enum_v<typename F::Value> || is_vector));
  });
  CHECK(names.size() == std::tuple_size_v<decltype(experiment_table)>);
}

TEST_CASE("a field is read from its record, and a stored one can be set") {
  Snapshot snapshot{};
  snapshot.sample.time = 1.5;
  snapshot.membranes[0].depth = 2e-3;
  for_each_field(tick_table, [&](const auto& field, auto) {
    using F = std::remove_cvref_t<decltype(field)>;
    if constexpr (std::is_same_v<typename F::Value, double>) {
      if (std::string(field.name) == "depth") {
        if constexpr (F::per_membrane) CHECK(field.get(snapshot.membranes[0]) == 2e-3);
      } else if (std::string(field.name) == "time") {
        if constexpr (!F::per_membrane) CHECK(std::exchange(field.get(snapshot), 2.5) == 1.5);
      }
    }
  });
  CHECK(snapshot.sample.time == 2.5);
}
