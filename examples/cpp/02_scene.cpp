// A needle in space, at 40 degrees to the normal, through two membranes 3 mm apart.
#include <cmath>
#include <cstdio>

#include "punctura/punctura.hpp"

int main() {
  using namespace punctura;
  Scene scene{"two walls", {1.08e-3, 0.28}, {400, 1}, {}, {}, Direction::stylus};
  scene.membranes.push_back({"first", {570, 0.41, 0.2, 1.0e-3}, {0, 0, 0}, {0, -1, 0}});
  scene.membranes.push_back({"second", {570, 0.41, 0.2, 0.5e-3}, {0, -4e-3, 0}, {0, -1, 0}});

  Insertion insertion = build_insertion(scene);  // throws SceneError with all problems of the scene
  const double beta = 40 * 3.14159265358979 / 180;
  const Vector3d axis(std::sin(beta), -std::cos(beta), 0);
  for (int k = 0; k <= 4000; ++k) {
    const Vector3d tip = Vector3d(0, 1e-3, 0) + 8e-3 * k / 1600 * axis;
    const Vector3d force = insertion.step(tip, axis);
    if (k % 200 == 0)
      std::printf("y %6.2f mm   force %6.3f %6.3f %6.3f N\n", tip.y() * 1e3, force.x(), force.y(), force.z());
  }
}
