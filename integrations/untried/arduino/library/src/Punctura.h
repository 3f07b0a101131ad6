// The needle on one axis, for firmware: Proxy1d<ThickLawF>. docs: integrations/untried/arduino/README.md.
#pragma once
// Some cores of Arduino define these words as macros, which break the C++ library. The sketch keeps them.
#pragma push_macro("min")
#pragma push_macro("max")
#pragma push_macro("abs")
#pragma push_macro("round")
#undef min
#undef max
#undef abs
#undef round
#include "punctura/model/thick_law.hpp"
#include "punctura/proxy/proxy_1d.hpp"
#pragma pop_macro("min")
#pragma pop_macro("max")
#pragma pop_macro("abs")
#pragma pop_macro("round")
