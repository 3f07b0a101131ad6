// The table of a tick's fields.
#include "punctura/servo/tick_table.hpp"

#include <doctest/doctest.h>

#include <set>
#include <string>

#include "punctura/lab/plant/experiment_table.hpp"

using namespace punctura;

TEST_CASE("every field has a name and a column of its own, a description, and the place for its components") {
  std::set<std::string> names, columns;
  for_each_field(experiment_table, [&](const auto& field, auto) {
    CAPTURE(field.name);
    CHECK(names.insert(field.name).second);
    CHECK(columns.insert(field.column).second);
    CHECK(std::string(field.says).size() > 5);
    using F = std::remove_cvref_t<decltype(field)>;
    using Part = std::conditional_t<F::per_membrane, MembraneRecord,
                                    std::conditional_t<F::part == TickPart::extra, ExperimentExtra, Snapshot>>;
    const std::string column = field.column;
    const bool is_vector = std::is_same_v<typename F::template Value<Part>, std::array<double, 3>>;
    CHECK((column.find("{a}") != std::string::npos) == is_vector);
    CHECK((column.find("{i}") != std::string::npos) == F::per_membrane);
    if (field.use & use_input) CHECK(F::template stored<Part>);
    if (field.use & use_page) CHECK(fits_the_page<typename F::template Value<Part>>);
  });
  CHECK(names.size() == std::tuple_size_v<decltype(experiment_table)>);
}

TEST_CASE("a field is read from its record, and a stored one can be set") {
  Snapshot snapshot{};
  snapshot.sample.time = 1.5;
  snapshot.membranes[0].depth = 2e-3;
  for_each_field(tick_table, [&](const auto& field, auto) {
    using F = std::remove_cvref_t<decltype(field)>;
    if constexpr (F::part == TickPart::snapshot) {
      if (std::string(field.name) == "time") {
        if constexpr (std::is_same_v<typename F::template Value<Snapshot>, double>) {
          CHECK(field.get(snapshot) == 1.5);
          field.get(snapshot) = 2.5;
        }
      }
    } else if (std::string(field.name) == "depth") {
      if constexpr (std::is_same_v<typename F::template Value<MembraneRecord>, double>)
        CHECK(field.get(snapshot.membranes[0]) == 2e-3);
    }
  });
  CHECK(snapshot.sample.time == 2.5);
}

TEST_CASE("a derived field returns a value and is not stored") {
  const auto twice = detail::tick_field<TickPart::snapshot>(
      "twice", "twice_s", "s", use_file, [](auto& s) { return 2 * s.sample.time; }, "Twice the time");
  Snapshot snapshot{};
  snapshot.sample.time = 3;
  CHECK(twice.get(snapshot) == 6);
  CHECK(!decltype(twice)::stored<Snapshot>);
}
