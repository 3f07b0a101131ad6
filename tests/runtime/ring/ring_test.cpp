#include <doctest/doctest.h>

#include <thread>
#include <vector>

#include "punctura_runtime/ring/handover.hpp"
#include "punctura_runtime/ring/latest.hpp"
#include "punctura_runtime/ring/spsc_ring.hpp"

using namespace punctura;

TEST_CASE("a ring hands over what was put in, in order") {
  SpscRing<int> ring(4);
  for (int i = 0; i < 3; ++i) CHECK(ring.push([&](int& to) { to = i; }));
  std::vector<int> got;
  CHECK(ring.pop(2, [&](int v) { got.push_back(v); }) == 2);
  CHECK(ring.pop(9, [&](int v) { got.push_back(v); }) == 1);
  CHECK(got == std::vector<int>{0, 1, 2});
  CHECK(ring.lost() == 0);
}

TEST_CASE("a full ring loses the new record, and counts it") {
  SpscRing<int> ring(4);
  for (int i = 0; i < 10; ++i) ring.push([&](int& to) { to = i; });
  CHECK(ring.lost() == 6);
  std::vector<int> got;
  ring.pop(99, [&](int v) { got.push_back(v); });
  CHECK(got == std::vector<int>{0, 1, 2, 3});
}

TEST_CASE("across two threads nothing is lost in silence, doubled or torn") {
  struct Record {
    std::uint64_t a, b, c;
  };
  SpscRing<Record> ring(64);
  const std::uint64_t n = 300000;
  std::thread writer([&] {
    for (std::uint64_t i = 0; i < n; ++i) ring.push([&](Record& to) { to = {i, i * 3, ~i}; });
  });
  std::uint64_t seen = 0, last = 0;
  bool good = true, first = true;
  const auto drain = [&] {
    return ring.pop(1000, [&](const Record& r) {
      good = good && r.b == r.a * 3 && r.c == ~r.a && (first || r.a > last);
      first = false;
      last = r.a;
      ++seen;
    });
  };
  while (seen + ring.lost() < n) drain();
  writer.join();
  drain();
  CHECK(good);
  CHECK(seen + ring.lost() == n);
}

TEST_CASE("the latest value is never half of one and half of another, and never goes back") {
  struct Value {
    std::uint64_t a = 0, b = 0;
  };
  Latest<Value> latest;
  std::atomic<bool> done{false};
  std::thread writer([&] {
    for (std::uint64_t i = 1; i <= 300000; ++i) latest.write([&](Value& to) { to = {i, ~i}; });
    done = true;
  });
  std::uint64_t last = 0;
  bool good = true;
  while (!done) {
    const Value v = latest.read();
    if (v.a == 0) continue;
    good = good && v.b == ~v.a && v.a >= last;
    last = v.a;
  }
  writer.join();
  CHECK(good);
  CHECK(latest.read().a == 300000);
}

namespace {
struct Counted {
  explicit Counted(int given) : value(given) { ++alive; }
  ~Counted() { --alive; }
  int value;
  static std::atomic<int> alive;
};
std::atomic<int> Counted::alive{0};
}  // namespace

TEST_CASE("what is handed over arrives once, and what it replaces is freed by the side that offered it") {
  {
    Handover<Counted> handover;
    std::atomic<bool> done{false};
    std::atomic<int> last_taken{-1};
    std::thread taker([&] {
      auto* mine = new Counted(-1);
      while (!done || handover.pending()) {
        if (Counted* next = handover.take()) {
          handover.retire(mine);
          mine = next;
          last_taken = mine->value;
        }
        handover.pending() ? void() : std::this_thread::yield();
        if (done) handover.collect();  // the offering side has gone home
      }
      delete mine;
    });
    for (int i = 0; i < 20000; ++i) handover.offer(std::make_unique<Counted>(i));
    while (handover.pending()) handover.collect();
    done = true;
    taker.join();
    CHECK(last_taken == 19999);
  }
  CHECK(Counted::alive == 0);
}
