#include <cstdio>
#include <map>
#include <memory>

#include "fsw/geometry/se3.hpp"
#include "hal_sim/scan_file.hpp"
#include "mdat/common/errors.hpp"
#include "mdat/recording/recording_export.hpp"
#include "mdat/recording/scan_cloud.hpp"

namespace lasso::mdat {
namespace {

namespace fs = std::filesystem;
using mcap::MessageValue;

struct ScanRow {
  std::string name;
  Pose truth;
};

TimeUs stamp_us(const MessageValue& message) {
  const MessageValue& stamp = message.at("header").at("stamp");
  return stamp.at("sec").get<TimeUs>() * 1'000'000 + stamp.at("nanosec").get<TimeUs>() / 1000;
}

std::string csv_of_scan(const fs::path& file, const MessageValue& message) {
  const auto& bytes = message.at("data").get_binary();
  const ros::PointCloud cloud{{}, message.at("point_step").get<std::uint32_t>(), std::string(bytes.begin(), bytes.end())};
  std::vector<RangeSample> samples;
  if (!samples_of(cloud, stamp_us(message), samples) || samples.size() > kMaxRays)
    throw InputError(file.string() + ": /scan: is no scan of a run: expected a recording of mdat run --record");
  const auto image = std::make_unique<RangeImage>();
  for (const RangeSample& sample : samples) (void)image->samples.push_back(sample);
  return sim::scan_csv(*image);
}

Pose true_pose(const MessageValue& message) {
  const MessageValue &p = message.at("pose").at("position"), &q = message.at("pose").at("orientation");
  const auto number = [](const MessageValue& of, const char* name) { return of.at(name).get<double>(); };
  return {Quat(number(q, "w"), number(q, "x"), number(q, "y"), number(q, "z")), Vec3(number(p, "x"), number(p, "y"), number(p, "z"))};
}

std::string pose_row(const std::string& name, const Pose& pose) {
  char row[256];
  (void)std::snprintf(row, sizeof row, "%s,%.12f,%.12f,%.12f,%.12f,%.9f,%.9f,%.9f\n", name.c_str(), pose.q.x(), pose.q.y(), pose.q.z(),
                      pose.q.w(), pose.p.x(), pose.p.y(), pose.p.z());
  return row;
}

// Of the frame before; before the first one as far back as the second is after it.
Pose pose_before(const std::vector<ScanRow>& rows, std::size_t i) {
  if (i > 0) return rows[i - 1].truth;
  return rows.size() > 1 ? rows[0].truth * inverse(rows[1].truth) * rows[0].truth : rows[0].truth;
}

void add_pose_tables(const std::vector<ScanRow>& rows, ExportedFiles& result) {
  std::string truths = "scan,qx,qy,qz,qw,x_m,y_m,z_m\n", starts = truths;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    truths += pose_row(rows[i].name, rows[i].truth);
    starts += pose_row(rows[i].name, pose_before(rows, i));
  }
  result.files["truth.csv"] = truths;
  result.files["poses.csv"] = starts;
}

}  // namespace

ExportedFiles export_scans(const fs::path& file, const ExportOptions& options) {
  std::map<std::uint64_t, Pose> truths;        // by time: topics of large messages lie in chunks of their own
  std::map<std::uint64_t, std::string> scans;  // the same
  const auto wanted = [](const TopicName& name) { return name.topic == "/truth" || name.topic == "/scan"; };
  (void)read_topics(file, options.span, wanted, [&](const TopicMessage& message) {
    if (message.topic == "/truth") {
      truths[message.t_ns] = true_pose(message.value);
    } else {
      scans[message.t_ns] = csv_of_scan(file, message.value);
    }
  });
  ExportedFiles result;
  std::vector<ScanRow> rows;
  for (auto& [t_ns, text] : scans) {
    const auto truth = truths.find(t_ns);
    if (truth == truths.end()) continue;
    char name[24];
    (void)std::snprintf(name, sizeof name, "f%05zu", rows.size());
    result.files[std::string("scans/") + name + ".csv"] = std::move(text);
    rows.push_back({name, truth->second});
  }
  if (rows.empty())
    throw InputError(file.string() + ": no scan with its true pose in this span: expected a recording of mdat run --record");
  add_pose_tables(rows, result);
  return result;
}

}  // namespace lasso::mdat
