#include "instance.hpp"

#include <cmath>
#include <cstring>
#include <fstream>
#include <iterator>
#include <sstream>

namespace punctura_fmi {

namespace {

/// Finds damaged bytes; no defence against a forger. FNV-1a.
std::uint64_t checksum(const unsigned char* bytes, std::size_t size) noexcept {
  std::uint64_t sum = 14695981039346656037u;
  for (std::size_t i = 0; i < size; ++i) sum = (sum ^ bytes[i]) * 1099511628211u;
  return sum;
}

}  // namespace

void Saved::write(unsigned char* to) const noexcept {
  std::memcpy(to, &run, sizeof run);
  if (!insertion.empty()) std::memcpy(to + sizeof run, insertion.data(), insertion.size());
  const std::size_t before = size() - sizeof(std::uint64_t);
  const std::uint64_t sum = checksum(to, before);
  std::memcpy(to + before, &sum, sizeof sum);
}

std::unique_ptr<Instance> Instance::make(const std::string& resources, std::string& error) {
  auto made = std::make_unique<Instance>();
  std::ifstream file(resources + "/scene.txt", std::ios::binary);
  made->text_.assign(std::istreambuf_iterator<char>(file), {});
  if (!file) {
    error = "cannot read " + resources + "/scene.txt: the FMU is not complete";
    return nullptr;
  }
  if (made->reset()) return made;
  error = made->error_;
  return nullptr;
}

bool Instance::fail(std::string error) {
  error_ = std::move(error);
  return false;
}

bool Instance::reset() {
  punctura_scene* scene = nullptr;
  if (punctura_scene_from_values(text_.data(), text_.size(), &scene) != PUNCTURA_OK) return fail(punctura_last_error());
  scene_.reset(scene);
  insertion_.reset();
  run_ = {};
  parameters_.clear();  // the numbers of scene.txt, in its order
  std::istringstream lines(text_);
  for (std::string path, equals, value; lines >> path >> equals && std::getline(lines >> std::ws, value);)
    if (value.front() != '"') parameters_.push_back(path);
  // The start values of the inputs in the model description: 10 mm in front of the first membrane, pointing at it.
  for (std::size_t k = 0; k < 3; ++k) {
    const std::string index = "[" + std::to_string(k) + "]";
    double point = 0, normal = 0;
    punctura_scene_get(scene, ("membrane[0].point" + index).c_str(), &point);
    punctura_scene_get(scene, ("membrane[0].inward_normal" + index).c_str(), &normal);
    run_.input[k] = point - 0.01 * normal;
    run_.input[3 + k] = normal;
  }
  return true;
}

bool Instance::get(std::uint32_t reference, double& value) const {
  if (reference == time_reference) return value = run_.time, true;
  if (reference < output_reference) return value = run_.input[reference - input_reference], true;
  if (reference < ramp_reference) return value = run_.force[reference - output_reference], true;
  if (reference >= parameter_reference && reference - parameter_reference < parameters_.size())
    return punctura_scene_get(scene_.get(), parameters_[reference - parameter_reference].c_str(), &value) ==
           PUNCTURA_OK;
  const auto membrane = static_cast<std::int32_t>(reference - membrane_reference) / 4;
  if (reference < membrane_reference || membrane >= punctura_scene_membrane_count(scene_.get())) return false;
  punctura_membrane_tick tick;
  std::memset(&tick, 0, sizeof tick);
  tick.struct_size = sizeof tick;
  if (insertion_) punctura_insertion_membrane(insertion_.get(), membrane, &tick);
  switch ((reference - membrane_reference) % 4) {
    case 0: return value = tick.depth, true;
    case 1: return value = tick.axial_force, true;
    case 2: return value = tick.phase, true;
    default: return false;
  }
}

bool Instance::get(std::uint32_t reference, std::int32_t& value) const {
  if (reference == ramp_reference) return value = run_.ramp, true;
  double number = 0;
  const bool is_phase = reference >= membrane_reference && reference < parameter_reference &&
                        (reference - membrane_reference) % 4 == 2 && get(reference, number);
  value = static_cast<std::int32_t>(number);
  return is_phase;
}

bool Instance::set(std::uint32_t reference, double value) {
  if (reference >= input_reference && reference < output_reference)
    return run_.input[reference - input_reference] = value, true;
  if (reference < parameter_reference || reference - parameter_reference >= parameters_.size())
    return fail("value reference " + std::to_string(reference) + " cannot be set");
  const std::string& path = parameters_[reference - parameter_reference];
  if (insertion_) return fail(path + " cannot be set after the initialization");
  return punctura_scene_set(scene_.get(), path.c_str(), value) == PUNCTURA_OK || fail(punctura_last_error());
}

bool Instance::set(std::uint32_t reference, std::int32_t value) {
  if (reference != ramp_reference) return fail("value reference " + std::to_string(reference) + " cannot be set");
  run_.ramp = value != 0;
  return true;
}

bool Instance::set_derivative(std::uint32_t reference, double value) {
  if (reference < input_reference || reference >= output_reference)
    return fail("value reference " + std::to_string(reference) + " is no input");
  run_.derivative[reference - input_reference] = value;
  run_.given = 1;
  return true;
}

bool Instance::begin() {
  punctura_insertion* insertion = nullptr;
  if (punctura_scene_get(scene_.get(), "servo.rate", &rate_) != PUNCTURA_OK ||
      punctura_insertion_new(scene_.get(), &insertion) != PUNCTURA_OK)
    return fail(punctura_last_error());
  insertion_.reset(insertion);
  return true;
}

bool Instance::step(double time, double duration) {
  if (!insertion_) return fail("a step before the end of the initialization");
  if (!(duration >= 0 && std::isfinite(time + duration))) return fail("a step of no finite duration");
  // The ticks lie on the scene's own grid. A step may hold any number of them, also a fraction.
  const double due = std::floor((time + duration - run_.start) * rate_ + 1e-6);
  if (!(due < 9e15)) return fail("the time is too large to count its ticks");
  const std::uint64_t count = due > static_cast<double>(run_.ticks) ? static_cast<std::uint64_t>(due) - run_.ticks : 0;
  if (count > most_ticks)
    return fail("a step of " + std::to_string(count) + " ticks takes too long: make steps of at most " +
                std::to_string(static_cast<double>(most_ticks) / rate_) + " s");
  if (!run_.stepped) run_.previous = run_.input;
  for (std::uint64_t i = 1; i <= count; ++i)
    if (!tick(i, count)) return fail("the position or the axis is not finite, or the axis is 0");
  run_.ticks += count;
  run_.time = time + duration;
  run_.previous = run_.input;
  run_.given = 0;
  run_.derivative = {};
  run_.stepped = 1;
  return true;
}

/// Tick i of the `count` ticks of a step.
bool Instance::tick(std::uint64_t i, std::uint64_t count) {
  std::array<double, 6> now = run_.input;
  const double share = static_cast<double>(i) / static_cast<double>(count);
  for (std::size_t k = 0; k < now.size(); ++k) {
    if (run_.given)
      now[k] += run_.derivative[k] * static_cast<double>(i - 1) / rate_;
    else if (run_.ramp && i < count)  // the last tick has the input itself, with all its bits
      now[k] = run_.previous[k] + (run_.input[k] - run_.previous[k]) * share;
  }
  return punctura_insertion_step(insertion_.get(), now.data(), now.data() + 3, run_.force.data()) == PUNCTURA_OK;
}

std::unique_ptr<Saved> Instance::save() {
  auto saved = std::make_unique<Saved>();
  saved->run = run_;
  if (!insertion_) return saved;
  saved->insertion.resize(punctura_insertion_state_size(insertion_.get()));
  if (punctura_insertion_save(insertion_.get(), saved->insertion.data(), saved->insertion.size()) == PUNCTURA_OK)
    return saved;
  error_ = punctura_last_error();
  return nullptr;
}

bool Instance::restore(const Saved& saved) {
  if (saved.insertion.empty() != !insertion_)
    return fail("the state was saved on the other side of the initialization; call reset first");
  if (insertion_ &&
      punctura_insertion_restore(insertion_.get(), saved.insertion.data(), saved.insertion.size()) != PUNCTURA_OK)
    return fail(punctura_last_error());
  run_ = saved.run;
  return true;
}

std::unique_ptr<Saved> Instance::read(const unsigned char* bytes, std::size_t size) {
  const std::size_t before = sizeof(Run) + (insertion_ ? punctura_insertion_state_size(insertion_.get()) : 0);
  const std::size_t whole = before + sizeof(std::uint64_t);
  if (size != whole) {
    error_ =
        "the serialized state has " + std::to_string(size) + " bytes; this FMU's state has " + std::to_string(whole);
    return nullptr;
  }
  std::uint64_t sum = 0;
  std::memcpy(&sum, bytes + before, sizeof sum);
  if (sum != checksum(bytes, before)) {
    error_ = "the serialized state is damaged";
    return nullptr;
  }
  auto saved = std::make_unique<Saved>();
  std::memcpy(&saved->run, bytes, sizeof(Run));
  saved->insertion.assign(bytes + sizeof(Run), bytes + before);
  return saved;
}

}  // namespace punctura_fmi
