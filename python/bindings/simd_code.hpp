// The instruction set of a batch, by its name.
#pragma once

#include <nanobind/nanobind.h>

#include <cstdlib>
#include <optional>
#include <string>

#include "punctura_runtime/batch/run_line.hpp"

namespace punctura::bindings {

/// The instruction set with this name; by default that of the environment variable PUNCTURA_SIMD, or the fastest.
inline const batch::LineCode& code_named(const std::optional<std::string>& given) {
  const char* preset = std::getenv("PUNCTURA_SIMD");
  const std::string name = given ? *given : preset ? preset : "";
  if (const batch::LineCode* code = batch::line_code(name)) return *code;
  std::string names;
  for (const batch::LineCode* code : batch::line_codes())
    names += (names.empty() ? "" : ", ") + std::string(code->name);
  throw nanobind::value_error(("instructions: this processor or this build has no \"" + name + "\": choose one of " +
                               names + (given ? "" : " in the environment variable PUNCTURA_SIMD, or remove it"))
                                  .c_str());
}

}  // namespace punctura::bindings
