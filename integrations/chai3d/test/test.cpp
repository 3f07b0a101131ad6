// The effect gives the forces of the core, bit for bit.   test REFERENCE
#include <cstdio>
#include <cstring>
#include <fstream>
#include <iterator>
#include <vector>

#include "PuncturaEffect.h"

namespace {

int failures = 0;
void require(bool holds, const char* what) {
  if (holds) return;
  std::fprintf(stderr, "not so: %s\n", what);
  ++failures;
}

std::string read(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

}  // namespace

int main(int, char** arguments) {
  const std::string folder = arguments[1], scene = read(folder + "/scene.toml"), bytes = read(folder + "/motion.f64");
  std::vector<double> rows(bytes.size() / sizeof(double));
  std::memcpy(rows.data(), bytes.data(), rows.size() * sizeof(double));
  const std::size_t n = rows.size() / 9;

  chai3d::cGenericObject object;
  double now = 1e6;
  cPuncturaEffect effect(&object, scene, 1, [&] { return now; });
  const auto equal = [&](const chai3d::cVector3d& force, std::size_t k) {
    const double numbers[3] = {force.x(), force.y(), force.z()};
    return std::memcmp(numbers, &rows[9 * k + 6], sizeof numbers) == 0;
  };
  const auto force_at = [&](cPuncturaEffect& of, std::size_t k) {
    chai3d::cVector3d force;
    of.setAxis({rows[9 * k + 3], rows[9 * k + 4], rows[9 * k + 5]});
    of.computeForce({rows[9 * k], rows[9 * k + 1], rows[9 * k + 2]}, {}, 0, force);
    return force;
  };
  bool same = true;
  for (std::size_t k = 0; k < n; ++k) {
    now = 1e6 + static_cast<double>(k) / 1600;
    same &= equal(force_at(effect, k), k);
  }
  require(same && n == 4000, "every force equals the core's, one haptic cycle a tick");
  require(effect.ticks() == n, "one tick a cycle");

  // Three cycles a tick: the force stays between two ticks, and no tick is lost.
  cPuncturaEffect fast(&object, scene, 1, [&] { return now; });
  same = true;
  for (std::size_t k = 0; k < n; ++k)
    for (int i = 0; i < 3; ++i) {
      now = 2e6 + (static_cast<double>(k) + i / 3.0) / 1600;
      same &= equal(force_at(fast, k), k);
    }
  require(same && fast.ticks() == n, "three cycles a tick give the same forces");

  // Who calls no setAxis() has a needle that points down, into a scene whose membranes lie flat.
  cPuncturaEffect down(&object, scene, 1, [&] { return now; });
  chai3d::cVector3d force;
  for (int k = 0; k < 800; ++k) {
    now = 3e6 + k / 1600.0;
    down.computeForce({0, 1e-3 - 5e-3 * k / 1600, 0}, {}, 0, force);
  }
  require(force.y() > 0.1, "the needle points down by itself");

  // A position that is no number gives no force, and the tick after it continues.
  now += 1 / 1600.0;
  require(!down.computeForce({0, std::nan(""), 0}, {}, 0, force) && force.y() == 0, "no force at NaN");
  now += 1 / 1600.0;
  down.computeForce({0, 1e-3 - 5e-3 * 799 / 1600, 0}, {}, 0, force);
  require(force.y() > 0.1, "the tick after NaN continues");

  now += 1;
  require(!effect.computeForce({0, 0, 0}, {}, 0, force) && force.y() == 0, "no force after a gap");
  require(!effect.computeForce({0, -0.005, 0}, {}, 1, force), "one point only");
  effect.setEnabled(false);
  require(!effect.computeForce({0, -0.005, 0}, {}, 0, force), "no force of a disabled effect");
  const auto refused = [&](const std::string& text, double metres_per_unit, const char* named) {
    try {
      cPuncturaEffect wrong(&object, text, metres_per_unit);
      require(false, named);
    } catch (const std::invalid_argument& e) {
      require(std::string(e.what()).find(named) != std::string::npos, e.what());
    }
  };
  refused("name = 1", 1, "needle");
  refused(scene, 0, "metres_per_unit");
  refused(scene, std::nan(""), "metres_per_unit");
  if (failures == 0) std::printf("chai3d: %zu forces equal the core's bit for bit\n", n);
  return failures;
}
