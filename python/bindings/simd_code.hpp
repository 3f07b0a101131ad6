// The instruction set of a batch, by its name, and the options of a run.
#pragma once

#include <cstdlib>
#include <optional>
#include <string>

#include "bindings.hpp"
#include "punctura_runtime/batch/blocks.hpp"
#include "punctura_runtime/batch/run_line.hpp"
#include "ticks.hpp"
#include "without_lock.hpp"

namespace punctura::bindings {

/// The instruction set with this name; by default that of the environment variable PUNCTURA_SIMD, or the fastest.
inline const batch::LineCode& code_named(const std::optional<std::string>& given) {
  const char* preset = std::getenv("PUNCTURA_SIMD");
  const std::string name = given ? *given : preset ? preset : "";
  if (const batch::LineCode* code = batch::line_code(name)) return *code;
  std::string names;
  for (const batch::LineCode* code : batch::line_codes())
    names += (names.empty() ? "" : ", ") + std::string(code->name);
  throw value_error("instructions: this processor or this build has no \"" + name + "\": choose one of " + names +
                    (given ? "" : " in the environment variable PUNCTURA_SIMD, or remove it"));
}

/// The options of a run that tells its progress and ends at Ctrl-C.
inline batch::RunOptions options_of(const nb::object& threads, const std::optional<std::string>& instructions,
                                    const Progress& progress) {
  batch::RunOptions options;
  options.threads = threads_from(threads);
  options.code = &code_named(instructions);
  options.watch = [&progress](std::size_t done, std::size_t all) {
    const WithLock lock;
    if (PyErr_CheckSignals() != 0) throw nb::python_error();
    progress.report(done, all);
    return true;
  };
  return options;
}

}  // namespace punctura::bindings
