// A knob: one needle in one membrane on one axis, in float. The state has a fixed place; nothing is allocated.
#include "punctura/model/thick_law.hpp"
#include "punctura/proxy/proxy_1d.hpp"

using punctura::Proxy1d;
using punctura::ThickLawF;
using Knob = Proxy1d<ThickLawF>;

alignas(Knob) static unsigned char place[sizeof(Knob)];
static Knob* knob;

/// Call it once, before the first tick. It needs tan() of the tip angle; the tick needs no function of libm.
extern "C" void knob_setup() {
  const ThickLawF skin({1.08e-3f, 0.28f}, {570, 0.41f, 0.2f, 1e-3f});  // needle; membrane: N/m, N, -, m
  knob = new (place) Knob(skin, {400, 1}, 1 / 1600.0f);
}

/// Call it 1600 times a second. depth: of the tip, m, inward.
/// Returns the force on the needle, N, positive inward. NaN if depth is no number.
extern "C" float knob_tick(float depth) { return knob->step(depth); }
