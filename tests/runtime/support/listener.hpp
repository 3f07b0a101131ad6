// Accepts connections from this machine for a simulated service.
#pragma once

#include <cstdint>

#include "punctura_runtime/os/socket.hpp"

namespace punctura::test {

class Listener {
 public:
  Listener();  ///< on a free port of 127.0.0.1; port() is 0 if the system gives none
  Listener(const Listener&) = delete;
  Listener& operator=(const Listener&) = delete;
  ~Listener();

  std::uint16_t port() const noexcept { return port_; }
  os::Socket accept(std::int64_t deadline) noexcept;  ///< empty if no client connects before the deadline

 private:
  os::Socket::Handle handle_ = os::Socket::none;
  std::uint16_t port_ = 0;
};

}  // namespace punctura::test
