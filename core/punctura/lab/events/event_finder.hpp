// Finds the events touch, pop and out at the membranes of a scene, tick by tick (docs/events.md).
#pragma once

#include <algorithm>
#include <array>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "punctura/insertion/conditioned_proxies.hpp"
#include "punctura/lab/events/contact.hpp"
#include "punctura/scene/build.hpp"

namespace punctura {

/// An event at a membrane. The forces are those of the model along the needle, before any safety limit. Only a pop
/// has forces; for other events they are 0.
struct Event {
  EventKind what;
  std::uint32_t membrane;  ///< number of the membrane in the scene, from 0
  std::uint64_t tick;
  double time;          ///< time of the tick, s
  double depth;         ///< m: along the needle while inside, otherwise along the normal
  double force_before;  ///< the largest resistance before the pop, N
  double force_after;   ///< the friction of the shaft alone after the pop, N

  double drop() const noexcept { return force_before - force_after; }  ///< N
};

/// The inputs of an event finder in a tick. A Snapshot contains all of them.
struct EventTick {
  std::uint64_t tick;
  double time;                 ///< s
  std::array<double, 3> axis;  ///< direction of the stylus, used if the record of a membrane has no direction
  std::uint32_t commands;      ///< bits of Command; only command_scene is used
  std::span<const MembraneRecord> membranes;
};

/// Finds the events of a run, in the order of its ticks. A tick allocates no memory. L: the law, as in InsertionOf.
template <ObliqueLaw L>
class EventFinderOf {
 public:
  /// scene must have passed check(). law_of(needle, membrane, i) returns the law of membrane i, as for
  /// build_insertion().
  template <typename LawOf>
  EventFinderOf(const Scene& scene, LawOf&& law_of) : now_(scene, law_of) {}
  explicit EventFinderOf(const Scene& scene)
    requires std::same_as<L, SceneLaw<double>>
      : EventFinderOf(scene, scene_law_of<double>(scene)) {}

  /// Changes the scene, from the next tick with command_scene on. It allocates memory: do not call it in a tick.
  template <typename LawOf>
  void change(const Scene& scene, LawOf&& law_of) {
    next_ = SceneSites(scene, law_of);
    scene_is_pending_ = true;
  }
  void change(const Scene& scene)
    requires std::same_as<L, SceneLaw<double>>
  {
    change(scene, scene_law_of<double>(scene));
  }
  /// Whether a changed scene waits for a tick with command_scene.
  bool waits_for_scene() const noexcept { return scene_is_pending_; }
  /// The scene that waits, or the scene of the last tick.
  const Scene& newest_scene() const noexcept { return scene_is_pending_ ? next_.scene : now_.scene; }

  /// The events of a tick, valid until the next call. They are sorted by membrane.
  std::span<const Event> step(const EventTick& tick) noexcept {
    if (scene_is_pending_ && (tick.commands & command_scene) != 0) take_scene();
    found_ = 0;
    const std::size_t n = std::min({now_.sites.size(), tick.membranes.size(), max_membranes});
    for (std::size_t i = 0; i < n; ++i) {
      const MembraneRecord& record = tick.membranes[i];
      Site& site = now_.sites[i];
      const auto enter = [&] {
        return now_.crossing(site, entry_cosine(site.normal, to_vector(record.direction), to_vector(tick.axis)));
      };
      site.contact.step(record, enter, [&](EventKind what, double before, double after) {
        events_[found_++] = {what, static_cast<std::uint32_t>(i), tick.tick, tick.time, record.depth, before, after};
      });
    }
    return {events_.data(), found_};
  }
  std::span<const Event> step(const Snapshot& s) noexcept {
    return step(EventTick{s.tick, s.sample.time, s.sample.axis, s.commands, {s.membranes.data(), s.membrane_count}});
  }

  /// The scene of the last tick.
  const Scene& scene() const noexcept { return now_.scene; }

  /// For save_state() and load_state() (state/archive.hpp). A changed scene that waits is not in the state.
  static void archive(auto& self, auto& state) {
    for (auto& site : self.now_.sites)
      Contact::archive(site.contact, state, [&](double cos_beta) { return self.now_.crossing(site, cos_beta); });
  }
  void describe(auto& parameters) const {
    for (const Site& site : now_.sites) {
      untouched_pieces(site.law, 1).describe(parameters);
      parameters.fields(site.point, site.normal, site.thickness);
    }
  }

 private:
  struct Site {
    L law;
    Vector3d point, normal;
    double thickness;
    Contact contact{};

    bool same_place(const Site& other) const noexcept { return point == other.point && normal == other.normal; }
  };

  /// A scene with a Site for each membrane.
  struct SceneSites {
    template <typename LawOf>
    SceneSites(const Scene& given, LawOf&& law_of) : scene(given) {
      for (const PlacedMembrane& placed : scene.membranes)
        sites.push_back({law_of(scene.needle, placed.membrane, sites.size()), to_vector(placed.point),
                         to_vector(placed.inward_normal).stableNormalized(), placed.membrane.thickness});
    }

    Crossing crossing(const Site& site, double cos_beta) const noexcept {
      return punctura::crossing(site.law, scene.needle, site.thickness, cos_beta);
    }

    Scene scene;
    std::vector<Site> sites;
  };

  /// Switches to the next scene. A membrane at the same place keeps its contact under the new law, also if its number
  /// differs. Other membranes start without history. ConditionedProxies::resume() does the same.
  void take_scene() noexcept {
    scene_is_pending_ = false;
    std::swap(now_, next_);
    match_by_place(now_.sites, next_.sites, [&](Site& site, const Site& old) {
      site.contact = old.contact;
      site.contact.change_law([&](double cos_beta) { return now_.crossing(site, cos_beta); });
    });
  }

  SceneSites now_;
  SceneSites next_ = now_;
  bool scene_is_pending_ = false;
  std::array<Event, 2 * max_membranes> events_{};  // one tick can have a touch and a pop at a membrane
  std::size_t found_ = 0;
};

using EventFinder = EventFinderOf<SceneLaw<double>>;

}  // namespace punctura
