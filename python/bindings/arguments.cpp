// Similar words, and warnings for numbers that are off by a factor of 1000.
#include "arguments.hpp"

#include <cstdio>

#include "punctura/scene/usual.hpp"

namespace punctura::bindings {

std::string nearest(const std::string& word, const nb::list& words) {
  const nb::object found = nb::module_::import_("difflib").attr("get_close_matches")(word, words, 1, 0.5);
  return nb::len(found) > 0 ? "; did you mean " + nb::cast<std::string>(found[0]) + "?" : "";
}

void warn_unusual(const std::string& path, double value) {
  const std::string advice = unusual(path, value);
  if (advice.empty()) return;
  char given[40];
  std::snprintf(given, sizeof given, " = %g ", value);
  const std::string text = path + given + usual_unit(path) + " is unusual. " + advice + ": all numbers are in SI units";
  if (PyErr_WarnEx(PyExc_UserWarning, text.c_str(), 1) != 0) throw nb::python_error();
}

}  // namespace punctura::bindings
