// Many ticks of a model in space, along positions.
#pragma once

#include <string_view>
#include <vector>

#include "bindings.hpp"
#include "punctura/servo/snapshot.hpp"
#include "state.hpp"
#include "tick_columns.hpp"
#include "ticks.hpp"

namespace punctura::bindings {

/// Makes n ticks. model: of one membrane, or of a scene; a OneThread. fields: those that Ticks has.
template <typename Model>
TicksObject run_in_space(Model& model, const std::vector<std::string_view>& fields, const ArrayLike& positions,
                         const ArrayLike& axis, const ProgressArgument& progress) {
  constexpr bool has_scene = requires { model.tick(0); };
  Snapshot record{};
  bool uses_axis = true;
  if constexpr (has_scene) uses_axis = model.uses_axis();
  if constexpr (has_scene)
    record.membrane_count = static_cast<std::uint32_t>(model.size());
  else
    record.membrane_count = 1;
  TickColumns columns(fields);
  columns.reserve(nb::len_hint(positions), record.membrane_count);  // before the positions are copied
  const Input p = points(positions, "p");
  const std::size_t n = p.shape(0);
  const Rows axes(input(axis, "axis"), n, "axis");
  check_places(p.data(), 3 * n, "p", 3);
  if (uses_axis) axes.check("axis");
  const OneThread::Running running(model);
  const auto tick = [&](std::size_t i) {
    const Vector3d position(p.data() + 3 * i), direction = axes[i].stableNormalized();
    record.sample.position = to_array(position);
    record.sample.axis = to_array(direction);
    record.force = to_array(model.step(position, direction));
    if constexpr (has_scene) {
      record.tip = to_array(model.tip());
      for (std::size_t j = 0; j < model.size(); ++j) record.membranes[j] = record_of(model.tick(j));
    } else {
      record.membranes[0] = record_of(model.tick());
    }
    columns.add(record);
  };
  make_ticks(n, tick, progress);
  return columns.to_ticks(3, !has_scene);
}

/// One tick. Throws ValueError.
template <typename Model>
Triple step_in_space(Model& model, const Triple& p, const Triple& axis) {
  check_places(p.data(), 3, "p");
  bool uses_axis = true;
  if constexpr (requires { model.uses_axis(); }) uses_axis = model.uses_axis();
  return to_array(model.step(Vector3d(p), uses_axis ? direction(axis) : Vector3d()));
}

/// Defines step and peek. T is a Model, and a OneThread.
template <typename Model, typename T>
void def_steps_in_space(nb::class_<T>& cls) {
  cls.def(
         "step",
         [](T& self, const Triple& p, const Triple& axis) {
           self.must_rest();
           return step_in_space(self, p, axis);
         },
         nb::arg("p"), nb::arg("axis"),
         "Makes one tick. Returns the force on the device, N.\n\n"
         "p: measured position, m. axis: direction of the needle, of any length but 0. Raises ValueError.")
      .def(
          "peek",
          [](const T& self, const Triple& p, const Triple& axis) {
            self.must_rest();
            Model copy = self;
            return step_in_space(copy, p, axis);
          },
          nb::arg("p"), nb::arg("axis"), "The force of step(p, axis), without changing the state.");
}

/// Defines run(), with these fields.
template <typename T>
void def_run_in_space(nb::class_<T>& cls, const std::vector<std::string_view>& fields, const char* doc) {
  cls.def(
      "run",
      [fields](T& self, const ArrayLike& positions, const ArrayLike& axis, const ProgressArgument& progress) {
        return run_in_space(self, fields, positions, axis, progress);
      },
      nb::arg("p"), nb::arg("axis"), nb::kw_only(), nb::arg("progress") = nb::none(), doc);
}

}  // namespace punctura::bindings
