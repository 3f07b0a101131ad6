// Touch, pop and out at the membranes of a scene, tick by tick (docs/events.md).
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "punctura/events/contact.hpp"
#include "punctura/scene/build.hpp"

namespace punctura {

/// SI. Forces are the model's own, along the needle, before any safety limit. They are 0 but for a pop.
struct Event {
  EventKind what;
  std::uint32_t membrane;  ///< its place in the scene, from 0
  std::uint64_t tick;
  double time;          ///< s, of the tick
  double depth;         ///< m: along the needle while inside, else along the normal
  double force_before;  ///< N, the largest resistance on the way to the pop
  double force_after;   ///< N, the resistance of the shaft alone once the tip is through

  double drop() const noexcept { return force_before - force_after; }
};

/// What an event finder reads of a tick: a Snapshot has it all.
struct EventTick {
  std::uint64_t tick;
  double time;                 ///< s
  std::array<double, 3> axis;  ///< of the stylus; read where a membrane has no direction
  std::uint32_t commands;      ///< bits of Command; command_scene is read
  std::span<const MembraneRecord> membranes;
};

/// Gives the events of a run in the order of its ticks. A tick takes no memory. L: the membranes' law, as in InsertionOf.
template <ObliqueLaw L>
class EventFinderOf {
 public:
  /// scene: one that has passed check(). law_of(needle, membrane, i): the law of membrane i, as build_insertion() takes it.
  template <typename LawOf>
  EventFinderOf(const Scene& scene, LawOf&& law_of) : now_(scene, law_of) {}
  explicit EventFinderOf(const Scene& scene) : EventFinderOf(scene, detail::k06_law<double>) {}

  /// The run goes on in another scene from the next tick that has command_scene. Takes memory: not for a tick.
  template <typename LawOf>
  void change(const Scene& scene, LawOf&& law_of) {
    next_ = Laid(scene, law_of);
    waits_ = true;
  }
  void change(const Scene& scene) { change(scene, detail::k06_law<double>); }
  bool waits_for_scene() const noexcept { return waits_; }

  /// The events of a tick, valid until the next call. Those of one membrane follow one another.
  std::span<const Event> step(const EventTick& tick) noexcept {
    if (waits_ && (tick.commands & command_scene) != 0) take_scene();
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

 private:
  struct Site {
    L law;
    Vector3d point, normal;
    double thickness;
    Contact contact{};

    bool same_place(const Site& other) const noexcept { return point == other.point && normal == other.normal; }
  };

  /// A scene, with a contact at each membrane.
  struct Laid {
    template <typename LawOf>
    Laid(const Scene& given, LawOf&& law_of) : scene(given) {
      for (const PlacedMembrane& placed : scene.membranes)
        sites.push_back({law_of(scene.needle, placed.membrane, sites.size()), to_vector(placed.point),
                         to_vector(placed.inward_normal).stableNormalized(), placed.membrane.thickness});
    }

    Crossing crossing(const Site& site, double cos_beta) const noexcept {
      return punctura::crossing(site.law, scene.needle, site.thickness, cos_beta);
    }

    /// How many sites before the i-th are in its place.
    std::size_t same_before(std::size_t i) const noexcept {
      const auto first = sites.begin();
      return static_cast<std::size_t>(std::count_if(first, first + static_cast<std::ptrdiff_t>(i),
                                                    [&](const Site& other) { return other.same_place(sites[i]); }));
    }

    Scene scene;
    std::vector<Site> sites;
  };

  /// Membranes in the same place go on under their new law, whatever their number; others begin anew. As in InsertionOf::resume().
  void take_scene() noexcept {
    waits_ = false;
    std::swap(now_, next_);
    for (std::size_t i = 0; i < now_.sites.size(); ++i) {
      Site& site = now_.sites[i];
      std::size_t before = now_.same_before(i);
      for (const Site& old : next_.sites)
        if (site.same_place(old) && before-- == 0) {
          site.contact = old.contact;
          site.contact.change_law([&](double cos_beta) { return now_.crossing(site, cos_beta); });
          break;
        }
    }
  }

  Laid now_;
  Laid next_ = now_;
  bool waits_ = false;
  std::array<Event, 2 * max_membranes> events_{};  // a membrane may be touched and popped in one tick
  std::size_t found_ = 0;
};

/// With K06's law.
using EventFinder = EventFinderOf<ThickLaw>;

}  // namespace punctura
