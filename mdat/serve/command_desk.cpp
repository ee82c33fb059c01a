#include "mdat/serve/command_desk.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "mdat/common/errors.hpp"
#include "mdat/link/dictionary_text.hpp"
#include "mdat/serve/http.hpp"

namespace lasso::mdat::serve {
namespace {

using DeskJson = nlohmann::ordered_json;

constexpr const char* kCommandPhases[] = {"waiting", "sent", "accepted", "executed", "failed", "refused", "unanswered", "not_sent"};
constexpr std::size_t kMostThatWait = 8;
constexpr double kCommandAnswer_s = 3;

// The error of a form is the first line: below it is help for the command line.
std::string first_line(const std::string& text) { return text.substr(0, text.find('\n')); }

const PacketRow& checked_row(const CommandOrder& order) {
  try {
    const PacketRow& row = command_row(order.name);
    if (order.arm && row.hazard == Hazard::kNone) throw InputError(order.name + ": is not hazardous, and needs no arm");
    if (!order.arm) static_cast<void>(encode_command(row, order.values, 0));
    return row;
  } catch (const InputError& error) {
    throw Refusal{400, first_line(error.what()), "correct it"};
  }
}

CommandPhase phase_of(Outcome outcome) {
  if (outcome == Outcome::kDone) return CommandPhase::kDone;
  if (outcome == Outcome::kFailed) return CommandPhase::kFailed;
  return outcome == Outcome::kOpen ? CommandPhase::kUnanswered : CommandPhase::kRefused;
}

bool hazardous(const std::string& name) { return command_row(name).hazard != Hazard::kNone; }

}  // namespace

const char* phase_name(CommandPhase phase) { return kCommandPhases[static_cast<std::size_t>(phase)]; }

std::uint64_t CommandDesk::order(const CommandOrder& order) {
  static_cast<void>(checked_row(order));
  const std::lock_guard lock(mutex_);
  const auto waits = [](const CommandRecord& record) { return record.phase == CommandPhase::kWaiting; };
  if (static_cast<std::size_t>(std::count_if(records_.begin(), records_.end(), waits)) >= kMostThatWait)
    throw Refusal{409, "too many commands wait", "see why the component does not answer"};
  records_.push_back({++last_, order, CommandPhase::kWaiting, ""});
  if (records_.size() > kMostRecords) records_.pop_front();
  return last_;
}

bool CommandDesk::waiting() const {
  const std::lock_guard lock(mutex_);
  return std::any_of(records_.begin(), records_.end(), [](const CommandRecord& record) { return record.phase == CommandPhase::kWaiting; });
}

bool CommandDesk::next(CommandRecord& record) {
  const std::lock_guard lock(mutex_);
  const auto found =
      std::find_if(records_.begin(), records_.end(), [](const CommandRecord& one) { return one.phase == CommandPhase::kWaiting; });
  if (found == records_.end()) return false;
  found->phase = CommandPhase::kSent;
  record = *found;
  return true;
}

void CommandDesk::note(std::uint64_t number, CommandPhase phase, const std::string& why) {
  const std::lock_guard lock(mutex_);
  for (CommandRecord& record : records_) {
    if (record.number != number) continue;
    record.phase = phase;
    record.why = why;
  }
}

void CommandDesk::work(Station& station, const std::function<void()>& changed) {
  CommandRecord record;
  if (!next(record)) return;
  const auto noted = [&](CommandPhase phase, const std::string& why) {
    note(record.number, phase, why);
    changed();
  };
  changed();
  station.on_acceptance([&] { noted(CommandPhase::kAccepted, ""); });
  const PacketRow& row = command_row(record.order.name);
  try {
    const CommandAnswer answer =
        record.order.arm ? station.arm(row, kCommandAnswer_s) : station.command(row, record.order.values, false, kCommandAnswer_s);
    noted(phase_of(answer.outcome), answer.outcome == Outcome::kOpen ? "no answer came within 3 s" : answer.why);
  } catch (const RunError& error) {
    noted(CommandPhase::kUnanswered, error.what());
  }
  station.on_acceptance([] {});
}

void CommandDesk::drop(const std::string& why) {
  const std::lock_guard lock(mutex_);
  for (CommandRecord& record : records_) {
    if (record.phase != CommandPhase::kWaiting) continue;
    record.phase = CommandPhase::kNotSent;
    record.why = why;
  }
}

std::deque<CommandRecord> CommandDesk::records() const {
  const std::lock_guard lock(mutex_);
  return records_;
}

void CommandDesk::clear() {
  const std::lock_guard lock(mutex_);
  records_.clear();
}

std::string commands_json() {
  const DeskJson dictionary = DeskJson::parse(dictionary_json());
  DeskJson commands = DeskJson::array(), enumerations = DeskJson::object();
  for (const DeskJson& packet : dictionary["packets"]) {
    if (packet["type"] != "command") continue;
    const std::string name = packet["name"];
    commands.push_back({{"name", name}, {"meaning", packet["meaning"]}, {"hazardous", hazardous(name)}, {"items", packet["items"]}});
    for (const DeskJson& item : packet["items"]) {
      if (!item.contains("enumeration")) continue;
      const std::string enumeration = item["enumeration"];
      enumerations[enumeration] = dictionary["enumerations"][enumeration];
    }
  }
  return DeskJson({{"commands", commands}, {"enumerations", enumerations}}).dump();
}

}  // namespace lasso::mdat::serve
