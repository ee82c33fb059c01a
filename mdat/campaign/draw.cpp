#include "mdat/campaign/draw.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <boost/math/distributions/normal.hpp>
#include <cmath>
#include <numeric>

#include "fsw/geometry/portable_math.hpp"
#include "mdat/common/double_policy.hpp"

namespace lasso::mdat {
namespace {

boost::math::normal_distribution<double, DoublePolicy> standard_normal() { return {}; }

// Of a standard normal law between two ends: mirrored where both are above, as small numbers keep their digits and those near 1 do not.
double cut_normal(double low, double high, double share) {
  if (low > 0) return -cut_normal(-high, -low, 1 - share);
  const double below = boost::math::cdf(standard_normal(), low), inside = boost::math::cdf(standard_normal(), high) - below;
  constexpr double kBelowOne = 1 - 0x1p-53;  // where the sum rounds to 1, which has no quantile
  return std::clamp(boost::math::quantile(standard_normal(), std::min(below + share * inside, kBelowOne)), low, high);
}

double value_of(const Uniform& law, double share) { return std::clamp(law.low + share * (law.high - law.low), law.low, law.high); }

double value_of(const LogUniform& law, double share) {
  return std::clamp(law.low * std::exp(share * std::log(law.high / law.low)), law.low, law.high);
}

double value_of(const Normal& law, double share) {
  const double z = cut_normal((law.low - law.mean) / law.sigma, (law.high - law.mean) / law.sigma, share);
  return std::clamp(law.mean + law.sigma * z, law.low, law.high);
}

double value_of(const OneOf& law, double share) {
  double rest = share * std::accumulate(law.weights.begin(), law.weights.end(), 0.0);
  for (std::size_t i = 0; i + 1 < law.values.size(); ++i) {
    rest -= law.weights[i];
    if (rest < 0) return law.values[i];
  }
  return law.values.back();
}

double value_of(const Fixed& law, double /*share*/) { return law.value; }

std::size_t dimensions_of(const NumberLaw& law) { return std::holds_alternative<Fixed>(law) ? 0 : 1; }

std::size_t dimensions_of(const Dispersion& dispersion) {
  return std::visit(LawVisitor{[](const NumberLaw& law) { return dimensions_of(law); },
                               [](const AnyDirection& law) { return 2 + dimensions_of(law.length); },
                               [](const AnyAttitude&) -> std::size_t { return 3; }, [](const Correlated& law) { return law.mean.size(); },
                               [](const Rows& law) -> std::size_t { return law.in_order ? 0 : 1; }},
                    dispersion.law);
}

std::size_t dimensions_of(const std::vector<Dispersion>& dispersions) {
  std::size_t sum = 0;
  for (const Dispersion& dispersion : dispersions) sum += dimensions_of(dispersion);
  return sum;
}

// One case: takes the numbers of its point, one after the other, and appends values.
class CaseDraw {
 public:
  CaseDraw(std::uint32_t case_number, std::vector<double> point, std::vector<double>& values)
      : case_(case_number), point_(std::move(point)), values_(values) {}

  void operator()(const NumberLaw& law) { values_.push_back(number(law)); }

  // A height, and an angle about it: each part of the sphere has the share of its area (Archimedes).
  void operator()(const AnyDirection& law) {
    const double height = 2 * next() - 1;
    const SinCos turn = sin_cos(2 * kPi * next());
    const double length = number(law.length), across = length * std::sqrt(1 - height * height);
    values_.insert(values_.end(), {across * turn.cos, across * turn.sin, length * height});
  }

  // Roll, tilt and boresight turn about x, the horizontal and the boresight: uniform on the rotations where the sine of the tilt is.
  void operator()(const AnyAttitude&) {
    const double roll = 360 * next() - 180, tilt = arc_sine(2 * next() - 1) / kRadPerDeg;
    values_.insert(values_.end(), {roll, tilt, 360 * next() - 180});
  }

  // By the Cholesky factor. Each number is kept in its range by cutting off its own normal, given those before it.
  void operator()(const Correlated& law) {
    const auto size = static_cast<Eigen::Index>(law.mean.size());
    const Eigen::MatrixXd factor = Eigen::Map<const Eigen::MatrixXd>(law.covariance.data(), size, size).llt().matrixL();
    Eigen::VectorXd z = Eigen::VectorXd::Zero(size);
    for (Eigen::Index i = 0; i < size; ++i) {
      const auto at = static_cast<std::size_t>(i);
      const double mean = law.mean[at] + factor.row(i).head(i).dot(z.head(i));
      const double value = value_of(Normal{mean, factor(i, i), law.low[at], law.high[at]}, next());
      z[i] = (value - mean) / factor(i, i);
      values_.push_back(value);
    }
  }

  void operator()(const Rows& law) {
    const std::size_t rows = law.values.size() / columns;
    const std::size_t row = law.in_order ? case_ % rows : std::min(static_cast<std::size_t>(next() * static_cast<double>(rows)), rows - 1);
    const auto first = law.values.begin() + static_cast<std::ptrdiff_t>(row * columns);
    values_.insert(values_.end(), first, first + static_cast<std::ptrdiff_t>(columns));
  }

  std::size_t columns = 1;  // of the dispersion that is drawn

 private:
  double next() { return point_.at(taken_++); }
  double number(const NumberLaw& law) { return quantile_of(law, dimensions_of(law) == 0 ? 0.5 : next()); }

  std::uint32_t case_;
  std::vector<double> point_;
  std::size_t taken_ = 0;
  std::vector<double>& values_;
};

constexpr std::uint64_t kSeedStream = ~std::uint64_t{0};  // that of no dimension
constexpr std::uint64_t kSeeds = std::uint64_t{1} << 32;  // as many as a scenario has

}  // namespace

double quantile_of(const NumberLaw& law, double share) {
  return std::visit([&](const auto& l) { return value_of(l, share); }, law);
}

CaseDraws::CaseDraws(const CampaignSource& campaign)
    : seed_(campaign.seed),
      dispersions_(campaign.dispersions),
      sampler_(campaign.sampling, campaign.seed, campaign.cases, dimensions_of(campaign.dispersions)) {}

std::vector<std::string> CaseDraws::columns() const {
  std::vector<std::string> names;
  for (const Dispersion& dispersion : dispersions_) names.insert(names.end(), dispersion.columns.begin(), dispersion.columns.end());
  return names;
}

CaseValues CaseDraws::values(std::uint32_t case_number) const {
  CaseValues values{permuted(case_number, kSeeds, hash(seed_, kSeedStream, 0)), {}};
  CaseDraw draw(case_number, sampler_.point(case_number), values.numbers);
  for (const Dispersion& dispersion : dispersions_) {
    draw.columns = dispersion.columns.size();
    std::visit(draw, dispersion.law);
  }
  return values;
}

}  // namespace lasso::mdat
