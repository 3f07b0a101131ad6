// Makes the servo step of a scene: with the model of the scene, with rivals, or with a model of your own.
#pragma once

#include <concepts>
#include <functional>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "punctura/rivals/rival_insertion.hpp"
#include "punctura/scene/build.hpp"
#include "punctura/servo/any_step.hpp"

namespace punctura {

/// Gives the model of a scene, or an empty optional and the scene's problems.
template <typename ModelOf>
concept GivesModel =
    requires(const ModelOf make, const Scene& scene, std::vector<Problem>& problems) { *make(scene, problems); };

/// Makes the whole tick of a scene with a model of any kind. A loop and a replay have one.
///
/// It gets only the model from outside. Gate, limits, force scale and syringe are its own, so no model goes around
/// them.
class StepMaker {
 public:
  /// model_of(scene, problems): the model of a scene that has passed check(), or an empty optional and its problems. It
  /// can be an InsertionOf, whose laws are then checked, or any other Model.
  template <GivesModel ModelOf>
  StepMaker(ModelOf model_of)
      : make_([model_of = std::move(model_of)](const Scene& scene, const GateLimits& gate, const ForceLimits& limits) {
          using M = std::remove_cvref_t<decltype(*model_of(scene, std::declval<std::vector<Problem>&>()))>;
          static_assert(Model<M> && std::copy_constructible<M>,
                        "the class is no model for a servo step. It needs using Scalar, using StoredIn and the nine "
                        "functions of Model in punctura/servo/servo_step.hpp, each noexcept and of that type, and a "
                        "copy constructor");
          return AnyStep::of(detail::or_throw([&](auto& problems) {
            problems = check(scene);
            auto model = problems.empty() ? model_of(scene, problems) : decltype(model_of(scene, problems))();
            if (model && model->size() != scene.membranes.size())
              problems.push_back({"membrane", static_cast<double>(model->size()),
                                  "is the number of walls in the model; the scene must have as many membranes"});
            detail::check_model(model, problems);
            if (!problems.empty()) model.reset();
            if (!model && problems.empty())
              problems.push_back({"model", not_given, "is empty without a reason: add a Problem that says why"});
            return detail::step_of(scene, std::move(model), problems, gate, limits);
          }));
        }) {}

  /// The model of a scene file: K06's law or measured tissue.
  StepMaker()
      : StepMaker([](const Scene& scene, std::vector<Problem>& problems) {
          return try_build_insertion<double>(scene, problems);
        }) {}
  /// A law of your own in each membrane: law_of(needle, membrane, i), see GivesLaws. A copy of law_of is kept.
  template <GivesLaws<double> LawOf>
  static StepMaker with_laws(LawOf law_of) {
    return {[law_of = std::move(law_of)](const Scene& scene, std::vector<Problem>& problems) {
      return try_build_insertion<double>(scene, problems, law_of);
    }};
  }

  /// Rivals in place of the scene's law: one for each membrane, or one for all; without any the scene's own.
  static StepMaker with_rivals(std::vector<AnyRival> rivals) {
    if (rivals.empty()) return {};
    StepMaker made([rivals](const Scene& scene, std::vector<Problem>& problems) {
      return try_build_rivals(scene, rivals, problems);
    });
    made.rivals_ = std::move(rivals);
    return made;
  }
  const std::vector<AnyRival>& rivals() const noexcept { return rivals_; }  ///< of with_rivals(); otherwise empty

  /// Throws SceneError with the problems of scene and limits.
  std::unique_ptr<AnyStep> operator()(const Scene& scene, const GateLimits& gate, const ForceLimits& limits) const {
    return make_(scene, gate, limits);
  }

 private:
  std::function<std::unique_ptr<AnyStep>(const Scene&, const GateLimits&, const ForceLimits&)> make_;
  std::vector<AnyRival> rivals_;
};

}  // namespace punctura
