// What an operator sent to a run, as its component got it: kept on its way, and given again.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <utility>
#include <vector>

#include "fsw/core/time.hpp"
#include "fsw/link/byte_link.hpp"
#include "mdat/run/run_listener.hpp"

namespace lasso::mdat {

// What one read of the link gave, in the slot that was to begin at `slot_us`.
struct CommandPiece {
  TimeUs slot_us = 0;
  std::vector<std::uint8_t> bytes;
};

struct CommandStream {
  bool datagrams = false;            // of one packet each; otherwise a stream of bytes
  std::vector<CommandPiece> pieces;  // as they came
};

using SlotClock = std::function<TimeUs()>;  // begin of the slot for which the link is read

// Passes each call on, and tells a listener of what comes from the ground.
class ListenedLink final : public ByteLink {
 public:
  // Both outlive it.
  ListenedLink(ByteLink& link, RunListener& listener, SlotClock clock) : link_(link), listener_(listener), clock_(std::move(clock)) {}
  bool datagrams() const override { return link_.datagrams(); }
  std::size_t read(Bytes out) override;
  std::size_t write(ConstBytes packets) override { return link_.write(packets); }
  void peer_spoke() override { link_.peer_spoke(); }

 private:
  ByteLink& link_;
  RunListener& listener_;
  SlotClock clock_;
};

// Gives each piece in the slot in which it came, or, to a component that has no room for it then, as soon after as it reads. What the
// component answers goes nowhere.
class ReplayedLink final : public ByteLink {
 public:
  // The stream outlives it.
  ReplayedLink(const CommandStream& stream, SlotClock clock) : stream_(stream), clock_(std::move(clock)) {}
  bool datagrams() const override { return stream_.datagrams; }
  // Of a piece that `out` does not hold the rest follows; of a datagram it is lost, as on any link.
  std::size_t read(Bytes out) override;
  std::size_t write(ConstBytes packets) override { return packets.size(); }

 private:
  const CommandStream& stream_;
  SlotClock clock_;
  std::size_t piece_ = 0, at_ = 0;  // the next one, and its next byte
};

// The link of a run: an operator's, or what that of an earlier run sent, or none. Who listens to the run is told what comes.
class RunLink {
 public:
  // All that is given outlives it; null: there is none. `link` goes before `stream`.
  RunLink(ByteLink* link, const CommandStream* stream, RunListener* listener, const SlotClock& clock);
  RunLink(const RunLink&) = delete;
  RunLink& operator=(const RunLink&) = delete;
  ByteLink* get() { return used_; }  // null: none

 private:
  std::optional<ListenedLink> listened_;
  std::optional<ReplayedLink> replayed_;
  ByteLink* used_;
};

}  // namespace lasso::mdat
