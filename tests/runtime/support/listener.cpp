#include "runtime/support/listener.hpp"

#include <algorithm>

#include "punctura_runtime/os/os.hpp"

#ifdef _WIN32
#include <winsock2.h>
#include <ws2tcpip.h>
using Number = SOCKET;
static void close_number(Number number) { closesocket(number); }
#else
#include <netinet/in.h>
#include <sys/select.h>
#include <sys/socket.h>
#include <unistd.h>
using Number = int;
static void close_number(Number number) { ::close(number); }
#endif

namespace punctura::test {

Listener::Listener() {
  if (!os::start_sockets()) return;
  handle_ = static_cast<os::Socket::Handle>(::socket(AF_INET, SOCK_STREAM, 0));
  if (handle_ == os::Socket::none) return;
  const auto number = static_cast<Number>(handle_);
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  socklen_t size = sizeof address;
  auto* any = reinterpret_cast<sockaddr*>(&address);
  if (::bind(number, any, size) == 0 && ::listen(number, 8) == 0 && ::getsockname(number, any, &size) == 0)
    port_ = ntohs(address.sin_port);
}

Listener::~Listener() {
  if (handle_ != os::Socket::none) close_number(static_cast<Number>(handle_));
}

os::Socket Listener::accept(std::int64_t deadline) noexcept {
  if (port_ == 0) return {};
  const auto number = static_cast<Number>(handle_);
  const std::int64_t left = std::max<std::int64_t>(0, deadline - os::now_ns()) / 1000;  // us
  timeval time{};
  time.tv_sec = static_cast<decltype(time.tv_sec)>(left / 1'000'000);
  time.tv_usec = static_cast<decltype(time.tv_usec)>(left % 1'000'000);
  fd_set readable;
  FD_ZERO(&readable);
  FD_SET(number, &readable);
  if (::select(static_cast<int>(handle_) + 1, &readable, nullptr, nullptr, &time) <= 0) return {};
  const auto client = static_cast<os::Socket::Handle>(::accept(number, nullptr, nullptr));
  return client == os::Socket::none ? os::Socket() : os::Socket(client);
}

}  // namespace punctura::test
