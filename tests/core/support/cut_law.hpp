// A custom law with memory: it remembers the deepest point of the cut.
#pragma once

#include "punctura/model/law.hpp"

namespace punctura::test {

struct Cut {
  double cut = 0;  ///< the deepest point, m
  static void archive(auto& self, auto& state) { state.fields(self.cut); }
};
/// A cut needs 1 N behind the deepest point of the cut. There is no force in the hole.
struct CutLaw {
  using Scalar = double;
  using Memory = Cut;
  constexpr PiecewiseBand<double, 3> pieces(double = 1, const Memory& memory = {}) const noexcept {
    return {{0, memory.cut}, {{{}, {}, {memory.cut, {-1, 0, 0}, {}}}}};
  }
  constexpr bool advance(Memory& memory, double depth) const noexcept {
    return depth > memory.cut && (memory.cut = depth, true);
  }
};

}  // namespace punctura::test
