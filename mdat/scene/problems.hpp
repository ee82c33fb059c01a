// Gathers what is wrong with a scene or a file of it, so that a person can repair all of it at once. Inside of scene.
#pragma once

#include <algorithm>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "mdat/source/mission_error.hpp"

namespace lasso::mdat::scene {

// Where a mission says what a node or a motion is. Line 0: no place in the file is known.
struct Place {
  std::string file = "scene";
  int line = 0, column = 0;  // from 1
};

class Problems {
 public:
  explicit Problems(Place place) : place_(std::move(place)) {}

  void add(const std::string& key, const std::string& value, const std::string& expected) { add_at(place_, key, value, expected); }
  void add_at(const Place& place, const std::string& key, const std::string& value, const std::string& expected) {
    problems_.push_back({place.file, place.line, place.column, key, value, expected});
  }
  void require(bool holds, const std::string& key, const std::string& value, const std::string& expected) {
    if (!holds) add(key, value, expected);
  }
  bool empty() const { return problems_.empty(); }
  const std::vector<Problem>& all() const { return problems_; }
  void throw_if_any() const {
    if (empty()) return;
    std::vector<Problem> told(problems_.begin(), problems_.begin() + static_cast<std::ptrdiff_t>(std::min(problems_.size(), kMost)));
    if (problems_.size() > kMost) told.push_back({place_.file, 0, 0, "", "", std::to_string(problems_.size() - kMost) + " more problems"});
    throw MissionError(std::move(told));
  }

 private:
  static constexpr std::size_t kMost = 50;  // are told: a table has thousands of rows
  Place place_;
  std::vector<Problem> problems_;
};

}  // namespace lasso::mdat::scene
