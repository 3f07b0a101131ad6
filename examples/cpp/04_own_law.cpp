// A custom friction law: any class that provides the pieces of its band.
#include <cstdio>

#include "punctura/punctura.hpp"

/// A gel whose friction grows with the inserted length, up to its bottom: friction(q) = slope q, in both directions.
class GelLaw {
 public:
  using Scalar = double;

  GelLaw(double slope, double bottom) {
    // A piece is {origin, lower, upper}. An edge is {c0, c1, c2}: c0 + c1 x + c2 x^2, N, with x = depth - origin, m.
    // pieces[0], before the first break, stays 0.
    pieces_.breaks = {0, bottom};
    pieces_.pieces[1] = {0, {0, -slope, 0}, {0, slope, 0}};
    pieces_.pieces[2] = {bottom, {-slope * bottom, 0, 0}, {slope * bottom, 0, 0}};
  }
  const punctura::PiecewiseBand<double, 3>& pieces() const noexcept { return pieces_; }

 private:
  punctura::PiecewiseBand<double, 3> pieces_{};
};
static_assert(punctura::Law<GelLaw>);

int main() {
  punctura::Proxy1d proxy(GelLaw(50, 30e-3), punctura::Coupling{400, 1}, 1 / 1600.0);
  for (int k = 0; k <= 1600; ++k) {
    const double depth = k < 800 ? 20e-3 * k / 800 : 20e-3 * (1600 - k) / 800;
    const double force = proxy.step(depth);
    if (k % 100 == 0) std::printf("depth %6.2f mm   force %7.4f N\n", depth * 1e3, force);
  }
}
