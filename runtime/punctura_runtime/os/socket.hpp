// Stream sockets, which differ from one operating system to the next. posix_socket.cpp implements this for Linux and macOS, windows_socket.cpp for Windows.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

namespace punctura::os {

/// How an attempt to send or to receive ended.
enum class Io : std::uint8_t { done, timeout, closed, failed };

/// One connection. It never blocks beyond a deadline (ns on now_ns()), raises no signal when the other side has gone, and takes
/// no memory after connect(). Small messages leave at once (TCP_NODELAY).
class Socket {
 public:
  using Handle = std::intptr_t;
  static constexpr Handle none = -1;

  Socket() = default;
  explicit Socket(Handle handle) noexcept;  ///< takes over a connected one
  Socket(Socket&& other) noexcept;
  Socket& operator=(Socket&& other) noexcept;
  ~Socket() { close(); }

  /// Tries every address of the host in turn. Without a connection by the deadline, the socket is empty and `error` says why.
  static Socket connect(const std::string& host, std::uint16_t port, std::int64_t deadline, std::string& error);

  explicit operator bool() const noexcept { return handle_ != none; }

  /// All of it, or not `done`.
  Io send(const void* data, std::size_t size, std::int64_t deadline) noexcept;
  /// What there is, at least one byte, when `done`.
  Io receive(void* data, std::size_t capacity, std::size_t& received, std::int64_t deadline) noexcept;
  void close() noexcept;

 private:
  Handle handle_ = none;
};

/// Waits for connections from this machine: what a simulated service stands behind.
class Listener {
 public:
  Listener();  ///< on a free port of 127.0.0.1; port() is 0 where the system gives none
  Listener(const Listener&) = delete;
  Listener& operator=(const Listener&) = delete;
  ~Listener();

  std::uint16_t port() const noexcept { return port_; }
  Socket accept(std::int64_t deadline) noexcept;  ///< empty when nobody has come

 private:
  Socket::Handle handle_ = Socket::none;
  std::uint16_t port_ = 0;
};

}  // namespace punctura::os
