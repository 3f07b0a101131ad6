// core/punctura/scene: a membrane with its place and its tissue, and the branches of a coupling that relaxes.
#include <array>
#include <string>
#include <vector>

#include "arguments.hpp"
#include "bindings.hpp"
#include "punctura/scene/check.hpp"
#include "value.hpp"

namespace punctura::bindings {
namespace {

using Point = std::array<double, 2>;  // opening, m; grip, N
using Row = std::array<double, 3>;    // depth, m; lower, upper, N

nb::str text(std::string_view s) { return nb::str(s.data(), s.size()); }

/// The type hint of a word out of a list.
template <typename Enum>
std::string literal() {
  std::string text;
  for (const auto word : words_of<Enum>) text += (text.empty() ? "typing.Literal['" : ", '") + std::string(word) + "'";
  return text + "]";
}
const std::string look_type = literal<Look>(), behind_type = literal<Behind>(), grip_type = literal<GripShape>();

/// The enumerator of a word. Throws ConfigurationError that lists the words.
template <typename Enum>
Enum from_word(const std::string& path, const std::string& given) {
  if (const auto found = enum_of<Enum>(given)) return *found;
  std::string reason = "must be one of";
  for (const auto word : words_of<Enum>)
    reason += (word == words_of<Enum>.front() ? " \"" : ", \"") + std::string(word) + "\"";
  raise_word(path, given, reason.c_str());
}

Tissue unchecked_tissue(std::string grip, double growth, std::vector<Point> grip_table, double tip_length,
                        double tail_length, double tail_floor, double cutting, double set, std::vector<Row> profile) {
  Tissue made;
  made.grip = from_word<GripShape>("tissue.grip", grip);
  made.growth = growth;
  for (const auto& [opening, force] : grip_table) made.grip_table.push_back({opening, force});
  made.tip_length = tip_length;
  made.tail_length = tail_length;
  made.tail_floor = tail_floor;
  made.cutting = cutting;
  made.set = set;
  for (const auto& [depth, lower, upper] : profile) made.profile.push_back({depth, lower, upper});
  return made;
}

Tissue make_tissue(std::string grip, double growth, std::vector<Point> grip_table, double tip_length,
                   double tail_length, double tail_floor, double cutting, double set, std::vector<Row> profile) {
  Tissue made = unchecked_tissue(std::move(grip), growth, std::move(grip_table), tip_length, tail_length, tail_floor,
                                 cutting, set, std::move(profile));
  std::vector<Problem> problems;
  check(made, "tissue", problems);
  raise_if(problems);
  return made;
}

MaxwellBranch unchecked_branch(double stiffness, double time_constant) { return {stiffness, time_constant}; }

MaxwellBranch make_branch(double stiffness, double time_constant) {
  const MaxwellBranch made{stiffness, time_constant};
  std::vector<Problem> problems;
  check_fields(branch_fields, made, "coupling.relaxation", problems);
  raise_if(problems);
  return made;
}

PlacedMembrane unchecked_placed(std::string name, Membrane membrane, Triple point, Triple inward_normal,
                                std::string behind, std::string look, Outlet outflow, Outlet outflow_behind,
                                Tissue tissue) {
  return {std::move(name),
          membrane,
          point,
          inward_normal,
          from_word<Behind>("membrane.behind", behind),
          from_word<Look>("membrane.look", look),
          outflow,
          outflow_behind,
          std::move(tissue)};
}

PlacedMembrane make_placed(std::string name, Membrane membrane, Triple point, Triple inward_normal, std::string behind,
                           std::string look, Outlet outflow, Outlet outflow_behind, Tissue tissue) {
  PlacedMembrane made = unchecked_placed(std::move(name), membrane, point, inward_normal, std::move(behind),
                                         std::move(look), outflow, outflow_behind, std::move(tissue));
  std::vector<Problem> problems;
  check_place(made, "membrane", problems);
  raise_if(problems);
  return made;
}

}  // namespace

void bind_membrane(nb::module_& m) {
  auto tissue =
      nb::class_<Tissue>(m, "Tissue", "What a membrane of measured tissue has beside the four numbers of K06.")
          .def_static("unchecked", &unchecked_tissue, nb::arg("grip"), nb::arg("growth"), nb::arg("grip_table"),
                      nb::arg("tip_length"), nb::arg("tail_length"), nb::arg("tail_floor"), nb::arg("cutting"),
                      nb::arg("set"), nb::arg("profile"),
                      "Creates the additions without checks of the numbers. The scene that uses them checks all.")
          .def_prop_ro(
              "grip", [](const Tissue& t) { return text(word_of(t.grip)); },
              nb::sig(("def grip(self) -> " + grip_type).c_str()), "How the grip grows with the opening of the hole")
          .def_ro("growth", &Tissue::growth, "Of an exponential grip, 1/m; 0 is linear")
          .def_prop_ro(
              "grip_table",
              [](const Tissue& t) {
                nb::list rows;
                for (const auto& p : t.grip_table) rows.append(nb::make_tuple(p.opening, p.grip));
                return nb::tuple(rows);
              },
              nb::sig("def grip_table(self) -> tuple[tuple[float, float], ...]"),
              "Of a measured grip: openings (m) and grips (N)")
          .def_ro("tip_length", &Tissue::tip_length, "X, m; 0 is w / tan(theta)")
          .def_ro("tail_length", &Tissue::tail_length, "The shaft's friction falls on this length behind the tip, m")
          .def_ro("tail_floor", &Tissue::tail_floor, "The part of the shaft's friction that is left behind the tail")
          .def_ro("cutting", &Tissue::cutting, "The force on the tip while it cuts for the first time, N")
          .def_ro("set", &Tissue::set, "The part of the grip that a hole has lost")
          .def_prop_ro(
              "profile",
              [](const Tissue& t) {
                nb::list rows;
                for (const auto& k : t.profile) rows.append(nb::make_tuple(k.depth, k.lower, k.upper));
                return nb::tuple(rows);
              },
              nb::sig("def profile(self) -> tuple[tuple[float, float, float], ...]"),
              "A measured profile: depths (m), lower and upper forces of an infinitely thin wall (N)");
  const Tissue none;
  def_init(tissue, &make_tissue, nb::arg("grip") = "linear", nb::arg("growth") = none.growth,
           nb::arg("grip_table") = nb::make_tuple(), nb::arg("tip_length") = none.tip_length,
           nb::arg("tail_length") = none.tail_length, nb::arg("tail_floor") = none.tail_floor,
           nb::arg("cutting") = none.cutting, nb::arg("set") = none.set, nb::arg("profile") = nb::make_tuple(),
           nb::sig(("def __init__(self, grip: " + grip_type +
                    " = ..., growth: float = ..., grip_table: Sequence[tuple[float, float]] = ..., tip_length: float = "
                    "..., tail_length: float = ..., tail_floor: float = ..., cutting: float = ..., set: float = ..., "
                    "profile: Sequence[tuple[float, float, float]] = ...) -> None")
                       .c_str()),
           "Tissue() is K06's membrane. A profile replaces grip and tail. docs/measured-tissue.md. Raises\n"
           "ConfigurationError.");
  def_value(tissue,
            {"grip", "growth", "grip_table", "tip_length", "tail_length", "tail_floor", "cutting", "set", "profile"});

  auto branch = nb::class_<MaxwellBranch>(m, "MaxwellBranch",
                                          "A spring in series with a damper, beside the coupling: it relaxes while the "
                                          "needle rests.")
                    .def_static("unchecked", &unchecked_branch, nb::arg("stiffness"), nb::arg("time_constant"),
                                "Creates a branch without checks. The scene that uses it checks all values.")
                    .def_ro("stiffness", &MaxwellBranch::stiffness, "K_m of the spring, N/m; 0 is no branch")
                    .def_ro("time_constant", &MaxwellBranch::time_constant, "tau: damping over stiffness, s");
  def_init(branch, &make_branch, nb::arg("stiffness"), nb::arg("time_constant"), "Raises ConfigurationError.");
  def_value(branch, {"stiffness", "time_constant"});

  auto placed =
      nb::class_<PlacedMembrane>(m, "PlacedMembrane", "A membrane and its place in the scene.")
          .def_static("unchecked", &unchecked_placed, nb::arg("name"), nb::arg("membrane"), nb::arg("point"),
                      nb::arg("inward_normal"), nb::arg("behind"), nb::arg("look"), nb::arg("outflow"),
                      nb::arg("outflow_behind"), nb::arg("tissue"),
                      "Creates a membrane without a check of its place. The scene that uses it checks all values.")
          .def_ro("name", &PlacedMembrane::name)
          .def_ro("membrane", &PlacedMembrane::membrane)
          .def_prop_ro(
              "point", [](const PlacedMembrane& p) { return as_tuple(p.point); },
              nb::sig("def point(self) -> tuple[float, float, float]"), "Any point of the surface, m")
          .def_prop_ro(
              "inward_normal", [](const PlacedMembrane& p) { return as_tuple(p.inward_normal); },
              nb::sig("def inward_normal(self) -> tuple[float, float, float]"), "A direction of any length but 0")
          .def_prop_ro(
              "behind", [](const PlacedMembrane& p) { return text(word_of(p.behind)); },
              nb::sig(("def behind(self) -> " + behind_type).c_str()),
              "Content of the space between this membrane and the next. It does not affect the force")
          .def_prop_ro(
              "look", [](const PlacedMembrane& p) { return text(word_of(p.look)); },
              nb::sig(("def look(self) -> " + look_type).c_str()),
              "The kind of tissue that the studio draws. It does not affect the force")
          .def_ro("outflow", &PlacedMembrane::outflow, "What liquid from the needle's syringe meets in the membrane")
          .def_ro("outflow_behind", &PlacedMembrane::outflow_behind, "The same for the space behind it")
          .def_ro("tissue", &PlacedMembrane::tissue, "What measured tissue adds to the membrane; Tissue() in K06");
  def_init(
      placed, &make_placed, nb::arg("name"), nb::arg("membrane"), nb::arg("point"), nb::arg("inward_normal"),
      nb::arg("behind") = "tissue", nb::arg("look") = "plain", nb::arg("outflow") = dense_tissue,
      nb::arg("outflow_behind") = dense_tissue, nb::arg("tissue") = Tissue{},
      nb::sig(("def __init__(self, name: str, membrane: Membrane, point: _Vector, inward_normal: _Vector, behind: " +
               behind_type + " = ..., look: " + look_type +
               " = ..., outflow: Outlet = ..., outflow_behind: Outlet = ..., tissue: Tissue = ...) -> None")
                  .c_str()),
      "point: any point of the surface, m. inward_normal: a direction of any length but 0. behind: content between\n"
      "this membrane and the next. look: kind of tissue in the studio's picture. outflow,\n"
      "outflow_behind: what liquid from a syringe meets in the membrane and behind it; by default it cannot leave.\n"
      "tissue: what measured tissue adds. Raises ConfigurationError.");
  def_value(placed,
            {"name", "membrane", "point", "inward_normal", "behind", "look", "outflow", "outflow_behind", "tissue"});
}

}  // namespace punctura::bindings
