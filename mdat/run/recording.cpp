#include "mdat/run/recording.hpp"

#include <algorithm>
#include <cstdio>
#include <fstream>
#include <iterator>
#include <regex>
#include <stdexcept>
#include <vector>

#include "hal_sim/scan_file.hpp"
#include "mdat/common/errors.hpp"
#include "mdat/common/output.hpp"

namespace lasso::mdat {
namespace {

constexpr char kHeader[] = "scan,qx,qy,qz,qw,x_m,y_m,z_m\n";

std::string scan_name(std::uint32_t frame) {
  char name[16];
  std::snprintf(name, sizeof name, "f%05u", frame);
  return name;
}

std::string pose_row(std::uint32_t frame, const Pose& pose) {
  char row[256];
  std::snprintf(row, sizeof row, "%s,%.12f,%.12f,%.12f,%.12f,%.9f,%.9f,%.9f\n", scan_name(frame).c_str(), pose.q.x(), pose.q.y(),
                pose.q.z(), pose.q.w(), pose.p.x(), pose.p.y(), pose.p.z());
  return row;
}

// "4m"; where several runs have this range, "4m_2" is the second of them.
std::string run_name(const std::vector<double>& ranges_m, std::size_t run) {
  const auto here = ranges_m.begin() + static_cast<std::ptrdiff_t>(run);
  const auto before = std::count(ranges_m.begin(), here, *here);
  char name[48];
  std::snprintf(name, sizeof name, before > 0 ? "%gm_%td" : "%gm", *here, before + 1);
  return name;
}

void write_scan(const std::filesystem::path& folder, const KeptScan& scan) {
  const auto image = std::make_unique<RangeImage>();
  for (const RangeSample& sample : scan.samples) (void)image->samples.push_back(sample);  // a scan has at most kMaxRays
  sim::write_scan_csv(folder / (scan_name(scan.frame) + ".csv"), *image);
}

// Of an earlier recording: replay would read them with the new ones.
void remove_scans(const std::filesystem::path& folder) {
  const std::regex scan("f[0-9]{5,}\\.csv");
  std::vector<std::filesystem::path> earlier;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    if (std::regex_match(entry.path().filename().string(), scan)) earlier.push_back(entry.path());
  }
  for (const std::filesystem::path& file : earlier) std::filesystem::remove(file);
}

void write_range(const std::filesystem::path& folder, const CaseResult& run) {
  OutputFolder scans(folder / "scans");
  remove_scans(scans.path());
  std::string truth_rows = kHeader, start_rows = kHeader;
  for (const KeptScan& scan : run.scans) {
    write_scan(scans.path(), scan);
    truth_rows += pose_row(scan.frame, scan.truth);
    start_rows += pose_row(scan.frame, scan.truth_before);
  }
  scans.commit();
  write_file(folder / "truth.csv", truth_rows);
  write_file(folder / "poses.csv", start_rows);
}

}  // namespace

void write_recording(const CompiledMission& mission, SimulationOptions options, const std::filesystem::path& folder) {
  options.plain = true;
  options.keep_scans = true;
  const SimulationResult result = simulate(mission, options);
  const TableResult& table = result.tables.front();
  const VariantResult& variant = table.variants.front();
  for (std::size_t i = 0; i < variant.cases.size(); ++i) write_range(folder / run_name(table.scenario.runs_m(), i), variant.cases[i]);
}

std::string recording_text(const sim::SensorRecording& recording) {
  const std::vector<std::uint8_t> bytes = sim::to_bytes(recording);
  return {bytes.begin(), bytes.end()};
}

std::shared_ptr<const sim::SensorRecording> load_sensor_recording(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  const std::vector<std::uint8_t> bytes((std::istreambuf_iterator<char>(in)), {});
  if (!in) throw InputError("--sensor replay: " + file.string() + ": cannot be read");
  try {
    return std::make_shared<const sim::SensorRecording>(sim::recording_of(ConstBytes(bytes.data(), bytes.size())));
  } catch (const std::invalid_argument& error) {
    throw InputError("--sensor replay: " + file.string() + ": " + error.what());
  }
}

}  // namespace lasso::mdat
