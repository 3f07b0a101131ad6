// Every call of this module: it is counted for the end of the program, it locks its object where Python has no GIL, and
// wrong arguments are told in plain words, in place of nanobind's list of signatures.
#include <array>
#include <string_view>

#include "bindings.hpp"
#include "without_lock.hpp"

namespace punctura::bindings {
namespace {

using Call = PyObject* (*)(PyObject*, PyObject* const*, std::size_t, PyObject*);

/// How a function of nanobind begins. nanobind promises no such thing, and nothing that it promises is as fast:
/// docs/decisions/calls-of-the-core.md. hook() compares this with what the function itself tells, so another layout
/// would lose the plain words, not a call; with another version, look at nb_func in nanobind's nb_internals.h.
static_assert(NB_VERSION_MAJOR == 3 && NB_VERSION_MINOR == 1);
struct Function {
  PyObject_VAR_HEAD Call call;
};

constexpr std::size_t most_kinds = 12;
std::array<Call, most_kinds> calls{};  // nanobind has a few, one for each kind of signature

/// Replaces the TypeError of nanobind by one with the text of punctura.call_errors. Keeps any other exception.
void explain(PyObject* function, PyObject* const* given, std::size_t count, PyObject* words) noexcept {
  nb::python_error error;  // takes the exception
  try {
    const std::string_view marks = "(): incompatible function arguments. The following";
    if (error.matches(PyExc_TypeError)) {
      const auto text = nb::cast<std::string>(nb::str(error.value()));
      if (text.find(marks) != std::string::npos) {
        nb::list arguments;
        for (std::size_t i = 0; i < count; ++i) arguments.append(nb::handle(given[i]));
        nb::dict named;
        if (words)
          for (const nb::handle word : nb::borrow<nb::tuple>(words)) named[word] = nb::handle(given[count++]);
        const nb::object error_text = nb::module_::import_("punctura.call_errors")
                                          .attr("explained")(nb::handle(function), arguments, named, text);
        PyErr_SetObject(PyExc_TypeError, error_text.ptr());
        return;
      }
    }
  } catch (...) {
    PyErr_Clear();
  }
  error.restore();
}

template <std::size_t kind>
PyObject* call(PyObject* function, PyObject* const* given, std::size_t flags_and_count, PyObject* words) {
  const std::size_t count = flags_and_count & 0xffffffff;  // the upper bits are flags
  const InCall in_call;
#ifdef NB_FREE_THREADED
  // Like the GIL, Python opens this lock while the thread waits and in WithoutLock. Therefore nothing here can wait for
  // itself, and what holds with the GIL, such as OneThread, holds with this lock.
  std::optional<nb::ft_object_guard> object;
  if (count > 0 && nb::inst_check(given[0])) object.emplace(given[0]);
#endif
  PyObject* result = calls[kind](function, given, flags_and_count, words);
  if (!result) explain(function, given, count, words);
  return result;
}

template <std::size_t... kind>
constexpr std::array<Call, most_kinds> all_calls(std::index_sequence<kind...>) {
  return {&call<kind>...};
}

/// Does nothing if the function is not one of nanobind, or not laid out as expected.
void hook(nb::handle object) {
  constexpr auto ours = all_calls(std::make_index_sequence<most_kinds>());
  if (!nb::hasattr(object, "__nb_signature__")) return;
  auto* const function = reinterpret_cast<Function*>(object.ptr());
  const nb::object place = nb::getattr(object, "__vectorcalloffset__", nb::none());
  if (place.is_none() || nb::cast<std::intptr_t>(place) != reinterpret_cast<std::intptr_t>(function->call)) return;
  for (std::size_t kind = 0; kind < most_kinds; ++kind) {
    if (!calls[kind]) calls[kind] = function->call;
    if (function->call == ours[kind]) return;
    if (function->call == calls[kind]) {
      function->call = ours[kind];
      return;
    }
  }
}

}  // namespace

void explain_calls(nb::module_& m) {
  const nb::dict all = nb::borrow<nb::dict>(m.attr("__dict__"));
  for (const auto& [name, value] : all) {
    hook(value);
    if (!PyType_Check(value.ptr())) continue;
    for (const nb::handle member : nb::module_::import_("builtins").attr("vars")(value).attr("values")()) {
      hook(member);
      for (const char* accessor : {"fget", "fset"})
        if (nb::hasattr(member, accessor)) hook(nb::object(member.attr(accessor)));
    }
  }
}

}  // namespace punctura::bindings
