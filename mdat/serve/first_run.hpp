// The recording of a first visit: the tenth-scale Hubble, tracked while it turns.
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>

namespace lasso::mdat::serve {

constexpr char kFirstName[] = "hubble_tenth-spin.mcap", kFirstScenario[] = "spin", kFirstMission[] = "hubble_tenth";

// The shipped mission: below the current folder (of the sources), beside the program, or where it was installed. None: it is not there.
std::optional<std::filesystem::path> first_mission();

// The command that does the same.
std::string first_command(const std::filesystem::path& mission, const std::filesystem::path& folder);

// Flies it and writes FOLDER/kFirstName, which appears whole or not at all. `tell` gets the share that is done. Throws InputError,
// MissionError or RunError.
void record_first(const std::filesystem::path& mission, const std::filesystem::path& folder, const std::string& commit,
                  const std::function<void(double)>& tell);

}  // namespace lasso::mdat::serve
