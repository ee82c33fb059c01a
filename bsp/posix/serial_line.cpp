#include "bsp/posix/serial_line.hpp"

#include <arpa/inet.h>
#include <fcntl.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <poll.h>
#include <sys/file.h>
#include <sys/ioctl.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <termios.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <utility>

namespace lasso::posix {
namespace {

constexpr char kTcp[] = "tcp://";
constexpr char kUnix[] = "unix:";

bool begins(const std::string& text, const char* with) { return text.rfind(with, 0) == 0; }

// An address of a socket, ready for the system.
struct SocketAddress {
  sockaddr_storage storage{};
  socklen_t size = 0;
  int family = AF_UNSPEC;
  std::string path;  // of a Unix socket
};

bool parse_port(const std::string& text, std::uint16_t& port) {
  if (text.empty() || text.size() > 5 || text.find_first_not_of("0123456789") != std::string::npos) return false;
  const unsigned long value = std::strtoul(text.c_str(), nullptr, 10);
  port = static_cast<std::uint16_t>(value);
  return value <= 65535;
}

std::string parse_tcp(const std::string& address, bool remote, SocketAddress& out) {
  const std::size_t colon = address.rfind(':');
  std::string host = address.substr(sizeof kTcp - 1, colon < sizeof kTcp - 1 ? 0 : colon - (sizeof kTcp - 1));
  if (host == "localhost") host = "127.0.0.1";
  sockaddr_in in{};
  in.sin_family = AF_INET;
  std::uint16_t port = 0;
  if (inet_pton(AF_INET, host.c_str(), &in.sin_addr) != 1 || !parse_port(address.substr(colon + 1), port)) {
    return address + ": no address: expected tcp://127.0.0.1:PORT";
  }
  if ((ntohl(in.sin_addr.s_addr) >> 24) != 127 && !remote) return address + ": reaches other machines, which has to be allowed (--remote)";
  in.sin_port = htons(port);
  std::memcpy(&out.storage, &in, sizeof in);
  out.size = sizeof in;
  out.family = AF_INET;
  return {};
}

std::string parse_unix(const std::string& address, SocketAddress& out) {
  out.path = address.substr(sizeof kUnix - 1);
  sockaddr_un un{};
  un.sun_family = AF_UNIX;
  if (out.path.empty() || out.path.size() >= sizeof un.sun_path) {
    return address + ": no address: expected unix:PATH, PATH of 1 to " + std::to_string(sizeof un.sun_path - 1) + " characters";
  }
  std::memcpy(un.sun_path, out.path.c_str(), out.path.size() + 1);
  std::memcpy(&out.storage, &un, sizeof un);
  out.size = sizeof un;
  out.family = AF_UNIX;
  return {};
}

bool is_socket(const std::string& address) { return begins(address, kTcp) || begins(address, kUnix); }

std::string parse(const std::string& address, bool remote, SocketAddress& out) {
  return begins(address, kTcp) ? parse_tcp(address, remote, out) : parse_unix(address, out);
}

std::string cause_of(const std::string& address, int error) {
  switch (error) {
    case ENOENT:
      return address + ": not there: is the device connected, does the path exist?";
    case ECONNREFUSED:
      return address + ": nobody listens there, or another program has the line";
    case EBUSY:
    case EWOULDBLOCK:
      return address + ": taken by another program";
    case EADDRINUSE:
      return address + ": taken: another program listens there";
    case EACCES:
    case EPERM:
      return address + ": not allowed for this user";
    case ENOTTY:
      return address + ": not a serial line";
    default:
      return address + ": " + std::strerror(error);
  }
}

void no_waiting(int fd) { (void)fcntl(fd, F_SETFL, fcntl(fd, F_GETFL) | O_NONBLOCK); }

void no_delay(int fd) {
  const int on = 1;
  (void)setsockopt(fd, IPPROTO_TCP, TCP_NODELAY, &on, sizeof on);  // fails for Unix sockets, which have no delay
}

struct Rate {
  unsigned bits_per_s;
  speed_t code;
};
constexpr Rate kRates[] = {{1000000, B1000000}, {1500000, B1500000}, {2000000, B2000000}, {2500000, B2500000},
                           {3000000, B3000000}, {3500000, B3500000}, {4000000, B4000000}};

bool make_raw(int fd, unsigned bits_per_s) {
  termios settings{};
  if (tcgetattr(fd, &settings) != 0) return false;
  cfmakeraw(&settings);
  constexpr tcflag_t kOn = CLOCAL | CREAD, kOff = CSTOPB | PARENB | CRTSCTS;
  settings.c_cflag = (settings.c_cflag | kOn) & ~kOff;
  settings.c_cc[VMIN] = 0;
  settings.c_cc[VTIME] = 0;
  for (const Rate& rate : kRates) {
    if (rate.bits_per_s == bits_per_s) (void)cfsetspeed(&settings, rate.code);
  }
  return tcsetattr(fd, TCSANOW, &settings) == 0;
}

int open_device(const std::string& path, unsigned bits_per_s) {
  const int fd = ::open(path.c_str(), O_RDWR | O_NOCTTY | O_NONBLOCK | O_CLOEXEC);
  if (fd < 0) return fd;
  if (flock(fd, LOCK_EX | LOCK_NB) == 0 && make_raw(fd, bits_per_s) && ioctl(fd, TIOCEXCL) == 0) return fd;
  const int error = errno;
  (void)::close(fd);
  errno = error;
  return -1;
}

int connect_to(const SocketAddress& address) {
  const int fd = socket(address.family, SOCK_STREAM | SOCK_CLOEXEC, 0);
  if (fd < 0) return fd;
  if (connect(fd, reinterpret_cast<const sockaddr*>(&address.storage), address.size) == 0) return fd;
  const int error = errno;
  (void)::close(fd);
  errno = error;
  return -1;
}

// A path that a program left behind is free; one at which a program listens is not.
void remove_stale(const SocketAddress& address) {
  if (address.family != AF_UNIX) return;
  const int fd = connect_to(address);
  if (fd >= 0) (void)::close(fd);
  if (fd < 0 && errno == ECONNREFUSED) (void)unlink(address.path.c_str());
}

int listen_on(const SocketAddress& address) {
  const int fd = socket(address.family, SOCK_STREAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0);
  if (fd < 0) return fd;
  const int on = 1;
  (void)setsockopt(fd, SOL_SOCKET, SO_REUSEADDR, &on, sizeof on);
  if (bind(fd, reinterpret_cast<const sockaddr*>(&address.storage), address.size) == 0 && ::listen(fd, 1) == 0) return fd;
  const int error = errno;
  (void)::close(fd);
  errno = error;
  return -1;
}

std::string name_of(int fd, const std::string& asked) {
  if (!begins(asked, kTcp)) return asked;
  sockaddr_in in{};
  socklen_t size = sizeof in;
  (void)getsockname(fd, reinterpret_cast<sockaddr*>(&in), &size);
  return asked.substr(0, asked.rfind(':') + 1) + std::to_string(ntohs(in.sin_port));
}

int new_terminal(std::string& name) {
  const int fd = posix_openpt(O_RDWR | O_NOCTTY | O_CLOEXEC);
  if (fd < 0 || grantpt(fd) != 0 || unlockpt(fd) != 0) return -1;
  char path[128] = {};
  if (ptsname_r(fd, path, sizeof path) != 0) return -1;
  name = path;
  no_waiting(fd);
  return fd;
}

// Nobody has a terminal's other end open while poll says that it hung up. It says so only once somebody has been there.
bool hung_up(int fd) {
  pollfd state{fd, POLLIN, 0};
  return poll(&state, 1, 0) >= 0 && (state.revents & POLLHUP) != 0;
}

}  // namespace

SerialLine& SerialLine::operator=(SerialLine&& other) noexcept {
  std::swap(fd_, other.fd_);
  return *this;
}

std::string SerialLine::check(const std::string& address, bool remote) {
  SocketAddress socket;
  std::string wrong = is_socket(address) ? parse(address, remote, socket) : std::string();
  if (!wrong.empty() || begins(address, kTcp)) return wrong;
  const std::string& path = is_socket(address) ? socket.path : address;
  return access(path.c_str(), F_OK) == 0 ? std::string() : cause_of(address, errno);
}

std::string SerialLine::open(const std::string& address, unsigned bits_per_s, bool remote) {
  close();
  SocketAddress socket;
  if (is_socket(address)) {
    std::string wrong = parse(address, remote, socket);
    if (!wrong.empty()) return wrong;
  }
  fd_ = is_socket(address) ? connect_to(socket) : open_device(address, bits_per_s);
  if (fd_ < 0) return cause_of(address, errno);
  no_waiting(fd_);
  no_delay(fd_);
  return {};
}

void SerialLine::close() {
  if (fd_ >= 0) (void)::close(fd_);
  fd_ = -1;
}

std::size_t SerialLine::settle(long result) {
  if (result > 0) return static_cast<std::size_t>(result);
  const bool none = result < 0 && (errno == EAGAIN || errno == EWOULDBLOCK || errno == EINTR);
  if (!none) close();
  return 0;
}

// A terminal without data reads as nothing, and has not gone.
std::size_t SerialLine::read(Bytes out) {
  if (fd_ < 0 || out.empty()) return 0;
  const long result = ::read(fd_, out.data(), out.size());
  if (result == 0 && isatty(fd_) != 0 && !hung_up(fd_)) return 0;
  return settle(result);
}

std::size_t SerialLine::write(ConstBytes bytes) {
  if (fd_ < 0 || bytes.empty()) return 0;
  long result = ::send(fd_, bytes.data(), bytes.size(), MSG_NOSIGNAL);
  if (result < 0 && errno == ENOTSOCK) result = ::write(fd_, bytes.data(), bytes.size());
  return settle(result);
}

std::string LineServer::listen(const std::string& address, bool remote) {
  close();
  remote_ = remote;
  pty_ = address == "pty";
  address_ = address;
  if (!pty_ && !is_socket(address)) return address + ": no address: expected pty, tcp://127.0.0.1:PORT or unix:PATH";
  return listen_again();
}

std::string LineServer::listen_again() {
  if (pty_) {
    fd_ = new_terminal(address_);
    return fd_ >= 0 ? std::string() : cause_of("pty", errno);
  }
  SocketAddress socket;
  std::string wrong = parse(address_, remote_, socket);
  if (!wrong.empty()) return wrong;
  remove_stale(socket);
  fd_ = listen_on(socket);
  if (fd_ < 0) return cause_of(address_, errno);
  unix_path_ = socket.path;
  address_ = name_of(fd_, address_);
  return {};
}

bool LineServer::accept(SerialLine& line) {
  if (pty_) {  // open from the first byte on
    pollfd state{fd_, POLLIN, 0};
    if (poll(&state, 1, 0) <= 0 || (state.revents & POLLIN) == 0) return false;
    line = SerialLine(dup(fd_));
    return line.is_open();
  }
  if (fd_ < 0 && !listen_again().empty()) return false;
  const int fd = accept4(fd_, nullptr, nullptr, SOCK_NONBLOCK | SOCK_CLOEXEC);
  if (fd < 0) return false;
  no_delay(fd);
  line = SerialLine(fd);
  (void)::close(fd_);  // whoever comes now is refused
  fd_ = -1;
  return true;
}

void LineServer::close() {
  if (fd_ >= 0) (void)::close(fd_);
  fd_ = -1;
  if (!unix_path_.empty()) (void)unlink(unix_path_.c_str());
  unix_path_.clear();
}

}  // namespace lasso::posix
