// Sockets of Windows.
#ifndef NOMINMAX
#define NOMINMAX
#endif
#define WIN32_LEAN_AND_MEAN
#include <winsock2.h>
#include <ws2tcpip.h>

#include <algorithm>
#include <utility>

#include "punctura_runtime/os/os.hpp"
#include "punctura_runtime/os/socket.hpp"
#include "punctura_runtime/os/windows_words.hpp"

namespace punctura::os {

namespace {

/// Winsock wants to be woken once a process, before anything else.
bool awake() noexcept {
  static const bool good = [] {
    WSADATA data;
    return WSAStartup(MAKEWORD(2, 2), &data) == 0;
  }();
  return good;
}

SOCKET number(Socket::Handle handle) noexcept { return static_cast<SOCKET>(handle); }

void prepare(SOCKET handle) noexcept {
  u_long on = 1;
  ioctlsocket(handle, FIONBIO, &on);
  const BOOL yes = TRUE;
  setsockopt(handle, IPPROTO_TCP, TCP_NODELAY, reinterpret_cast<const char*>(&yes), sizeof yes);
}

/// Sleeps until the handle is ready for `events`, or has gone, or the deadline is over: only then false.
bool ready(SOCKET handle, SHORT events, std::int64_t deadline) noexcept {
  for (;;) {
    const std::int64_t left = std::max<std::int64_t>(0, deadline - now_ns());
    const int ms = static_cast<int>(std::min<std::int64_t>((left + 999'999) / 1'000'000, 3'600'000));
    WSAPOLLFD entry{handle, events, 0};
    const int n = WSAPoll(&entry, 1, ms);
    if (n != 0) return true;  // what is wrong, the call that follows will say
    if (now_ns() >= deadline) return false;
  }
}

std::string words_for(int error) { return windows_words(static_cast<unsigned long>(error)); }

SOCKET connected(const addrinfo& address, std::int64_t deadline, int& error) noexcept {
  const SOCKET handle = ::socket(address.ai_family, address.ai_socktype, address.ai_protocol);
  if (handle == INVALID_SOCKET) {
    error = WSAGetLastError();
    return INVALID_SOCKET;
  }
  prepare(handle);
  error = 0;
  if (::connect(handle, address.ai_addr, static_cast<int>(address.ai_addrlen)) != 0) {
    error = WSAGetLastError();
    if (error == WSAEWOULDBLOCK) {
      error = WSAETIMEDOUT;
      int size = sizeof error;
      if (ready(handle, POLLOUT, deadline))
        getsockopt(handle, SOL_SOCKET, SO_ERROR, reinterpret_cast<char*>(&error), &size);
    }
  }
  if (error == 0) return handle;
  closesocket(handle);
  return INVALID_SOCKET;
}

}  // namespace

Socket::Socket(Handle handle) noexcept : handle_(handle) { prepare(number(handle)); }

Socket::Socket(Socket&& other) noexcept : handle_(std::exchange(other.handle_, none)) {}

Socket& Socket::operator=(Socket&& other) noexcept {
  std::swap(handle_, other.handle_);
  return *this;
}

Socket Socket::connect(const std::string& host, std::uint16_t port, std::int64_t deadline, std::string& error) {
  if (!awake()) {
    error = "Windows has no sockets to give";
    return {};
  }
  addrinfo wanted{}, *found = nullptr;
  wanted.ai_family = AF_UNSPEC;
  wanted.ai_socktype = SOCK_STREAM;
  if (const int code = getaddrinfo(host.c_str(), std::to_string(port).c_str(), &wanted, &found); code != 0) {
    error = words_for(code);
    return {};
  }
  Socket socket;
  for (const addrinfo* at = found; at && !socket; at = at->ai_next) {
    int why = 0;
    const SOCKET handle = connected(*at, deadline, why);
    if (handle != INVALID_SOCKET)
      socket.handle_ = static_cast<Handle>(handle);
    else
      error = words_for(why);
  }
  freeaddrinfo(found);
  return socket;
}

Io Socket::send(const void* data, std::size_t size, std::int64_t deadline) noexcept {
  const char* at = static_cast<const char*>(data);
  while (size > 0) {
    if (handle_ == none) return Io::failed;
    const int n = ::send(number(handle_), at, static_cast<int>(std::min<std::size_t>(size, 1 << 20)), 0);
    if (n >= 0) {
      at += n;
      size -= static_cast<std::size_t>(n);
      continue;
    }
    const int error = WSAGetLastError();
    if (error == WSAECONNRESET || error == WSAECONNABORTED) return Io::closed;
    if (error != WSAEWOULDBLOCK) return Io::failed;
    if (!ready(number(handle_), POLLOUT, deadline)) return Io::timeout;
  }
  return Io::done;
}

Io Socket::receive(void* data, std::size_t capacity, std::size_t& received, std::int64_t deadline) noexcept {
  received = 0;
  for (;;) {
    if (handle_ == none) return Io::failed;
    const int n = ::recv(number(handle_), static_cast<char*>(data),
                         static_cast<int>(std::min<std::size_t>(capacity, 1 << 20)), 0);
    if (n > 0) {
      received = static_cast<std::size_t>(n);
      return Io::done;
    }
    const int error = n == 0 ? WSAECONNRESET : WSAGetLastError();
    if (error == WSAECONNRESET || error == WSAECONNABORTED) return Io::closed;
    if (error != WSAEWOULDBLOCK) return Io::failed;
    if (!ready(number(handle_), POLLIN, deadline)) return Io::timeout;
  }
}

void Socket::close() noexcept {
  if (handle_ != none) closesocket(number(std::exchange(handle_, none)));
}

Listener::Listener() {
  if (!awake()) return;
  const SOCKET handle = ::socket(AF_INET, SOCK_STREAM, 0);
  if (handle == INVALID_SOCKET) return;
  handle_ = static_cast<Socket::Handle>(handle);
  prepare(handle);
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  int size = sizeof address;
  sockaddr* any = reinterpret_cast<sockaddr*>(&address);
  if (::bind(handle, any, size) == 0 && ::listen(handle, 8) == 0 && ::getsockname(handle, any, &size) == 0)
    port_ = ntohs(address.sin_port);
}

Listener::~Listener() {
  if (handle_ != Socket::none) closesocket(number(handle_));
}

Socket Listener::accept(std::int64_t deadline) noexcept {
  if (port_ == 0 || !ready(number(handle_), POLLIN, deadline)) return {};
  const SOCKET handle = ::accept(number(handle_), nullptr, nullptr);
  return handle == INVALID_SOCKET ? Socket() : Socket(static_cast<Socket::Handle>(handle));
}

}  // namespace punctura::os
