// A servo loop in ten lines: a scene on a device, with ticks on the device's thread and all safety limits on.
#include <cstdio>

#include "punctura_runtime/backends/simulated.hpp"
#include "punctura_runtime/loop/servo_loop.hpp"

using namespace punctura;

int main() {
  // For hardware use open_device("openhaptics") from punctura_runtime/backends/registry.hpp
  auto device = std::make_shared<SimulatedDevice>(StrokesMotion({{0, 5e-3, 0}, {0, -10e-3, 0}}, 1), SimulatedOptions{});
  const PlacedMembrane wall{"wall", {570, 0.41, 0.2, 1e-3}, {0, 0, 0}, {0, -1, 0}};
  ServoLoop loop(device, {"one wall", {1.08e-3, 0.28}, {400, 1}, {wall}});
  loop.start();
  loop.arm();  // the force ramps up over half a second as soon as the tip is outside tissue
  while (loop.report().ticks < 4000) {
    std::this_thread::sleep_for(std::chrono::milliseconds(250));
    std::printf("y %6.2f mm   force %6.3f N\n", loop.latest().tip[1] * 1e3, loop.latest().force[1]);
  }
  loop.stop();  // sets zero force, then ends the ticks
}
