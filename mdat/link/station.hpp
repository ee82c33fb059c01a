// The ground's end of a link: numbers commands, sends them, and learns from telemetry what became of each.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "fsw/link/byte_link.hpp"
#include "fsw/link/commands.hpp"
#include "mdat/link/command_encoder.hpp"
#include "mdat/link/decode.hpp"
#include "mdat/link/signature.hpp"
#include "mdat/link/telemetry_receiver.hpp"

namespace lasso::mdat {

// Refused: it was not looked at, as if it had been lost on the way; repeated: so, for its sequence count.
enum class Outcome { kOpen, kDone, kFailed, kRefused, kRepeated };

// What became of a command; where it failed, the reason: its name, meaning and remedy.
struct CommandAnswer {
  Outcome outcome = Outcome::kOpen;
  std::string why;
};

class Station {
 public:
  using Values = std::map<std::string, std::string>;
  using Listener = TelemetryReceiver::Listener;

  // Of the component `apid`. `name` stands in errors. The listener gets each packet that comes, before anything else is done with it. The
  // link outlives the station.
  Station(ByteLink& link, std::string name, Listener listener, std::uint16_t apid = kApid);

  // From now on commands are signed.
  void sign_with(const Key& key) { signer_.emplace(key); }

  // From now on counts go on from here; otherwise they are such that the component takes them.
  void set_count(std::uint16_t count);

  // Sends a command, and waits until it is answered, at most so long: kOpen then. Armed first, if asked for. Throws RunError where the
  // link takes nothing.
  CommandAnswer command(const PacketRow& row, const Values& values, bool arm, double wait_s);

  // The command that arms a hazardous one, which is carried out within kArmFrames frames. As command().
  CommandAnswer arm(const PacketRow& row, double wait_s);
  // Called once where the answer to a command has not come after so long.
  void on_silence(double after_s, std::function<void()> silent) {
    silent_after_s_ = after_s;
    silent_ = std::move(silent);
  }
  // Whether the other end has gone for good: what waits for an answer throws RunError then, instead of waiting on.
  void end_where(std::function<bool()> ended) { ended_ = std::move(ended); }
  // Called where a command is reported as accepted, before its end.
  void on_acceptance(std::function<void()> accepted) { accepted_ = std::move(accepted); }

  // Sends a command and does not wait. Throws RunError.
  void send(const PacketRow& row, const Values& values);
  // Commands that were sent and neither answered nor forgotten.
  std::size_t unanswered() const;
  // Why one of those that were sent and not waited for failed; empty where none did. One that was refused did not: others overtook it.
  std::string failure() const;
  // Of all that were sent: their answers are of no interest any more.
  void forget() { sent_.clear(); }

  // Sends a ping: a component at the other end of datagrams learns where to send its telemetry. Where it is refused for its count, the next
  // one has another. False: the link takes nothing now.
  bool call();
  // Why the last call was refused, its count aside; empty: it was not, or nothing has answered it.
  const std::string& call_refusal() const { return call_refusal_; }

  // Bytes that have come and belong to no packet.
  std::uint64_t other_bytes() const { return receiver_.other_bytes(); }

  // Takes telemetry until `done` holds, at most so long. Whether it does. Throws RunError where the other end has gone.
  bool listen(double seconds, const std::function<bool()>& done);

 private:
  CommandAnswer ask(const std::function<std::vector<std::uint8_t>(std::uint16_t)>& encode, double wait_s);
  CommandAnswer wait_for(const std::vector<std::uint8_t>& packet, double wait_s);
  void transmit(const std::vector<std::uint8_t>& packet);
  void note(const DecodedPacket& packet);
  void note_call(const DecodedPacket& packet);
  std::string refusal_of(const DecodedPacket& packet) const;

  ByteLink& link_;
  std::string name_;
  std::uint16_t apid_;
  Listener listener_;
  std::function<void()> accepted_ = [] {};
  std::function<bool()> ended_ = [] { return false; };
  double silent_after_s_ = 0;
  std::function<void()> silent_;  // none: nobody wants to know, or it was called
  std::optional<Signer> signer_;
  std::uint16_t count_;
  std::uint32_t called_ = 0;  // key of the last call
  std::string call_refusal_;
  bool called_again_ = false;                    // with another count
  std::uint16_t shift_ = 0;                      // of counts by the time, for calls
  bool agreed_ = false;                          // the component has taken a count, or somebody has set it
  bool fixed_ = false;                           // somebody has
  std::map<std::uint32_t, CommandAnswer> sent_;  // by the first four bytes
  TelemetryReceiver receiver_;
};

// The first value of an item; 0 where the packet does not have it.
double item_value(const DecodedPacket& packet, const std::string& item, std::size_t element = 0);
// Its name, where it has names.
std::string item_name(const DecodedPacket& packet, const std::string& item);

}  // namespace lasso::mdat
