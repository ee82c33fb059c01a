// What a benchmark set is, as it stands in its folder: protocol.json, which any program can read (docs/benchmark-protocol.md).
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "mdat/missiondb/mission_source.hpp"
#include "mdat/run/knowable.hpp"

namespace lasso::mdat {

constexpr int kProtocolVersion = 1;  // counts up where the same plan gives other files, or a pose is judged otherwise
constexpr char kProtocolFile[] = "protocol.json", kMeshFile[] = "mesh.stl", kMissionFile[] = "mission.toml", kStartsFile[] = "starts.csv",
               kScansFolder[] = "scans";
constexpr double kShiftPerDeg = 0.01;  // of the body's size, for each degree that a start is turned

constexpr std::uint64_t kSeedMost = 4294967295, kBodiesMost = 10000, kScansMost = 10000;
constexpr double kStartLeast_deg = 0.1, kStartMost_deg = 20;  // as rough as mdat replay --wide takes them

// From which a set follows, byte for byte.
struct SetPlan {
  std::uint64_t seed = 0;             // of the first body; those of the others follow
  std::size_t bodies = 0, scans = 0;  // scans of each body
  std::optional<SensorKind> sensor;   // without one a body's size decides
  double start_deg = 0;               // how far starts are turned; they are shifted by kShiftPerDeg for each degree
  double start_share() const { return kShiftPerDeg * start_deg; }
};

struct ProtocolBody {
  std::string name;  // of its folder
  SensorKind sensor = SensorKind::kLaserCamera;
  KnowableNoise noise;  // as the mission states it
  double size_m = 0;    // largest side of its box
};

struct Protocol {
  SetPlan plan;
  std::string made_by;  // version of mdat
  std::vector<ProtocolBody> bodies;
  std::map<std::string, std::string> files;  // path in the folder, SHA-256
};

// "laser_camera" or "lidar".
const char* sensor_name(SensorKind sensor);
// Nothing for another name.
std::optional<SensorKind> sensor_named(const std::string& name);

// "body_2001" and "s01", as wide as the set needs.
std::string body_name(std::uint64_t seed);
std::string scan_name(const SetPlan& plan, std::size_t scan);

std::vector<std::string> body_names(const Protocol& protocol);
bool has_body(const Protocol& protocol, const std::string& body);
bool has_scan(const SetPlan& plan, const std::string& scan);

std::string protocol_json(const Protocol& protocol);

// Throws InputError that names the file, what is wrong with it and the remedy: none there, no JSON, of another version, not whole.
Protocol read_protocol(const std::filesystem::path& folder);

// Throws InputError that names the first file which is missing or not as `files` say.
void check_files(const std::filesystem::path& folder, const Protocol& protocol);

// Throws InputError that names the first file which the plan, made again, gives otherwise.
void check_made_again(const std::filesystem::path& folder, const Protocol& protocol, const Protocol& again);

}  // namespace lasso::mdat
