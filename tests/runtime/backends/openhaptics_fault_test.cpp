// Failures of the HD device, and the motors' force after them.
#include <limits>

#include "core/support/paper_scene.hpp"
#include "core/support/tick.hpp"
#include "punctura_runtime/loop/servo_loop.hpp"
#include "runtime/support/fake_hd.hpp"
#include "runtime/support/patient.hpp"

using namespace punctura;
using namespace punctura::test;

namespace {

constexpr unsigned long long moment = 1800, for_ever = ~0ull, ten_ms = 16;

/// A run that is in the tissue at tick `moment`, with force on.
struct InTissue {
  explicit InTissue(double temperature = 0) {
    reset_fake_hd([&](fake_hd_settings& s) { s.temperature = temperature; });
    device = std::make_shared<OpenHapticsDevice>(with_fake_hd());
    fake_hd().restart();
    loop = std::make_unique<ServoLoop>(device, paper_scene(), patient());
    loop->arm();
  }
  void go(unsigned long long ticks = 2 * moment) {
    loop->start();
    until_tick(ticks);
  }
  std::shared_ptr<OpenHapticsDevice> device;
  std::unique_ptr<ServoLoop> loop;
};

bool force_at(const fake_hd_record& r) { return r.force[0] != 0 || r.force[1] != 0 || r.force[2] != 0; }

struct Trouble {
  const char* what;
  int fault;
  unsigned value;
  unsigned long long ticks;
  Fault latched;
  const char* words;
};

const Trouble troubles[] = {
    {"the link breaks for one reading", FAKE_HD_ERROR_AT_BEGIN, 0x302, 1, Fault::device, "COMM_ERROR"},
    {"the link breaks", FAKE_HD_ERROR_AT_BEGIN, 0x302, for_ever, Fault::device, "cable"},
    {"a force is not sent", FAKE_HD_ERROR_AT_END, 0x302, 1, Fault::device, "COMM_ERROR"},
    {"forces are not sent for 5 ms", FAKE_HD_ERROR_AT_END, 0x302, 8, Fault::device, "COMM_ERROR"},
    {"a force is refused", FAKE_HD_ERROR_AT_END, 0x204, 1, Fault::device, "FORCE_ERROR"},
    {"the device has a fault", FAKE_HD_ERROR_AT_BEGIN, 0x300, for_ever, Fault::device, "DEVICE_FAULT"},
    {"the scheduler does not keep up", FAKE_HD_ERROR_AT_BEGIN, 0x304, 1, Fault::device, "TIMER_ERROR"},
    {"an error of which we do not know", FAKE_HD_ERROR_AT_BEGIN, 0x777, 1, Fault::device, "0x777"},
    {"the cable is pulled", FAKE_HD_UNPLUG, 0, for_ever, Fault::device, "COMM_ERROR"},
    {"the position jumps", FAKE_HD_JUMP, 250, for_ever, Fault::position_jump, ""},
    {"the position jumps and comes back", FAKE_HD_JUMP, 250, 1, Fault::position_jump, ""},
    {"the position is no number", FAKE_HD_NOT_A_NUMBER, 0, 1, Fault::non_finite_input, ""},
};

}  // namespace

TEST_CASE("after every fault the motors' force is zero within 10 ms and stays zero") {
  for (const Trouble& trouble : troubles) {
    CAPTURE(trouble.what);
    InTissue t;
    fake_hd().inject(trouble.fault, trouble.value, moment, trouble.ticks);
    t.go();
    const auto log = fake_hd_log();
    REQUIRE(force_at(log[moment - 1]));
    bool any = false;
    for (std::size_t k = moment + ten_ms; k < log.size(); ++k) any = any || force_at(log[k]);
    CHECK_FALSE(any);
    CHECK(t.loop->latest().fault == trouble.latched);
    CHECK(t.loop->latest().force == zero);
    const std::string text = t.device->trouble();
    CHECK(text.empty() == (trouble.latched != Fault::device));
    CHECK_MESSAGE(text.find(trouble.words) != std::string::npos, text);
    t.loop->stop();
    CHECK(held_force() == zero);
    CHECK(fake_hd().operations() == 0);
    CHECK(fake_hd().misuses() == 0);
  }
}

TEST_CASE("the step gets an error of the library once, and no tick follows") {
  InTissue t;
  auto& ring = t.loop->listen(8192);
  fake_hd().inject(FAKE_HD_ERROR_AT_END, 0x300, moment, 1);
  t.go();
  const auto ticks = t.loop->report().ticks;
  CHECK(ticks == moment + 2);  // the tick whose force was not sent, and one that reports it
  int unhealthy = 0;
  ring.pop(8192, [&](const Snapshot& s) { unhealthy += s.sample.healthy ? 0 : 1; });
  CHECK(unhealthy == 1);
  CHECK(t.loop->fault_history().back().fault == Fault::device);
}

TEST_CASE("a calibration lost during a run ends the force, with advice") {
  InTissue t;
  fake_hd().inject(FAKE_HD_CALIBRATION, 0x5002, moment, 1);
  t.go(2 * moment);
  const auto log = fake_hd_log();
  bool any = false;
  for (std::size_t k = moment + 256 + ten_ms; k < log.size(); ++k) any = any || force_at(log[k]);
  CHECK_FALSE(any);
  CHECK(t.loop->latest().fault == Fault::device);
  CHECK(t.device->trouble().find("calibrate") != std::string::npos);
}

TEST_CASE("warnings are counted and reported, and the force continues") {
  InTissue t;
  fake_hd().inject(FAKE_HD_ERROR_AT_BEGIN, 0x200, 100, 25);
  fake_hd().inject(FAKE_HD_ERROR_AT_END, 0x203, 200, 1);
  t.go(moment);
  CHECK(t.loop->latest().fault == Fault::none);
  CHECK(force_at(fake_hd_log()[moment - 1]));
  std::string all;
  for (const auto& line : t.device->statements()) all += line + "\n";
  CHECK_MESSAGE(all.find("warned 25 times: WARM_MOTORS") != std::string::npos, all);
  CHECK_MESSAGE(all.find("warned 1 times: EXCEEDED_MAX_VELOCITY") != std::string::npos, all);
  CHECK(t.device->trouble().empty());
}

TEST_CASE("hot motors get no force") {
  InTissue t(1.0);
  t.go();
  CHECK(t.loop->latest().sample.motor_temperature == 1.0);
  bool any = false;
  for (const auto& record : fake_hd_log()) any = any || force_at(record);
  CHECK_FALSE(any);
}

TEST_CASE("a motor temperature that is not a number is a fault, also beside others") {
  InTissue t(std::numeric_limits<double>::quiet_NaN());
  t.go();
  CHECK(t.loop->latest().fault == Fault::non_finite_input);
}

TEST_CASE("stop leaves zero force; a second stop, or the destructor of a running device, is harmless") {
  for (int k = 0; k < 5; ++k) {
    InTissue t;
    t.go(moment);
    if (k % 2 == 0) {
      t.loop->stop();
      t.loop->stop();
      t.device->stop();
      CHECK(held_force() == zero);
      CHECK_FALSE(fake_hd().scheduler_runs());
    }
    t.loop.reset();
    t.device.reset();
    CHECK(held_force() == zero);
    CHECK_FALSE(fake_hd().scheduler_runs());
    CHECK(fake_hd().operations() == 0);
    CHECK(fake_hd().devices_open() == 0);
    CHECK(fake_hd().misuses() == 0);
  }
}

TEST_CASE("a stopped device starts again, also after a fault, and its clock continues") {
  InTissue t;
  double last = -1;
  for (int k = 0; k < 4; ++k) {
    if (k == 1) fake_hd().inject(FAKE_HD_ERROR_AT_BEGIN, 0x302, 50, 1);
    t.loop->reset();
    t.go(100);
    CHECK(t.device->trouble().empty() == (k != 1));
    t.loop->stop();
    const Snapshot s = t.loop->latest();
    CHECK(s.fault == (k == 1 ? Fault::device : Fault::none));
    CHECK(s.sample.time > last);
    last = s.sample.time;
    fake_hd().restart();
  }
  CHECK(fake_hd().misuses() == 0);
}

TEST_CASE("a scheduler that stops calling is reported, and stop still leaves zero force") {
  InTissue t;
  fake_hd().inject(FAKE_HD_FREEZE, 0, moment, 1);
  t.go(2 * moment);
  CHECK(t.device->trouble().find("not called") != std::string::npos);
  CHECK(held_force() != zero);  // before the stop, nothing can change it
  t.loop->stop();
  CHECK(held_force() == zero);
  CHECK(fake_hd().misuses() == 0);
}
