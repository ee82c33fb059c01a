// What a campaign of a mission varies from case to case, and what it asks of them: [campaign.NAME] of a mission file, checked.
#pragma once

#include <cstdint>
#include <string>
#include <variant>
#include <vector>

namespace lasso::mdat {

// Laws of one number, in the unit that its key names. `low`, `high` of a normal one: what lies beyond is never drawn (truncated, not
// clipped). Where the mission says nothing of them, they are the range of the key.
struct Uniform {
  double low = 0, high = 1;
};
struct LogUniform {
  double low = 1, high = 10;  // > 0; the logarithm is uniform
};
struct Normal {
  double mean = 0, sigma = 1, low = 0, high = 0;
};
struct OneOf {
  std::vector<double> values, weights;  // as many weights, > 0, of any sum
};
struct Fixed {
  double value = 0;
};
using NumberLaw = std::variant<Fixed, Uniform, LogUniform, Normal, OneOf>;

// Laws of several numbers at once.
struct AnyDirection {
  NumberLaw length;  // of a vector of three; each direction is as likely as any other
};
struct AnyAttitude {};  // roll, tilt, boresight in degrees: each attitude is as likely as any other
struct Correlated {
  std::vector<double> mean, covariance;  // normal; the matrix by rows, symmetric, positive definite
  std::vector<double> low, high;         // the ranges of the keys, 4 sigma away or more: what lies beyond is never drawn
};
struct Rows {
  std::string file;            // CSV, as it was written in the mission
  bool in_order = true;        // case k takes row k (modulo their number); otherwise each row is as likely as any other
  std::vector<double> values;  // by rows
};
using Law = std::variant<NumberLaw, AnyDirection, AnyAttitude, Correlated, Rows>;

// For std::visit of a law: a call operator for each kind.
template <class... Functions>
struct LawVisitor : Functions... {
  using Functions::operator()...;
};

// Some columns of the table of cases, and the law that they follow together. A column is named as a mission file names the value, after
// "mission." (the component believes it: it goes into the image) or "truth." (it is simulated: a key of the scenario); of a list's number a
// final ".x", ".y", ".z" or, where there are more than three, ".1", ".2", ... follows.
struct Dispersion {
  std::vector<std::string> columns;
  Law law;
  std::string key{};  // where the mission says it: "campaign.NAME.truth.range_m", "campaign.NAME.together[0]"
};

enum class Sampling : std::uint8_t { kRandom = 0, kLatinHypercube = 1, kSobol = 2 };

// Asks that a figure of a case (a column of the results) is within bounds, in at least a share of all possible cases, with confidence: the
// criterion is met if the lower limit of the share is at least `share_min`, and failed if the upper one is below it.
struct Criterion {
  std::string name, figure;
  double at_least = 0, at_most = 0;  // infinite where there is no bound
  double share_min = 1;              // < 1 where it is to be decided: no number of cases shows 1
  double confidence = 0.95;
};

struct CampaignSource {
  std::string name, scenario;
  std::uint32_t cases = 0;  // with a stopping rule: at most
  std::uint64_t seed = 1;
  std::uint32_t frames = 0;  // of a case; 0: as the scenario says
  Sampling sampling = Sampling::kRandom;
  std::uint32_t look_every = 0;  // cases between two looks of the stopping rule; 0: none, all are flown
  std::vector<Dispersion> dispersions;
  std::string sensor = "simulated";        // or at the end of its line, as mdat run --sensor names it
  std::vector<std::string> fault_scripts;  // files, found; each case has one of them
  std::vector<Criterion> criteria;
};

}  // namespace lasso::mdat
