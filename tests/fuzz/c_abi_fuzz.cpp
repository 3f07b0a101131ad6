// The C ABI under libFuzzer: the bytes are the text of a scene, and then calls with odd arguments. tools/fuzz.sh.
#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <iterator>
#include <string>
#include <vector>

#include "punctura.h"
#include "punctura/scene/name.hpp"

namespace {

/// The rest of the input; 0 after its end.
class Input {
 public:
  Input(const std::uint8_t* data, std::size_t size) : at_(data), end_(data + size) {}

  bool empty() const { return at_ == end_; }
  std::uint8_t byte() { return empty() ? 0 : *at_++; }
  std::string text() {
    const auto* const end = std::find(at_, end_, 0);
    const std::string found(at_, end);
    at_ = end == end_ ? end : end + 1;
    return found;
  }
  double number() {
    constexpr double odd[] = {0, -0.0, 1e-3, -1e-3, 5e-3, 1, -1, 1000, 1e6, 1e-300, 5e-324, 1e300, NAN, INFINITY};
    const unsigned kind = byte();
    if (kind < std::size(odd)) return odd[kind];
    if (kind < 200) return (byte() * 256 + byte() - 32768) * 1e-6;  // places within 33 mm
    std::uint64_t bits = 0;
    for (int i = 0; i < 8; ++i) bits = bits << 8 | byte();
    return std::bit_cast<double>(bits);
  }
  std::size_t size(std::size_t right) {
    const std::size_t sizes[] = {0, 1, 8, right / 2, right - 1, right + 1, right + 64, SIZE_MAX};
    const unsigned kind = byte();
    return kind < std::size(sizes) ? sizes[kind] : right;
  }

 private:
  const std::uint8_t *at_, *end_;
};

void demand(bool good) {
  if (!good) std::abort();
}
/// A call outside a tick has failed: there is a text, and it is fit for a log.
punctura_status checked(punctura_status status) {
  std::string text = punctura_last_error();
  std::erase(text, '\n');
  if (status != PUNCTURA_OK && status != PUNCTURA_NO_PEEK) demand(!text.empty() && punctura::is_plain_text(text));
  for (int i = -1; i <= punctura_problem_count(); ++i) {
    const char *path = nullptr, *reason = nullptr;
    double value = 0;
    demand((punctura_problem(i, &path, &value, &reason) == PUNCTURA_OK) == (i >= 0 && i < punctura_problem_count()));
  }
  return status;
}
/// A tick gives a force exactly if its status is good.
void check_force(punctura_status status, const double force[3]) {
  for (int i = 0; i < 3; ++i) demand(std::isfinite(force[i]) == (status == PUNCTURA_OK));
}

template <typename Object, auto make, auto free, auto save, auto restore, auto size>
struct Handle {
  Object* object = nullptr;
  ~Handle() { free(object); }
  template <typename... Rest>
  void renew(const punctura_scene* scene, Rest... rest) {
    Object* made = nullptr;
    if (checked(make(scene, rest..., &made)) != PUNCTURA_OK) return demand(made == nullptr);
    free(std::exchange(object, made));
  }
  void again(Input& input) {
    std::vector<unsigned char> state(size(object) + 8);
    checked(save(object, state.data(), input.byte() % 8 == 0 ? size(object) / 2 : size(object)));
    if (input.byte() % 2 == 0 && size(object) > 0)
      state[(input.byte() * 256u + input.byte()) % size(object)] ^= input.byte();
    checked(restore(object, state.data(), input.byte() % 8 == 0 ? size(object) + 1 : size(object)));
  }
};
#define HANDLE(name)                                                                             \
  Handle<punctura_##name, punctura_##name##_new, punctura_##name##_free, punctura_##name##_save, \
         punctura_##name##_restore, punctura_##name##_state_size>

struct Objects {
  punctura_scene* scene = nullptr;
  HANDLE(insertion) insertion;
  HANDLE(proxy1d) line;
  HANDLE(proxy3d) space;
  HANDLE(servo) servo;
  std::uint64_t ticks = 0;
  ~Objects() { punctura_scene_free(scene); }
};

void change_scene(Objects& all, Input& input) {
  constexpr const char* words[] = {"name",
                                   "needle.direction",
                                   "servo.solver",
                                   "servo.conditioning",
                                   "display.force_scale",
                                   "membrane[0].name",
                                   "membrane[1].look",
                                   "membrane[0].grip"};
  constexpr const char* lists[] = {"coupling.relaxation", "membrane[0].grip_table", "membrane[0].profile",
                                   "membrane[9]"};
  punctura_field field = {};
  field.struct_size = input.size(sizeof field);
  switch (input.byte() % 7) {
    case 0: {
      const int count = punctura_scene_field_count(all.scene);
      if (checked(punctura_scene_field(all.scene, input.byte() % (count + 1), &field)) == PUNCTURA_OK)
        checked(punctura_scene_set(all.scene, field.path, input.number()));
      break;
    }
    case 1: punctura_scene_set_word(all.scene, words[input.byte() % std::size(words)], input.text().c_str()); break;
    case 2: checked(punctura_scene_make_rows(all.scene, lists[input.byte() % std::size(lists)], input.byte())); break;
    case 3: checked(punctura_scene_add_syringe(all.scene)); break;
    case 4: {
      punctura_membrane membrane;
      if (punctura_membrane_init(&membrane, sizeof membrane) != PUNCTURA_OK) break;
      membrane.struct_size = input.size(sizeof membrane);
      for (double* v : {&membrane.stiffness, &membrane.precompression, &membrane.friction, &membrane.thickness})
        *v = std::abs(input.number());
      for (int i = 0; i < 3; ++i) membrane.point[i] = input.number(), membrane.inward_normal[i] = -i % 2;
      checked(punctura_scene_add_membrane(all.scene, &membrane));
      break;
    }
    case 5: demand(punctura_scene_unusual(all.scene) != nullptr); break;
    default: checked(punctura_scene_check(all.scene));
  }
}

void tick(Objects& all, Input& input) {
  double places[12], axis[3] = {0, -1, 0}, force[12];
  for (int i = 0; i < 12; ++i) places[i] = input.number();
  if (input.byte() % 8 == 0) axis[input.byte() % 3] = input.number();
  const int membrane = input.byte() % 4 - 1;
  punctura_membrane_tick about;
  about.struct_size = input.size(sizeof about);
  auto* const insertion = all.insertion.object;
  switch (input.byte() % 8) {
    case 0: check_force(punctura_insertion_step(insertion, places, axis, force), force); break;
    case 1: check_force(punctura_insertion_peek(insertion, places, axis, force), force); break;
    case 2: punctura_insertion_commit(insertion); break;
    case 3: punctura_insertion_run(insertion, 4, places, axis, input.byte() % 2, force); break;
    case 4: punctura_insertion_membrane(insertion, membrane, &about); break;
    case 5: check_force(punctura_proxy3d_step(all.space.object, places, axis, force), force); break;
    case 6: punctura_proxy1d_step(all.line.object, places[0]); break;
    default: punctura_proxy1d_membrane(all.line.object, &about);
  }
}

void servo_tick(Objects& all, Input& input) {
  auto* const servo = all.servo.object;
  punctura_sample sample;
  punctura_sample_init(&sample, sizeof sample);
  punctura_record record = {};
  record.force[1] = record.thumb_force = 7;
  sample.sequence = ++all.ticks + input.byte() % 2;
  sample.time = static_cast<double>(all.ticks) / 1000 + (input.byte() == 0 ? input.number() : 0);
  for (double& p : sample.position) p = input.number();
  sample.thumb = input.byte() % 4 == 0 ? input.number() : 0;
  sample.motor_temperature = input.byte() % 8 == 0 ? input.number() : 0;
  sample.struct_size = std::min(input.size(sizeof sample), sizeof sample);
  record.struct_size = std::min(input.size(sizeof record), sizeof record);
  const unsigned kind = input.byte() % 8;
  if (kind == 0) punctura_servo_arm(servo);
  if (kind == 1) punctura_servo_reset(servo);
  if (kind == 2) punctura_servo_commit(servo);
  const auto call = kind == 3 ? punctura_servo_peek : punctura_servo_step;
  const punctura_status status = call(servo, &sample, &record);
  for (const double f : {record.force[0], record.force[1], record.force[2], record.thumb_force}) {
    demand(std::isfinite(f));
    demand(f == 0 || (status == PUNCTURA_OK && record.state == PUNCTURA_ACTIVE));
  }
  demand(std::hypot(record.force[0], record.force[1], record.force[2]) <= 3.3 * (1 + 1e-12));  // the default limit
  demand(punctura_fault_text(record.fault) != nullptr);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  Input input(data, size);
  Objects all;
  const bool lines = input.byte() % 2 == 1;
  const std::string text = input.text();
  const auto read = lines ? punctura_scene_from_values : punctura_scene_from_toml;
  if (checked(read(text.data(), text.size(), &all.scene)) != PUNCTURA_OK) return demand(all.scene == nullptr), 0;
  all.insertion.renew(all.scene);
  all.servo.renew(all.scene, static_cast<const punctura_limits*>(nullptr));
  punctura_servo_arm(all.servo.object);
  for (int calls = 0; !input.empty() && calls < 400; ++calls) switch (input.byte() % 8) {
      case 0: change_scene(all, input); break;
      case 1: all.insertion.renew(all.scene); break;
      case 2: all.servo.renew(all.scene, static_cast<const punctura_limits*>(nullptr)); break;
      case 3: all.line.renew(all.scene, input.byte() % 4 - 1); break;
      case 4: all.space.renew(all.scene, input.byte() % 4 - 1); break;
      case 5: input.byte() % 2 ? all.insertion.again(input) : all.servo.again(input); break;
      case 6: tick(all, input); break;
      default: servo_tick(all, input);
    }
  return 0;
}
