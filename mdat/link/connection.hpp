// The ground's end of a component's link for as long as somebody wants it: it is asked for telemetry where it has to be, and opened again
// where it has ended.
#pragma once

#include <chrono>
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "bsp/posix/links.hpp"
#include "mdat/link/link_health.hpp"
#include "mdat/link/station.hpp"

namespace lasso::mdat {

struct ConnectionPlace {
  std::string url;         // as posix::connect_link takes it
  bool listens = false;    // bound there, udp or tcp, for a component that sends by itself
  std::optional<Key> key;  // by which commands are signed
  std::uint16_t apid = kApid;
};

class Connection {
 public:
  // The listener gets each packet that comes. Throws InputError where the link cannot be opened.
  Connection(ConnectionPlace place, Station::Listener listener);
  ~Connection();
  Connection(const Connection&) = delete;
  Connection& operator=(const Connection&) = delete;

  // Takes what comes until `done` holds, at most so long; a link that has ended may take some seconds more to be opened again. By datagrams
  // a component tells who has commanded: it is sent a ping at first, where nothing has come for 2 s, and each 20 s.
  void listen(double seconds, const std::function<bool()>& done);

  // Of all packets since the beginning; those that were missed between two links are missing.
  const LinkHealth& health() const { return health_; }
  // That belong to no packet.
  std::uint64_t other_bytes() const;
  // Why nothing can come now; empty: it can.
  const std::string& trouble() const { return trouble_; }
  // Why the component refused the last ping; empty: it did not.
  std::string call_refusal() const { return station_ ? station_->call_refusal() : ""; }
  // Where the link is bound, or leads to; empty: it has ended.
  std::string address() const;
  // To command by; null: the link has ended.
  Station* station() { return station_.get(); }

 private:
  using Time = LinkHealth::Time;
  void open();
  void keep();
  void call_in_time();

  const ConnectionPlace place_;
  const Station::Listener listener_;
  std::unique_ptr<posix::PosixLink> link_;
  std::unique_ptr<Station> station_;  // of the link
  LinkHealth health_;
  std::string trouble_;
  Time acted_{};                   // when the link was last opened, tried, or called
  std::uint64_t other_bytes_ = 0;  // of links that have ended
};

}  // namespace lasso::mdat
