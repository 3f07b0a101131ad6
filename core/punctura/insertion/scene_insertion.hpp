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

/// The models of a scene: with K06's laws and coupling, and with those that go beyond K06.
template <typename Scalar>
using K06Insertion = InsertionOf<BasicThickLaw<Scalar>>;
template <typename Scalar>
using WideInsertion = InsertionOf<SceneLaw<Scalar>, RelaxingCoupling<Scalar>>;

/// The model of a scene: one type for all scenes, so that a scene can be changed during a run.
///
/// A scene of K06 runs the code of K06Insertion: each call costs one comparison more. Only a scene with a wider law or
/// a coupling that relaxes runs the larger model. The state of a scene is that of its K06Insertion or WideInsertion.
template <OneNumber Scalar>
class BasicInsertion
    : public ConditionedProxies<
          Scalar, std::variant<typename K06Insertion<Scalar>::Proxies, typename WideInsertion<Scalar>::Proxies>,
          HeapStorage> {
 public:
  BasicInsertion(K06Insertion<Scalar> model) : BasicInsertion::ConditionedProxies(std::move(model)) {}
  BasicInsertion(WideInsertion<Scalar> model) : BasicInsertion::ConditionedProxies(std::move(model)) {}

  /// The proxies of a scene that is K06's; otherwise a null pointer.
  auto* k06() const noexcept { return std::get_if<0>(&this->proxies_); }
};
using Insertion = BasicInsertion<double>;
using InsertionF = BasicInsertion<float>;

}  // namespace punctura
