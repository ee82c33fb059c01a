#include "mdat/missiondb/depth_camera_file.hpp"

#include "mdat/missiondb/toml_reader.hpp"

namespace lasso::mdat {
namespace {

ValueRow real(const char* key, const char* unit, double minimum, double maximum, const char* meaning) {
  ValueRow row;
  row.meaning = meaning;
  row.key = key;
  row.unit = unit;
  row.kind = ValueKind::kReal;
  row.minimum = minimum;
  row.maximum = maximum;
  row.count_min = row.count_max = 1;
  row.required = true;
  return row;
}

ValueRow values_row() {
  ValueRow row = real("values", "1", 0, 1, "what pixels are");
  row.kind = ValueKind::kChoice;
  row.choices = {"depth", "range"};
  row.required = false;
  return row;
}

}  // namespace

sim::DepthCamera load_depth_camera(const std::filesystem::path& file) {
  constexpr double kLargest = 1e6;  // pixels
  const std::vector<ValueRow> rows = {real("fx", "pixels", 1e-3, kLargest, "focal length along x"),
                                      real("fy", "pixels", 1e-3, kLargest, "focal length along y"),
                                      real("cx", "pixels", -kLargest, kLargest, "principal point, from the left"),
                                      real("cy", "pixels", -kLargest, kLargest, "principal point, from the top"),
                                      real("scale_m", "m", 1e-9, 1e3, "length of one step of a pixel's value"),
                                      values_row()};
  ProblemList problems(file);
  const FoundValues found = read_table(parse_toml(file), "", rows, {}, problems);
  problems.throw_if_any();
  const auto value = [&](const char* key) { return found.at(key).numbers.at(0); };
  return {value("fx"), value("fy"), value("cx"), value("cy"), value("scale_m"), found.count("values") > 0 && value("values") > 0.5};
}

}  // namespace lasso::mdat
