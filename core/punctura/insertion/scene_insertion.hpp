// The model of any scene: with K06's law and coupling, or with laws and a coupling that go beyond K06.
#pragma once

#include <cstddef>
#include <utility>
#include <variant>

#include "punctura/insertion/insertion.hpp"
#include "punctura/model/lane.hpp"
#include "punctura/model/tissue_law.hpp"
#include "punctura/proxy/relaxing_coupling.hpp"

namespace punctura {

/// The law of a membrane in a scene that goes beyond K06. A membrane without tissue has K06's law in it, bit for bit.
template <typename Scalar>
using SceneLaw = BasicTissueLaw<Scalar>;

/// The model of a scene: one type for all scenes, so that a scene can be changed during a run.
///
/// A scene of K06 runs the code of InsertionOf<BasicThickLaw>: each call costs one comparison more. Only a scene with
/// a wider law or a coupling that relaxes runs the larger model.
template <OneNumber Scalar_>
class BasicInsertion {
 public:
  using Scalar = Scalar_;
  using Vector = Vector3<Scalar>;
  using StoredIn = HeapStorage;
  using K06 = InsertionOf<BasicThickLaw<Scalar>>;
  using Wide = InsertionOf<SceneLaw<Scalar>, RelaxingCoupling<Scalar>>;

  BasicInsertion(K06 model) : model_(std::in_place_index<0>, std::move(model)) {}
  BasicInsertion(Wide model) : model_(std::in_place_index<1>, std::move(model)) {}

  /// Calls visitor(model) with the K06 or the Wide in use, and returns its result.
  template <typename Visitor>
  decltype(auto) visit(Visitor&& visitor) const {
    if (const K06* model = k06()) return visitor(*model);
    return visitor(*std::get_if<1>(&model_));
  }
  template <typename Visitor>
  decltype(auto) visit(Visitor&& visitor) {
    if (K06* model = std::get_if<0>(&model_)) return visitor(*model);
    return visitor(*std::get_if<1>(&model_));
  }
  /// The model of a scene that is K06's; otherwise a null pointer.
  const K06* k06() const noexcept { return std::get_if<0>(&model_); }

  /// All of these do what they do in InsertionOf.
  void reset() noexcept {
    visit([](auto& model) { model.reset(); });
  }
  void resume(BasicInsertion& previous) noexcept {
    visit([&](auto& model) { previous.visit([&](auto& old) { model.resume(old); }); });
  }
  Vector step(const Vector& position, const Vector& axis) noexcept {
    return visit([&](auto& model) { return model.step(position, axis); });
  }
  const Vector& tip() const noexcept {
    return visit([](const auto& model) -> const Vector& { return model.tip(); });
  }
  const Vector& force() const noexcept {
    return visit([](const auto& model) -> const Vector& { return model.force(); });
  }
  bool uses_axis() const noexcept {
    return visit([](const auto& model) { return model.uses_axis(); });
  }
  bool outside() const noexcept {
    return visit([](const auto& model) { return model.outside(); });
  }
  std::size_t size() const noexcept {
    return visit([](const auto& model) { return model.size(); });
  }
  SpaceTick<Scalar> tick(std::size_t i) const noexcept {
    return visit([i](const auto& model) { return model.tick(i); });
  }
  Scalar cos_beta(std::size_t i) const noexcept {
    return visit([i](const auto& model) { return model.cos_beta(i); });
  }

  /// The scene decides which model there is. So the state of a scene of K06 is that of its InsertionOf.
  static void archive(auto& self, auto& state) {
    self.visit([&](auto& model) { std::remove_cvref_t<decltype(model)>::archive(model, state); });
  }
  void describe(auto& parameters) const {
    visit([&](const auto& model) { model.describe(parameters); });
  }

 private:
  std::variant<K06, Wide> model_;
};
using Insertion = BasicInsertion<double>;
using InsertionF = BasicInsertion<float>;

}  // namespace punctura
