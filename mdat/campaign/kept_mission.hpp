// The files of a mission, copied into its campaign's folder: each case can be flown again from there, whatever becomes of the mission.
#pragma once

#include <filesystem>
#include <map>
#include <string>

#include "mdat/missiondb/mission_source.hpp"

namespace lasso::mdat {

// Names below the campaign's folder, "mission/...": as far apart as the originals are, so that what they say of each other holds.
struct KeptMission {
  std::string mission;                                     // its own file
  std::map<std::string, std::filesystem::path> originals;  // of each name
  std::map<std::string, std::string> digests() const;      // SHA-256 of the originals, by name. Throws InputError.
};
KeptMission kept_mission(const MissionSource& source);

// Copies all; the folder `mission` appears whole or not at all. One that was there is replaced. Throws InputError.
void keep_mission(const KeptMission& kept, const std::filesystem::path& folder);

}  // namespace lasso::mdat
