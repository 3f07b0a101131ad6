// The live estimate of a run, as messages for the page. It is the C++ of python/punctura/studio/followers.py.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "json.hpp"
#include "punctura/lab/trace/live_estimate.hpp"
#include "punctura/scene/scene.hpp"
#include "punctura/servo/snapshot.hpp"

namespace punctura::live {

/// Depth is along the first membrane's normal, the force is the model's along the needle.
class Estimator {
 public:
  Estimator(const Scene& scene, double period) : period_(period) { change(scene); }

  void change(const Scene& scene) {
    normal_ = to_vector(scene.membranes[0].inward_normal).stableNormalized();
    point_ = to_vector(scene.membranes[0].point);
  }

  void step(const Snapshot& s) {
    const double depth = (to_vector(s.tip) - point_).dot(normal_);
    if (live_.step(depth, -to_vector(s.model_force).dot(to_vector(s.sample.axis)), period_).punctured)
      found_.push_back({static_cast<double>(s.tick), depth});
    now_ = s.sample.time;
  }

  /// Whether a message is due: four times a second, and after a puncture.
  bool due() const noexcept { return !found_.empty() || !(now_ >= reported_ && now_ - reported_ < 0.25); }

  void write(Json& json) {
    const LiveReading& r = live_.reading();
    constexpr std::array phases = {"free", "rise", "behind"};
    json.open('{').field("kind", "estimate").field("on", true);
    json.field("phase", phases[static_cast<std::size_t>(r.phase)]);
    write_value(json, "slope", r.slope);
    write_value(json, "plateau", r.plateau);
    json.field("punctures", r.punctures).field("drop", r.drop).field("ignored", live_.ignored());
    json.key("found").open('[');
    for (const auto& [tick, depth] : found_) json.open('{').field("tick", tick).field("depth", depth).close('}');
    json.close(']').close('}');
    reported_ = now_;
    found_.clear();
  }

 private:
  static void write_value(Json& json, const char* name, const LiveValue& v) {
    constexpr double interval = 1.96;  // standard deviations on either side of a 95 % interval
    json.key(name);
    if (std::isnan(v.value))
      json.null();
    else
      json.open('{').field("value", v.value).field("half", interval * v.error).close('}');
  }

  double period_;
  LiveEstimate live_;
  Vector3d normal_, point_;
  struct Found {
    double tick, depth;
  };
  std::vector<Found> found_;
  double now_ = 0, reported_ = std::numeric_limits<double>::infinity();  // no message yet
};

}  // namespace punctura::live
