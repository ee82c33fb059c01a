// A component elsewhere that is watched by its link: its telemetry is recorded as it comes, and commands are sent to it.
#pragma once

#include <atomic>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>

#include "fsw/core/span.hpp"
#include "mdat/link/connection.hpp"
#include "mdat/serve/command_desk.hpp"

namespace lasso::mdat::serve {

struct WatchOrder {
  std::string address;            // as mdat monitor takes it
  std::filesystem::path mission;  // that it flies; empty: not known
  std::filesystem::path file;     // to write
  std::optional<Key> key;         // by which commands are signed
  std::uint16_t apid = kApid;
};

// Calls come from the watch's thread.
struct WatchTold {
  std::function<void()> begun;  // the mission is compiled, the link is open
  std::function<void(ConstBytes packet)> packet;
  // All so far is in the first so many bytes of this file. Another one than before: the component's clock began anew.
  std::function<void(const std::filesystem::path& file, std::uint64_t bytes, std::uint64_t frames)> written;
  // Several times a second, on the same link: why nothing can come (empty: it can), and bytes that belong to no packet.
  std::function<void(Connection& connection)> looked;
  std::function<void()> commanded;  // a command's phase has changed
};

// Until it is to end; the file is whole then. Sends what `desk` has, as long as the link is open. Throws InputError or MissionError: the
// mission, the link or the file cannot be opened.
void watch_link(const WatchOrder& order, const std::string& commit, const std::atomic<bool>& ending, CommandDesk& desk,
                const WatchTold& told);

// Only networks and serial devices are reached from a page: "", or why this is neither.
std::string address_fault(const std::string& address);

std::string watch_command(const WatchOrder& order);

}  // namespace lasso::mdat::serve
