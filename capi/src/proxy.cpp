// The proxies of the C ABI: one membrane, on a line and in space.
#include <optional>

#include "punctura/proxy/proxy_1d.hpp"
#include "punctura/servo/record.hpp"
#include "scene.hpp"
#include "stepper.hpp"

namespace punctura::c {
namespace {

using InSpace = SceneInsertion::Wide::Proxies::value_type;  // of every scene; K06's membranes have K06's bits in it
using Law = std::remove_cvref_t<decltype(std::declval<InSpace>().law())>;
using Coupled = std::remove_cvref_t<decltype(std::declval<InSpace>().params().coupling)>;
using OnALine = Proxy1d<Law, Coupled>;

/// The proxy of one membrane of a scene; empty after it has kept an error.
std::optional<InSpace> proxy_of(const Scene& scene, int32_t membrane, punctura_status& status) {
  auto problems = check(scene);
  if (!problems.empty()) {
    status = fail(std::move(problems));
    return std::nullopt;
  }
  const auto built = detail::wide_model_of<double>(scene);
  const std::size_t count = built.size();
  if (membrane < 0 || static_cast<std::size_t>(membrane) >= count) {
    status = fail(PUNCTURA_BAD_ARGUMENT, "membrane " + std::to_string(membrane) + ": the scene has " +
                                             std::to_string(count) + " membranes, counted from 0");
    return std::nullopt;
  }
  status = ok;
  return built.proxies()[static_cast<std::size_t>(membrane)];
}

}  // namespace
}  // namespace punctura::c

using namespace punctura::c;

struct punctura_proxy1d : Stepper<OnALine> {
  using Stepper::Stepper;
};
struct punctura_proxy3d : Stepper<InSpace> {
  using Stepper::Stepper;
};
PUNCTURA_STEPPER(proxy1d)
PUNCTURA_STEPPER(proxy3d)
PUNCTURA_STEPS_IN_SPACE(proxy3d)

punctura_status punctura_proxy1d_new(const punctura_scene* scene, int32_t membrane, punctura_proxy1d** proxy) {
  return make_handle(scene, proxy, [&](auto& made) {
    punctura_status status = ok;
    if (const auto found = proxy_of(scene->scene, membrane, status))
      made = std::make_unique<punctura_proxy1d>(OnALine(found->law(), found->params().coupling, found->solver()));
    return status;
  });
}

double punctura_proxy1d_step(punctura_proxy1d* proxy, double depth) {
  return proxy ? proxy->stepping().step(depth) : punctura::nothing;
}

double punctura_proxy1d_peek(punctura_proxy1d* proxy, double depth) {
  return proxy ? proxy->peeking().step(depth) : punctura::nothing;
}

punctura_status punctura_proxy1d_membrane(const punctura_proxy1d* proxy, punctura_membrane_tick* tick) {
  return proxy ? give_membrane(tick, punctura::record_of(proxy->now.tick())) : PUNCTURA_BAD_ARGUMENT;
}

punctura_status punctura_proxy3d_new(const punctura_scene* scene, int32_t membrane, punctura_proxy3d** proxy) {
  return make_handle(scene, proxy, [&](auto& made) {
    punctura_status status = ok;
    if (auto found = proxy_of(scene->scene, membrane, status))
      made = std::make_unique<punctura_proxy3d>(std::move(*found));
    return status;
  });
}

punctura_status punctura_proxy3d_membrane(const punctura_proxy3d* proxy, punctura_membrane_tick* tick) {
  return proxy ? give_membrane(tick, punctura::record_of(proxy->now.tick())) : PUNCTURA_BAD_ARGUMENT;
}
