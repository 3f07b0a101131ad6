#include "punctura_runtime/backends/haply/service.hpp"

#include <doctest/doctest.h>

#include <thread>

#include "core/support/allocations.hpp"
#include "punctura_runtime/backends/haply/haply_device.hpp"
#include "punctura_runtime/backends/haply/websocket.hpp"
#include "punctura_runtime/os/os.hpp"
#include "runtime/support/haply_fake.hpp"

using namespace punctura;
using namespace punctura::test;
using namespace punctura::haply;

namespace {

std::string refusal(const FakeSettings& settings, const std::string& device = "") {
  HaplyFake fake(settings);
  HaplyOptions options;
  options.url = fake.url();
  options.device = device;
  options.real_time = false;
  try {
    const HaplyDevice opened(options);
  } catch (const DeviceError& error) {
    return error.what();
  }
  return "opened";
}

BackendStatus::State state(const FakeSettings& settings, std::string& words) {
  HaplyFake fake(settings);
  const BackendStatus status = status_at(fake.url());
  words = status.detail;
  return status.state;
}

}  // namespace

TEST_CASE("the version is found in every known answer of /version, and selects the form of the command") {
  CHECK(find_version(R"({"version":"3.5.2"})") == Version{3, 5});
  CHECK(find_version(R"({"api":"1.0","service_version":"3.4"})") == Version{3, 4});
  CHECK(find_version("12\n3.10.1") == Version{3, 10});
  CHECK_FALSE(find_version(""));
  CHECK_FALSE(find_version("none 3 . 4"));
  CHECK_FALSE(find_version("99999999999999.1"));
  CHECK(force_key({3, 4}) == ForceKey::values);
  CHECK(force_key({3, 5}) == ForceKey::vector);
  CHECK(force_key({4, 0}) == ForceKey::vector);
}

TEST_CASE("an address is a host and a port, and nothing else") {
  CHECK(parse_url("ws://localhost")->port == 10001);
  CHECK(parse_url("ws://127.0.0.1:99/")->port == 99);
  CHECK(parse_url("ws://[::1]:7")->host == "::1");
  CHECK(parse_url("ws://[::1]")->text() == "ws://[::1]:10001");
  for (const char* bad : {"", "localhost", "http://x", "ws://", "ws://a:", "ws://a:0", "ws://a:65536", "ws://a/b",
                          "ws://a\r\nX: y", "ws://[::1", "ws://[]:1", "ws://a:1x"})
    CHECK_FALSE(parse_url(bad));
}

TEST_CASE("from 3.5 on, the first message names the program; the test force is too small to feel") {
  HaplyFake fake;
  HaplyOptions options;
  options.url = fake.url();
  options.real_time = false;
  {
    const HaplyDevice opened(options);
  }
  const auto messages = fake.messages();
  REQUIRE(messages.size() >= 2);
  CHECK(messages[0] == R"({"session":{"configure":{"profile":{"name":"org.punctura","required_version":">=3.5"},)"
                       R"("basis":{"permutation":"XYZ"}}},)"
                       R"("inverse3":[{"device_id":"049D","configure":{"preset":{"preset":"arm_front_centered"}}}]})");
  CHECK(messages[1] ==
        R"({"inverse3":[{"device_id":"049D","commands":{"set_cursor_force":{"vector":{"x":0,"y":0,"z":0.001}}}}]})");
  CHECK(messages[2].ends_with(R"({"vector":{"x":0,"y":0,"z":0}}}}]})"));
}

TEST_CASE("a service that expects another force key than its version has is refused, with the reason") {
  FakeSettings settings;
  settings.version = "3.5.0";
  settings.takes = "values";
  const std::string silent = refusal(settings);
  CHECK_MESSAGE(
      silent.find("(version 3.5) did not take a force by \"vector\": current_cursor_force in its answers stayed 0") !=
          std::string::npos,
      silent);
  settings.version = "3.4.0";
  settings.takes = "vector";
  CHECK(refusal(settings).find("by \"values\"") != std::string::npos);
  settings.closes_on_wrong_key = true;
  CHECK(refusal(settings).find("unknown field in set_cursor_force") != std::string::npos);
  settings.version = "";
  settings.takes = "something";
  settings.closes_on_wrong_key = false;
  CHECK(refusal(settings).find("neither \"vector\" nor \"values\"") != std::string::npos);
}

TEST_CASE("a failed opening reports the cause and the address") {
  FakeSettings settings;
  CHECK(refusal(settings, "FFFF").find("has no Inverse3 called 'FFFF'") != std::string::npos);
  settings.inventory = R"({"session_id":1})";
  CHECK(refusal(settings).find("plug one in") != std::string::npos);
  settings.inventory = "[";
  CHECK(refusal(settings).find("it sent no list of its devices: a message was not JSON") != std::string::npos);
  settings.inventory = R"({"inverse3":[{"device_id":"a\"b"}]})";
  CHECK(refusal(settings).find("no usable device_id") != std::string::npos);

  HaplyOptions nowhere;
  nowhere.url = "nowhere";
  CHECK_THROWS_WITH_AS(HaplyDevice{nowhere}, doctest::Contains("ws://localhost:10001"), DeviceError);
  std::string gone;
  {
    const HaplyFake fake;
    gone = fake.url();
  }
  nowhere.url = gone;
  CHECK_THROWS_WITH_AS(HaplyDevice{nowhere}, doctest::Contains(gone.c_str()), DeviceError);
}

TEST_CASE("a service that reduces the force is used, and this is reported") {
  FakeSettings settings;
  settings.gives = 0.3;
  HaplyFake fake(settings);
  HaplyOptions options;
  options.url = fake.url();
  options.real_time = false;
  const HaplyDevice device(options);
  CHECK(device.statements().back() ==
        "the service gives 30 % of the requested force: check its force scale and force gate");
}

TEST_CASE("each state of the back-end has a message") {
  using S = BackendStatus::State;
  std::string words;
  FakeSettings settings;
  CHECK(state(settings, words) == S::available);
  CHECK(words.find("version 3.5, with a VerseGrip") != std::string::npos);
  settings.status = R"("calibrated":false)";
  CHECK(state(settings, words) == S::needs_calibration);
  settings.status = R"("power_supply":false)";
  CHECK(state(settings, words) == S::fault);
  settings.status = R"("in_use":true)";
  CHECK(state(settings, words) == S::in_use);
  settings.status = R"("ready":false)";
  CHECK(state(settings, words) == S::fault);
  settings.inventory = "{}";
  CHECK(state(settings, words) == S::no_device);
  CHECK(words.find("plug one in") != std::string::npos);
  CHECK(status_at("ws://127.0.0.1:1").state == S::library_not_found);
  CHECK(status_at("ws://127.0.0.1:1").detail.find("ws://127.0.0.1:1") != std::string::npos);
  CHECK(status_at("here").state == S::fault);
}

TEST_CASE("an exchange with the service allocates no memory") {
  // The service prepares all answers before, so that only the client could allocate memory in this process.
  Listener listener;
  const auto soon = [] { return os::now_ns() + 20'000'000'000; };
  constexpr int answers = 120;
  std::thread server([&] {
    listener.accept(soon());  // /version: closes at once
    os::Socket client = listener.accept(soon());
    std::string head(4096, '\0');
    std::size_t n = 0;
    client.receive(head.data(), head.size(), n, soon());
    std::string out = "HTTP/1.1 101 x\r\nUpgrade: websocket\r\nConnection: Upgrade\r\nSec-WebSocket-Accept: " +
                      std::string(upgrade_accept) + "\r\n\r\n";
    const std::string state = R"({"inverse3":[{"device_id":"A","state":{"cursor_position":{"x":0.1,"y":-0.2,"z":3e-2},)"
                              R"("current_cursor_force":{"x":0,"y":0,"z":0.001}}}]})";
    for (int i = 0; i < answers; ++i)
      out += std::string("\x89\x01?\x81\x7e\x00", 6) + static_cast<char>(state.size()) + state;
    client.send(out.data(), out.size(), soon());
    while (client.receive(head.data(), head.size(), n, soon()) == os::Io::done) {
    }
  });
  Service service;
  CHECK(service.connect(*parse_url("ws://127.0.0.1:" + std::to_string(listener.port()))) == "");
  CHECK(service.begin("A") == "");
  const auto before = allocations();
  bool good = true;
  for (int i = 0; i < 100; ++i)
    good = good && service.exchange({0.1 * i, 1.0 / 3, -1e-300}, 10'000'000'000) == Received::message;
  const auto after = allocations();
  CHECK(good);
  CHECK(after == before);
  service.leave();
  server.join();
}
