#include "common.hpp"

#include "punctura/safety/fault.hpp"

namespace punctura::c {
namespace {

struct LastError {
  std::string text;
  std::vector<Problem> problems;
};

LastError& last_error() {
  thread_local LastError error;
  return error;
}

}  // namespace

punctura_status fail(punctura_status status, std::string text) {
  LastError& error = last_error();
  error.text = std::move(text);
  error.problems.clear();
  return status;
}

punctura_status fail(std::vector<Problem> problems) {
  LastError& error = last_error();
  error.text.clear();
  for (const Problem& p : problems) error.text += (error.text.empty() ? "" : "\n") + line_of(p);
  error.problems = std::move(problems);
  return PUNCTURA_BAD_SCENE;
}

}  // namespace punctura::c

using punctura::c::last_error;

const char* punctura_version(void) { return PUNCTURA_VERSION; }
int32_t punctura_supports_abi(int32_t abi) { return abi == PUNCTURA_ABI ? 1 : 0; }

const char* punctura_status_text(punctura_status status) {
  switch (status) {
    case PUNCTURA_OK: return "no error";
    case PUNCTURA_BAD_ARGUMENT:
      return "a pointer is NULL, an index is out of range, or a stride or a struct_size is wrong. "
             "punctura_last_error() says which, but not after a tick or an _init function";
    case PUNCTURA_BAD_SCENE: return "the scene or the limits have problems: see punctura_last_error()";
    case PUNCTURA_BAD_STATE: return "the bytes are no state of this object: see punctura_last_error()";
    case PUNCTURA_NO_PEEK: return "there is no tick to commit: call the _peek function first";
    case PUNCTURA_NO_NUMBER: return "the position or the axis is not finite, or the axis is 0";
    case PUNCTURA_NO_MEMORY: return "there is not enough memory";
    case PUNCTURA_NOT_BUILT: return "this library was built without the TOML reader: build it with PUNCTURA_C_TOML=ON";
    case PUNCTURA_INTERNAL: return "a defect of Punctura: please report it";
    default: return "unknown status";
  }
}

const char* punctura_fault_text(int32_t fault) {
  if (fault < 0 || fault > static_cast<int32_t>(punctura::Fault::thumb)) return "unknown fault";
  return punctura::describe(static_cast<punctura::Fault>(fault));
}

const char* punctura_last_error(void) { return last_error().text.c_str(); }

int32_t punctura_problem_count(void) { return static_cast<int32_t>(last_error().problems.size()); }

punctura_status punctura_problem(int32_t index, const char** path, double* value, const char** reason) {
  const auto& problems = last_error().problems;
  if (index < 0 || static_cast<std::size_t>(index) >= problems.size()) return PUNCTURA_BAD_ARGUMENT;
  const punctura::Problem& problem = problems[static_cast<std::size_t>(index)];
  if (path) *path = problem.path.c_str();
  if (value) *value = problem.value;
  if (reason) *reason = problem.reason.c_str();
  return PUNCTURA_OK;
}
