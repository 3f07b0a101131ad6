// TCP connections.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

namespace punctura::os {

/// How an attempt to send or to receive ended.
enum class Io : std::uint8_t { done, timeout, closed, failed };

/// One connection. No call blocks beyond its deadline (ns on now_ns()), raises a signal when the other side has gone,
/// or, after connect(), allocates. Small messages leave at once (TCP_NODELAY).
class Socket {
 public:
  using Handle = std::intptr_t;
  static constexpr Handle none = -1;

  Socket() = default;
  explicit Socket(Handle handle) noexcept;  ///< takes ownership of a connected socket
  Socket(Socket&& other) noexcept;
  Socket& operator=(Socket&& other) noexcept;
  ~Socket() { close(); }

  /// Tries every address of the host in turn. Without a connection by the deadline, the socket is empty and `error`
  /// says why.
  static Socket connect(const std::string& host, std::uint16_t port, std::int64_t deadline, std::string& error);

  explicit operator bool() const noexcept { return handle_ != none; }

  /// `done` only if all bytes were sent.
  Io send(const void* data, std::size_t size, std::int64_t deadline) noexcept;
  /// `done` with at least one byte.
  Io receive(void* data, std::size_t capacity, std::size_t& received, std::int64_t deadline) noexcept;
  void close() noexcept;

 private:
  Handle handle_ = none;
};

/// Starts the system's sockets, once. Only Windows needs it. False if there are none.
bool start_sockets() noexcept;

}  // namespace punctura::os
