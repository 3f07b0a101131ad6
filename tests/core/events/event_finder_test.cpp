#include "punctura/lab/events/event_finder.hpp"

#include <doctest/doctest.h>

#include <initializer_list>
#include <limits>
#include <utility>

#include "../support/allocations.hpp"
#include "../support/paper_scene.hpp"
#include "punctura/state/archive.hpp"

using namespace punctura;
using namespace punctura::test;

static_assert(noexcept(std::declval<EventFinder&>().step(std::declval<const Snapshot&>())));
static_assert(std::is_trivially_copyable_v<Contact> && std::is_trivially_copyable_v<Event>);

namespace {

constexpr double speed = 3e-6;  // m per tick
const double no_number = std::numeric_limits<double>::quiet_NaN();

Scene quick_scene(double thickness = 1e-3) {
  Scene scene = paper_scene(thickness);
  scene.servo.low_pass = 0;
  return scene;
}

/// Moves the tip through the given depths at constant speed. Returns all events.
std::vector<Event> run(const Scene& scene, EventFinder& finder, std::initializer_list<double> depths) {
  ServoStep step = build(scene);
  std::vector<Event> found;
  double depth = *depths.begin();
  std::uint64_t k = 0;
  for (const double to : depths) {
    const auto ticks = static_cast<int>(std::abs(to - depth) / speed) + 1;
    for (int i = 0; i < ticks; ++i) {
      depth += (to - depth) / (ticks - i);
      for (const Event& event : finder.step(step.step(reading(k, -depth)))) found.push_back(event);
      ++k;
    }
  }
  return found;
}
std::vector<Event> run(const Scene& scene, std::initializer_list<double> depths) {
  EventFinder finder(scene);
  return run(scene, finder, depths);
}

std::vector<EventKind> kinds(const std::vector<Event>& events) {
  std::vector<EventKind> all;
  for (const Event& event : events) all.push_back(event.what);
  return all;
}

/// A record at a depth, on the lower edge.
MembraneRecord at(double depth, double force = 0.1, Phase phase = Phase::sliding_in) {
  return {depth, -force, -force, force, {}, {0, -1, 0}, phase};
}
std::vector<EventKind> steps(EventFinder& finder, std::initializer_list<MembraneRecord> records) {
  std::vector<Event> found;
  for (const MembraneRecord& record : records)
    for (const Event& event : finder.step(EventTick{0, 0, {0, -1, 0}, 0, {&record, 1}})) found.push_back(event);
  return kinds(found);
}

}  // namespace

TEST_CASE("insertion and withdrawal give touch, pop and out, with the forces of the law") {
  const Scene scene = quick_scene();
  const auto events = run(scene, {-2e-3, 15e-3, -2e-3});
  REQUIRE(kinds(events) == std::vector{EventKind::touch, EventKind::pop, EventKind::out});
  const Event& pop = events[1];
  const ThickLaw law(scene.needle, scene.membranes[0].membrane);
  const Crossing turns = crossing(law, scene.needle, 1e-3, 1);
  CHECK(pop.depth >= turns.through);
  CHECK(pop.depth < turns.through + 1e-4);
  CHECK(pop.force_before == doctest::Approx(-law.band(turns.peak).lower).epsilon(2e-3));
  CHECK(pop.force_after == -law.band(1).lower);
  CHECK(pop.drop() == pop.force_before - pop.force_after);
  CHECK(pop.time == doctest::Approx(static_cast<double>(pop.tick) / 1600));
  CHECK(events[2].depth <= -Contact::clear);
  for (const Event& event : {events[0], events[2]}) CHECK(event.drop() == 0);
}

TEST_CASE("a second pop needs a tip that came back before the peak") {
  EventFinder finder(quick_scene());
  const Crossing turns = crossing(ThickLaw(paper_needle, paper_membrane(1e-3)), paper_needle, 1e-3, 1);
  const double in = turns.through, near = std::nextafter(turns.again, 1.0);
  using enum EventKind;
  CHECK(steps(finder, {at(1e-3), at(in), at(near), at(in)}) == std::vector{touch, pop});
  CHECK(steps(finder, {at(turns.again, 0.7), at(in)}) == std::vector{pop});
  CHECK(steps(finder, {at(-0.1e-3, 0, Phase::outside), at(in)}) ==
        std::vector{pop});  // in again, without an `out` in between
  CHECK(steps(finder, {at(-0.25e-3, 0, Phase::outside), at(-1, 0, Phase::outside), at(in)}) ==
        std::vector{out, touch, pop});
}

TEST_CASE("ticks without depth or with an invalid phase are ignored, and a barred membrane has no pop") {
  EventFinder finder(quick_scene());
  using enum EventKind;
  constexpr auto none = static_cast<Phase>(255);
  CHECK(steps(finder, {at(no_number), at(1e-3), at(no_number), at(no_number, 0, Phase::outside), at(9e-3)}) ==
        std::vector{touch, pop});
  CHECK(steps(finder, {at(20e-3, 0, Phase::barred), at(20e-3, 0, none)}).empty());
  CHECK(steps(finder, {at(-1e-3, 0, Phase::outside)}) == std::vector{out});
  CHECK(steps(finder, {at(20e-3, 0, Phase::barred), at(20e-3, 0, none)}).empty());
}

TEST_CASE("a pop uses the friction of the shaft if the record has NaN, and NaN does not hide the peak") {
  EventFinder finder(quick_scene());
  MembraneRecord blind = at(9e-3);
  blind.axial_force = blind.lower = no_number;
  std::vector<Event> found;
  for (const MembraneRecord& record : {at(1e-3, 0.7), at(no_number, 0, Phase::outside), blind})
    for (const Event& event : finder.step(EventTick{0, 0, {}, 0, {&record, 1}})) found.push_back(event);
  REQUIRE(found.size() == 2);
  CHECK(found[1].force_before == 0.7);
  CHECK(found[1].force_after == -ThickLaw(paper_needle, paper_membrane(1e-3)).band(1).lower);
}

TEST_CASE("after a change of scene, a membrane at the same place keeps its contact under the new law") {
  Scene two = quick_scene(3e-3);
  two.membranes.insert(two.membranes.begin(), {"above", paper_membrane(0), {0, 4e-3, 0}, {0, -1, 0}});
  EventFinder finder(quick_scene());
  const MembraneRecord inside = at(1e-3);
  CHECK(finder.step(EventTick{0, 0, {}, 0, {&inside, 1}}).size() == 1);
  finder.change(two);
  CHECK(finder.step(EventTick{1, 0, {}, 0, {&inside, 1}}).empty());
  CHECK(finder.scene().membranes.size() == 1);

  const double through = tip_length(paper_needle) + 3e-3;
  const MembraneRecord records[2] = {at(5e-3), at(1e-3)}, deep[2] = {at(5e-3), at(through)},
                       before[2] = {at(5e-3), at(std::nextafter(through, 0.0))};
  const auto changed = finder.step(EventTick{2, 0, {}, command_scene, records});
  REQUIRE(changed.size() == 2);  // only the new membrane has events
  CHECK(changed[0].membrane + changed[1].membrane == 0);
  CHECK(finder.scene().membranes[1].name == "wall");
  CHECK(finder.step(EventTick{3, 0, {}, 0, before}).empty());  // with the old law this would be a pop
  const auto popped = finder.step(EventTick{3, 0, {}, 0, deep});
  REQUIRE(popped.size() == 1);
  CHECK((popped[0].membrane == 1 && popped[0].what == EventKind::pop));
}

TEST_CASE("the depths of an oblique needle are those of its direction at entry") {
  const double cos_beta = 0.6;
  const double through = tip_length(paper_needle) + 3e-3 / cos_beta;
  for (const bool by_axis : {false, true}) {
    EventFinder finder(quick_scene(3e-3));
    const std::array<double, 3> slanted{0.8, -0.6, 0};
    MembraneRecord before = at(std::nextafter(through, 0.0)), after = at(std::nextafter(through, 1.0));
    before.direction = after.direction = by_axis ? std::array{no_number, no_number, no_number} : slanted;
    const auto axis = by_axis ? slanted : std::array{0.0, -1.0, 0.0};
    CHECK(finder.step(EventTick{0, 0, axis, 0, {&before, 1}}).size() == 1);
    CHECK(finder.step(EventTick{1, 0, axis, 0, {&after, 1}}).size() == 1);
  }
}

namespace {
/// The resistance grows with 0.5 N/mm up to 1 mm. Behind it, the friction is 0.1 N.
struct FoilLaw {
  using Scalar = double;
  PiecewiseBand<double, 3> pieces(double = 1) const noexcept {
    return {{0, 1e-3}, {{{}, {0, {0, -500, 0}, {0, 500, 0}}, {1e-3, {-0.1, 0, 0}, {0.1, 0, 0}}}}};
  }
};
}  // namespace

TEST_CASE("the events of a custom law are at its breaks") {
  const Scene scene = quick_scene();
  const auto foil = [](const Needle&, const Membrane&, std::size_t) { return FoilLaw{}; };
  auto insertion = build_insertion<double>(scene, foil);
  EventFinderOf<FoilLaw> finder(scene, foil);
  std::vector<Event> found;
  for (std::uint64_t k = 0; k < 3000; ++k) {
    insertion.step({0, 1e-3 - speed * static_cast<double>(k), 0}, {0, -1, 0});
    const auto& tick = insertion.proxies()[0].tick();
    const MembraneRecord record{tick.depth, tick.axial_force,         tick.band.lower, tick.band.upper,
                                {},         to_array(tick.direction), tick.phase};
    for (const Event& event : finder.step(EventTick{k, 0, {}, 0, {&record, 1}})) found.push_back(event);
  }
  REQUIRE(kinds(found) == std::vector{EventKind::touch, EventKind::pop});
  CHECK(found[1].depth >= 1e-3);
  CHECK(found[1].force_before == doctest::Approx(0.5).epsilon(0.01));
  CHECK(found[1].force_after == 0.1);
}

TEST_CASE("a tick allocates no memory, also if it changes the scene") {
  const Scene scene = quick_scene();
  EventFinder finder(scene);
  finder.change(quick_scene(2e-3));
  ServoStep step = build(scene);
  std::size_t events = 0;
  const std::size_t before = allocations();
  for (std::uint64_t k = 0; k < 4000; ++k) {
    Snapshot s = step.step(reading(k, 1e-3 - 5 * speed * static_cast<double>(k)));
    if (k == 500) s.commands |= command_scene;
    events += finder.step(s).size();
  }
  CHECK(allocations() == before);
  CHECK(events == 2);
}

TEST_CASE("a saved finder continues with the same events, and a state of another scene is refused") {
  const Scene scene = quick_scene();
  ServoStep step = build(scene);
  EventFinder first(scene), other(scene), thick(quick_scene(2e-3));
  std::uint64_t k = 0;
  for (const auto& [from, to] : {std::pair{-2e-3, 4e-3}, std::pair{4e-3, 15e-3}, std::pair{15e-3, -2e-3}}) {
    for (double depth = from; from < to ? depth < to : depth > to; depth += from < to ? speed : -speed, ++k) {
      const Snapshot& now = step.step(reading(k, -depth));
      const auto one = first.step(now), two = other.step(now);
      REQUIRE(one.size() == two.size());
      for (std::size_t i = 0; i < one.size(); ++i) {
        CHECK(one[i].what == two[i].what);
        CHECK(one[i].force_before == two[i].force_before);
      }
    }
    const auto kept = save_state(first);
    EventFinder loaded(scene);
    REQUIRE(load_state(loaded, kept));
    CHECK_FALSE(load_state(thick, kept));
    CHECK(save_state(loaded) == kept);
    other = loaded;
  }
}
