// A needle in CHAI3D: a haptic device moves a cursor through the membranes of a scene.
//
//   example SCENE.toml          the first haptic device moves the needle, for 60 s
//   example SCENE.toml --hand   without a device: a simulated hand pushes the needle 20 mm down, at 5 mm/s
//
// It has no graphics: it prints height and force five times a second.
#include <chai3d.h>

#include <cstdio>
#include <cstring>
#include <exception>
#include <fstream>
#include <iterator>

#include "PuncturaEffect.h"

namespace {

/// A hand that begins 5 mm above the tissue and pushes straight down, in CHAI3D's frame.
class Hand : public chai3d::cGenericHapticDevice {
 public:
  Hand() { m_deviceAvailable = true; }
  bool open() override {
    clock_.start(true);
    return m_deviceReady = true;
  }
  bool close() override { return true; }
  bool getPosition(chai3d::cVector3d& position) override {
    position.set(0, 0, 5e-3 - 5e-3 * clock_.getCurrentTimeSeconds());
    return true;
  }

 private:
  chai3d::cPrecisionClock clock_;
};

void run(const char* path, bool hand) {
  std::ifstream file(path);
  if (!file) throw std::runtime_error(std::string(path) + ": this scene file cannot be read");
  const std::string scene{std::istreambuf_iterator<char>(file), {}};

  chai3d::cWorld world;
  auto* tissue = new chai3d::cShapeBox(0.1, 0.1, 0.1);
  world.addChild(tissue);
  // A scene of Punctura has x to the right, y up and z towards the user. In CHAI3D x points towards the user, y to the
  // right and z up.
  tissue->setLocalRot(chai3d::cMatrix3d(0, 0, 1, 1, 0, 0, 0, 1, 0));
  auto* effect = new cPuncturaEffect(tissue, scene);
  tissue->addEffect(effect);

  chai3d::cHapticDeviceHandler handler;
  chai3d::cGenericHapticDevicePtr device = std::make_shared<Hand>();
  if (!hand && !handler.getDevice(device, 0))
    throw std::runtime_error("there is no haptic device: --hand runs without one");
  auto* tool = new chai3d::cToolCursor(&world);
  world.addChild(tool);
  tool->setHapticDevice(device);  // the world is in metres: no workspace radius
  if (!tool->start()) throw std::runtime_error("the haptic device does not start");
  chai3d::cPrecisionClock clock;
  clock.start();
  for (double shown = -1; clock.getCurrentTimeSeconds() < (hand ? 5 : 60);) {
    world.computeGlobalPositions(true);
    tool->updateFromDevice();
    // The needle points straight down here. For the stylus of your device: effect->setAxis(turned back into the frame
    // of the tissue).
    effect->setAxis({0, -1, 0});
    tool->computeInteractionForces();
    tool->applyToDevice();
    if (clock.getCurrentTimeSeconds() - shown < 0.2) continue;
    shown = clock.getCurrentTimeSeconds();
    std::printf("%7.2f mm %7.3f N\n", 1e3 * tool->getDeviceGlobalPos().z(), tool->getDeviceGlobalForce().z());
  }
  tool->stop();
}

}  // namespace

int main(int count, char** arguments) {
  const bool hand = count == 3 && std::strcmp(arguments[2], "--hand") == 0;
  if (count != 2 && !hand) return std::fprintf(stderr, "usage: example SCENE.toml [--hand]\n"), 2;
  try {
    run(arguments[1], hand);
  } catch (const std::exception& e) {
    return std::fprintf(stderr, "%s\n", e.what()), 1;
  }
  return 0;
}
