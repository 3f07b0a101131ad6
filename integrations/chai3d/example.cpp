// A needle in CHAI3D: a haptic device moves a cursor through the membranes of a scene.   example SCENE.toml
//
// Compile it with CHAI3D and libpunctura. It has no graphics: it prints the force twice a second.
#include <chai3d.h>

#include <cstdio>
#include <fstream>
#include <iterator>

#include "PuncturaEffect.h"

int main(int count, char** arguments) {
  if (count != 2) return std::fprintf(stderr, "usage: example SCENE.toml\n"), 2;
  std::ifstream file(arguments[1]);
  const std::string scene{std::istreambuf_iterator<char>(file), {}};

  chai3d::cWorld world;
  auto* tissue = new chai3d::cShapeBox(0.1, 0.1, 0.1);
  world.addChild(tissue);
  tissue->addEffect(new cPuncturaEffect(tissue, scene));

  chai3d::cHapticDeviceHandler handler;
  chai3d::cGenericHapticDevicePtr device;
  if (!handler.getDevice(device, 0)) return std::fprintf(stderr, "there is no haptic device\n"), 1;
  auto* tool = new chai3d::cToolCursor(&world);
  world.addChild(tool);
  tool->setHapticDevice(device);
  tool->start();
  chai3d::cPrecisionClock clock;
  clock.start();
  for (double shown = 0; clock.getCurrentTimeSeconds() < 60;) {
    world.computeGlobalPositions(true);
    tool->updateFromDevice();
    tool->computeInteractionForces();
    tool->applyToDevice();
    if (clock.getCurrentTimeSeconds() - shown < 0.5) continue;
    shown = clock.getCurrentTimeSeconds();
    std::printf("%.2f N\n", tool->getDeviceGlobalForce().length());
  }
  tool->stop();
  return 0;
}
