// The link on Linux: UDP, TCP, serial lines and files.
#pragma once

#include <memory>
#include <stdexcept>
#include <string>

#include "bsp/posix/tcp_clients.hpp"
#include "fsw/link/byte_link.hpp"

namespace lasso::posix {

// The link cannot be opened: names it and says why.
class LinkError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

// The link could be opened, but nobody is at its other end.
class NobodyThere : public LinkError {
 public:
  using LinkError::LinkError;
};

class PosixLink : public ByteLink {
 public:
  PosixLink() = default;
  virtual ~PosixLink() = default;
  PosixLink(const PosixLink&) = delete;
  PosixLink& operator=(const PosixLink&) = delete;
  // Where it is bound, as an URL that the other end can use.
  virtual std::string address() const = 0;
  // The other end has gone, and cannot come back: the link has to be opened again.
  virtual bool ended() const { return false; }
  // The ground's end of datagrams: the other machine says that nobody is at the port.
  virtual bool unreached() { return false; }
};

// A component's end of a link:
//   udp://[HOST]:PORT   bound there; telemetry goes to who is vouched for (peer_spoke()), as UdpPeers says, and to `told`, HOST:PORT
//   tcp://[HOST]:PORT   listens there; telemetry goes to one client, as TcpClients says; packets are those of `heard`
//   file://PATH         reads commands from PATH.commands, if there is one, and appends telemetry to PATH
// Without a host the loopback address; a host is a numeric IPv4 address. Port 0: a free one, which address() says. Throws LinkError.
std::unique_ptr<PosixLink> open_link(const std::string& url, const std::string& told = "", const Heard& heard = {});
// Does open_link() of it let other machines in? Throws LinkError.
bool is_reached_from_elsewhere(const std::string& url);
// The ground's end of the first two, which a component hears only from its first datagram or connection on; or of a line:
//   serial:PATH         a serial device, taken for this program alone, at the rate that it was set to (stty)
//   unix:PATH           a Unix socket that stands for one
// Waits at most a few seconds for who does not answer. Throws LinkError, of a connection that nobody takes NobodyThere.
std::unique_ptr<PosixLink> connect_link(const std::string& url);

}  // namespace lasso::posix
