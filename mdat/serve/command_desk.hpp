// Commands that a page gives to the component that it is connected to: sent one after the other, and what became of each.
#pragma once

#include <cstdint>
#include <deque>
#include <functional>
#include <mutex>
#include <string>

#include "mdat/link/station.hpp"

namespace lasso::mdat::serve {

struct CommandOrder {
  std::string name;  // of the dictionary
  Station::Values values;
  bool arm = false;  // not the command, but the one that arms it
};

enum class CommandPhase : std::uint8_t { kWaiting, kSent, kAccepted, kDone, kFailed, kRefused, kUnanswered, kNotSent };

struct CommandRecord {
  std::uint64_t number = 0;  // from 1
  CommandOrder order;
  CommandPhase phase = CommandPhase::kWaiting;
  std::string why;  // of what was not done: reason, meaning and remedy
};

constexpr std::size_t kMostRecords = 10;  // the last ones

// Safe for several threads; work() is for one.
class CommandDesk {
 public:
  // Its number. Throws Refusal: 400 what the dictionary does not have, in its words; 409 too many wait.
  std::uint64_t order(const CommandOrder& order);
  bool waiting() const;
  // Sends the first that waits, and waits for its answer, some seconds at most. `changed` is called at each change of its phase.
  void work(Station& station, const std::function<void()>& changed);
  // None that waits is sent any more: nobody wants a command of a link that was lost to be carried out at some later time.
  void drop(const std::string& why);
  // The last ones, the newest at the end.
  std::deque<CommandRecord> records() const;
  void clear();

 private:
  bool next(CommandRecord& record);
  void note(std::uint64_t number, CommandPhase phase, const std::string& why);

  mutable std::mutex mutex_;
  std::deque<CommandRecord> records_;
  std::uint64_t last_ = 0;
};

const char* phase_name(CommandPhase phase);

// What can be ordered, as JSON: names, meanings, whether a command has to be armed, and its items as `mdat dictionary --format json` tells
// them.
std::string commands_json();

}  // namespace lasso::mdat::serve
