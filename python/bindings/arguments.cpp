// Similar words, and warnings for numbers that are off by a factor of 1000.
#include "arguments.hpp"

#include <utility>

#include "punctura/scene/usual.hpp"

namespace punctura::bindings {

std::string nearest(const std::string& word, const nb::list& words) {
  const nb::object found = nb::module_::import_("difflib").attr("get_close_matches")(word, words, 1, 0.5);
  return nb::len(found) > 0 ? "; did you mean " + nb::cast<std::string>(found[0]) + "?" : "";
}

std::size_t count_from(const nb::object& given, const char* name, std::size_t least, std::size_t most) {
  const auto wrong = [&] {
    return std::string(name) + " must be a whole number from " + std::to_string(least) + " to " + std::to_string(most) +
           ", not " + nb::cast<std::string>(nb::repr(given));
  };
  const nb::object whole = nb::steal(PyNumber_Index(given.ptr()));
  if (!whole) {
    PyErr_Clear();
    throw nb::type_error(wrong().c_str());
  }
  int overflow = 0;
  const long long number = PyLong_AsLongLongAndOverflow(whole.ptr(), &overflow);
  if (overflow != 0 || number < 0 || static_cast<std::size_t>(number) < least ||
      static_cast<std::size_t>(number) > most)
    throw nb::value_error(wrong().c_str());
  return static_cast<std::size_t>(number);
}

std::size_t threads_from(const nb::object& given) {
  return given.is_none() ? 0 : count_from(given, "threads", 0, 4096);
}

namespace {
thread_local bool unusual_warnings = true;
}

bool set_unusual_warnings(bool on) { return std::exchange(unusual_warnings, on); }

void warn_unusual(const std::string& path, double value) {
  if (!unusual_warnings) return;
  const std::string advice = unusual(path, value);
  if (advice.empty()) return;
  const std::string text = path + " = " + decimal_text(value, 6) + " " + std::string(scene_field(path)->unit) +
                           " is unusual. " + advice + ": all numbers are in SI units";
  if (PyErr_WarnEx(PyExc_UserWarning, text.c_str(), 1) != 0) throw nb::python_error();
}

}  // namespace punctura::bindings
