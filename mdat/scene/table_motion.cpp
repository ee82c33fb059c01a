#include "mdat/scene/table_motion.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "fsw/geometry/portable_math.hpp"
#include "hal_sim/scan_text.hpp"

namespace lasso::mdat::scene {
namespace {

constexpr double kFarthest_m = 1e9, kLongest_s = 1e9, kFastest = 1e9;  // as in a mission file
constexpr double kLengthTolerance = 1e-3;                              // of quaternions in files, which are rounded

std::size_t rows_of(const MotionTable& table) {
  const auto degree = static_cast<std::size_t>(table.degree);
  return table.interpolation == Interpolation::kHermite ? degree / 2 + 1 : degree + 1;
}

// The problems of a table's rows, each at its line.
class RowCheck {
 public:
  RowCheck(const MotionTable& table, const Place& place, Problems& problems) : table_(table), place_(place), problems_(problems) {}

  void check(std::size_t row) {
    row_ = row;
    check_time();
    check_numbers(table_.positions_m, kFarthest_m, "position");
    check_numbers(table_.velocities_mps, kFastest, "velocity");
    check_numbers(table_.omegas_radps, kFastest, "angular velocity");
    check_length();
    if (row > 0 && !table_.omegas_radps.empty() && !table_.attitudes.empty()) check_turn();
  }

 private:
  void check_time() {
    const double t_s = table_.times_s[row_];
    if (!(std::fabs(t_s) <= kLongest_s)) return complain("time", sim::text_of(t_s), "expected a number of seconds from -1e9 to 1e9");
    if (row_ == 0 || t_s > table_.times_s[row_ - 1]) return;
    complain("time", sim::text_of(t_s) + " s",
             "is not after " + sim::text_of(table_.times_s[row_ - 1]) + " s of the row before: sort the rows by time, each time once");
  }
  void check_numbers(const std::vector<Vec3>& column, double most, const char* key) {
    const bool good = column.empty() || (column[row_].cwiseAbs().array() <= most).all();  // no NaN is
    if (!good) complain(key, "", "expected finite numbers, each from -1e9 to 1e9");
  }
  void check_length() {
    if (table_.attitudes.empty()) return;
    const double length = table_.attitudes[row_].norm();
    if (std::fabs(length - 1) <= kLengthTolerance) return;  // no NaN is
    complain("quaternion", "length " + sim::text_of(length), "expected a quaternion of unit length, the scalar last");
  }
  void check_turn() {
    const double span_s = table_.times_s[row_] - table_.times_s[row_ - 1];
    const double rate_radps = std::max(table_.omegas_radps[row_].norm(), table_.omegas_radps[row_ - 1].norm());
    if (!(rate_radps * span_s >= kPi)) return;
    complain("angular velocity", sim::text_of(rate_radps) + " rad/s",
             "turns the node by half a turn or more since the row before: expected rows at most " + sim::text_of(kPi / rate_radps) +
                 " s apart, and radians");
  }
  void complain(const std::string& key, const std::string& value, const std::string& expected) {
    Place place = place_;
    if (!table_.lines.empty()) place.line = table_.lines[row_], place.column = 1;
    problems_.add_at(place, key, value, expected);
  }

  const MotionTable& table_;
  const Place& place_;
  Problems& problems_;
  std::size_t row_ = 0;
};

bool same_lengths(const MotionTable& table) {
  const auto fits = [&](std::size_t size) { return size == 0 || size == table.times_s.size(); };
  return fits(table.positions_m.size()) && fits(table.velocities_mps.size()) && fits(table.attitudes.size()) &&
         fits(table.omegas_radps.size()) && fits(table.lines.size());
}

void check_degree(const MotionTable& table, const Place& place, Problems& problems) {
  const int most = static_cast<int>(kMostNodes) - 1;
  if (table.degree < 1 || table.degree > most) {
    problems.add_at(place, "degree", std::to_string(table.degree), "expected a degree of interpolation from 1 to " + std::to_string(most));
  } else if (!table.positions_m.empty() && table.times_s.size() > 1 && rows_of(table) > table.times_s.size()) {
    problems.add_at(place, "degree", std::to_string(table.degree),
                    "needs " + std::to_string(rows_of(table)) + " rows, and there are " + std::to_string(table.times_s.size()) +
                        ": lower the degree of interpolation, or add rows");
  }
}

}  // namespace

void check_table(const MotionTable& table, const Place& place, Problems& problems) {
  if (table.times_s.empty()) problems.add_at(place, "", "", "has no row: expected at least one");
  if (!same_lengths(table)) return problems.add_at(place, "", "", "has columns of different lengths");
  RowCheck rows(table, place, problems);
  for (std::size_t row = 0; row < table.times_s.size(); ++row) rows.check(row);
  check_degree(table, place, problems);
}

TableMotion::TableMotion(MotionTable table, const Place& place) : table_(std::move(table)) {
  Problems problems(place);
  check_table(table_, place, problems);
  problems.throw_if_any();
  if (table_.times_s.size() == 1) table_.degree = 1, table_.interpolation = Interpolation::kLagrange;
  add_velocities();
  add_attitudes();
}

void TableMotion::add_velocities() {
  const bool needed = table_.interpolation == Interpolation::kHermite && !table_.positions_m.empty();
  if (!needed || !table_.velocities_mps.empty()) return;
  std::vector<Vec3> secants;
  for (std::size_t i = 1; i < table_.times_s.size(); ++i) {
    secants.emplace_back((table_.positions_m[i] - table_.positions_m[i - 1]) / (table_.times_s[i] - table_.times_s[i - 1]));
  }
  table_.velocities_mps = slopes(table_.times_s, secants);
  table_.degree = 3;
}

void TableMotion::add_attitudes() {
  for (const Quat& q : table_.attitudes) turnings_.push_back({normalized(q), Vec3::Zero()});
  if (turnings_.size() < 2) return;
  std::vector<Vec3> secants;
  for (std::size_t i = 1; i < turnings_.size() && table_.omegas_radps.empty(); ++i) {
    const Vec3 turn_rad = log_so3(turnings_[i - 1].q_a_b.conjugate() * turnings_[i].q_a_b);  // the same in the axes of both rows
    secants.emplace_back(turn_rad / (table_.times_s[i] - table_.times_s[i - 1]));
  }
  const std::vector<Vec3> omegas = secants.empty() ? std::vector<Vec3>{} : slopes(table_.times_s, secants);
  for (std::size_t i = 0; i < turnings_.size(); ++i) {
    turnings_[i].omega_b_radps = secants.empty() ? rotate(turnings_[i].q_a_b.conjugate(), table_.omegas_radps[i]) : omegas[i];
  }
}

// Between `row` and the next one: through the rows around them.
Sample TableMotion::position_at(std::size_t row, double t_s) const {
  const std::size_t count = rows_of(table_);
  const std::size_t before = (count - 1) / 2;
  const std::size_t first = std::min(row > before ? row - before : 0, table_.times_s.size() - count);
  const auto part = [&](const auto& column) { return std::span(column).subspan(first, count); };
  const bool hermite = table_.interpolation == Interpolation::kHermite;
  return interpolate(part(table_.times_s), part(table_.positions_m), hermite ? part(table_.velocities_mps) : std::span<const Vec3>{}, t_s);
}

MotionState TableMotion::at(TimeUs t_us) const {
  const double t_s = to_seconds(t_us);
  const std::vector<double>& times = table_.times_s;
  const auto after = static_cast<std::size_t>(std::upper_bound(times.begin(), times.end(), t_s) - times.begin());
  MotionState state;
  if (after == 0 || after == times.size()) {
    const std::size_t row = after == 0 ? 0 : after - 1;
    if (!table_.positions_m.empty()) state.T_a_b.p = table_.positions_m[row];
    if (!turnings_.empty()) state.T_a_b.q = turnings_[row].q_a_b;
    return state;
  }
  if (!table_.positions_m.empty()) {
    const Sample position = position_at(after - 1, t_s);
    state.T_a_b.p = position.value;
    state.rates.v_mps = position.derivative;
  }
  if (!turnings_.empty()) {
    const Turning turning = interpolate(turnings_[after - 1], turnings_[after], times[after] - times[after - 1], t_s - times[after - 1]);
    state.T_a_b.q = turning.q_a_b;
    state.rates.omega_radps = rotate(turning.q_a_b, turning.omega_b_radps);
  }
  return state;
}

}  // namespace lasso::mdat::scene
