// A custom device in less than 80 lines: implement Device, and call the tick for each reading.
//
// This device is an imaginary pendulum. Its bob carries the needle and swings into the tissue. Replace read() and
// write() by the calls of your driver. Any device that this program clocks needs the rest unchanged.
#include <atomic>
#include <chrono>
#include <cstdio>
#include <thread>

#include "punctura_runtime/loop/pacer.hpp"
#include "punctura_runtime/loop/servo_loop.hpp"

using namespace punctura;

class Pendulum : public Device {
 public:
  ~Pendulum() override { stop(); }

  const DeviceInfo& info() const noexcept override { return info_; }
  void start(Tick tick) override {
    if (thread_.joinable()) throw DeviceError("the pendulum is already running");
    stop_ = false;
    thread_ = std::thread([this, tick] { run(tick); });
  }
  void stop() noexcept override {  // on return the force is zero and the ticks have ended
    stop_ = true;
    if (thread_.joinable()) thread_.join();
  }

 private:
  void run(Tick tick) noexcept {
    // Without real-time priority another program can delay a tick by 20 ms, which is a fault.
    for (const os::RealtimeItem& item : os::make_realtime(os::RealtimeSettings{}.at_rate(info_.rate)))
      std::printf("%s: %s %s\n", item.what.c_str(), item.granted ? "granted" : "not granted,", item.detail.c_str());
    const std::int64_t begin = os::now_ns();
    Pacer<> pacer(info_.rate);
    for (std::uint64_t k = 0; !stop_; ++k) {
      pacer.wait();
      write(tick({k, static_cast<double>(os::now_ns() - begin) * 1e-9, read(), {0, -1, 0}, 0, true}));
    }
    write({0, 0, 0});
  }

  /// In Punctura's axes, m: x right, y up, z towards the user.
  std::array<double, 3> read() const noexcept { return {0, height_, 0}; }
  /// Applies the force, N, and simulates one period.
  void write(const Tick::Force& force) noexcept {
    speed_ += (force[1] / mass - stiffness / mass * height_) / info_.rate;
    height_ += speed_ / info_.rate;
  }

  static constexpr double mass = 0.2, stiffness = 2;  // kg; N/m: a period of two seconds
  // max_force, N: the loop reduces its limits to it. rate, Hz: ticks per second.
  const DeviceInfo info_{
      .backend = "pendulum", .model = "made up", .serial = "", .has_orientation = true, .max_force = 3, .rate = 1000};
  double height_ = 0.05, speed_ = 0;  // m above its lowest point, m/s
  std::atomic<bool> stop_{false};
  std::thread thread_;
};

int main() {
  const PlacedMembrane wall{"wall", {570, 0.41, 0.2, 1e-3}, {0, 0.02, 0}, {0, -1, 0}};
  ServoLoop loop(std::make_shared<Pendulum>(), {"one wall", {1.08e-3, 0.28}, {400, 1}, {wall}});
  loop.start();
  loop.arm();
  while (loop.report().ticks < 2000) {
    std::this_thread::sleep_for(std::chrono::milliseconds(200));
    const Snapshot now = loop.latest();
    std::printf("y %6.2f mm   force %6.3f N   %s\n", now.sample.position[1] * 1e3, now.force[1], describe(now.fault));
  }
  loop.stop();
}
