// Reads the arguments of a call by name and reports wrong ones.
#include "arguments.hpp"

#include <algorithm>
#include <cstdio>

#include "punctura/scene/usual.hpp"

namespace punctura::bindings {

std::string nearest(const std::string& word, const nb::list& words) {
  const nb::object found = nb::module_::import_("difflib").attr("get_close_matches")(word, words, 1, 0.5);
  return nb::len(found) > 0 ? "; did you mean " + nb::cast<std::string>(found[0]) + "?" : "";
}

Arguments::Arguments(const std::string& call, const std::vector<Argument>& wanted, const nb::args& args,
                     const nb::kwargs& kwargs)
    : call_(call), wanted_(wanted), values_(wanted.size()) {
  std::string faults;
  nb::list names;
  for (const Argument& a : wanted_) names.append(a.name);
  const auto add = [&faults](const std::string& fault) { faults += (faults.empty() ? "" : "; ") + fault; };
  if (args.size() > wanted_.size())
    add("takes " + std::to_string(wanted_.size()) + " arguments, not " + std::to_string(args.size()));
  for (std::size_t i = 0; i < std::min<std::size_t>(args.size(), wanted_.size()); ++i) values_[i] = args[i];
  for (const auto& [key, value] : kwargs) {
    const auto word = nb::cast<std::string>(key);
    const auto same = [&](const Argument& a) { return word == a.name; };
    const auto i = static_cast<std::size_t>(std::find_if(wanted_.begin(), wanted_.end(), same) - wanted_.begin());
    if (i == wanted_.size())
      add("there is no argument " + word + nearest(word, names));
    else if (values_[i])
      add(word + " is given twice");
    else
      values_[i] = nb::borrow(value);
  }
  for (std::size_t i = 0; i < wanted_.size(); ++i) {
    if (!values_[i]) values_[i] = wanted_[i].otherwise;
    if (!values_[i]) add(std::string(wanted_[i].name) + " is missing");
  }
  if (!faults.empty()) refuse(faults);
}

void Arguments::refuse(std::size_t i) const {
  const std::string type = wanted_[i].type, given = nb::cast<std::string>(values_[i].type().attr("__name__"));
  const std::string wanted = type == "float" ? "number" : type;
  refuse(std::string(wanted_[i].name) + " must be a " + wanted + ", not " + given);
}

void Arguments::refuse(const std::string& faults) const {
  std::string takes;
  for (const Argument& a : wanted_)
    takes += std::string(takes.empty() ? "" : ", ") + a.name + ": " + a.type + (a.otherwise ? " (optional)" : "");
  const char* end = faults.ends_with('?') ? " It takes (" : ". It takes (";
  throw nb::type_error((call_ + "(): " + faults + end + takes + ")").c_str());
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
