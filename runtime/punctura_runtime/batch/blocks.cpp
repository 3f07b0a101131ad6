#include "punctura_runtime/batch/blocks.hpp"

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>

#if defined(__linux__)
#include <sched.h>
#endif

namespace punctura::batch {

std::size_t usable_threads(std::size_t wanted) noexcept {
  if (wanted > 0) return wanted;
#if defined(__linux__)
  cpu_set_t allowed;
  if (sched_getaffinity(0, sizeof allowed, &allowed) == 0) return static_cast<std::size_t>(CPU_COUNT(&allowed));
#endif
  return std::max(1u, std::thread::hardware_concurrency());
}

void for_each_block(std::size_t count, std::size_t threads, Work& work, const std::function<void(std::size_t)>& block,
                    const std::function<bool()>& watch) {
  if ((threads <= 1 || count <= 1) && !watch) {
    for (std::size_t i = 0; i < count && !work.stop; ++i) block(i);
    return;
  }
  std::atomic<std::size_t> next{0};
  std::mutex lock;
  std::condition_variable ended;
  std::exception_ptr error;
  const std::size_t helps = watch ? 0 : 1;  // the calling thread works, too
  const std::size_t wanted = std::min(std::max<std::size_t>(threads, 1), count);
  std::size_t running = wanted;

  const auto fail = [&](std::exception_ptr what) {
    const std::lock_guard guard(lock);
    if (!error) error = what;
    work.stop = true;
  };
  const auto loop = [&] {
    try {
      for (std::size_t i; !work.stop && (i = next++) < count;) block(i);
    } catch (...) {
      fail(std::current_exception());
    }
    const std::lock_guard guard(lock);
    --running;
    ended.notify_one();
  };
  std::vector<std::thread> workers;
  try {
    for (std::size_t i = wanted - helps; i > 0; --i) workers.emplace_back(loop);
  } catch (...) {  // no more threads to be had
    const std::lock_guard guard(lock);
    running -= std::min(running, wanted - helps - workers.size());
    if (workers.size() + helps == 0) error = std::current_exception();
  }
  if (helps > 0) loop();
  for (std::unique_lock guard(lock); running > 0;) {
    if (ended.wait_for(guard, std::chrono::milliseconds(50), [&] { return running == 0; })) break;
    guard.unlock();
    try {
      if (watch && !watch()) work.stop = true;
    } catch (...) {
      fail(std::current_exception());
    }
    guard.lock();
  }
  for (std::thread& worker : workers) worker.join();
  if (error) std::rethrow_exception(error);
}

}  // namespace punctura::batch
