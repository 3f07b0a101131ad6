#include "runtime/support/haply_fake.hpp"

#include <charconv>

#include "punctura/model/decimal.hpp"
#include "punctura_runtime/backends/haply/websocket.hpp"
#include "punctura_runtime/os/os.hpp"

namespace punctura::test {

namespace {

constexpr double rate = 1600;
std::int64_t soon() { return os::now_ns() + 20'000'000'000; }

/// Reads exactly n bytes. Returns false if the client has closed the connection.
bool read(os::Socket& client, std::string& to, std::size_t n) {
  to.resize(n);
  for (std::size_t at = 0, got = 0; at < n; at += got)
    if (client.receive(to.data() + at, n - at, got, soon()) != os::Io::done) return false;
  return true;
}

unsigned byte(const std::string& text, std::size_t i) { return static_cast<unsigned char>(text[i]); }

/// Reads a client's frame, RFC 6455. Returns 0 if it is not masked or the client has closed the connection.
unsigned read_frame(os::Socket& client, std::string& payload) {
  std::string head, mask;
  if (!read(client, head, 2) || (byte(head, 1) & 0x80) == 0) return 0;
  const unsigned first = byte(head, 0);
  std::size_t size = byte(head, 1) & 0x7f;
  if (size >= 126) {
    if (!read(client, head, size == 126 ? 2 : 8)) return 0;
    size = 0;
    for (std::size_t i = 0; i < head.size(); ++i) size = size << 8 | byte(head, i);
  }
  if (!read(client, mask, 4) || !read(client, payload, size)) return 0;
  for (std::size_t i = 0; i < size; ++i) payload[i] = static_cast<char>(byte(payload, i) ^ byte(mask, i % 4));
  return first;
}

std::string frame(unsigned first, const std::string& payload) {
  std::string out(1, static_cast<char>(first));
  const auto put = [&](std::size_t value, int bytes) {
    while (bytes-- > 0) out += static_cast<char>(value >> (8 * bytes) & 0xff);
  };
  if (payload.size() < 126) {
    put(payload.size(), 1);
  } else if (payload.size() < 65536) {
    put(126, 1);
    put(payload.size(), 2);
  } else {
    put(127, 1);
    put(payload.size(), 8);
  }
  return out + payload;
}

/// Converts to the service's axes (z up, y away from the user). Punctura's axes are its (x, z, -y).
std::string vector_text(const std::array<double, 3>& ours) {
  return R"({"x":)" + decimal_text(ours[0]) + R"(,"y":)" + decimal_text(-ours[2]) + R"(,"z":)" + decimal_text(ours[1]) +
         "}";
}

double after(const std::string& text, const std::string& key, std::size_t from) {
  const std::size_t at = text.find(key, from) + key.size();
  double value = 0;
  std::from_chars(text.data() + at, text.data() + text.size(), value);
  return value;
}

}  // namespace

HaplyFake::HaplyFake(FakeSettings settings)
    : settings_(std::move(settings)),
      plant_({}, {}, 1 / rate, settings_.seed),
      motion_(settings_.strokes, settings_.seed) {
  plant_.place(motion_.at(0).position);
  thread_ = std::thread([this] {
    while (!stop_)
      if (os::Socket client = listener_.accept(os::now_ns() + 5'000'000)) serve(std::move(client));
  });
}

HaplyFake::~HaplyFake() {
  stop_ = true;
  thread_.join();
}

void HaplyFake::begin() { begun_ = true; }

void HaplyFake::happen(Mishap what, std::size_t after) {
  after_ = after;
  mishap_ = what;
}

std::vector<std::array<double, 3>> HaplyFake::forces() {
  const std::lock_guard lock(mutex_);
  return forces_;
}

std::size_t HaplyFake::mishap_at() { return mishap_at_; }

std::vector<std::string> HaplyFake::messages() {
  const std::lock_guard lock(mutex_);
  return messages_;
}

void HaplyFake::serve(os::Socket client) {
  std::string head, next;
  while (head.find("\r\n\r\n") == std::string::npos && read(client, next, 1)) head += next;
  if (head.starts_with("GET /version ")) {
    const std::string body = R"({"version":")" + settings_.version + R"(","build":"1.0"})";
    const std::string text = settings_.version.empty()
                                 ? "HTTP/1.1 404 Not Found\r\n\r\n"
                                 : "HTTP/1.1 200 OK\r\nContent-Type: application/json\r\n\r\n" + body;
    client.send(text.data(), text.size(), soon());
  } else if (head.find("Sec-WebSocket-Key: " + std::string(haply::upgrade_key) + "\r\n") != std::string::npos) {
    const std::string text =
        "HTTP/1.1 101 Switching Protocols\r\nUpgrade: websocket\r\nConnection: Upgrade\r\n"
        "Sec-WebSocket-Accept: " +
        std::string(haply::upgrade_accept) + "\r\n\r\n";
    client.send(text.data(), text.size(), soon());
    speak(client);
  }
}

void HaplyFake::speak(os::Socket& client) {
  {
    const std::lock_guard lock(mutex_);
    messages_.clear();
  }
  left_ = false;
  std::string payload;
  bool on = send(client, settings_.inventory.empty() ? state(true) : settings_.inventory);
  while (on) {
    const unsigned first = read_frame(client, payload);
    if (first == 0x8a) continue;  // a pong
    if (first != 0x81) break;
    on = answer(client, payload);
  }
  // No more messages: the device is idle.
  for (int i = 0; i < 100 && begun_; ++i) pass({0, 0, 0});
  left_ = true;
}

bool HaplyFake::answer(os::Socket& client, const std::string& message) {
  if (on_message) on_message();
  {
    const std::lock_guard lock(mutex_);
    if (messages_.size() < 16) messages_.push_back(message);
  }
  const bool asks = message.find("set_cursor_force") != std::string::npos;
  if (asks && settings_.closes_on_wrong_key && message.find('"' + settings_.takes + '"') == std::string::npos) {
    const std::string bye = frame(0x88,
                                  "\x03\xf0"
                                  "unknown field in set_cursor_force");
    client.send(bye.data(), bye.size(), soon());
    return false;
  }
  const std::array<double, 3> force = wanted(message);
  for (std::size_t i = 0; i < 3; ++i) echo_[i] = settings_.gives * force[i];
  if (begun_ && !first_) pass(force);
  if (begun_) first_ = false;
  if (begun_ && mishap_ != Mishap::none && tick_ >= after_) return mishap(client);
  return send(client, state(false));
}

/// The force of a message in Punctura's axes; empty if the message has no force under the right key.
std::array<double, 3> HaplyFake::wanted(const std::string& message) const {
  const std::size_t at = message.find("{\"" + settings_.takes + "\":{");
  if (at == std::string::npos) return {0, 0, 0};
  return {after(message, "\"x\":", at), after(message, "\"z\":", at), -after(message, "\"y\":", at)};
}

void HaplyFake::pass(const std::array<double, 3>& force) {
  const Desired desired = motion_.at(static_cast<double>(tick_++) * (1 / rate));
  plant_.step({force[0], force[1], force[2]}, desired);
  const std::lock_guard lock(mutex_);
  forces_.push_back(force);
}

std::string HaplyFake::state(bool with_config) const {
  const Mishap now = spoilt_ ? mishap_.load() : Mishap::none;
  std::string text = R"({"session_id":7,"inverse3":[)";
  if (now != Mishap::removed) {
    text += R"({"status":{)" + settings_.status + (now == Mishap::no_power ? R"(,"power_supply":false)" : "") + "},";
    if (with_config)
      text += R"("config":{"type":"inverse3","device_info":{"id":"049D"},"mount":{"scale":{"x":1,"y":1}}},)";
    text +=
        R"("state":{"cursor_velocity":{"x":0,"y":0,"z":0},"mode":"force","current_cursor_force":)" + vector_text(echo_);
    const Vector3d p = plant_.measured();
    if (now != Mishap::no_position) text += R"(,"cursor_position":)" + vector_text({p.x(), p.y(), p.z()});
    text += R"(},"device_id":")" + settings_.id + "\"}";
  }
  text += "]";
  if (settings_.grip && now != Mishap::no_grip)
    text += R"(,"wireless_verse_grip":[{"device_id":"1102","state":{"orientation":{"w":0.5,"x":-0.5,"y":0,"z":0},)"
            R"("buttons":{"a":true,"b":false,"c":true},"hall":16},"status":{"connected":true}}])";
  return text + "}";
}

bool HaplyFake::send(os::Socket& client, const std::string& text) {
  std::string out = frame(0x81, text);
  const Travel how = travel_;
  if (how == Travel::in_fragments) {
    const std::size_t a = text.size() / 3, b = text.size() / 2;
    out = frame(0x01, text.substr(0, a)) + frame(0x89, "x") + frame(0x00, text.substr(a, b - a)) +
          frame(0x80, text.substr(b));
  }
  if (how == Travel::with_pings) out = frame(0x89, "are you there") + frame(0x8a, "") + out + frame(0x89, "");
  const std::size_t piece = how == Travel::byte_by_byte ? 1 : out.size();
  for (std::size_t at = 0; at < out.size(); at += piece)
    if (client.send(out.data() + at, std::min(piece, out.size() - at), soon()) != os::Io::done) return false;
  return true;
}

/// Returns false to end the connection.
bool HaplyFake::mishap(os::Socket& client) {
  if (!spoilt_) mishap_at_ = static_cast<std::size_t>(tick_);
  spoilt_ = true;
  std::string out;
  switch (mishap_.load()) {
    case Mishap::closes: out = frame(0x88, "\x03\xe9going away"); break;
    case Mishap::silent: return true;
    case Mishap::malformed: out = frame(0x81, R"({"inverse3":[{"device_id":049D)"); break;
    case Mishap::oversized: out = frame(0x81, std::string(300'000, ' ')); break;
    case Mishap::masked: out = std::string("\x81\x82\0\0\0\0{}", 8); break;
    case Mishap::cut_off: out = frame(0x81, state(false)).substr(0, 40); break;
    default: return send(client, state(false));
  }
  client.send(out.data(), out.size(), soon());
  return mishap_ == Mishap::malformed || mishap_ == Mishap::oversized || mishap_ == Mishap::masked;
}

}  // namespace punctura::test
