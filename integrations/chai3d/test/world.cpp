// The effect in a world of CHAI3D itself: a cursor moves on the reference motion, and every force is the core's.
//   world REFERENCE
#include <chai3d.h>

#include <cstdio>
#include <cstring>
#include <fstream>
#include <iterator>
#include <vector>

#include "PuncturaEffect.h"

namespace {

/// A device that is where the test says, and that keeps the force that it gets.
class PlayedDevice : public chai3d::cGenericHapticDevice {
 public:
  PlayedDevice() { m_deviceAvailable = m_deviceReady = true; }
  bool open() override { return true; }
  bool close() override { return true; }
  bool getPosition(chai3d::cVector3d& position) override {
    position = at;
    return true;
  }
  bool setForceAndTorqueAndGripperForce(const chai3d::cVector3d& force, const chai3d::cVector3d&, double) override {
    given = force;
    return true;
  }
  chai3d::cVector3d at{0, 0, 0}, given{0, 0, 0};
};

std::string read(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

}  // namespace

int main(int, char** arguments) {
  const std::string folder = arguments[1], bytes = read(folder + "/motion.f64");
  std::vector<double> rows(bytes.size() / sizeof(double));
  std::memcpy(rows.data(), bytes.data(), rows.size() * sizeof(double));
  const std::size_t n = rows.size() / 9;

  double now = 1e6;
  chai3d::cWorld world;
  auto* tissue = new chai3d::cShapeBox(0.1, 0.1, 0.1);
  world.addChild(tissue);
  tissue->setLocalRot(chai3d::cMatrix3d(0, 0, 1, 1, 0, 0, 0, 1, 0));  // as in example.cpp
  auto* effect = new cPuncturaEffect(tissue, read(folder + "/scene.toml"), 1, [&] { return now; });
  tissue->addEffect(effect);
  auto device = std::make_shared<PlayedDevice>();
  auto* tool = new chai3d::cToolCursor(&world);
  world.addChild(tool);
  tool->setHapticDevice(device);
  tool->setWaitForSmallForce(false);
  tool->setUseForceRise(false);
  if (!tool->start()) return std::fprintf(stderr, "the cursor does not start\n"), 1;

  std::size_t same = 0, in_tissue = 0;
  for (std::size_t k = 0; k < n; ++k) {
    now = 1e6 + static_cast<double>(k) / 1600;
    const double* row = &rows[9 * k];
    device->at.set(row[2], row[0], row[1]);
    effect->setAxis({row[3], row[4], row[5]});
    world.computeGlobalPositions(true);
    tool->updateFromDevice();
    tool->computeInteractionForces();
    tool->applyToDevice();
    const chai3d::cVector3d& f = device->given;
    same += f.y() == row[6] && f.z() == row[7] && f.x() == row[8];  // equal bits, but for the sign of 0
    in_tissue += row[6] != 0 || row[7] != 0 || row[8] != 0;
  }
  if (same != n || n != 4000 || in_tissue < 1000 || effect->ticks() != n)
    return std::fprintf(stderr, "%zu of %zu forces equal the core's, %zu in tissue\n", same, n, in_tissue), 1;
  std::printf("chai3d: in CHAI3D's own world %zu forces on the device equal the core's, %zu of them in tissue\n", n,
              in_tissue);
}
