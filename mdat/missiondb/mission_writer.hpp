// The text of a new mission for any target: all keys with their meanings, lengths that fit its size, and scenarios.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "mdat/missiondb/mesh_facts.hpp"
#include "mdat/missiondb/mission_source.hpp"

namespace lasso::mdat {

// What has to be known before a line is written.
struct NewMission {
  std::string name, path, sha256;  // of the target's file; its path as the mission says it
  bool parametric = false;         // the file is a model (TOML), not a mesh
  double scale = 1;
  Eigen::Vector3d origin_m = Eigen::Vector3d::Zero();  // target.origin_m
  MeshSize size;                                       // about that origin
  double cell_size_m = 0, surface_sigma_m = 0;
  std::optional<SensorKind> sensor;  // where one is asked for
  std::vector<std::string> remarks;  // what was guessed, a line each
};

// The preset of a length, for a target of this size: presets are those of the tenth-scale Hubble.
double sized_preset(const std::string& key, double largest_m);

// Where the sphere about the target fills nine tenths of the field of view, or farther, where a laser camera would see nothing so near.
double initial_range_m(const MeshSize& size);

// The sensor that is asked for; otherwise a LIDAR where the scenarios lead beyond a laser camera's ranges. A laser camera's noise at the
// initial range grows with the target.
struct RangeNoise {
  SensorKind kind = SensorKind::kLaserCamera;
  double sigma0_m = 0, sigma_k_per_m = 0;
};
RangeNoise guessed_noise(const MeshSize& size, std::optional<SensorKind> sensor);

std::string new_mission_text(const NewMission& mission);

}  // namespace lasso::mdat
