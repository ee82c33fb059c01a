#include "bsp/posix/tcp_clients.hpp"

#include <algorithm>
#include <cerrno>
#include <iterator>
#include <utility>

#include "fsw/link/link_report.hpp"

namespace lasso::posix {
namespace {

constexpr std::chrono::seconds kUnfinished{1};  // after which the rest of a packet will not come

}  // namespace

void TcpClients::drop(Place client) {
  if (last_ == &*client) last_ = nullptr;
  clients_.erase(client);
}

void TcpClients::add(Descriptor socket, Time now) {
  if (clients_.size() == kClients) {
    const Place least = std::min_element(clients_.begin(), clients_.end(), [](const Client& a, const Client& b) {
      return std::pair(a.vouched, a.heard) < std::pair(b.vouched, b.heard);
    });
    if (keeps(*least, now)) return;
    drop(least);
  }
  clients_.emplace_back(std::move(socket), heard_, now);
}

// The holder alone: who waits keeps nobody from anything. One that was vouched for loses its place to another such one alone, in vouch().
void TcpClients::drop_silent(Time now) {
  if (clients_.size() < 2) return;
  const Client& holder = clients_.front();
  if (!holder.vouched && now - holder.heard >= kSilent) drop(clients_.begin());
}

// Loop bound: the clients, each of which is asked for kReadBytes at most.
std::size_t TcpClients::read(Bytes out, Time now) {
  drop_silent(now);
  for (std::size_t i = clients_.size(); i > 0; --i) {
    const Place client = std::next(clients_.begin(), static_cast<std::ptrdiff_t>(turn_++ % clients_.size()));
    if (!look(*client, now)) {
      if (!client->socket.open()) drop(client);
      if (clients_.empty()) return 0;
      continue;
    }
    const ConstBytes packet = client->finder.packet();
    last_ = &*client;
    client->asked[client->next] = {command_key(packet), turn_};
    client->next = (client->next + 1) % kAsked;
    const std::size_t size = std::min(packet.size(), out.size());
    std::copy_n(packet.begin(), size, out.begin());
    return size;
  }
  return 0;
}

// True: its finder has a packet. What seemed to begin one and never ended is looked behind.
bool TcpClients::look(Client& client, Time now) {
  if (client.in.empty()) receive(client, now);
  const std::size_t taken = client.finder.take({client.in.data(), client.in.size()});
  client.in.erase(client.in.begin(), client.in.begin() + static_cast<std::ptrdiff_t>(taken));
  if (!client.finder.packet().empty()) return true;
  if (now - client.came < kUnfinished || !client.finder.give_up()) return false;
  static_cast<void>(client.finder.take({}));
  return !client.finder.packet().empty();
}

void TcpClients::receive(Client& client, Time now) {
  client.in.resize(kReadBytes);
  const ssize_t result = recv(client.socket.get(), client.in.data(), client.in.size(), 0);
  if (result > 0) client.came = now;
  if (result == 0 || (result < 0 && errno != EAGAIN)) client.socket.reset(-1);  // it has gone; what it sent is still looked at
  client.in.resize(counted(result));
}

void TcpClients::vouch(Time now) {
  if (last_ == nullptr) return;
  last_->vouched = true;
  last_->heard = now;
  if (last_ == &clients_.front() || keeps(clients_.front(), now)) return;
  const Place holder = std::find_if(clients_.begin(), clients_.end(), [this](const Client& client) { return &client == last_; });
  clients_.splice(clients_.begin(), clients_, holder);
}

// Who sent a command of this key last, of those that were vouched for or of the others; null: none of them. Loop bound: kClients * kAsked.
TcpClients::Client* TcpClients::asker(std::uint32_t key, bool vouched) {
  Client* last = nullptr;
  std::uint64_t turn = 0;
  for (Client& client : clients_) {
    if (client.vouched != vouched) continue;
    for (const Asked& asked : client.asked) {
      if (asked.key != key || asked.turn <= turn) continue;
      last = &client;
      turn = asked.turn;
    }
  }
  return last;
}

// A stranger's command may have the key of an operator's: the answer is the operator's then.
TcpClients::Client* TcpClients::receiver(ConstBytes packet) {
  std::uint32_t key = 0;
  if (is_answer(packet, key)) {
    for (const bool vouched : {true, false}) {
      if (Client* const client = asker(key, vouched); client != nullptr) return client;
    }
  }
  return clients_.empty() ? nullptr : &clients_.front();
}

// What has been begun goes first. False: not all of it has gone.
bool TcpClients::flush(Client& client) {
  if (client.rest.empty()) return true;
  const ssize_t result = ::send(client.socket.get(), client.rest.data(), client.rest.size(), MSG_NOSIGNAL);
  if (result < 0 && errno != EAGAIN) {
    client.rest.clear();
    client.socket.reset(-1);
    return true;
  }
  client.rest.erase(client.rest.begin(), client.rest.begin() + static_cast<std::ptrdiff_t>(counted(result)));
  return client.rest.empty();
}

bool TcpClients::write(ConstBytes packet) {
  for (Place client = clients_.begin(); client != clients_.end();) {
    const Place here = client++;
    if (!here->socket.open() && here->in.empty()) drop(here);
  }
  Client* const client = receiver(packet);
  if (client == nullptr) return true;
  if (!flush(*client)) return client != &clients_.front();  // an answer to somebody who does not listen is lost
  client->rest.assign(packet.begin(), packet.end());
  (void)flush(*client);
  return true;
}

}  // namespace lasso::posix
