// Measures the wake-up latency of the servo loop: its pacer and real-time settings, with a whole servo tick per
// wake-up.
//
//   bench_wakeups --seconds S --rate HZ --priority P --processor N --dump FILE
//
// FILE: the latency of each wake-up, ns, as 64-bit integers. Prints one JSON object for wakeups.py, which runs this
// program.
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <string>
#include <thread>

#include "punctura_runtime/loop/pacer.hpp"
#include "punctura_runtime/loop/servo_loop.hpp"

namespace {

using namespace punctura;

/// A device without hardware. It records its wake-up times and moves a needle back and forth through the tissue.
class Metronome : public Device {
 public:
  Metronome(double rate, double seconds, const os::RealtimeSettings& settings)
      : settings_(settings), latencies_(static_cast<std::size_t>(std::lround(rate * seconds))) {
    info_.backend = "metronome";
    info_.rate = rate;
  }
  ~Metronome() override { stop(); }

  const DeviceInfo& info() const noexcept override { return info_; }
  void start(Tick tick) override {
    thread_ = std::thread([this, tick] { run(tick); });
  }
  void stop() noexcept override {
    if (thread_.joinable()) thread_.join();
  }

  const std::vector<std::int64_t>& latencies() const noexcept { return latencies_; }
  const std::vector<os::RealtimeItem>& realtime() const noexcept { return realtime_; }
  std::uint64_t missed() const noexcept { return missed_; }

 private:
  void run(Tick tick) noexcept {
    realtime_ = os::make_realtime(settings_.at_rate(info_.rate));
    Pacer<> pacer(info_.rate);
    auto latency = latencies_.begin();
    for (std::uint64_t k = 0; latency != latencies_.end(); ++k) {
      const std::int64_t asleep = os::now_ns();
      missed_ += pacer.wait();
      const std::int64_t woken = os::now_ns();
      // A tick that was already due did not wait, so it is not a wake-up. cyclictest counts in the same way.
      if (pacer.due() > asleep) *latency++ = woken - pacer.due();
      const double time = static_cast<double>(woken) * 1e-9;
      tick({k, time, {0, 5e-3 * std::cos(time), 0}, {0, -1, 0}, 0, true});
    }
  }

  DeviceInfo info_;
  os::RealtimeSettings settings_;
  std::vector<std::int64_t> latencies_;
  std::vector<os::RealtimeItem> realtime_;
  std::uint64_t missed_ = 0;
  std::thread thread_;
};

}  // namespace

int main(int argc, char** argv) {
  double seconds = 5, rate = 1600;
  os::RealtimeSettings settings;
  std::string file;
  for (int i = 1; i + 1 < argc; i += 2) {
    if (std::strcmp(argv[i], "--seconds") == 0) seconds = std::atof(argv[i + 1]);
    if (std::strcmp(argv[i], "--rate") == 0) rate = std::atof(argv[i + 1]);
    if (std::strcmp(argv[i], "--priority") == 0) settings.priority = std::atoi(argv[i + 1]);
    if (std::strcmp(argv[i], "--processor") == 0) settings.processor = std::atoi(argv[i + 1]);
    if (std::strcmp(argv[i], "--dump") == 0) file = argv[i + 1];
  }
  const PlacedMembrane wall{"wall", {570, 0.41, 0.2, 1e-3}, {0, 0, 0}, {0, -1, 0}};
  auto device = std::make_shared<Metronome>(rate, seconds, settings);
  ServoLoop loop(device, {"one wall", {1.08e-3, 0.28}, {400, 1}, {wall}});
  loop.arm();
  loop.start();
  device->stop();  // waits for the last tick
  loop.stop();

  const auto& latencies = device->latencies();
  std::ofstream out(file, std::ios::binary);
  out.write(reinterpret_cast<const char*>(latencies.data()),
            static_cast<std::streamsize>(latencies.size() * sizeof(std::int64_t)));
  if (!out) {
    std::fprintf(stderr, "cannot write %s\n", file.c_str());
    return 2;
  }
  std::printf("{\"ticks\": %zu, \"missed\": %llu, \"realtime\": {", latencies.size(),
              static_cast<unsigned long long>(device->missed()));
  const char* comma = "";
  for (const auto& item : device->realtime()) {
    std::printf("%s\"%s\": %s", comma, item.what.c_str(), item.granted ? "true" : "false");
    comma = ", ";
  }
  std::printf("}}\n");
}
