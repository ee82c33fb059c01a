// What became of the poses of one body.
#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <vector>

#include "mdat/benchmark/subject.hpp"
#include "mdat/run/protection_level.hpp"
#include "mdat/run/symmetric_error.hpp"
#include "mdat/run/time_to_alert.hpp"

namespace lasso::bodies {

using mdat::Subject;

// A pose that was to be found: of a frame, a start or a search.
struct Trial {
  std::size_t number = 0, frame = 0;  // of the flight, or the start; in it
  double range_m = 0;
  bool determined = false;  // the scan can tell the pose
  bool valid = false;       // it is said that the pose can be trusted
  bool settled = true;      // false: of a flight, before its first valid pose
  bool among = false;       // of a search that is ambiguous: the right pose is among its candidates
  std::string reason;       // why it is not valid
  mdat::SymmetricError error;
  double sigma_m = 0, sigma_rad = 0;  // roots of the traces of its covariance
  mdat::ProtectionLevels level;

  bool is_wrong(double size_m) const { return valid && mdat::is_wrong(error, size_m); }
  bool is_misleading() const { return valid && (error.translation_m > level.position_m || error.rotation_rad > level.attitude_rad); }
};

struct Tally {
  std::size_t numbers = 0;  // flights, starts, searches
  std::size_t trials = 0, valid = 0, determined = 0, determined_valid = 0, settled_determined = 0, settled_valid = 0;
  std::size_t among = 0;  // determined, not valid, but among
  std::size_t wrong = 0, wrong_numbers = 0;
  std::size_t misleading = 0;                  // valid, and farther off than its protection level
  mdat::AlertTimes alert;                      // of flights
  double nees = 0;                             // mean of the valid ones; 0 where there is none
  double worst = 0;                            // of the valid ones: largest normalised error squared
  std::map<std::string, std::size_t> reasons;  // of determined ones that are not valid
  std::vector<Trial> wrong_trials;
  std::vector<std::string> again;  // of each flight with a wrong pose: the command that flies it again

  void add(const Trial& trial, double size_m);
};

// A body's line of the table.
struct Row {
  std::uint64_t seed = 0;
  std::string kind, what, sensor, symmetry;
  double size_m = 0;
  bool knowable = true;
  std::string failure;  // why it was not tried; empty: it was
  Tally tally;
};
Row row_of(const Subject& subject);

std::string table_csv(const std::vector<Row>& rows);
// A command a line.
std::string again_text(const std::vector<Row>& rows);
// Each wrong and valid pose.
std::string wrong_csv(const std::vector<Row>& rows);

// All bodies together, with exact limits of the shares, and the worst ones.
std::string summary_text(const std::string& what, const std::vector<Row>& rows);

}  // namespace lasso::bodies
