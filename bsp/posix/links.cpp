#include "bsp/posix/links.hpp"

#include <arpa/inet.h>
#include <fcntl.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <cstring>
#include <fstream>
#include <system_error>

#include "bsp/posix/serial_line.hpp"
#include "bsp/posix/socket.hpp"
#include "bsp/posix/udp_peers.hpp"

namespace lasso::posix {
namespace {

constexpr int kVanished_s = 10;    // without a sign of life: a TCP client that is gone
constexpr int kAnswer_ms = 5'000;  // that connecting may take
constexpr char kSerial[] = "serial:", kUnixSocket[] = "unix:";

struct Place {
  std::string scheme, host, port;
};

[[noreturn]] void refuse(const std::string& url, const std::string& why) { throw LinkError(url + ": " + why); }

[[noreturn]] void refuse_errno(const std::string& url, const char* what) {
  const int error = errno;
  refuse(url, std::string(what) + ": " + std::generic_category().message(error));
}

Place place_of(const std::string& url) {
  const std::size_t scheme = url.find("://");
  if (scheme == std::string::npos)
    refuse(url, "no link; one of udp://[HOST]:PORT, tcp://[HOST]:PORT, file://PATH, or to connect to serial:PATH, unix:PATH");
  Place place{url.substr(0, scheme), "", ""};
  const std::string rest = url.substr(scheme + 3);
  if (place.scheme == "file") {
    place.host = rest;
    return place;
  }
  if (place.scheme != "udp" && place.scheme != "tcp") refuse(url, "no link of kind " + place.scheme + "; there are udp, tcp and file");
  const std::size_t colon = rest.rfind(':');
  if (colon == std::string::npos) refuse(url, "a port is missing: " + place.scheme + "://[HOST]:PORT");
  place.host = rest.substr(0, colon);
  place.port = rest.substr(colon + 1);
  return place;
}

sockaddr_in address_of(const std::string& url, const Place& place) {
  sockaddr_in address{};
  address.sin_family = AF_INET;
  const std::string host = place.host.empty() ? "127.0.0.1" : place.host;
  if (inet_pton(AF_INET, host.c_str(), &address.sin_addr) != 1) refuse(url, host + " is no numeric IPv4 address");
  const bool digits = !place.port.empty() && place.port.size() <= 5 && place.port.find_first_not_of("0123456789") == std::string::npos;
  if (!digits || std::stoul(place.port) > 0xFFFF) refuse(url, "'" + place.port + "' is no port: 0 to 65535");
  address.sin_port = htons(static_cast<std::uint16_t>(std::stoul(place.port)));
  return address;
}

// Of a socket that does not wait.
void connect_socket(const std::string& url, const Descriptor& socket, const sockaddr_in& place) {
  if (::connect(socket.get(), generic(place), sizeof place) == 0) return;
  pollfd waiting{socket.get(), POLLOUT, 0};
  int error = errno;
  if (error == EINPROGRESS) {
    socklen_t size = sizeof error;
    const bool settled = ::poll(&waiting, 1, kAnswer_ms) > 0 && getsockopt(socket.get(), SOL_SOCKET, SO_ERROR, &error, &size) == 0;
    if (settled && error == 0) return;
    if (!settled) error = ETIMEDOUT;
  }
  throw NobodyThere(url + ": nobody answers: " + std::generic_category().message(error));
}

void make_socket(const std::string& url, int type, Descriptor& socket) {
  socket.reset(::socket(AF_INET, type | SOCK_NONBLOCK | SOCK_CLOEXEC, 0));
  if (!socket.open()) refuse_errno(url, "no socket");
}

void bind_to(const std::string& url, const Descriptor& socket, const sockaddr_in& address) {
  if (::bind(socket.get(), generic(address), sizeof address) != 0) refuse_errno(url, "cannot be bound");
}

// A component's end, or that of a ground that waits for one.
class BoundUdp final : public PosixLink {
 public:
  BoundUdp(const std::string& url, const sockaddr_in& place) {
    make_socket(url, SOCK_DGRAM, socket_);
    bind_to(url, socket_, place);
  }
  void tell(const sockaddr_in& address) { peers_.configure(address); }
  bool datagrams() const override { return true; }
  // Empty datagrams, and those of a crowd of strangers, are passed over: what is behind them must not wait for the next call.
  std::size_t read(Bytes out) override {
    for (int i = 0; i < kMostPassedOver; ++i) {
      sockaddr_in from{};
      socklen_t size = sizeof from;
      const ssize_t result = recvfrom(socket_.get(), out.data(), out.size(), 0, generic(from), &size);
      if (result < 0) return 0;
      const auto bytes = static_cast<std::size_t>(result);
      if (bytes > 0 && peers_.heard(from, {out.data(), bytes}, std::chrono::steady_clock::now())) return bytes;
    }
    return 0;
  }
  void peer_spoke() override { peers_.vouch(std::chrono::steady_clock::now()); }
  // While nobody has commanded, or nobody listens any more, telemetry is lost, as it is on a radio link. It is taken once the first
  // receiver's has been.
  std::size_t write(ConstBytes packet) override {
    bool first = true;
    for (const sockaddr_in& peer : peers_.receivers(packet)) {
      const bool sent = sendto(socket_.get(), packet.data(), packet.size(), 0, generic(peer), sizeof peer) >= 0;
      if (!sent && errno == EAGAIN && first) return 0;
      first = false;
    }
    return packet.size();
  }
  std::string address() const override { return bound_address("udp", socket_); }

 private:
  static constexpr int kMostPassedOver = 1024;
  Descriptor socket_;
  UdpPeers peers_;
};

// The ground's end: the machine's kernel lets nobody else in.
class ConnectedUdp final : public PosixLink {
 public:
  ConnectedUdp(const std::string& url, const sockaddr_in& place) {
    make_socket(url, SOCK_DGRAM, socket_);
    if (::connect(socket_.get(), generic(place), sizeof place) != 0) refuse_errno(url, "cannot be reached");
  }
  bool datagrams() const override { return true; }
  std::size_t read(Bytes out) override { return counted(recv(socket_.get(), out.data(), out.size(), 0)); }
  // What nobody takes is lost. That an earlier one found nobody is told to the next, which is not sent then.
  std::size_t write(ConstBytes packet) override {
    const auto sends = [&] { return ::send(socket_.get(), packet.data(), packet.size(), 0) >= 0; };
    const bool sent = sends() || (errno == ECONNREFUSED && sends());
    return !sent && errno == EAGAIN ? 0 : packet.size();
  }
  // An empty datagram asks: what is there passes it over.
  bool unreached() override {
    (void)::send(socket_.get(), nullptr, 0, 0);
    pollfd waiting{socket_.get(), POLLERR, 0};
    (void)::poll(&waiting, 1, kTold_ms);
    int error = 0;
    socklen_t size = sizeof error;
    return getsockopt(socket_.get(), SOL_SOCKET, SO_ERROR, &error, &size) == 0 && error == ECONNREFUSED;
  }
  std::string address() const override { return bound_address("udp", socket_); }

 private:
  static constexpr int kTold_ms = 20;
  Descriptor socket_;
};

// A component's end: packets, as by datagrams.
class BoundTcp final : public PosixLink {
 public:
  BoundTcp(const std::string& url, const sockaddr_in& place, const Heard& heard) : clients_(heard) {
    make_socket(url, SOCK_STREAM, listener_);
    const int yes = 1;  // what was said to an earlier listener may still be on its way
    (void)setsockopt(listener_.get(), SOL_SOCKET, SO_REUSEADDR, &yes, sizeof yes);
    bind_to(url, listener_, place);
    if (::listen(listener_.get(), static_cast<int>(TcpClients::kClients)) != 0) refuse_errno(url, "cannot listen");
  }
  bool datagrams() const override { return true; }
  std::size_t read(Bytes out) override {
    accept_clients();
    return clients_.read(out, std::chrono::steady_clock::now());
  }
  void peer_spoke() override { clients_.vouch(std::chrono::steady_clock::now()); }
  std::size_t write(ConstBytes packet) override {
    accept_clients();
    return clients_.write(packet) ? packet.size() : 0;
  }
  std::string address() const override { return bound_address("tcp", listener_); }

 private:
  void accept_clients() {
    for (std::size_t i = 0; i < TcpClients::kClients; ++i) {
      Descriptor client(accept4(listener_.get(), nullptr, nullptr, SOCK_NONBLOCK | SOCK_CLOEXEC));
      if (!client.open()) return;
      set(client, IPPROTO_TCP, TCP_NODELAY, 1);
      // One that vanishes without a word (its cable, its power) would keep its place.
      set(client, IPPROTO_TCP, TCP_USER_TIMEOUT, kVanished_s * 1000);
      set(client, IPPROTO_TCP, TCP_KEEPIDLE, kVanished_s / 2);
      set(client, IPPROTO_TCP, TCP_KEEPINTVL, 1);
      set(client, IPPROTO_TCP, TCP_KEEPCNT, kVanished_s / 2);
      set(client, SOL_SOCKET, SO_KEEPALIVE, 1);
      clients_.add(std::move(client), std::chrono::steady_clock::now());
    }
  }
  static void set(const Descriptor& client, int level, int option, int value) {
    (void)setsockopt(client.get(), level, option, &value, sizeof value);
  }
  Descriptor listener_;
  TcpClients clients_;
};

// The ground's end.
class ConnectedTcp final : public PosixLink {
 public:
  ConnectedTcp(const std::string& url, const sockaddr_in& place) {
    make_socket(url, SOCK_STREAM, socket_);
    connect_socket(url, socket_, place);
  }
  bool datagrams() const override { return false; }
  std::size_t read(Bytes out) override {
    if (!socket_.open()) return 0;
    const ssize_t result = recv(socket_.get(), out.data(), out.size(), 0);
    if (result == 0 || (result < 0 && errno != EAGAIN)) socket_.reset(-1);
    return counted(result);
  }
  // What nobody listens to is lost.
  std::size_t write(ConstBytes packets) override {
    if (!socket_.open()) return packets.size();
    const ssize_t result = ::send(socket_.get(), packets.data(), packets.size(), MSG_NOSIGNAL);
    if (result >= 0 || errno == EAGAIN) return counted(result);
    socket_.reset(-1);
    return packets.size();
  }
  std::string address() const override { return bound_address("tcp", socket_); }
  bool ended() const override { return !socket_.open(); }

 private:
  Descriptor socket_;
};

// A serial device, or a Unix socket in its place.
class Line final : public PosixLink {
 public:
  Line(const std::string& url, const std::string& address) : url_(url) {
    const std::string wrong = line_.open(address, 0, false);
    if (!wrong.empty()) throw LinkError(wrong);
  }
  bool datagrams() const override { return false; }
  std::size_t read(Bytes out) override { return line_.is_open() ? line_.read(out) : 0; }
  std::size_t write(ConstBytes packets) override { return line_.is_open() ? line_.write(packets) : packets.size(); }
  std::string address() const override { return url_; }
  bool ended() const override { return !line_.is_open(); }

 private:
  std::string url_;
  SerialLine line_;
};

class File final : public PosixLink {
 public:
  explicit File(const std::string& path)
      : path_(path), commands_(path + ".commands", std::ios::binary), telemetry_(path, std::ios::binary) {
    if (!telemetry_) refuse("file://" + path, "cannot be written");
  }
  bool datagrams() const override { return false; }
  std::size_t read(Bytes out) override {
    commands_.read(reinterpret_cast<char*>(out.data()), static_cast<std::streamsize>(out.size()));
    return static_cast<std::size_t>(commands_.gcount());
  }
  std::size_t write(ConstBytes packets) override {
    telemetry_.write(reinterpret_cast<const char*>(packets.data()), static_cast<std::streamsize>(packets.size())).flush();
    return packets.size();
  }
  std::string address() const override { return "file://" + path_; }

 private:
  std::string path_;
  std::ifstream commands_;
  std::ofstream telemetry_;
};

// HOST:PORT that telemetry goes to. Where the kernel sends nothing there from the link's own address, nobody would notice.
sockaddr_in told_address(const std::string& told, sockaddr_in from) {
  if (told.find(':') == std::string::npos) refuse(told, "a port is missing: HOST:PORT");
  const sockaddr_in to = address_of(told, {"udp", told.substr(0, told.rfind(':')), told.substr(told.rfind(':') + 1)});
  if (to.sin_port == 0) refuse(told, "'0' is no port to send to: 1 to 65535");
  Descriptor trial;
  make_socket(told, SOCK_DGRAM, trial);
  from.sin_port = 0;
  bind_to(told, trial, from);
  if (::connect(trial.get(), generic(to), sizeof to) != 0) refuse_errno(told, "is not reached from the link's address");
  return to;
}

std::unique_ptr<PosixLink> bound_udp(const std::string& url, const std::string& told) {
  const sockaddr_in place = address_of(url, place_of(url));
  auto link = std::make_unique<BoundUdp>(url, place);
  if (!told.empty()) link->tell(told_address(told, place));
  return link;
}

}  // namespace

std::string bound_address(const std::string& scheme, const Descriptor& socket) {
  sockaddr_in address{};
  socklen_t size = sizeof address;
  (void)getsockname(socket.get(), generic(address), &size);
  char host[INET_ADDRSTRLEN] = {};
  (void)inet_ntop(AF_INET, &address.sin_addr, host, sizeof host);
  return scheme + "://" + host + ":" + std::to_string(ntohs(address.sin_port));
}

std::unique_ptr<PosixLink> open_link(const std::string& url, const std::string& told, const Heard& heard) {
  const Place place = place_of(url);
  if (!told.empty() && place.scheme != "udp") refuse(url, "only of udp:// is said whom it tells");
  if (place.scheme == "udp") return bound_udp(url, told);
  if (place.scheme == "file") return std::make_unique<File>(place.host);
  return std::make_unique<BoundTcp>(url, address_of(url, place), heard);
}

bool is_reached_from_elsewhere(const std::string& url) {
  const Place place = place_of(url);
  if (place.scheme == "file") return false;
  return ntohl(address_of(url, place).sin_addr.s_addr) >> 24 != IN_LOOPBACKNET;
}

std::unique_ptr<PosixLink> connect_link(const std::string& url) {
  if (url.rfind(kSerial, 0) == 0) return std::make_unique<Line>(url, url.substr(sizeof kSerial - 1));
  if (url.rfind(kUnixSocket, 0) == 0) return std::make_unique<Line>(url, url);
  const Place place = place_of(url);
  if (place.scheme == "file") refuse(url, "commands are sent by udp or tcp; a file is written by --out");
  if (place.scheme == "udp") return std::make_unique<ConnectedUdp>(url, address_of(url, place));
  return std::make_unique<ConnectedTcp>(url, address_of(url, place));
}

}  // namespace lasso::posix
