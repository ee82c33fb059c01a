// What the sockets of the link share.
#pragma once

#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cstddef>
#include <string>
#include <utility>

namespace lasso::posix {

// A descriptor that closes.
class Descriptor {
 public:
  Descriptor() = default;
  explicit Descriptor(int fd) : fd_(fd) {}
  ~Descriptor() { close(); }
  Descriptor(Descriptor&& other) noexcept : fd_(std::exchange(other.fd_, -1)) {}
  Descriptor& operator=(Descriptor&& other) noexcept {
    reset(std::exchange(other.fd_, -1));
    return *this;
  }
  void reset(int fd) {
    close();
    fd_ = fd;
  }
  int get() const { return fd_; }
  bool open() const { return fd_ >= 0; }

 private:
  void close() {
    if (fd_ >= 0) (void)::close(fd_);
    fd_ = -1;
  }
  int fd_ = -1;
};

inline const sockaddr* generic(const sockaddr_in& address) { return reinterpret_cast<const sockaddr*>(&address); }
inline sockaddr* generic(sockaddr_in& address) { return reinterpret_cast<sockaddr*>(&address); }

inline std::size_t counted(ssize_t result) { return result > 0 ? static_cast<std::size_t>(result) : 0; }

// As an URL.
std::string bound_address(const std::string& scheme, const Descriptor& socket);

}  // namespace lasso::posix
