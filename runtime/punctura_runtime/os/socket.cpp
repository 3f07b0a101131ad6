// The sockets of Windows and of POSIX differ in names, types and error numbers. Those stand in the first half of this
// file.
#ifdef _WIN32
#ifndef NOMINMAX
#define NOMINMAX
#endif
#define WIN32_LEAN_AND_MEAN
#include <winsock2.h>
#include <ws2tcpip.h>
#else
#include <fcntl.h>
#include <netdb.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#endif

#include <algorithm>
#include <utility>

#include "punctura_runtime/os/os.hpp"
#include "punctura_runtime/os/socket.hpp"

namespace punctura::os {

namespace {

#ifdef _WIN32

using Number = SOCKET;
using Length = int;
constexpr int timed_out = WSAETIMEDOUT, send_flags = 0;

int last_error() noexcept { return WSAGetLastError(); }
bool is_busy(int error) noexcept { return error == WSAEWOULDBLOCK; }
bool is_gone(int error) noexcept { return error == WSAECONNRESET || error == WSAECONNABORTED; }
bool is_interrupted(int) noexcept { return false; }
std::string words(int error) { return windows_words(static_cast<unsigned long>(error)); }
std::string lookup_words(int code) { return words(code); }
int poll_one(pollfd& entry, int ms) noexcept { return WSAPoll(&entry, 1, ms); }
void close_number(Number number) noexcept { closesocket(number); }

void prepare(Number number) noexcept {
  u_long on = 1;
  ioctlsocket(number, static_cast<long>(FIONBIO), &on);
}

#else

using Number = int;
using Length = std::size_t;
#ifdef MSG_NOSIGNAL
constexpr int send_flags = MSG_NOSIGNAL;
#else
constexpr int send_flags = 0;  // macOS has an option of the socket for it: see prepare()
#endif
constexpr int timed_out = ETIMEDOUT;

int last_error() noexcept { return errno; }
bool is_busy(int error) noexcept { return error == EAGAIN || error == EWOULDBLOCK || error == EINPROGRESS; }
bool is_gone(int error) noexcept { return error == EPIPE || error == ECONNRESET; }
bool is_interrupted(int error) noexcept { return error == EINTR; }
std::string words(int error) { return std::strerror(error); }
std::string lookup_words(int code) { return gai_strerror(code); }
int poll_one(pollfd& entry, int ms) noexcept { return ::poll(&entry, 1, ms); }
void close_number(Number number) noexcept { ::close(number); }

void prepare(Number number) noexcept {
  fcntl(number, F_SETFL, fcntl(number, F_GETFL, 0) | O_NONBLOCK);
  fcntl(number, F_SETFD, FD_CLOEXEC);
#ifdef SO_NOSIGPIPE
  const int on = 1;
  setsockopt(number, SOL_SOCKET, SO_NOSIGPIPE, &on, sizeof on);
#endif
}

#endif

Number number_of(Socket::Handle handle) noexcept { return static_cast<Number>(handle); }

/// Waits until the socket is ready for `events` or has failed: then the call that follows says what is wrong. False at
/// the deadline.
bool ready(Number number, short events, std::int64_t deadline) noexcept {
  for (;;) {
    const std::int64_t left = std::max<std::int64_t>(0, deadline - now_ns());
    // Rounded up: to wake a moment late costs less than to poll again and again within the last millisecond.
    const int ms = static_cast<int>(std::min<std::int64_t>((left + 999'999) / 1'000'000, 3'600'000));
    pollfd entry{};
    entry.fd = number;
    entry.events = events;
    const int n = poll_one(entry, ms);
    if (n > 0 || (n < 0 && !is_interrupted(last_error()))) return true;
    if (n == 0 && now_ns() >= deadline) return false;
  }
}

/// 0, or the error.
int connect_by(Number number, const addrinfo& address, std::int64_t deadline) noexcept {
  if (::connect(number, address.ai_addr, static_cast<socklen_t>(address.ai_addrlen)) == 0) return 0;
  int error = last_error();
  if (!is_busy(error)) return error;
  socklen_t size = sizeof error;
  if (!ready(number, POLLOUT, deadline)) return timed_out;
  getsockopt(number, SOL_SOCKET, SO_ERROR, reinterpret_cast<char*>(&error), &size);
  return error;
}

/// After a send or a receive that failed. `done`: try it again.
Io after(int error, Number number, short events, std::int64_t deadline) noexcept {
  if (is_gone(error)) return Io::closed;
  if (is_interrupted(error)) return Io::done;
  if (!is_busy(error)) return Io::failed;
  return ready(number, events, deadline) ? Io::done : Io::timeout;
}

}  // namespace

bool start_sockets() noexcept {
#ifdef _WIN32
  static const bool started = [] {
    WSADATA data;
    return WSAStartup(MAKEWORD(2, 2), &data) == 0;
  }();
  return started;
#else
  return true;
#endif
}

Socket::Socket(Handle handle) noexcept : handle_(handle) {
  prepare(number_of(handle));
  const int on = 1;
  setsockopt(number_of(handle), IPPROTO_TCP, TCP_NODELAY, reinterpret_cast<const char*>(&on), sizeof on);
}

Socket::Socket(Socket&& other) noexcept : handle_(std::exchange(other.handle_, none)) {}

Socket& Socket::operator=(Socket&& other) noexcept {
  std::swap(handle_, other.handle_);
  return *this;
}

Socket Socket::connect(const std::string& host, std::uint16_t port, std::int64_t deadline, std::string& error) {
  if (!start_sockets()) {
    error = "Windows has no sockets to give";
    return {};
  }
  addrinfo wanted{}, *found = nullptr;
  wanted.ai_family = AF_UNSPEC;
  wanted.ai_socktype = SOCK_STREAM;
  if (const int code = getaddrinfo(host.c_str(), std::to_string(port).c_str(), &wanted, &found); code != 0) {
    error = lookup_words(code);
    return {};
  }
  Socket connected;
  for (const addrinfo* at = found; at && !connected; at = at->ai_next) {
    const auto handle = static_cast<Handle>(::socket(at->ai_family, at->ai_socktype, at->ai_protocol));
    int why = last_error();
    if (handle != none) {
      Socket candidate(handle);
      why = connect_by(number_of(handle), *at, deadline);
      if (why == 0) connected = std::move(candidate);
    }
    if (!connected) error = words(why);
  }
  freeaddrinfo(found);
  return connected;
}

Io Socket::send(const void* data, std::size_t size, std::int64_t deadline) noexcept {
  const char* at = static_cast<const char*>(data);
  while (size > 0) {
    if (handle_ == none) return Io::failed;
    const auto length = static_cast<Length>(std::min<std::size_t>(size, 1 << 20));
    const auto n = ::send(number_of(handle_), at, length, send_flags);
    if (n >= 0) {
      at += n;
      size -= static_cast<std::size_t>(n);
      continue;
    }
    if (const Io how = after(last_error(), number_of(handle_), POLLOUT, deadline); how != Io::done) return how;
  }
  return Io::done;
}

Io Socket::receive(void* data, std::size_t capacity, std::size_t& received, std::int64_t deadline) noexcept {
  received = 0;
  for (;;) {
    if (handle_ == none) return Io::failed;
    const auto length = static_cast<Length>(std::min<std::size_t>(capacity, 1 << 20));
    const auto n = ::recv(number_of(handle_), static_cast<char*>(data), length, 0);
    if (n > 0) {
      received = static_cast<std::size_t>(n);
      return Io::done;
    }
    if (n == 0) return Io::closed;
    if (const Io how = after(last_error(), number_of(handle_), POLLIN, deadline); how != Io::done) return how;
  }
}

void Socket::close() noexcept {
  if (handle_ != none) close_number(number_of(std::exchange(handle_, none)));
}

}  // namespace punctura::os
