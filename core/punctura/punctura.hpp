// Includes what computes a force, with scenes, states, rivals, events and plant. Headers of one's own devices, of
// lab/trace, of keys of scene files and of a thumb on the plunger are included one by one, as any folder can be.
#pragma once

#include "punctura/insertion/insertion.hpp"
#include "punctura/lab/events/event_finder.hpp"
#include "punctura/lab/events/law_curve.hpp"
#include "punctura/model/law.hpp"
#include "punctura/model/profile_law.hpp"
#include "punctura/model/thick_law.hpp"
#include "punctura/model/thin_law.hpp"
#include "punctura/model/tissue_law.hpp"
#include "punctura/model/validity.hpp"
#include "punctura/proxy/proxy_1d.hpp"
#include "punctura/proxy/proxy_3d.hpp"
#include "punctura/rivals/rival_insertion.hpp"
#include "punctura/scene/build.hpp"
#include "punctura/scene/passivity.hpp"
#include "punctura/scene/values.hpp"
#include "punctura/servo/any_step.hpp"
#include "punctura/state/archive.hpp"
#include "punctura/syringe/plunger.hpp"
#include "punctura/syringe/syringe.hpp"
#if defined(__cpp_exceptions)
#include "punctura/lab/plant/check.hpp"
#include "punctura/lab/plant/experiment.hpp"
#include "punctura/lab/plant/stroke_ends.hpp"
#endif
