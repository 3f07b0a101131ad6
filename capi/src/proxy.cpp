// The proxies of the C ABI: one membrane, on a line and in space.
#include "common.hpp"
#include "punctura/proxy/proxy_1d.hpp"
#include "punctura/servo/snapshot.hpp"
#include "stepper.hpp"

namespace punctura::c {
namespace {

using InSpace = WideInsertion<double>::Proxies::value_type;  // of every scene; K06's membranes have K06's bits in it
using Law = std::remove_cvref_t<decltype(std::declval<InSpace>().law())>;
using Coupled = std::remove_cvref_t<decltype(std::declval<InSpace>().params().coupling)>;
using OnALine = Proxy1d<Law, Coupled>;

/// Makes the handle of one membrane: make(proxy in space) gives its object.
template <typename Handle, typename Make>
punctura_status new_proxy(const punctura_scene* scene, int32_t membrane, Handle** proxy, Make&& make) {
  return make_handle(scene, proxy, [&](auto& made) {
    auto problems = check(scene->scene);
    if (!problems.empty()) return fail(std::move(problems));
    const auto built = detail::wide_model_of<double>(scene->scene);
    if (membrane < 0 || static_cast<std::size_t>(membrane) >= built.size())
      return fail(PUNCTURA_BAD_ARGUMENT, "membrane " + std::to_string(membrane) + ": the scene has " +
                                             std::to_string(built.size()) + " membranes, counted from 0");
    made = std::make_unique<Handle>(make(built.proxies()[static_cast<std::size_t>(membrane)]));
    return ok;
  });
}

}  // namespace
}  // namespace punctura::c

using namespace punctura::c;

PUNCTURA_STEPPER(proxy1d, OnALine)
PUNCTURA_STEPPER(proxy3d, InSpace)
PUNCTURA_STEPS_IN_SPACE(proxy3d)

punctura_status punctura_proxy1d_new(const punctura_scene* scene, int32_t membrane, punctura_proxy1d** proxy) {
  return new_proxy(scene, membrane, proxy,
                   [](const auto& p) { return OnALine(p.law(), p.params().coupling, p.solver()); });
}

punctura_status punctura_proxy3d_new(const punctura_scene* scene, int32_t membrane, punctura_proxy3d** proxy) {
  return new_proxy(scene, membrane, proxy, [](const auto& p) { return p; });
}

double punctura_proxy1d_step(punctura_proxy1d* proxy, double depth) {
  return proxy ? proxy->stepping().step(depth) : punctura::not_given;
}

double punctura_proxy1d_peek(punctura_proxy1d* proxy, double depth) {
  return proxy ? proxy->peeking().step(depth) : punctura::not_given;
}

punctura_status punctura_proxy1d_membrane(const punctura_proxy1d* proxy, punctura_membrane_tick* tick) {
  return proxy ? give_membrane(tick, punctura::record_of(proxy->now.tick())) : PUNCTURA_BAD_ARGUMENT;
}

punctura_status punctura_proxy3d_membrane(const punctura_proxy3d* proxy, punctura_membrane_tick* tick) {
  return proxy ? give_membrane(tick, punctura::record_of(proxy->now.tick())) : PUNCTURA_BAD_ARGUMENT;
}
