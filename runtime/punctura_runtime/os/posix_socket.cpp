// Sockets of Linux and macOS.
#include <fcntl.h>
#include <netdb.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <utility>

#include "punctura_runtime/os/os.hpp"
#include "punctura_runtime/os/socket.hpp"

namespace punctura::os {

namespace {

#ifdef MSG_NOSIGNAL
constexpr int no_signal = MSG_NOSIGNAL;
#else
constexpr int no_signal = 0;  // macOS has an option of the socket for it, see prepare()
#endif

int number(Socket::Handle handle) noexcept { return static_cast<int>(handle); }

void prepare(int handle) noexcept {
  fcntl(handle, F_SETFL, fcntl(handle, F_GETFL, 0) | O_NONBLOCK);
  fcntl(handle, F_SETFD, FD_CLOEXEC);
  const int on = 1;
  setsockopt(handle, IPPROTO_TCP, TCP_NODELAY, &on, sizeof on);  // no harm where the socket is no TCP
#ifdef SO_NOSIGPIPE
  setsockopt(handle, SOL_SOCKET, SO_NOSIGPIPE, &on, sizeof on);
#endif
}

/// Sleeps until the handle is ready for `events`, or has gone, or the deadline is over: only then false.
bool ready(int handle, short events, std::int64_t deadline) noexcept {
  for (;;) {
    const std::int64_t left = std::max<std::int64_t>(0, deadline - now_ns());
    // Rounded up: waking a moment late is better than turning round and round within the last millisecond.
    const int ms = static_cast<int>(std::min<std::int64_t>((left + 999'999) / 1'000'000, 3'600'000));
    pollfd entry{handle, events, 0};
    const int n = ::poll(&entry, 1, ms);
    if (n > 0) return true;
    if (n == 0 && now_ns() >= deadline) return false;
    if (n < 0 && errno != EINTR) return true;  // what is wrong, the call that follows will say
  }
}

int connected(const addrinfo& address, std::int64_t deadline) noexcept {
  const int handle = ::socket(address.ai_family, address.ai_socktype, address.ai_protocol);
  if (handle < 0) return -1;
  prepare(handle);
  int error = 0;
  if (::connect(handle, address.ai_addr, address.ai_addrlen) != 0) {
    error = errno;
    if (error == EINPROGRESS) {
      socklen_t size = sizeof error;
      error = ETIMEDOUT;
      if (ready(handle, POLLOUT, deadline)) getsockopt(handle, SOL_SOCKET, SO_ERROR, &error, &size);
    }
  }
  if (error == 0) return handle;
  ::close(handle);
  errno = error;
  return -1;
}

}  // namespace

Socket::Socket(Handle handle) noexcept : handle_(handle) { prepare(number(handle)); }

Socket::Socket(Socket&& other) noexcept : handle_(std::exchange(other.handle_, none)) {}

Socket& Socket::operator=(Socket&& other) noexcept {
  std::swap(handle_, other.handle_);
  return *this;
}

Socket Socket::connect(const std::string& host, std::uint16_t port, std::int64_t deadline, std::string& error) {
  addrinfo wanted{}, *found = nullptr;
  wanted.ai_family = AF_UNSPEC;
  wanted.ai_socktype = SOCK_STREAM;
  const int code = getaddrinfo(host.c_str(), std::to_string(port).c_str(), &wanted, &found);
  if (code != 0) {
    error = gai_strerror(code);
    return {};
  }
  Socket socket;
  for (const addrinfo* at = found; at && !socket; at = at->ai_next) {
    const int handle = connected(*at, deadline);
    if (handle >= 0)
      socket.handle_ = handle;
    else
      error = std::strerror(errno);
  }
  freeaddrinfo(found);
  return socket;
}

Io Socket::send(const void* data, std::size_t size, std::int64_t deadline) noexcept {
  const char* at = static_cast<const char*>(data);
  while (size > 0) {
    const ssize_t n = handle_ == none ? (errno = EBADF, -1) : ::send(number(handle_), at, size, no_signal);
    if (n >= 0) {
      at += n;
      size -= static_cast<std::size_t>(n);
    } else if (errno == EAGAIN || errno == EWOULDBLOCK) {
      if (!ready(number(handle_), POLLOUT, deadline)) return Io::timeout;
    } else if (errno == EPIPE || errno == ECONNRESET) {
      return Io::closed;
    } else if (errno != EINTR) {
      return Io::failed;
    }
  }
  return Io::done;
}

Io Socket::receive(void* data, std::size_t capacity, std::size_t& received, std::int64_t deadline) noexcept {
  received = 0;
  for (;;) {
    const ssize_t n = handle_ == none ? (errno = EBADF, -1) : ::recv(number(handle_), data, capacity, 0);
    if (n > 0) {
      received = static_cast<std::size_t>(n);
      return Io::done;
    }
    if (n == 0 || errno == ECONNRESET) return Io::closed;
    if (errno == EAGAIN || errno == EWOULDBLOCK) {
      if (!ready(number(handle_), POLLIN, deadline)) return Io::timeout;
    } else if (errno != EINTR) {
      return Io::failed;
    }
  }
}

void Socket::close() noexcept {
  if (handle_ != none) ::close(number(std::exchange(handle_, none)));
}

Listener::Listener() {
  const int handle = ::socket(AF_INET, SOCK_STREAM, 0);
  if (handle < 0) return;
  handle_ = handle;
  prepare(handle);
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  socklen_t size = sizeof address;
  sockaddr* any = reinterpret_cast<sockaddr*>(&address);
  if (::bind(handle, any, size) == 0 && ::listen(handle, 8) == 0 && ::getsockname(handle, any, &size) == 0)
    port_ = ntohs(address.sin_port);
}

Listener::~Listener() {
  if (handle_ != Socket::none) ::close(number(handle_));
}

Socket Listener::accept(std::int64_t deadline) noexcept {
  if (port_ == 0 || !ready(number(handle_), POLLIN, deadline)) return {};
  const int handle = ::accept(number(handle_), nullptr, nullptr);
  return handle < 0 ? Socket() : Socket(handle);
}

}  // namespace punctura::os
