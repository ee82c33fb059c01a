#include "mdat/missiondb/stereo_pair_file.hpp"

#include <cmath>

#include "fsw/geometry/so3.hpp"
#include "mdat/missiondb/toml_reader.hpp"

namespace lasso::mdat {
namespace {

constexpr double kLargest_px = 1e6, kWidest_px = 8192, kUnitWithin = 1e-3;

ValueRow pair_row(const std::string& key, const char* unit, ValueKind kind, double minimum, double maximum, const char* meaning) {
  ValueRow row = number_row("", unit, kind, 1, minimum, maximum, 0, meaning);
  row.key = key;
  row.preset.clear();
  return required(row);
}

ValueRow optional_row(ValueRow row) {
  row.required = false;
  return row;
}

ValueRow numbers_row(ValueRow row, std::size_t count) {
  row.kind = ValueKind::kReals;
  row.count_min = row.count_max = count;
  return row;
}

ValueRow codes_row() {
  ValueRow row = optional_row(pair_row("codes", "1", ValueKind::kChoice, 0, 1, "how the codes of the pictures grow with the light"));
  row.choices = {"square_root", "linear"};
  return row;
}

void add_camera_rows(const std::string& name, std::vector<ValueRow>& rows) {
  using enum ValueKind;
  rows.push_back(pair_row(name + ".width", "pixels", kInteger, 16, kWidest_px, "of the picture"));
  rows.push_back(pair_row(name + ".height", "pixels", kInteger, 16, kWidest_px, "of the picture"));
  rows.push_back(numbers_row(pair_row(name + ".focal_px", "pixels", kReal, 1, kLargest_px, "focal lengths along x and y"), 2));
  rows.push_back(numbers_row(pair_row(name + ".center_px", "pixels", kReal, -kLargest_px, kLargest_px, "principal point: column, row"), 2));
  rows.push_back(
      optional_row(numbers_row(pair_row(name + ".distortion", "1", kReal, -100, 100, "k1, k2, p1, p2, k3, as OpenCV has them"), 5)));
}

const std::vector<ValueRow>& pair_rows() {
  using enum ValueKind;
  static const std::vector<ValueRow> rows = [] {
    std::vector<ValueRow> all;
    add_camera_rows("left", all);
    add_camera_rows("right", all);
    all.push_back(
        numbers_row(pair_row("right.position_m", "m", kReal, -1000, 1000, "in the left camera's axes: x right, y down, z ahead"), 3));
    all.push_back(
        optional_row(numbers_row(pair_row("right.quaternion", "1", kReal, -1, 1, "x, y, z, w: takes its axes to the left camera's"), 4)));
    all.push_back(codes_row());
    all.push_back(optional_row(pair_row("full_well_e", "1", kReal, 100, 1e7, "electrons at the greatest code")));
    all.push_back(optional_row(pair_row("read_noise_e", "1", kReal, 0, 1000, "electrons, 1 sigma")));
    return all;
  }();
  return rows;
}

double pair_number(const FoundValues& found, const std::string& key, double preset) {
  const auto value = found.find(key);
  return value == found.end() ? preset : value->second.numbers.at(0);
}

PairCamera pair_camera(const FoundValues& found, const std::string& name) {
  const auto list = [&](const char* key) { return found.at(name + key).numbers; };
  PairCamera camera;
  camera.width = static_cast<int>(list(".width").at(0));
  camera.height = static_cast<int>(list(".height").at(0));
  camera.focal_x_px = list(".focal_px")[0];
  camera.focal_y_px = list(".focal_px")[1];
  camera.center_x_px = list(".center_px")[0];
  camera.center_y_px = list(".center_px")[1];
  const auto distortion = found.find(name + ".distortion");
  for (std::size_t i = 0; distortion != found.end() && i < camera.distortion.size(); ++i)
    camera.distortion[i] = distortion->second.numbers[i];
  return camera;
}

void read_place(const FoundValues& found, StereoPair& pair, ProblemList& problems) {
  const FoundValue& position = found.at("right.position_m");
  pair.T_left_right.p = Vec3(position.numbers.data());
  const Vec3 size = pair.T_left_right.p.cwiseAbs();
  if (!(pair.T_left_right.p.x() > std::max(size.y(), size.z())))
    problems.add(position.origin, "right.position_m", "",
                 "expected a camera to the right of the left one, x greater than y and z: exchange the pictures, or turn them upright");
  const auto quaternion = found.find("right.quaternion");
  if (quaternion == found.end()) return;
  const std::vector<double>& q = quaternion->second.numbers;
  pair.T_left_right.q = Quat(q[3], q[0], q[1], q[2]);
  if (std::fabs(pair.T_left_right.q.norm() - 1) > kUnitWithin)
    return problems.add(quaternion->second.origin, "right.quaternion", "", "is not of unit length: expected x, y, z, w of a rotation");
  pair.T_left_right.q = normalized(pair.T_left_right.q);
}

std::string pair_list(std::initializer_list<double> values) {
  std::string text;
  for (const double value : values) text += (text.empty() ? "[" : ", ") + number_text(value);
  return text + "]\n";
}

std::string camera_text(const PairCamera& camera) {
  std::string text = "width = " + std::to_string(camera.width) + "\nheight = " + std::to_string(camera.height) + "\n";
  text += "focal_px = " + pair_list({camera.focal_x_px, camera.focal_y_px});
  text += "center_px = " + pair_list({camera.center_x_px, camera.center_y_px});
  const auto& d = camera.distortion;
  return text + "distortion = " + pair_list({d[0], d[1], d[2], d[3], d[4]});
}

}  // namespace

StereoPair load_stereo_pair(const std::filesystem::path& file) {
  ProblemList problems(file);
  const FoundValues found = read_table(parse_toml(file), "", pair_rows(), {}, problems);
  problems.throw_if_any();
  StereoPair pair;
  pair.left = pair_camera(found, "left");
  pair.right = pair_camera(found, "right");
  read_place(found, pair, problems);
  problems.throw_if_any();
  pair.codes.square_root = pair_number(found, "codes", 0) < 0.5;
  pair.codes.full_well_e = pair_number(found, "full_well_e", pair.codes.full_well_e);
  pair.codes.read_noise_e = pair_number(found, "read_noise_e", pair.codes.read_noise_e);
  return pair;
}

std::string stereo_pair_text(const StereoPair& pair) {
  const Vec3& p = pair.T_left_right.p;
  const Quat& q = pair.T_left_right.q;
  return std::string("# Calibration of a stereo pair (docs/stereo.md).\ncodes = \"") + (pair.codes.square_root ? "square_root" : "linear") +
         "\"\nfull_well_e = " + number_text(pair.codes.full_well_e) + "\nread_noise_e = " + number_text(pair.codes.read_noise_e) +
         "\n\n[left]\n" + camera_text(pair.left) + "\n[right]\n" + camera_text(pair.right) +
         "position_m = " + pair_list({p.x(), p.y(), p.z()}) + "quaternion = " + pair_list({q.x(), q.y(), q.z(), q.w()});
}

}  // namespace lasso::mdat
