// The insertion of the C ABI.
#include "common.hpp"
#include "punctura/servo/snapshot.hpp"
#include "stepper.hpp"

using namespace punctura::c;

PUNCTURA_STEPPER(insertion, punctura::Insertion)
PUNCTURA_STEPS_IN_SPACE(insertion)

punctura_status punctura_insertion_new(const punctura_scene* scene, punctura_insertion** insertion) {
  return make_handle(scene, insertion, [&](auto& made) {
    std::vector<punctura::Problem> problems;
    auto built = punctura::try_build_insertion(scene->scene, problems);
    if (!built) return fail(std::move(problems));
    made = std::make_unique<punctura_insertion>(std::move(*built));
    return ok;
  });
}

punctura_status punctura_insertion_run(punctura_insertion* insertion, size_t count, const double* positions,
                                       const double* axes, size_t axis_stride, double* forces) {
  if (!insertion || !positions || !axes || !forces || (axis_stride != 0 && axis_stride != 3)) {
    for (size_t i = 0; forces && i < count; ++i) no_force(forces + 3 * i);
    return guarded({insertion, positions, axes, forces}, [] {
      return fail(PUNCTURA_BAD_ARGUMENT, "axis_stride must be 0, one axis for all ticks, or 3, an axis for each tick");
    });
  }
  punctura::Insertion& object = insertion->stepping();
  punctura_status status = ok;
  for (size_t i = 0; i < count; ++i) {
    if (status == ok)
      status = step_in_space(object, positions + 3 * i, axes + axis_stride * i, forces + 3 * i);
    else
      no_force(forces + 3 * i);
  }
  return status;
}

int32_t punctura_insertion_membrane_count(const punctura_insertion* insertion) {
  return insertion ? static_cast<int32_t>(insertion->now.size()) : 0;
}

punctura_status punctura_insertion_membrane(const punctura_insertion* insertion, int32_t membrane,
                                            punctura_membrane_tick* tick) {
  if (membrane < 0 || membrane >= punctura_insertion_membrane_count(insertion)) return PUNCTURA_BAD_ARGUMENT;
  return give_membrane(tick, punctura::record_of(insertion->now.tick(static_cast<size_t>(membrane))));
}
