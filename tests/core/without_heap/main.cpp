// The servo step in a program without a heap. The program is linked without the C++ library. So a use of operator new
// does not link.
#include <array>
#include <cmath>
#include <cstdio>

#include "punctura/servo/servo_step.hpp"

using namespace punctura;

namespace {

using Law = BasicThickLaw<float>;
using SmallInsertion = InsertionOf<Law, SampledCoupling<float>, FixedStorage<2>>;
using SmallStep = ServoStepOf<SmallInsertion>;

constexpr float period = 1 / 1600.0f;

/// Two walls, 4 mm apart.
SmallInsertion two_walls(Direction direction, Conditioning conditioning) {
  const NeedleF needle{1.08e-3f, 0.28f};
  const Law law(needle, {570, 0.41f, 0.2f, 1e-3f});
  const std::array<SiteOf<Law>, 2> sites{SiteOf<Law>{law, {0, 0, 0}, {0, -1, 0}},
                                         SiteOf<Law>{law, {0, -4e-3f, 0}, {0, -1, 0}}};
  return {sites,    SampledCoupling<float>({400, 1}, period), period, Solver::exact, 0, direction, conditioning,
          0.055e-3f};
}

/// The needle goes in at 5 mm/s to 10 mm and rests. Behind both walls, the friction of the shaft is 2 F.
bool passes(Direction direction, Conditioning conditioning) {
  SmallStep step(two_walls(direction, conditioning), period);
  step.arm();
  double force = 0;
  for (std::uint64_t k = 0; k < 4800; ++k) {
    const double depth = std::fmin(-5e-3 + 5e-3 * static_cast<double>(k) / 1600, 10e-3);
    force = step.step({k, static_cast<double>(k) / 1600, {0, -depth, 0}, {0, -1, 0}, 0, true}).force[1];
  }
  const double expected = 2 * 2 * 0.2 * (570 * 1.08e-3 + 0.41);
  std::printf("force %.6f N\n", force);
  return step.fault() == Fault::none && std::fabs(force - expected) < 2e-3;
}

}  // namespace

int main() {
  return passes(Direction::stylus, Conditioning::low_pass) && passes(Direction::motion, Conditioning::line_fit) ? 0 : 1;
}
