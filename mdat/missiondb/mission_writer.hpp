// The text of a new mission for any target: all keys with their meanings, lengths that fit its size, and scenarios.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "mdat/missiondb/mesh_facts.hpp"

namespace lasso::mdat {

// What has to be known before a line is written.
struct NewMission {
  std::string name, path, sha256;  // of the target's file; its path as the mission says it
  bool parametric = false;         // the file is a model (TOML), not a mesh
  double scale = 1;
  Eigen::Vector3d origin_m = Eigen::Vector3d::Zero();  // target.origin_m
  MeshSize size;                                       // about that origin
  double cell_size_m = 0, surface_sigma_m = 0;
  std::vector<std::string> remarks;  // what was guessed, a line each
};

// The preset of a length, for a target of this size: presets are those of the tenth-scale Hubble.
double sized_preset(const std::string& key, double largest_m);

// How the guessed range noise of a laser camera grows, of the square of the range: less for a larger target, never finer than its counts.
double noise_growth_per_m(double largest_m);

// Where the sphere about the target fills nine tenths of the field of view.
double initial_range_m(const MeshSize& size);

std::string new_mission_text(const NewMission& mission);

}  // namespace lasso::mdat
