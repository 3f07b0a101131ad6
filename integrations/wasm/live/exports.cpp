// LiveRun for JavaScript: the functions that punctura.mjs calls beside those of punctura.h.
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "common.hpp"
#include "live_run.hpp"

using punctura::HandPose;
using punctura::Vector3d;
using punctura::live::LiveRun;

namespace punctura::live {
std::string tables_of(std::string_view text);
}

namespace {

std::string kept;  // the last text that a function returned

const char* keep(std::string text) {
  kept = std::move(text);
  return kept.c_str();
}

HandPose pose_of(const double six[6]) { return {Vector3d(six), Vector3d(six + 3).stableNormalized()}; }

/// The place of the last frame and its size in bytes.
const std::byte* give(const std::vector<std::byte>& frame, uint32_t* size) {
  *size = static_cast<uint32_t>(frame.size());
  return frame.data();
}

}  // namespace

extern "C" {

/// pose: position, m, and axis; NULL for the scene's resting pose. NULL with the problems if the scene has some.
LiveRun* live_new(const punctura_scene* scene, uint32_t number, double seed, const double* pose) {
  std::vector<punctura::Problem> problems;
  const std::optional<HandPose> first = pose ? std::optional(pose_of(pose)) : std::nullopt;
  auto made = LiveRun::make(scene->scene, number, static_cast<uint64_t>(seed), first, problems);
  if (!made) punctura::c::fail(std::move(problems));
  return made.release();
}
void live_free(LiveRun* run) { delete run; }
/// The motors do not cool because a new run begins.
void live_go_on_from(LiveRun* run, const LiveRun* before) { run->go_on_from(*before); }
int32_t live_exchange(LiveRun* run, const punctura_scene* scene) {
  std::vector<punctura::Problem> problems;
  if (run->exchange(scene->scene, problems)) return PUNCTURA_OK;
  return punctura::c::fail(std::move(problems));
}

void live_arm(LiveRun* run) { run->arm(); }
void live_pause(LiveRun* run) { run->pause(); }
void live_reset(LiveRun* run) { run->reset(); }
void live_trip(LiveRun* run) { run->trip(); }
void live_target(LiveRun* run, const double* pose, uint32_t buttons) { run->target(pose_of(pose), buttons); }
void live_strokes(LiveRun* run, double period) { run->strokes(period); }
int32_t live_strokes_now(const LiveRun* run) { return run->strokes_now() ? 1 : 0; }
void live_push_plunger(LiveRun* run, double force) { run->push_plunger(force); }
void live_compare(LiveRun* run, int32_t on) { run->compare(on != 0); }
void live_estimate(LiveRun* run, int32_t on) { run->estimate(on != 0); }

const std::byte* live_advance(LiveRun* run, uint32_t count, uint32_t* size) { return give(run->advance(count), size); }
const std::byte* live_feed(LiveRun* run, const double* six, uint32_t* size) {
  return give(run->feed(Vector3d(six), Vector3d(six + 3)), size);
}

double live_rate(const LiveRun* run) { return run->rate(); }
void live_pose(const LiveRun* run, double* six) {
  for (std::size_t k = 0; k < 3; ++k) {
    six[k] = run->pose().position[k];
    six[k + 3] = run->pose().axis[k];
  }
}
const char* live_messages(LiveRun* run) { return keep(run->messages()); }
const char* live_scene(const LiveRun* run) { return keep(run->scene()); }
/// The limits of every run, and the simulated device, for the page: hello in python/punctura/studio/wire/messages.py.
const char* live_about() {
  punctura::live::Json json;
  const auto& force = LiveRun::limits;
  const auto& gate = LiveRun::gate;
  json.open('{').key("device").open('{').field("backend", "simulated").field("model", "PHANTOM Omni, simulated");
  json.field("simulated", true).field("has_orientation", true).field("max_force", force.max_force);
  json.field("rate", punctura::usual_rate).close('}').key("limits").open('{');
  json.field("max_force", force.max_force).field("continuous_force", force.continuous_force);
  json.field("continuous_time", force.continuous_time).field("ramp_time", force.ramp_time);
  json.field("warm_motor", force.warm_motor).field("max_speed", gate.max_speed).field("stale", gate.stale);
  json.field("deadline", gate.deadline).field("axis_tolerance", gate.axis_tolerance);
  json.key("dead_man_buttons").open('[').close(']').close('}').close('}');
  return keep(json.text());
}
/// The tables of a TOML text, as JSON; "" if it is not TOML.
const char* live_tables(const char* text, size_t size) { return keep(punctura::live::tables_of({text, size})); }
}
