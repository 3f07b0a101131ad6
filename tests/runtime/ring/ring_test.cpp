#include <doctest/doctest.h>

#include <thread>
#include <vector>

#include "punctura_runtime/ring/handover.hpp"
#include "punctura_runtime/ring/snapshot_ring.hpp"

using namespace punctura;

namespace {

/// A snapshot whose numbers follow from tick and count, so that a reader detects a torn one.
Snapshot numbered(std::uint64_t tick, std::uint32_t membranes) {
  Snapshot s{};
  s.tick = tick;
  s.ceiling = static_cast<double>(3 * tick);
  s.membrane_count = membranes;
  for (std::uint32_t i = 0; i < membranes; ++i) {
    s.membranes[i].depth = static_cast<double>(tick + i);
    s.membranes[i].phase = static_cast<Phase>((tick + i) % 4);
  }
  return s;
}

bool whole(const Snapshot& s) {
  const Snapshot other = numbered(s.tick, s.membrane_count);
  bool same = s.ceiling == other.ceiling;
  for (std::uint32_t i = 0; i < s.membrane_count; ++i)
    same = same && s.membranes[i].depth == other.membranes[i].depth && s.membranes[i].phase == other.membranes[i].phase;
  return same;
}

using TickNumbers = std::vector<std::uint64_t>;

TickNumbers taken(SnapshotRing& ring, std::size_t limit) {
  TickNumbers got;
  const std::size_t n = ring.pop(limit, [&](const Snapshot& s) {
    CHECK(whole(s));
    got.push_back(s.tick);
  });
  CHECK(n == got.size());
  return got;
}

}  // namespace

TEST_CASE("a ring returns the records in the order in which they were put in") {
  SnapshotRing ring(40, 1);
  for (std::uint64_t i = 0; i < 3; ++i) CHECK(ring.push(numbered(i, 1)));
  CHECK(taken(ring, 2) == TickNumbers{0, 1});
  CHECK(taken(ring, 9) == TickNumbers{2});
  CHECK(taken(ring, 9).empty());
  CHECK(ring.lost() == 0);
}

TEST_CASE("a ring never takes more memory than its limit") {
  for (const std::size_t membranes : {std::size_t{0}, std::size_t{1}, max_membranes}) {
    SnapshotRing ring(~std::size_t{0} / 2, membranes);
    CHECK(ring.capacity() == SnapshotRing::most_snapshots(membranes));
    CHECK(ring.capacity() * used_bytes(membranes) <= SnapshotRing::most_bytes);
    for (std::uint64_t i = 0; i < ring.capacity(); ++i)
      REQUIRE(ring.push(numbered(i, static_cast<std::uint32_t>(membranes))));
    CHECK(ring.push(numbered(ring.capacity(), max_membranes)) == false);
    CHECK(ring.lost() == 1);
  }
}

TEST_CASE("a full ring drops the new record and counts it; it holds as many records as it reports") {
  SnapshotRing ring(100, 2);
  for (std::uint64_t i = 0; i < 110; ++i) ring.push(numbered(i, 2));
  CHECK(ring.lost() == 10);
  const TickNumbers got = taken(ring, 999);
  REQUIRE(got.size() == 100);
  CHECK(got.front() == 0);
  CHECK(got.back() == 99);
}

TEST_CASE("a ring made for few membranes also takes a snapshot with the largest number of membranes") {
  SnapshotRing ring(1, 0);
  for (std::uint64_t i = 0; i < 100; ++i) {
    CHECK(ring.push(numbered(i, i % 2 ? max_membranes : 3)));
    CHECK(taken(ring, 9) == TickNumbers{i});
  }
  CHECK(ring.lost() == 0);
}

TEST_CASE("snapshots of different lengths wrap around the end of the ring") {
  SnapshotRing ring(50, 3);
  std::uint64_t next = 0, seed = 1;
  for (std::uint64_t i = 0; i < 20000; ++i) {
    seed = seed * 6364136223846793005u + 1442695040888963407u;
    CHECK(ring.push(numbered(i, static_cast<std::uint32_t>(seed >> 58))));
    if (i % 2 == 1)
      for (const std::uint64_t tick : taken(ring, 9)) CHECK(tick == next++);
  }
  CHECK(next == 20000);
}

TEST_CASE("between two threads, no record is torn or duplicated, and each lost one is counted") {
  SnapshotRing ring(64, 4);
  const std::uint64_t n = 300000;
  std::thread writer([&] {
    for (std::uint64_t i = 0; i < n; ++i) ring.push(numbered(i, static_cast<std::uint32_t>(i % 11)));
  });
  std::uint64_t seen = 0, last = 0;
  bool good = true, first = true;
  const auto drain = [&] {
    return ring.pop(1000, [&](const Snapshot& s) {
      good = good && whole(s) && (first || s.tick > last);
      first = false;
      last = s.tick;
      ++seen;
    });
  };
  while (seen + ring.lost() < n) drain();
  writer.join();
  drain();
  CHECK(good);
  CHECK(seen + ring.lost() == n);
}

TEST_CASE("the latest value is never torn and never goes back") {
  struct Value {
    std::uint64_t a = 0, b = 0;
  };
  TripleBuffer<Value> latest;
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

TEST_CASE("Handover delivers an object once; the offering thread frees the replaced one") {
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
        if (done) handover.collect();  // the offering thread has ended
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
