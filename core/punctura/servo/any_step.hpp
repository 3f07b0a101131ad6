// A servo step of any model, for a loop that does not know the model.
#pragma once

#include <memory>
#include <type_traits>
#include <utility>

#include "punctura/servo/servo_step.hpp"

namespace punctura {

/// A servo step whose model can be of any kind. A tick is one virtual call.
///
/// Only of() makes one, and it holds a ServoStepOf. So the gate, the limits and the latched fault of every model are
/// those of ServoGuard.
class AnyStep {
 public:
  using Guard = ServoGuard<double>;

  template <typename Insertion>
  static std::unique_ptr<AnyStep> of(ServoStepOf<Insertion> step) {
    static_assert(std::is_same_v<typename ServoStepOf<Insertion>::Guard, Guard>,
                  "a loop needs a model whose Scalar is double and whose StoredIn is HeapStorage");
    return std::unique_ptr<AnyStep>(new Holder<Insertion>(std::move(step)));
  }
  virtual ~AnyStep() = default;
  AnyStep(const AnyStep&) = delete;
  AnyStep& operator=(const AnyStep&) = delete;

  /// These do what they do in ServoStepOf.
  virtual const Snapshot& step(const DeviceSample& sample) noexcept = 0;
  virtual void reset() noexcept = 0;
  /// Takes over the run of another step of the same period. A model of the same kind takes over what it can; one of
  /// another kind begins afresh.
  virtual void resume(AnyStep& previous) noexcept = 0;

  Guard& guard() noexcept { return *guard_; }
  const Guard& guard() const noexcept { return *guard_; }

 private:
  template <typename Insertion>
  class Holder;
  /// Its address is the kind of a model. Two libraries may have two: then the model begins afresh. It is not const:
  /// linkers may give constants with the same value one address (/OPT:ICF of MSVC), and all kinds would be one.
  template <typename Insertion>
  static inline char kind_of = 0;

  explicit AnyStep(const char* kind) noexcept : kind_(kind) {}

  const char* kind_;
  Guard* guard_ = nullptr;
};

template <typename Insertion>
class AnyStep::Holder final : public AnyStep {
 public:
  explicit Holder(ServoStepOf<Insertion> step) : AnyStep(&kind_of<Insertion>), step_(std::move(step)) {
    guard_ = &step_;
  }
  const Snapshot& step(const DeviceSample& sample) noexcept override { return step_.step(sample); }
  void reset() noexcept override { step_.reset(); }
  void resume(AnyStep& previous) noexcept override {
    if (previous.kind_ == kind_)
      step_.resume(static_cast<Holder&>(previous).step_);
    else
      guard().resume(previous.guard());
  }

 private:
  ServoStepOf<Insertion> step_;
};

}  // namespace punctura
