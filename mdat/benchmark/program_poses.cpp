#include "mdat/benchmark/program_poses.hpp"

#include <array>
#include <cmath>
#include <set>
#include <utility>

#include "hal_sim/csv_table.hpp"
#include "mdat/common/errors.hpp"
#include "mdat/common/output.hpp"
#include "mdat/common/text.hpp"
#include "mdat/replay/initial_poses.hpp"
#include "mdat/run/statistics.hpp"
#include "mdat/source/nearest.hpp"

namespace lasso::mdat {
namespace {

using sim::CsvTable;

constexpr char kPosesHeader[] = "body,scan,qx,qy,qz,qw,x_m,y_m,z_m";
// As the table has them, and where a covariance of (rotation, translation) has them.
constexpr std::pair<const char*, int> kAxes[] = {{"x", 3}, {"y", 4}, {"z", 5}, {"rx", 0}, {"ry", 1}, {"rz", 2}};

std::string term_name(std::size_t a, std::size_t b) { return std::string("cov_") + kAxes[a].first + "_" + kAxes[b].first; }

// f(a, b) for each pair of axes, the diagonal and what is right of it, row by row.
template <class Function>
void for_each_term(const Function& f) {
  for (std::size_t a = 0; a < std::size(kAxes); ++a) {
    for (std::size_t b = a; b < std::size(kAxes); ++b) f(a, b);
  }
}

// Where a table has the covariance.
class CovarianceColumns {
 public:
  CovarianceColumns(const CsvTable& table, const std::string& file) {
    std::string missing;
    for_each_term([&](std::size_t a, std::size_t b) {
      const auto column = table.find({term_name(a, b), term_name(b, a)});
      if (column) columns_.push_back(*column);
      if (!column && missing.empty()) missing = term_name(a, b);
    });
    if (columns_.empty() || missing.empty()) return;
    throw InputError(file + format(":1: has %zu of the 21 columns of the covariance, but not ", columns_.size()) + missing +
                     ": write all of them, or none");
  }

  bool are_there() const { return !columns_.empty(); }

  Mat6 read(const CsvTable& table) const {
    Mat6 covariance;
    std::size_t next = 0;
    for_each_term([&](std::size_t a, std::size_t b) {
      const int row = kAxes[a].second, column = kAxes[b].second;
      covariance(row, column) = covariance(column, row) = table.number(columns_[next++]);
    });
    if (std::isfinite(nees(Pose(), Pose(), covariance))) return covariance;
    throw InputError(table.place(columns_.front()) +
                     ": cov_x_x to cov_rz_rz: not positive definite; write it with 17 digits, or valid 0 where a direction is open");
  }

 private:
  std::vector<std::size_t> columns_;
};

// Reads a table row by row.
class PoseReader {
 public:
  PoseReader(const CsvTable& table, const std::string& file, const Protocol& protocol)
      : table_(table),
        protocol_(protocol),
        body_(table.need({"body"})),
        pose_(table),
        covariance_(table, file),
        valid_(table.find({"valid"})),
        time_(table.find({"time_s"})) {}

  bool covariances() const { return covariance_.are_there(); }

  ProgramPose read() {
    ProgramPose row;
    row.body = std::string(table_.field(body_));
    row.scan = pose_.scan(table_);
    check_scan(row);
    row.valid = !valid_ || table_.yes_or_no(*valid_);
    row.time_s = time();
    if (!row.valid) return row;
    row.T_sensor_target = pose_.read(table_);
    if (covariances()) row.covariance = covariance_.read(table_);
    return row;
  }

 private:
  void check_scan(const ProgramPose& row) {
    if (!has_body(protocol_, row.body))
      throw InputError(table_.place(body_) + ": body: the set has no '" + row.body + "'" + did_you_mean(row.body, body_names(protocol_)));
    if (!has_scan(protocol_.plan, row.scan))
      throw InputError(pose_.scan_place(table_) + ": scan: the set has no '" + row.scan + "', it has " + scan_name(protocol_.plan, 1) +
                       " to " + scan_name(protocol_.plan, protocol_.plan.scans));
    if (!named_.insert({row.body, row.scan}).second)
      throw InputError(pose_.scan_place(table_) + ": scan: '" + row.scan + "' of " + row.body + " has a row already; leave one");
  }

  // Unknown where nothing stands there.
  std::optional<double> time() const {
    if (!time_ || table_.field(*time_).empty()) return std::nullopt;
    const double time_s = table_.number(*time_);
    if (time_s >= 0) return time_s;
    throw InputError(table_.place(*time_) + format(": time_s: %g, expected seconds from 0 on, or nothing", time_s));
  }

  const CsvTable& table_;
  const Protocol& protocol_;
  std::size_t body_;
  PoseColumns pose_;
  CovarianceColumns covariance_;
  std::optional<std::size_t> valid_, time_;
  std::set<std::pair<std::string, std::string>> named_;
};

std::string pose_fields(const ProgramPose& row) {
  const Quat& q = row.T_sensor_target.q;
  const Vec3& p = row.T_sensor_target.p;
  return format(",%.17g,%.17g,%.17g,%.17g,%.17g,%.17g,%.17g", q.x(), q.y(), q.z(), q.w(), p.x(), p.y(), p.z());
}

std::string covariance_fields(const ProgramPose& row) {
  std::string text;
  for_each_term(
      [&](std::size_t a, std::size_t b) { text += row.valid ? format(",%.17g", row.covariance(kAxes[a].second, kAxes[b].second)) : ","; });
  return text;
}

std::string header(bool covariances) {
  std::string text = "body,scan,valid,time_s,qx,qy,qz,qw,x_m,y_m,z_m";
  if (covariances) for_each_term([&](std::size_t a, std::size_t b) { text += "," + term_name(a, b); });
  return text + "\n";
}

}  // namespace

ProgramPoses read_program_poses(const std::filesystem::path& file, const Protocol& protocol) {
  const std::string text = file_content(file);
  CsvTable table(file.string(), text, kPosesHeader);
  PoseReader reader(table, file.string(), protocol);
  ProgramPoses poses{file.stem().string(), reader.covariances(), {}};
  while (table.next()) poses.rows.push_back(reader.read());
  if (poses.rows.empty()) throw InputError(table.place() + ": no row follows the header; write a row for each scan that was tried");
  return poses;
}

std::string program_poses_csv(const ProgramPoses& poses) {
  std::string text = header(poses.covariances);
  for (const ProgramPose& row : poses.rows) {
    text += row.body + "," + row.scan + (row.valid ? ",1," : ",0,") + (row.time_s ? format("%.9f", *row.time_s) : "") +
            (row.valid ? pose_fields(row) : ",,,,,,,") + (poses.covariances ? covariance_fields(row) : "") + "\n";
  }
  return text;
}

}  // namespace lasso::mdat
