// Conversions and errors shared by all binding files.

#include <utility>

#include "bindings.hpp"
#include "punctura/scene/usual.hpp"
#include "ticks.hpp"

namespace punctura::bindings {

namespace {

bool is_masked(nb::handle object) {
  return nb::hasattr(object, "_mask") &&
         nb::cast<bool>(nb::module_::import_("numpy").attr("ma").attr("is_masked")(object));
}

std::string kind_of(nb::handle array) { return nb::cast<std::string>(array.attr("dtype").attr("kind")); }

/// Throws MemoryError if there is no room for a copy of an array as numbers of 8 bytes.
void copy_fits(const nb::object& array, const char* name) {
  const auto numbers = nb::cast<std::size_t>(array.attr("size"));
  enough_memory(8.0 * static_cast<double>(numbers),
                std::string(name) + ": " + std::to_string(numbers) + " numbers in a copy", "Give them in parts.");
}

}  // namespace

bool is_real(nb::handle object) noexcept {
  if (PyComplex_Check(object.ptr())) return false;
  try {
    return !is_masked(object) && !(nb::hasattr(object, "dtype") && kind_of(object) == "c");
  } catch (...) {
    PyErr_Clear();
    return false;
  }
}

void enough_memory(double bytes, const std::string& what, const char* advice) {
  if (bytes >= 1e9) nb::module_::import_("punctura.batches.inputs").attr("enough_memory")(bytes, what, advice);
}

nb::object real_numbers(const nb::object& array_like, const char* name, const char* type) {
  const nb::object numpy = nb::module_::import_("numpy");
  if (is_masked(array_like))
    throw value_error(std::string(name) + " has masked elements: fill them in, or leave them out");
  nb::object given;
  try {
    given = numpy.attr("asarray")(array_like);
  } catch (nb::python_error& error) {
    if (!error.matches(PyExc_ValueError)) throw;
    throw value_error(std::string(name) + " must be an array of numbers: its rows have different lengths");
  }
  // Otherwise NumPy reads text and times as numbers, and drops the imaginary part of complex ones.
  const std::string kind = kind_of(given);
  if (std::string("biufO").find(kind) == std::string::npos) {
    const std::string held =
        kind == "U" || kind == "S" ? "text" : nb::cast<std::string>(nb::str(nb::object(given.attr("dtype"))));
    throw type_error(std::string(name) + " must hold real numbers, not " + held);
  }
  if (!given.attr("dtype").equal(numpy.attr("dtype")(type))) copy_fits(given, name);
  try {
    return numpy.attr("asarray")(given, type);
  } catch (nb::python_error& error) {
    if (!error.matches(PyExc_ValueError) && !error.matches(PyExc_TypeError)) throw;
    throw type_error(std::string(name) + " must hold real numbers");
  }
}

Input input(const nb::object& array_like, const char* name) {
  const nb::object given = real_numbers(array_like, name);
  if (!nb::cast<bool>(given.attr("flags").attr("c_contiguous"))) copy_fits(given, name);
  return nb::cast<Input>(nb::module_::import_("numpy").attr("ascontiguousarray")(given));
}

bool is_numpy_array(nb::handle object) noexcept {
  // Never freed. The stable ABI tells a type by its address only, without a string made for each call.
  static const PyObject* const type = []() noexcept -> PyObject* {
    try {
      return nb::object(nb::module_::import_("numpy").attr("ndarray")).release().ptr();
    } catch (const nb::python_error&) {
      return nullptr;
    }
  }();
  return reinterpret_cast<PyObject*>(Py_TYPE(object.ptr())) == type;
}

Input input_1d(const nb::object& array_like, const char* name) {
  Input array = input(array_like, name);
  if (array.ndim() != 1) throw value_error(std::string(name) + " must have shape (n,)");
  return array;
}

Input points(const nb::object& array_like, const char* name) {
  Input array = input(array_like, name);
  if (array.ndim() != 2 || array.shape(1) != 3) throw value_error(std::string(name) + " must have shape (n, 3)");
  return array;
}

Rows::Rows(Input array, std::size_t n, const char* name) : array_(std::move(array)), data_(array_.data()), stride_(3) {
  const bool one = array_.ndim() == 1 && array_.shape(0) == 3;
  const bool many = array_.ndim() == 2 && array_.shape(0) == n && array_.shape(1) == 3;
  if (!one && !many) {
    const std::string text = std::string(name) + " must have shape (3,) or (" + std::to_string(n) + ", 3)";
    throw value_error(text);
  }
  if (one) stride_ = 0;
}

void Rows::check(const char* name) const {
  check_finite(data_, array_.size(), name, 3);
  const std::size_t rows = array_.size() / 3;
  for (std::size_t i = 0; i < rows; ++i)
    if (const Vector3d row(data_ + 3 * i); row == Vector3d())
      check_direction(row, name + (rows > 1 ? "[" + std::to_string(i) + "]" : std::string()));
}

namespace {

[[noreturn]] void raise(const nb::list& problems) {
  const nb::object error = nb::module_::import_("punctura.errors").attr("ConfigurationError")(problems);
  PyErr_SetObject(error.type().ptr(), error.ptr());
  throw nb::python_error();
}

template <typename Value>
nb::object problem(const std::string& path, const Value& value, const std::string& reason) {
  return nb::module_::import_("punctura.errors").attr("Problem")(path, value, reason);
}

}  // namespace

std::vector<Problem> problems_of(const Needle& needle, const Membrane& membrane) {
  std::vector<Problem> problems;
  const bool needle_good = check(needle, "needle", problems);
  const bool membrane_good = check(membrane, "membrane", problems);
  if (needle_good && membrane_good) check_insertion(needle, membrane, "membrane", problems);
  return problems;
}

void check_period(double period, std::vector<Problem>& problems) {
  if (!(period > 0 && std::isfinite(period)))
    problems.push_back({"period", period, "must be greater than 0 s"});
  else if (period >= 1)
    problems.push_back({"period", period, "must be less than 1 s: the period of a tick is wanted, not its rate in Hz"});
}

void raise_if(const std::vector<Problem>& problems) {
  if (problems.empty()) return;
  nb::list list;
  for (const auto& p : problems)
    if (p.path.ends_with("name"))
      list.append(problem(p.path, nb::module_::import_("punctura.errors").attr("MISSING"), p.reason));
    else
      list.append(problem(p.path, p.value, p.reason));
  raise(list);
}

void raise_word(const std::string& path, const std::string& given, const char* reason) {
  nb::list list;
  list.append(problem(path, given, reason));
  raise(list);
}

Vector3d unit(const Triple& direction, const std::string& path) {
  const Vector3d v = to_vector(direction);
  if (!v.allFinite() || !(v.stableNorm() > 0))
    raise_if({{path, direction[0], "must be a direction: three finite numbers, at least one of them not 0"}});
  return v.stableNormalized();
}

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
    throw type_error(wrong());
  }
  int overflow = 0;
  const long long number = PyLong_AsLongLongAndOverflow(whole.ptr(), &overflow);
  if (overflow != 0 || number < 0 || static_cast<std::size_t>(number) < least ||
      static_cast<std::size_t>(number) > most)
    throw value_error(wrong());
  return static_cast<std::size_t>(number);
}

std::size_t threads_from(const nb::object& given) {
  return given.is_none() ? 0 : count_from(given, "threads", 0, 4096);
}

namespace {
thread_local bool unusual_warnings = true;
}

bool set_unusual_warnings(bool on) { return std::exchange(unusual_warnings, on); }

std::optional<std::pair<double, std::string>> unusual_list(std::string_view column, const std::vector<double>& written,
                                                           double size) {
  const bool depth = column == "profile[].depth", opening = column == "grip_table[].opening";
  if (written.empty() || (!depth && !opening && column.substr(0, 9) != "profile[]" && column != "grip_table[].grip"))
    return {};
  const double farthest =
      *std::max_element(written.begin(), written.end(), [](double a, double b) { return std::abs(a) < std::abs(b); });
  const bool is_long = depth && std::abs(farthest) * size > 1e-3;  // deep as a wall can be, short as a needle is thin
  const std::string advice = unusual(is_long            ? "membrane[0].thickness"
                                     : depth || opening ? "needle.diameter"
                                                        : "membrane[0].precompression",
                                     farthest, size);
  if (advice.empty()) return {};
  return std::pair{farthest, advice};
}

void warn_unusual(const std::string& path, double value) {
  if (!unusual_warnings) return;
  const std::string advice = unusual(path, value);
  if (advice.empty()) return;
  const std::string text = path + " = " + decimal_text(value, 6) + " " + std::string(scene_field(path)->unit) +
                           " is unusual. " + advice + ": all numbers are in SI units";
  if (PyErr_WarnEx(PyExc_UserWarning, text.c_str(), 1) != 0) throw nb::python_error();
}

}  // namespace punctura::bindings
