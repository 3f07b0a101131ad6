// The model of a loop or a replay: the scene's own, or rivals.
#pragma once

#include <vector>

#include "punctura_runtime/loop/step_maker.hpp"

namespace punctura::bindings {

inline StepMaker model_of(const std::vector<AnyRival>& rivals) {
  return rivals.empty() ? StepMaker() : StepMaker::with_rivals(rivals);
}

}  // namespace punctura::bindings
