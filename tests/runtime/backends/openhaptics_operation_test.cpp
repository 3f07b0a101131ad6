// Who frees what the HD scheduler's thread works on.
#include <doctest/doctest.h>

#include <utility>

#include "punctura_runtime/backends/openhaptics/hd_errors.hpp"

using namespace punctura;

namespace {
int counted_alive = 0;
std::pair<hd::Operation, void*> scheduled_work;

struct CountedWork : hd::Work {
  explicit CountedWork(int calls) : left_to_make(calls) { ++counted_alive; }
  ~CountedWork() { --counted_alive; }
  bool call() { return --left_to_make > 0; }
  int left_to_make;
};

hd::Interface counting_library() {
  hd::Interface made{};
  made.schedule = [](hd::Operation operation, void* data, std::uint16_t) -> hd::OperationHandle {
    scheduled_work = {operation, data};
    return 1;
  };
  return made;
}
std::uint32_t scheduler_calls() { return scheduled_work.first(scheduled_work.second); }
}  // namespace

TEST_CASE("what the scheduler's thread has left, or never had, is freed") {
  counted_alive = 0;
  {
    const hd::Lent<CountedWork> never(new CountedWork(1));
  }
  CHECK(counted_alive == 0);
  {
    const hd::Lent<CountedWork> work(new CountedWork(2));
    hd::schedule(counting_library(), work);
    CHECK(scheduler_calls() == hd::again);
    CHECK(scheduler_calls() == hd::done);
    CHECK(counted_alive == 1);
  }
  CHECK(counted_alive == 0);
}

TEST_CASE("what the scheduler's thread may still use is never freed: a late call is safe") {
  counted_alive = 0;
  {
    const hd::Lent<CountedWork> work(new CountedWork(2));
    hd::schedule(counting_library(), work);
  }
  CHECK(counted_alive == 1);
  CHECK(scheduler_calls() == hd::again);
  CHECK(scheduler_calls() == hd::done);
  CHECK(counted_alive == 1);
}
