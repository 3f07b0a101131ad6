#include "instance.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <sstream>

#include "punctura/model/decimal.hpp"

namespace punctura_fmi {

namespace {

/// Finds damaged bytes; no defence against a forger. FNV-1a.
std::uint64_t checksum(const unsigned char* bytes, std::size_t size) noexcept {
  std::uint64_t sum = 14695981039346656037u;
  for (std::size_t i = 0; i < size; ++i) sum = (sum ^ bytes[i]) * 1099511628211u;
  return sum;
}

/// The distance of a double to the next larger one.
double ulp(double x) noexcept {
  return std::nextafter(std::abs(x), std::numeric_limits<double>::infinity()) - std::abs(x);
}

constexpr const char* kinds[] = {"Real (Float64)", "Integer (Int32)", "Boolean"};

}  // namespace

void Saved::write(unsigned char* to) const noexcept {
  auto put = [at = to](const void* from, std::size_t n) mutable {
    if (n > 0) std::memcpy(at, from, n);
    at += n;
  };
  put(&run, sizeof run);
  put(parameters.data(), parameters.size() * sizeof(double));
  put(insertion.data(), insertion.size());
  const std::uint64_t sum = checksum(to, size() - sizeof sum);
  put(&sum, sizeof sum);
}

std::unique_ptr<Instance> Instance::make(const std::string& resources, std::string& error) {
  auto made = std::make_unique<Instance>();
  // FMI gives the folder in UTF-8. On Windows a narrow string would be read in the system's code page.
  const std::string name = resources + "/scene.txt";
  std::ifstream file(std::filesystem::path(std::u8string(name.begin(), name.end())), std::ios::binary);
  made->text_.assign(std::istreambuf_iterator<char>(file), {});
  if (!file) {
    error = "cannot read " + name + ": the FMU is not complete";
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
  run_.scene = checksum(reinterpret_cast<const unsigned char*>(text_.data()), text_.size());
  values_.clear();
  parameters_.clear();  // the numbers of scene.txt, in its order
  std::istringstream lines(text_);
  for (std::string path, equals, value; lines >> path >> equals && std::getline(lines >> std::ws, value);)
    if (value.front() != '"') {
      parameters_.push_back(path);
      punctura_scene_get(scene, path.c_str(), &values_.emplace_back());
    }
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

bool Instance::check(std::uint32_t reference, Kind kind) {
  const auto count = static_cast<std::uint32_t>(punctura_scene_membrane_count(scene_.get()));
  const std::uint32_t of_membranes = reference - membrane_reference;
  const bool membrane = reference >= membrane_reference && of_membranes < 4 * count && of_membranes % 4 < 3;
  const bool parameter = reference >= parameter_reference && reference - parameter_reference < parameters_.size();
  if (!(reference <= ramp_reference || membrane || parameter))
    return fail("this FMU has no variable with the value reference " + std::to_string(reference));
  const Kind right = reference == ramp_reference                       ? Kind::boolean
                     : membrane && !parameter && of_membranes % 4 == 2 ? Kind::integer
                                                                       : Kind::real;
  return kind == right || fail("the variable with the value reference " + std::to_string(reference) + " is a " +
                               kinds[static_cast<int>(right)] + ", not a " + kinds[static_cast<int>(kind)]);
}

bool Instance::get(std::uint32_t reference, Kind kind, double& value) {
  if (!check(reference, kind)) return false;
  if (reference == time_reference) return value = run_.time, true;
  if (reference < output_reference) return value = run_.input[reference - input_reference], true;
  if (reference < ramp_reference) return value = run_.force[reference - output_reference], true;
  if (reference == ramp_reference) return value = run_.ramp, true;
  if (reference >= parameter_reference) return value = values_[reference - parameter_reference], true;
  punctura_membrane_tick tick;
  std::memset(&tick, 0, sizeof tick);
  tick.struct_size = sizeof tick;
  const std::uint32_t of_membranes = reference - membrane_reference;
  if (insertion_) punctura_insertion_membrane(insertion_.get(), static_cast<std::int32_t>(of_membranes / 4), &tick);
  const double values[] = {tick.depth, tick.axial_force, static_cast<double>(tick.phase)};
  return value = values[of_membranes % 4], true;
}

bool Instance::settable(std::uint32_t reference, Kind kind) {
  if (!check(reference, kind)) return false;
  if (reference >= input_reference && reference < output_reference) return true;
  const bool parameter = reference >= parameter_reference;
  if (!parameter && reference != ramp_reference)
    return fail("the variable with the value reference " + std::to_string(reference) + " is no input and no parameter");
  return run_.state != State::running || fail((parameter ? parameters_[reference - parameter_reference] : "ramp") +
                                              " cannot be set after the initialization");
}

void Instance::set(std::uint32_t reference, double value) {
  if (reference < output_reference) {
    run_.input[reference - input_reference] = value;
  } else if (reference == ramp_reference) {
    run_.ramp = value != 0;
  } else {
    punctura_scene_set(scene_.get(), parameters_[reference - parameter_reference].c_str(), value);
    values_[reference - parameter_reference] = value;
  }
}

bool Instance::derivable(std::uint32_t reference, int order, double value) {
  if (reference < input_reference || reference >= output_reference)
    return fail("value reference " + std::to_string(reference) + " is no input");
  return (order == 1 && std::isfinite(value)) ||
         fail("only first derivatives are possible, and they must be finite numbers");
}

void Instance::set_derivative(std::uint32_t reference, double value) {
  run_.derivative[reference - input_reference] = value;
  run_.given = 1;
}

bool Instance::set_times(double start, double stop) {
  if (!std::isfinite(start) || !(stop >= start))
    return fail("the start must be a finite time and the stop must not be before it, not " +
                punctura::decimal_text(start) + " s and " + punctura::decimal_text(stop) + " s");
  run_.time = start;
  run_.stop = stop;
  return true;
}

bool Instance::build(const punctura_scene* scene, Insertion& insertion) {
  punctura_insertion* made = nullptr;
  if (punctura_insertion_new(scene, &made) != PUNCTURA_OK) return fail(punctura_last_error());
  insertion.reset(made);
  return true;
}

bool Instance::begin() {
  punctura_scene_get(scene_.get(), "servo.rate", &rate_);
  return build(scene_.get(), insertion_);
}

/// The ticks that are due at `end`, counted in the sum of all steps and not in absolute times: at 1.8e9 s doubles are
/// 0.24 us apart, so that a simulator that adds its step loses one tick in 14,000 at 1 kHz.
///
/// The tolerance, in ticks, is for what a simulator cannot avoid. A step of T differs from 1 / rate by 2^-53 of it, and
/// so does each of the two products and sums here: 2^-51 of all ticks. A step that is the difference of two times is
/// wrong by at most an ulp of the times, which does not add up. A millionth of a tick is for steps that were typed.
bool Instance::count_ticks(double time, double duration, Run& after, std::uint64_t& count) {
  const auto text = [](double number) { return punctura::decimal_text(number) + " s"; };
  const double end = time + duration, close = 1e-3 / rate_ + 4 * ulp(end);
  if (!(duration >= 0 && std::isfinite(end))) return fail("a step must have a finite duration of 0 or more");
  if (!(std::abs(time - run_.time) <= close))
    return fail("a step begins at " + text(time) + ", but the last one ended at " + text(run_.time));
  if (!(end <= run_.stop + close))
    return fail("a step to " + text(end) + " is beyond the end of the experiment, " + text(run_.stop));
  const auto [less, more] = std::minmax(run_.elapsed, duration);
  after.elapsed = more + less;
  after.rest += less - (after.elapsed - more);  // exact, because `more` is the larger one
  after.time = end;
  const double ticks = (after.elapsed + after.rest) * rate_;
  const double tolerance = 1e-6 + std::ldexp(ticks, -51) + rate_ * ulp(end);
  if (!(tolerance < 0.5)) return fail("the time is too large to count its ticks");
  const double due = std::floor(ticks + tolerance);
  count = due > static_cast<double>(run_.ticks) ? static_cast<std::uint64_t>(due) - run_.ticks : 0;
  if (count > most_ticks)
    return fail("a step of " + std::to_string(count) + " ticks takes too long: make steps of at most " +
                text(static_cast<double>(most_ticks) / rate_));
  after.ticks += count;
  return true;
}

bool Instance::step(double time, double duration) {
  Run after = run_;
  std::uint64_t count = 0;
  if (!count_ticks(time, duration, after, count)) return false;
  if (!run_.stepped) run_.previous = run_.input;
  // A tick may fail after others, for example where the axis turns through 0.
  const auto before = count > 1 ? bytes() : std::vector<unsigned char>();
  // A step without a tick looks at its inputs, too: the next step begins with them.
  bool good = count > 0 || punctura_insertion_peek(insertion_.get(), run_.input.data(), run_.input.data() + 3,
                                                   std::array<double, 3>().data()) == PUNCTURA_OK;
  for (std::uint64_t i = 1; good && i <= count; ++i) good = tick(i, count, after.force);
  if (!good) {
    if (!before.empty()) punctura_insertion_restore(insertion_.get(), before.data(), before.size());
    return fail("the position or the axis is not finite, or the axis is 0");
  }
  run_ = after;
  run_.previous = run_.input;
  run_.given = 0;
  run_.derivative = {};
  run_.stepped = 1;
  return true;
}

/// Tick i of the `count` ticks of a step.
bool Instance::tick(std::uint64_t i, std::uint64_t count, std::array<double, 3>& force) {
  std::array<double, 6> now = run_.input;
  const double share = static_cast<double>(i) / static_cast<double>(count);
  for (std::size_t k = 0; k < now.size(); ++k) {
    if (run_.given)
      now[k] += run_.derivative[k] * static_cast<double>(i - 1) / rate_;
    else if (run_.ramp && i < count)  // the last tick has the input itself, with all its bits
      now[k] = run_.previous[k] + (run_.input[k] - run_.previous[k]) * share;
  }
  return punctura_insertion_step(insertion_.get(), now.data(), now.data() + 3, force.data()) == PUNCTURA_OK;
}

std::vector<unsigned char> Instance::bytes() const {
  std::vector<unsigned char> all(punctura_insertion_state_size(insertion_.get()));
  if (insertion_) punctura_insertion_save(insertion_.get(), all.data(), all.size());
  return all;
}

std::unique_ptr<Saved> Instance::save() const { return std::make_unique<Saved>(Saved{run_, values_, bytes()}); }

bool Instance::restore(const Saved& saved) {
  if (saved.run.scene != run_.scene) return fail("the state is of another scene");
  Scene scene;
  Insertion insertion;
  const bool same = insertion_ && saved.parameters == values_;
  if (!same || saved.insertion.empty()) {
    punctura_scene* copy = nullptr;
    if (punctura_scene_copy(scene_.get(), &copy) != PUNCTURA_OK) return fail(punctura_last_error());
    scene.reset(copy);
    for (std::size_t i = 0; i < parameters_.size(); ++i)
      punctura_scene_set(copy, parameters_[i].c_str(), saved.parameters[i]);
    if (!saved.insertion.empty() && !build(copy, insertion)) return false;
  }
  punctura_insertion* const into = insertion ? insertion.get() : insertion_.get();
  if (!saved.insertion.empty() &&
      punctura_insertion_restore(into, saved.insertion.data(), saved.insertion.size()) != PUNCTURA_OK)
    return fail(punctura_last_error());
  if (scene) {
    scene_ = std::move(scene);
    insertion_ = std::move(insertion);
    values_ = saved.parameters;
    punctura_scene_get(scene_.get(), "servo.rate", &rate_);
  }
  run_ = saved.run;
  return true;
}

std::unique_ptr<Saved> Instance::read(const unsigned char* bytes, std::size_t size) {
  auto saved = std::make_unique<Saved>();
  saved->parameters.resize(parameters_.size());
  std::uint64_t sum = 0;
  const bool whole = size >= saved->size();
  if (whole) std::memcpy(&sum, bytes + size - sizeof sum, sizeof sum);
  if (!whole || sum != checksum(bytes, size - sizeof sum)) {
    error_ = "the serialized state is damaged, or it is of another FMU";
    return nullptr;
  }
  const std::size_t numbers = parameters_.size() * sizeof(double);
  std::memcpy(&saved->run, bytes, sizeof(Run));
  std::memcpy(saved->parameters.data(), bytes + sizeof(Run), numbers);
  saved->insertion.assign(bytes + sizeof(Run) + numbers, bytes + size - sizeof sum);
  return saved;
}

}  // namespace punctura_fmi
