#include "mdat/benchmark/protocol.hpp"

#include <algorithm>
#include <charconv>
#include <nlohmann/json.hpp>
#include <utility>

#include "mdat/common/errors.hpp"
#include "mdat/common/output.hpp"
#include "mdat/common/text.hpp"
#include "mdat/common/version.hpp"
#include "mdat/run/symmetric_error.hpp"
#include "mdat/source/sha256.hpp"

namespace lasso::mdat {
namespace {

using ProtocolJson = nlohmann::ordered_json;
namespace fs = std::filesystem;

constexpr char kFormat[] = "3dlasso-benchmark", kBySize[] = "by size";
constexpr std::size_t kSetDigestShown = 12;

constexpr std::pair<SensorKind, const char*> kSensorNames[] = {{SensorKind::kLaserCamera, "laser_camera"},
                                                               {SensorKind::kTimeOfFlight, "lidar"}};

// As a person wrote it: without the digits that a factor leaves.
double written(double value) { return std::stod(format("%.9g", value)); }

ProtocolJson frames_json() {
  return {{"units", "metres, radians, seconds; quaternions x, y, z, w (Hamilton), of unit length"},
          {"sensor", "origin of all rays; x right, y down, z along the boresight"},
          {"target", "that of the mesh"},
          {"pose", "T_sensor_target: takes target coordinates to sensor coordinates"}};
}

ProtocolJson start_json(const SetPlan& plan) {
  return {{"turn_deg", plan.start_deg},
          {"shift_over_size", written(plan.start_share())},
          {"meaning", "the true pose turned about the body's middle, and shifted, both in a random direction"}};
}

// The score's definition, for a reader; score.hpp is what counts.
ProtocolJson score_json() {
  return {{"near_translation_over_size", kWrongShare},
          {"near_rotation_deg", written(kWrongTurn_rad / kRadPerDeg)},
          {"wrong_squared_error_over", kWrongSquared},
          {"error", "the least over the poses of the body that look exactly the same; translation is that of the target's origin"},
          {"right", "valid, and near: neither error is above these"},
          {"wrong",
           "valid, not near, and the squared error over the stated covariance is above wrong_squared_error_over; of a program "
           "that states no covariance: valid and not near"},
          {"refused", "not valid, or without a row"},
          {"determined", "three Cramer-Rao sigmas of the hits are near in each direction, or the labels of at least three rays tell"},
          {"nees", "mean squared error over covariance of the valid poses of a body; 6 where the covariance is honest"}};
}

ProtocolJson noise_json(const KnowableNoise& noise) {
  return {{"along_ray_m", written(noise.sigma0_m)},
          {"along_ray_per_depth2_per_m", written(noise.sigma_k_per_m)},
          {"across_ray_rad", written(noise.sigma_angle_rad)},
          {"surface_m", written(noise.surface_sigma_m)}};
}

ProtocolJson body_json(const ProtocolBody& body) {
  const std::string folder = body.name + "/";
  return {{"name", body.name},
          {"size_m", written(body.size_m)},
          {"sensor", sensor_name(body.sensor)},
          {"sigma", noise_json(body.noise)},
          {"mesh", folder + kMeshFile},
          {"mission", folder + kMissionFile},
          {"starts", folder + kStartsFile},
          {"scans", folder + kScansFolder}};
}

KnowableNoise noise_of(const ProtocolJson& json) {
  KnowableNoise noise;
  json.at("along_ray_m").get_to(noise.sigma0_m);
  json.at("along_ray_per_depth2_per_m").get_to(noise.sigma_k_per_m);
  json.at("across_ray_rad").get_to(noise.sigma_angle_rad);
  json.at("surface_m").get_to(noise.surface_sigma_m);
  return noise;
}

SensorKind known_sensor(const std::string& name, const std::string& file) {
  const std::optional<SensorKind> sensor = sensor_named(name);
  if (!sensor) throw InputError(file + ": sensor is '" + name + "', expected laser_camera or lidar: make the set again");
  return *sensor;
}

ProtocolBody body_of(const ProtocolJson& json, const std::string& file) {
  ProtocolBody body;
  json.at("name").get_to(body.name);
  json.at("size_m").get_to(body.size_m);
  body.sensor = known_sensor(json.at("sensor").get<std::string>(), file);
  body.noise = noise_of(json.at("sigma"));
  return body;
}

// Counts are unsigned in the text, or refused.
std::uint64_t count_in(const ProtocolJson& json, const char* key, std::uint64_t least, std::uint64_t most, const std::string& file) {
  const ProtocolJson& value = json.at(key);
  if (value.is_number_unsigned() && value.get<std::uint64_t>() >= least && value.get<std::uint64_t>() <= most)
    return value.get<std::uint64_t>();
  throw InputError(
      file + ": " + key + " is " + value.dump() +
      format(", expected %llu to %llu: make the set again", static_cast<unsigned long long>(least), static_cast<unsigned long long>(most)));
}

Protocol protocol_of(const ProtocolJson& json, const std::string& file) {
  Protocol protocol;
  json.at("made_by").get_to(protocol.made_by);
  protocol.plan.seed = count_in(json, "seed", 0, kSeedMost, file);
  protocol.plan.bodies = count_in(json, "bodies", 1, kBodiesMost, file);
  protocol.plan.scans = count_in(json, "scans", 1, kScansMost, file);
  const auto sensor = json.at("sensor").get<std::string>();
  if (sensor != kBySize) protocol.plan.sensor = known_sensor(sensor, file);
  json.at("start").at("turn_deg").get_to(protocol.plan.start_deg);
  if (!(protocol.plan.start_deg >= kStartLeast_deg && protocol.plan.start_deg <= kStartMost_deg))
    throw InputError(
        file + format(": turn_deg is %g, expected %g to %g: make the set again", protocol.plan.start_deg, kStartLeast_deg, kStartMost_deg));
  for (const ProtocolJson& body : json.at("targets")) protocol.bodies.push_back(body_of(body, file));
  json.at("sha256").get_to(protocol.files);
  return protocol;
}

std::string shown_digest(const std::string& digest) { return digest.substr(0, kSetDigestShown) + "..."; }

std::string digest_of(const fs::path& file) {
  try {
    return sha256_of_file(file);
  } catch (const std::runtime_error& error) {
    throw InputError(file.string() + ": " + error.what() + ": restore it, or make the set again");
  }
}

std::string two_digits_at_least(std::uint64_t number, std::uint64_t most) {
  const int width = std::max(2, static_cast<int>(std::to_string(most).size()));
  return format("%0*llu", width, static_cast<unsigned long long>(number));
}

}  // namespace

const char* sensor_name(SensorKind sensor) {
  for (const auto& [kind, name] : kSensorNames) {
    if (kind == sensor) return name;
  }
  return "";
}

std::optional<SensorKind> sensor_named(const std::string& name) {
  for (const auto& [kind, known] : kSensorNames) {
    if (name == known) return kind;
  }
  return std::nullopt;
}

std::string body_name(std::uint64_t seed) { return "body_" + std::to_string(seed); }

std::string scan_name(const SetPlan& plan, std::size_t scan) { return "s" + two_digits_at_least(scan, plan.scans); }

std::vector<std::string> body_names(const Protocol& protocol) {
  std::vector<std::string> names;
  for (const ProtocolBody& body : protocol.bodies) names.push_back(body.name);
  return names;
}

bool has_body(const Protocol& protocol, const std::string& body) {
  return std::any_of(protocol.bodies.begin(), protocol.bodies.end(), [&](const ProtocolBody& known) { return known.name == body; });
}

bool has_scan(const SetPlan& plan, const std::string& scan) {
  std::size_t number = 0;
  const char* const end = scan.data() + scan.size();
  const auto [stop, error] = std::from_chars(scan.data() + std::min<std::size_t>(1, scan.size()), end, number);
  return error == std::errc{} && stop == end && number >= 1 && number <= plan.scans && scan == scan_name(plan, number);
}

std::string protocol_json(const Protocol& protocol) {
  const SetPlan& plan = protocol.plan;
  ProtocolJson json;
  json["format"] = kFormat;
  json["version"] = kProtocolVersion;
  json["made_by"] = protocol.made_by;
  json["seed"] = plan.seed;
  json["bodies"] = plan.bodies;
  json["scans"] = plan.scans;
  json["sensor"] = plan.sensor ? sensor_name(*plan.sensor) : kBySize;
  json["start"] = start_json(plan);
  json["frames"] = frames_json();
  json["score"] = score_json();
  json["targets"] = ProtocolJson::array();
  for (const ProtocolBody& body : protocol.bodies) json["targets"].push_back(body_json(body));
  json["sha256"] = protocol.files;
  return json.dump(1) + "\n";
}

Protocol read_protocol(const fs::path& folder) {
  const std::string file = (folder / kProtocolFile).string();
  if (!fs::exists(file)) throw InputError(file + ": there is none; mdat benchmark make " + shell_word(folder.string()) + " makes a set");
  const ProtocolJson json = ProtocolJson::parse(file_content(file), nullptr, false);
  if (!json.is_object() || !json.contains("format") || json["format"] != kFormat)
    throw InputError(file + ": is not the protocol of a benchmark set: make the set again");
  try {
    if (json.at("version") != kProtocolVersion)
      throw InputError(file + ": is of version " + json.at("version").dump() + ", expected " + std::to_string(kProtocolVersion) +
                       ": score it with the mdat that made it, or make the set again");
    return protocol_of(json, file);
  } catch (const ProtocolJson::exception& error) {
    throw InputError(file + ": is not whole (" + error.what() + "): make the set again");
  }
}

void check_files(const fs::path& folder, const Protocol& protocol) {
  for (const auto& [name, digest] : protocol.files) {
    const std::string found = digest_of(folder / name);
    if (found == digest) continue;
    throw InputError((folder / name).string() + ": was changed after the set was made (SHA-256 " + shown_digest(found) + ", " +
                     kProtocolFile + " says " + shown_digest(digest) + "): restore it, or make the set again");
  }
}

void check_made_again(const fs::path& folder, const Protocol& protocol, const Protocol& again) {
  const std::string file = (folder / kProtocolFile).string();
  for (const auto& [name, digest] : again.files) {
    const auto found = protocol.files.find(name);
    if (found != protocol.files.end() && found->second == digest) continue;
    const std::string says = found == protocol.files.end() ? "does not list it" : "says " + shown_digest(found->second);
    throw InputError(file + ": seed " + std::to_string(protocol.plan.seed) + " gives another " + name + " (SHA-256 " +
                     shown_digest(digest) + ", " + kProtocolFile + " " + says +
                     "): file and protocol were changed, or made by another mdat (" + protocol.made_by + "; this is " + kVersion +
                     "): make the set again");
  }
  Protocol made = again;
  made.made_by = protocol.made_by;
  if (protocol_json(made) != protocol_json(protocol))
    throw InputError(file + ": was changed after the set was made: restore it, or make the set again");
}

}  // namespace lasso::mdat
