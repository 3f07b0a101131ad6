// The functions of os.hpp, on the system that runs the tests.
#include "punctura_runtime/os/os.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <thread>
#include <vector>

#include "runtime/support/listener.hpp"

using namespace punctura;

TEST_CASE("a sleep never ends early; a sleep until a past time ends at once") {
  for (int k = 0; k < 20; ++k) {
    const std::int64_t until = os::now_ns() + 700'000;
    os::sleep_until_ns(until);
    REQUIRE(os::now_ns() >= until);
  }
  os::sleep_until_ns(0);
}

TEST_CASE("a refused real-time priority is reported with the reason and does no harm") {
  std::vector<os::RealtimeItem> items;
  std::thread([&] { items = os::make_realtime({80, 0, false, true}); }).join();
  CHECK_FALSE(items.empty());
  for (const auto& item : items) {
    CAPTURE(item.what);
    CHECK_FALSE(item.what.empty());
    CHECK(item.granted == item.detail.empty());
  }
}

TEST_CASE("a missing processor is refused and named by its number") {
  std::vector<os::RealtimeItem> items;
  for (const int processor : {64, 4095, 1 << 20})
    std::thread([&] {
      for (auto& item : os::make_realtime({0, processor, false, false})) items.push_back(item);
    }).join();
  REQUIRE(items.size() == 3);
  for (const auto& item : items) CHECK_FALSE(item.granted);
  CHECK(items[1].what == "processor 4095");
}

TEST_CASE("macOS gets the loop's period, clamped to the accepted range") {
  const os::RealtimeSettings asked{70, 1, false, true};
  const auto at_1600 = asked.at_rate(1600);
  CHECK(at_1600.period == 1 / 1600.0);
  CHECK(at_1600.priority == 70);
  CHECK(at_1600.processor == 1);
  CHECK(asked.at_rate(std::nan("")).period == asked.period);
  CHECK(asked.at_rate(0).period == asked.period);

  CHECK(os::TimeConstraint::of(at_1600.period).period == 625'000);
  CHECK(os::TimeConstraint::of(1e-3).period == 1'000'000);
  for (const double rate : {10.0, 100.0, 1000.0, 4000.0, 20'000.0, 100'000.0}) {
    const auto thread = os::TimeConstraint::of(1 / rate);
    CAPTURE(rate);
    CHECK(thread.computation >= 50'000);
    CHECK(thread.constraint >= thread.computation);
    CHECK(thread.constraint <= std::max<std::int64_t>(thread.period / 2, thread.computation));
  }
}

TEST_CASE("the error of a library that does not exist names it") {
  std::string error;
  CHECK(os::load_library("/nowhere/libnothing.so", error) == nullptr);
  CHECK(error.find("/nowhere/libnothing.so") != std::string::npos);
}

TEST_CASE("a connection that nobody accepts ends by its deadline, with a message") {
  std::uint16_t port = 0;
  {
    const test::Listener listener;
    port = listener.port();
    REQUIRE(port != 0);
  }
  std::string error;
  const auto socket = os::Socket::connect("127.0.0.1", port, os::now_ns() + 3'000'000'000, error);
  CHECK_FALSE(socket);
  CHECK(error.size() > 10);
  CHECK(error.find("error 1") == std::string::npos);  // a number alone does not help the user
}

TEST_CASE("sockets carry bytes both ways, obey their deadline, and report that the other side has closed") {
  test::Listener listener;
  const auto soon = [] { return os::now_ns() + 10'000'000'000; };
  std::string error;
  auto client = os::Socket::connect("127.0.0.1", listener.port(), soon(), error);
  REQUIRE_MESSAGE(client, error);
  auto server = listener.accept(soon());
  REQUIRE(server);

  const std::string sent(300'000, 'x');
  std::thread sender([&] { CHECK(client.send(sent.data(), sent.size(), soon()) == os::Io::done); });
  std::string received(sent.size(), ' ');
  for (std::size_t at = 0, n = 0; at < received.size(); at += n)
    REQUIRE(server.receive(received.data() + at, received.size() - at, n, soon()) == os::Io::done);
  sender.join();
  CHECK(received == sent);

  char byte = 0;
  std::size_t n = 0;
  CHECK(client.receive(&byte, 1, n, os::now_ns() + 2'000'000) == os::Io::timeout);
  server.close();
  CHECK(client.receive(&byte, 1, n, soon()) == os::Io::closed);
}
