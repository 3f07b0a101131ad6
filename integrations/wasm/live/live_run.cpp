#include "live_run.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "frame.hpp"
#include "scene_json.hpp"

namespace punctura::live {

namespace {

constexpr double turn = 0.5 * std::numbers::pi / 180;  // smaller changes of direction do not update the laws
constexpr double laws_every = 0.1;                     // s

std::vector<double> obliquities(const Scene& scene, const Vector3d& axis, const Snapshot* now) {
  std::vector<double> angles(scene.membranes.size());
  for (std::size_t i = 0; i < angles.size(); ++i) {
    const bool inside = now && i < now->membrane_count && now->membranes[i].phase != Phase::outside;
    const Vector3d entered = inside ? to_vector(now->membranes[i].direction) : Vector3d::Constant(not_given);
    angles[i] = drawn_obliquity(scene, scene.membranes[i], axis, entered);
  }
  return angles;
}

}  // namespace

/// The scene as the simulated device runs it: at its rate, with positions conditioned for its encoders.
Scene LiveRun::fitted(Scene scene, double rate) {
  scene.servo.rate = rate;
  scene.servo.conditioning = Conditioning::line_fit;
  scene.servo.encoder_step = device.encoder_step;
  return scene;
}

std::unique_ptr<LiveRun> LiveRun::make(Scene scene, std::uint32_t number, std::uint64_t seed,
                                       const std::optional<HandPose>& pose, std::vector<Problem>& problems) {
  problems = check(scene);
  if (!problems.empty()) return nullptr;
  const HandPose first = pose.value_or(resting_pose(scene));
  Scene fit = fitted(std::move(scene), scene.servo.rate);
  auto step = try_build<double>(fit, problems, gate, limits);
  if (!step) return nullptr;
  return std::unique_ptr<LiveRun>(new LiveRun(std::move(fit), std::move(*step), number, seed, first));
}

LiveRun::LiveRun(Scene scene, BasicServoStep<double> step, std::uint32_t number, std::uint64_t seed,
                 const HandPose& pose)
    : scene_(std::move(scene)),
      rate_(scene_.servo.rate),
      step_(std::move(step)),
      number_(number),
      pose_(pose),
      target_(pose.position),
      plant_(device, Hand{}, 1 / rate_, seed),
      finder_(scene_),
      angles_(obliquities(scene_, pose.axis, nullptr)) {
  plant_.place(pose.position);
}

void LiveRun::reset() noexcept {
  step_.reset();
  thumb_ = 0;  // the reset fills the syringe
}

void LiveRun::target(const HandPose& pose, std::uint32_t buttons) noexcept {
  strokes_.reset();
  pose_ = pose;
  buttons_ = buttons;
}

void LiveRun::strokes(double period) {
  const auto [start, end] = stroke_ends(scene_);
  constexpr double rest = 0.15;  // share of the period at each end
  constexpr std::size_t some = 100;
  strokes_.emplace(Strokes{start, end, some, (0.5 - rest) * period, rest * period, 0}, 0);
  stroke_period_ = period;
  strokes_began_ = static_cast<double>(ticks_) / rate_;
  pose_.axis = to_vector(scene_.membranes[0].inward_normal).stableNormalized();
}

bool LiveRun::exchange(Scene scene, std::vector<Problem>& problems) {
  Scene fit = fitted(std::move(scene), rate_);
  auto step = try_build<double>(fit, problems, gate, limits);
  if (!step) return false;
  step->resume(step_);
  step_ = std::move(*step);
  scene_ = std::move(fit);
  ++scenes_;
  finder_.change(scene_);
  if (other_) other_.emplace(scene_);
  if (estimator_) estimator_->change(scene_);
  angles_ = obliquities(scene_, pose_.axis, nullptr);
  return true;
}

void LiveRun::compare(bool on) {
  other_.reset();
  if (on) other_.emplace(scene_);
}

void LiveRun::estimate(bool on) {
  estimator_.reset();
  if (on) estimator_.emplace(scene_, 1 / rate_);
}

const std::vector<std::byte>& LiveRun::advance(std::size_t count) {
  block_.clear();
  other_force_.clear();
  for (std::size_t k = 0; k < count; ++k) {
    const double time = static_cast<double>(ticks_) / rate_;
    if (strokes_ && time - strokes_began_ >= strokes_->duration()) strokes(stroke_period_);  // they have no end
    if (strokes_) pose_.position = strokes_->at(time - strokes_began_).position;
    target_.move_to(pose_.position);
    const Desired desired = target_.at(time);
    DeviceSample sample = reading();
    if (std::exchange(trips_, false)) sample.position[0] = not_given;
    plant_.step(tick(sample), desired);
  }
  return frame(count);
}

const std::vector<std::byte>& LiveRun::feed(const Vector3d& position, const Vector3d& axis) {
  block_.clear();
  other_force_.clear();
  DeviceSample sample = reading();
  sample.position = to_array(position);
  sample.axis = to_array(axis);
  tick(sample);
  return frame(1);
}

DeviceSample LiveRun::reading() {
  return {ticks_, static_cast<double>(ticks_) / rate_, to_array(plant_.measured()), to_array(pose_.axis), buttons_,
          true};
}

/// Returns the force for the device.
Vector3d LiveRun::tick(DeviceSample sample) {
  sample.thumb = thumb_depth();
  const Snapshot& snapshot = step_.step(sample);
  ++ticks_;
  watch(snapshot);
  block_.push_back(snapshot);
  if (other_)
    for (const float x : other_->step(snapshot)) other_force_.push_back(x);
  return to_vector(snapshot.force);
}

/// The depth of the simulated thumb on the plunger, m.
double LiveRun::thumb_depth() noexcept {
  if (!step_.syringe()) return 0;
  if (step_.fault() == Fault::none && !std::isnan(wanted_thumb_))
    thumb_ = Thumb{}.step(thumb_, wanted_thumb_, step_.syringe()->plunger.force(), 1 / rate_);
  return thumb_;
}

const std::vector<std::byte>& LiveRun::frame(std::size_t count) {
  frame_.clear();
  if (count == 0) return frame_;
  watch_axis(block_.back());
  if (estimator_ && estimator_->due()) estimator_->write(message());
  write_frame(block_, number_, other_force_, frame_);
  return frame_;
}

void LiveRun::watch(const Snapshot& snapshot) {
  for (const Event& e : finder_.step(snapshot)) {
    constexpr std::array kinds = {"touch", "pop", "out"};
    Json& json = message();
    json.open('{').field("kind", "event").field("what", kinds[static_cast<std::size_t>(e.what)]);
    json.field("membrane", e.membrane).field("name", scene_.membranes[e.membrane].name).field("tick", e.tick);
    json.field("time", e.time).field("depth", e.depth).field("force_before", e.force_before);
    json.field("force_after", e.force_after).field("drop", e.drop()).close('}');
  }
  if (estimator_) estimator_->step(snapshot);
}

void LiveRun::watch_axis(const Snapshot& snapshot) {
  const Vector3d axis = to_vector(snapshot.sample.axis);
  if (!axis.allFinite() || snapshot.sample.time < laws_at_) return;
  const auto angles = obliquities(scene_, axis, &snapshot);
  const auto moved = [](double a, double b) { return std::abs(a - b) > turn; };
  if (std::equal(angles.begin(), angles.end(), angles_.begin(), [&](double a, double b) { return !moved(a, b); }))
    return;
  laws_at_ = snapshot.sample.time + laws_every;
  angles_ = angles;
  Json& json = message();
  json.open('{').field("kind", "laws").key("laws");
  write_laws(json, scene_, angles_);
  json.close('}');
}

Json& LiveRun::message() {
  if (!std::exchange(any_message_, true)) messages_.open('[');
  return messages_;
}

std::string LiveRun::messages() {
  if (!std::exchange(any_message_, false)) return "[]";
  return std::exchange(messages_.close(']'), Json()).text();
}

std::string LiveRun::scene() const {
  Json json;
  write_scene(json, scene_, scenes_, rate_, step_.force_scale(), angles_);
  return json.text();
}

}  // namespace punctura::live
