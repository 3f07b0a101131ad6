// Counts the operations of a tick: the kernel of the batch, compiled with an instruction set that counts.
#include "operations.hpp"

#include "punctura_runtime/batch/line_kernel.hpp"
#include "twice.hpp"

namespace punctura::bench_batch {

namespace {

Operations counted;

using Four = Twice<Twice<batch::Portable>>;

/// Four lanes. Each operation counts once for the whole vector.
struct Counting : Four {
  static Vector add(const Vector& a, const Vector& b) noexcept { return ++counted.add, Four::add(a, b); }
  static Vector subtract(const Vector& a, const Vector& b) noexcept { return ++counted.add, Four::subtract(a, b); }
  static Vector multiply(const Vector& a, const Vector& b) noexcept { return ++counted.multiply, Four::multiply(a, b); }
  static Vector divide(const Vector& a, const Vector& b) noexcept { return ++counted.divide, Four::divide(a, b); }
  static Vector root(const Vector& a) noexcept { return ++counted.root, Four::root(a); }
  static Vector smaller(const Vector& a, const Vector& b) noexcept { return ++counted.min_max, Four::smaller(a, b); }
  static Vector larger(const Vector& a, const Vector& b) noexcept { return ++counted.min_max, Four::larger(a, b); }
  static Mask less(const Vector& a, const Vector& b) noexcept { return ++counted.compare, Four::less(a, b); }
  static Mask less_equal(const Vector& a, const Vector& b) noexcept {
    return ++counted.compare, Four::less_equal(a, b);
  }
  static Mask equal(const Vector& a, const Vector& b) noexcept { return ++counted.compare, Four::equal(a, b); }
  static Vector select(const Mask& m, const Vector& a, const Vector& b) noexcept {
    return ++counted.select, Four::select(m, a, b);
  }
};

}  // namespace

Operations operations(Work& work, Solver solver) {
  const batch::LineCode code{
      "counting", Counting::lanes, batch::run_line<Counting, Paper>, batch::run_line<Counting, Exact>, nullptr, nullptr,
      nullptr,    nullptr};
  batch::RunOptions options;
  options.threads = 1;
  options.code = &code;
  batch::LineBatch all(period, solver);
  for (std::size_t i = 0; i < work.trials; ++i) all.add(work.laws[i].pieces(), work.couplings[i]);
  counted = {};
  // LineVector::step() makes one in each tick, only to replace all of its constants: the compiler leaves it out.
  using V = batch::Simd<Counting>;
  [[maybe_unused]] const SampledCoupling<V> unused({V(1), V(0)}, V(1));
  const Operations left_out = counted;
  counted = {};
  const auto n = static_cast<std::ptrdiff_t>(work.trials);
  all.run(work.ticks, {work.depth.data(), n, 1}, {work.force.data(), n, 1}, options);
  const std::size_t blocks = (work.trials + batch::block_lanes - 1) / batch::block_lanes;
  const auto ticks = static_cast<double>(work.ticks * blocks * (batch::block_lanes / Counting::lanes));
  Operations mean;
  for (double Operations::* count : {&Operations::multiply, &Operations::add, &Operations::divide, &Operations::root,
                                     &Operations::min_max, &Operations::compare, &Operations::select})
    mean.*count = counted.*count / ticks - left_out.*count;
  return mean;
}

}  // namespace punctura::bench_batch
