#include "mdat/link/connection.hpp"

#include <algorithm>
#include <thread>
#include <utility>

#include "mdat/common/errors.hpp"

namespace lasso::mdat {
namespace {

constexpr std::chrono::seconds kCallAfter(2), kTryAgainAfter(1);
constexpr std::chrono::seconds kCallAgainAfter(20);  // before another may take the place (posix::UdpPeers)
constexpr double kLookAfter_s = 0.1;                 // at the link itself
constexpr std::chrono::milliseconds kNoLink(50);

}  // namespace

Connection::Connection(ConnectionPlace place, Station::Listener listener) : place_(std::move(place)), listener_(std::move(listener)) {
  try {
    open();
  } catch (const posix::LinkError& error) {
    throw InputError(error.what());
  }
}

Connection::~Connection() = default;

void Connection::open() {
  acted_ = std::chrono::steady_clock::now();
  link_ = place_.listens ? posix::open_link(place_.url, "", {PacketType::kTelemetry, place_.apid}) : posix::connect_link(place_.url);
  station_ = std::make_unique<Station>(
      *link_, place_.url,
      [this](const DecodedPacket& packet) {
        health_.take(packet.bytes, std::chrono::steady_clock::now());
        listener_(packet);
      },
      place_.apid);
  if (place_.key) station_->sign_with(*place_.key);
  trouble_.clear();
  if (link_->datagrams() && !place_.listens) (void)station_->call();
}

std::uint64_t Connection::other_bytes() const { return other_bytes_ + (station_ ? station_->other_bytes() : 0); }

std::string Connection::address() const { return link_ ? link_->address() : ""; }

void Connection::listen(double seconds, const std::function<bool()>& done) {
  const auto end = std::chrono::steady_clock::now() + std::chrono::duration<double>(seconds);
  while (!done() && std::chrono::steady_clock::now() < end) {
    keep();
    const std::chrono::duration<double> left = end - std::chrono::steady_clock::now();
    if (!station_) {
      std::this_thread::sleep_for(kNoLink);
    } else if (left.count() > 0 && station_->listen(std::min(kLookAfter_s, left.count()), done)) {
      return;
    }
  }
}

void Connection::keep() {
  if (link_ && link_->ended()) {
    other_bytes_ = other_bytes();
    station_.reset();
    link_.reset();
    trouble_ = place_.url + ": the other end has closed the link";
  }
  const auto now = std::chrono::steady_clock::now();
  if (link_) return call_in_time();
  if (now - acted_ < kTryAgainAfter) return;
  try {
    open();
  } catch (const posix::LinkError& error) {
    trouble_ = error.what();
  }
}

void Connection::call_in_time() {
  if (!link_->datagrams() || place_.listens) return;
  const auto now = std::chrono::steady_clock::now();
  const double age_s = health_.age_s(now);
  const bool silent = age_s < 0 || age_s > std::chrono::duration<double>(kCallAfter).count();
  if (now - acted_ < (silent ? kCallAfter : kCallAgainAfter)) return;
  acted_ = now;
  (void)station_->call();
}

}  // namespace lasso::mdat
