#include "mdat/pair/disparity_map.hpp"

#include <fstream>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "fsw/geometry/so3.hpp"

namespace lasso::mdat {
namespace {

constexpr double kFarOutside = -1e9;

void put_file(const std::filesystem::path& file, const std::string& content) {
  std::ofstream out(file, std::ios::binary);
  out << content;
  out.close();
  if (!out) throw std::runtime_error(file.string() + ": cannot be written");
}

}  // namespace

Eigen::Vector2d DisparityMap::pixel_of(const Vec3& direction_left) const {
  const Vec3 ray = rotate(q_left_rectified.conjugate(), direction_left);
  if (!(ray.z() > 0)) return Eigen::Vector2d::Constant(kFarOutside);
  return {center_x_px + focal_px * ray.x() / ray.z(), center_y_px + focal_px * ray.y() / ray.z()};
}

Vec3 DisparityMap::point_m(int column, int row) const {
  const double depth_m = focal_px * baseline_m / disparity_px(index(column, row));
  return rotate(q_left_rectified, depth_m * Vec3((column - center_x_px) / focal_px, (row - center_y_px) / focal_px, 1));
}

void write_disparity_map(const DisparityMap& map, const std::filesystem::path& picture, const std::filesystem::path& geometry) {
  const Quat& q = map.q_left_rectified;
  const nlohmann::ordered_json json = {{"steps_per_pixel", kDisparitySteps},
                                       {"focal_px", map.focal_px},
                                       {"center_px", {map.center_x_px, map.center_y_px}},
                                       {"baseline_m", map.baseline_m},
                                       {"quaternion", {q.x(), q.y(), q.z(), q.w()}},
                                       {"dark", map.counts.dark},
                                       {"glint", map.counts.glint},
                                       {"flat", map.counts.flat},
                                       {"ambiguous", map.counts.ambiguous},
                                       {"matched", map.counts.matched}};
  put_file(picture, grey_png(map.codes));
  put_file(geometry, json.dump(2) + "\n");
}

DisparityMap read_disparity_map(const std::filesystem::path& picture, const std::filesystem::path& geometry) {
  std::ifstream in(geometry);
  const nlohmann::json json = nlohmann::json::parse(in, nullptr, false);
  if (json.is_discarded() || json.value("steps_per_pixel", 0) != kDisparitySteps)
    throw std::runtime_error(geometry.string() + ": is not the geometry of a disparity map");
  DisparityMap map;
  map.focal_px = json.at("focal_px");
  map.center_x_px = json.at("center_px").at(0);
  map.center_y_px = json.at("center_px").at(1);
  map.baseline_m = json.at("baseline_m");
  const auto& q = json.at("quaternion");
  map.q_left_rectified = normalized(Quat(q.at(3), q.at(0), q.at(1), q.at(2)));
  map.counts = {json.at("dark"), json.at("glint"), json.at("flat"), json.at("ambiguous"), json.at("matched")};
  map.codes = read_grey16_png(picture);
  return map;
}

}  // namespace lasso::mdat
