#include "mdat/link/station.hpp"

#include <algorithm>
#include <chrono>
#include <thread>
#include <utility>

#include "fsw/link/link_report.hpp"
#include "mdat/common/errors.hpp"

namespace lasso::mdat {
namespace {

using Clock = std::chrono::steady_clock;
using Packet = std::vector<std::uint8_t>;

constexpr double kTakenWithin_s = 5;  // by a link that is full
// After a refusal that a stranger may have provoked, by a packet with the count of a signed command: a component answers within 2 frames.
constexpr double kOwnAnswer_s = 0.6;
constexpr auto kPause = std::chrono::milliseconds(2);
// Who does not know the counts before: any count is after the last one or, moved by half of all, is.
constexpr std::uint16_t kHalf = 1U << 13;

std::uint16_t some_count() {
  const auto now = std::chrono::system_clock::now().time_since_epoch();
  return static_cast<std::uint16_t>(std::chrono::duration_cast<std::chrono::milliseconds>(now).count() / 100 & kSequenceCountMask);
}

const DecodedItem* find_item(const DecodedPacket& packet, const std::string& item) {
  const auto found = std::find_if(packet.items.begin(), packet.items.end(), [&](const DecodedItem& it) { return item == it.row->name; });
  return found == packet.items.end() ? nullptr : &*found;
}

const Choice* choice_in(const DecodedPacket& packet, const std::string& item) {
  const DecodedItem* found = find_item(packet, item);
  return found != nullptr ? choice_of(*found->row, found->values.front()) : nullptr;
}

// Of an answer: the first of its reasons that is one.
std::string reason_of(const DecodedPacket& packet) {
  for (const char* item : {"fault", "mode_refusal", "start_refusal", "service_refusal"}) {
    const Choice* reason = choice_in(packet, item);
    if (reason == nullptr || !(item_value(packet, item) > 0)) continue;
    const std::string action = reason->action;
    return std::string(reason->name) + " (" + reason->meaning + ")" + (action.empty() ? "" : "; " + action);
  }
  return "no reason was given";
}

}  // namespace

double item_value(const DecodedPacket& packet, const std::string& item, std::size_t element) {
  const DecodedItem* found = find_item(packet, item);
  return found != nullptr && element < found->values.size() ? value_of(found->values[element]) : 0;
}

std::string item_name(const DecodedPacket& packet, const std::string& item) {
  const Choice* choice = choice_in(packet, item);
  return choice != nullptr ? choice->name : "unknown";
}

Station::Station(ByteLink& link, std::string name, Listener listener, std::uint16_t apid)
    : link_(link), name_(std::move(name)), apid_(apid), listener_(std::move(listener)), count_(some_count()), receiver_(apid) {}

void Station::set_count(std::uint16_t count) {
  count_ = count;
  agreed_ = true;
  fixed_ = true;
}

CommandAnswer Station::command(const PacketRow& row, const Values& values, bool arm, double wait_s) {
  if (arm) {
    const CommandAnswer armed = this->arm(row, wait_s);
    if (armed.outcome != Outcome::kDone) return armed;
  }
  return ask([&](std::uint16_t count) { return encode_command(row, values, count, apid_); }, wait_s);
}

CommandAnswer Station::arm(const PacketRow& row, double wait_s) {
  return ask([&](std::uint16_t count) { return arm_for(row, count, apid_); }, wait_s);
}

// Of a count that the component does not take, as others have counted on, the one half of all counts further on is taken, but where the
// last one was either of the two: then the one behind it is.
CommandAnswer Station::ask(const std::function<Packet(std::uint16_t)>& encode, double wait_s) {
  const std::uint16_t first = count_;
  CommandAnswer answer = wait_for(encode(count_++), wait_s);
  for (const unsigned further : {kHalf + 0U, kHalf + 1U, 1U}) {
    if (answer.outcome != Outcome::kRepeated || fixed_) break;
    count_ = static_cast<std::uint16_t>((first + further) & kSequenceCountMask);
    answer = wait_for(encode(count_++), wait_s);
  }
  agreed_ = agreed_ || answer.outcome == Outcome::kDone;
  return answer;
}

CommandAnswer Station::wait_for(const Packet& packet, double wait_s) {
  const std::uint32_t key = command_key({packet.data(), packet.size()});
  transmit(packet);
  const auto answered = [&] { return sent_[key].outcome != Outcome::kOpen; };
  const double quiet_s = silent_ ? std::min(silent_after_s_, wait_s) : 0;
  if (silent_ && !listen(quiet_s, answered)) std::exchange(silent_, nullptr)();
  static_cast<void>(listen(wait_s - quiet_s, answered));
  if (signer_ && sent_[key].outcome == Outcome::kRefused)
    static_cast<void>(listen(kOwnAnswer_s, [&] { return sent_[key].outcome != Outcome::kRefused; }));
  const CommandAnswer answer = sent_[key];
  sent_.erase(key);
  return answer;
}

void Station::send(const PacketRow& row, const Values& values) { transmit(encode_command(row, values, count_++, apid_)); }

void Station::transmit(const Packet& packet) {
  const Packet sent = signer_ ? signer_->sign(packet) : packet;
  ConstBytes rest(sent.data(), sent.size());
  const auto end = Clock::now() + std::chrono::duration<double>(kTakenWithin_s);
  while (!rest.empty()) {
    const std::size_t written = link_.write(rest);
    rest = rest.subspan(written, rest.size() - written);
    if (rest.empty()) break;
    if (Clock::now() > end) throw RunError(name_ + ": does not take the command");
    std::this_thread::sleep_for(kPause);
  }
  sent_[command_key({packet.data(), packet.size()})] = {};
}

std::size_t Station::unanswered() const {
  return static_cast<std::size_t>(
      std::count_if(sent_.begin(), sent_.end(), [](const auto& sent) { return sent.second.outcome == Outcome::kOpen; }));
}

std::string Station::failure() const {
  for (const auto& [key, answer] : sent_) {
    if (answer.outcome == Outcome::kFailed) return answer.why;
  }
  return "";
}

bool Station::listen(double seconds, const std::function<bool()>& done) {
  const auto end = Clock::now() + std::chrono::duration<double>(seconds);
  while (!done()) {
    if (Clock::now() > end) return false;
    if (ended_()) throw RunError(name_ + ": the other end has closed the link: it has ended, or others take all its connections");
    if (!receiver_.take(link_, [this](const DecodedPacket& packet) { note(packet); })) std::this_thread::sleep_for(kPause);
  }
  return true;
}

// By the time, so that it is not behind what others have counted since the last call.
bool Station::call() {
  const auto count = static_cast<std::uint16_t>((agreed_ ? count_++ : some_count() + shift_) & kSequenceCountMask);
  const Packet ping = encode_command(command_row("ping"), {}, count, apid_);
  called_ = command_key({ping.data(), ping.size()});
  const Packet sent = signer_ ? signer_->sign(ping) : ping;
  return link_.write({sent.data(), sent.size()}) > 0;
}

// A count half of all further on is taken where this one is not.
void Station::note_call(const DecodedPacket& packet) {
  std::uint32_t key = 0;
  if (!is_answer(packet.bytes, key) || key != called_) return;
  const bool refused = packet.bytes[8] == kSubserviceRefused;
  const bool repeated = refused && item_value(packet, "fault") == static_cast<double>(PacketFault::kRepeated);
  call_refusal_ = refused && !repeated ? refusal_of(packet) : "";
  if (!repeated) return;
  agreed_ = false;
  shift_ = static_cast<std::uint16_t>(shift_ ^ kHalf);
  if (!called_again_) (void)call();
  called_again_ = !called_again_;
}

// A component without a key takes a signature for bytes too many.
std::string Station::refusal_of(const DecodedPacket& packet) const {
  const bool too_long = item_value(packet, "fault") == static_cast<double>(PacketFault::kBadLength);
  return reason_of(packet) + (signer_ && too_long ? "; or leave --key out: a component without a key takes no signed command" : "");
}

void Station::note(const DecodedPacket& packet) {
  listener_(packet);
  if (packet.bytes[7] != kServiceVerification) return;
  note_call(packet);
  const auto sent = sent_.find(command_key(packet.bytes.subspan(kPacketHeaderBytes, 4)));
  if (sent == sent_.end()) return;
  CommandAnswer& answer = sent->second;
  const std::uint8_t subservice = packet.bytes[8];
  if (subservice == kSubserviceAccepted) accepted_();
  if (subservice == kSubserviceCompleted) answer.outcome = Outcome::kDone;
  if (subservice != kSubserviceFailed && subservice != kSubserviceRefused) return;
  if (answer.outcome == Outcome::kDone || answer.outcome == Outcome::kFailed) return;  // the refusal is of another packet
  const bool repeated = item_value(packet, "fault") == static_cast<double>(PacketFault::kRepeated);
  const Outcome refused = repeated ? Outcome::kRepeated : Outcome::kRefused;
  answer = {subservice == kSubserviceFailed ? Outcome::kFailed : refused, refusal_of(packet)};
}

}  // namespace lasso::mdat
