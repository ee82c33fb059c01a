#include <algorithm>
#include <cmath>

#include "ut/support/box_tables.hpp"

namespace lasso::test {
namespace {

constexpr std::uint32_t kSearchCells[3] = {28, 24, 20};  // fewer where the box is smaller would do, too
constexpr int kViews = 162;
constexpr int kViewRays = 8;  // each way: every test that loads an image pays for them

double size_of(const BoxModel& bounds) { return 2 * bounds.half.maxCoeff(); }
double search_cell(const BoxModel& bounds) { return size_of(bounds) / 20; }
Vec3 search_origin(const BoxModel& bounds) {
  return bounds.center - search_cell(bounds) / 2 * Vec3(kSearchCells[0], kSearchCells[1], kSearchCells[2]);
}

struct SeenBoxes {
  Vec3 middle = Vec3::Zero();
  double median = 0;  // of the depth, from the middle
};

// What rays in a square around the model meet: parallel ones, or from `eye` sizes before its middle.
SeenBoxes seen_from(const Boxes& boxes, const BoxModel& bounds, const Vec3& direction, double eye) {
  const Vec3 right = direction.unitOrthogonal();
  const double radius = bounds.half.norm();
  SeenBoxes seen;
  std::vector<std::pair<double, double>> depths;
  double weights = 1e-9;
  for (int i = 0; i < kViewRays * kViewRays; ++i) {
    const double x = (2.0 * (i % kViewRays) + 1) / kViewRays - 1;
    const double y = (2.0 * (i / kViewRays) + 1) / kViewRays - 1;
    const Vec3 across = bounds.center + 1.4 * radius * (x * right + y * direction.cross(right));
    const Vec3 from = eye > 0 ? Vec3(bounds.center + eye * size_of(bounds) * direction) : Vec3(across + 2 * radius * direction);
    const Vec3 u = (across - from).normalized();
    const double range = cast_boxes(boxes, from, u);
    if (range < 0) continue;
    const double weight = eye > 0 ? range * range : 1;
    const Vec3 point = from + range * u;
    seen.middle += weight * point;
    depths.emplace_back(-direction.dot(point), weight);
    weights += weight;
  }
  seen.middle /= weights;
  std::sort(depths.begin(), depths.end());
  double below = 0;
  for (const auto& [depth, weight] : depths) {
    if (2 * below < weights) seen.median = depth + direction.dot(seen.middle);
    below += weight;
  }
  return seen;
}

}  // namespace

Words search_grid_words(const BoxModel& bounds) {
  const Vec3 origin = search_origin(bounds);
  const double size = size_of(bounds);
  return {length(origin[0]), length(origin[1]), length(origin[2]), length(search_cell(bounds)), kSearchCells[0], kSearchCells[1],
          kSearchCells[2],   length(size / 10), length(size)};
}

Words distance_words(const Boxes& boxes, const BoxModel& bounds) {
  Words words;
  std::uint32_t word = 0;
  for (std::uint32_t i = 0; i < kSearchCells[0] * kSearchCells[1] * kSearchCells[2]; ++i) {
    const Vec3 place(i % kSearchCells[0], i / kSearchCells[0] % kSearchCells[1], i / kSearchCells[0] / kSearchCells[1]);
    const Vec3 center = search_origin(bounds) + search_cell(bounds) * (place + Vec3::Constant(0.5));
    const double distance = (closest_on_face(face_of(boxes, closest_face(boxes, center, -1, 1e9)), center) - center).norm();
    word = word << 8 | static_cast<std::uint32_t>(255 * std::min(distance / (size_of(bounds) / 10), 1.0) + 0.5);
    if (i % 4 == 3) words.push_back(word);
  }
  return words;
}

Words view_words(const Boxes& boxes, const BoxModel& bounds) {
  Words words;
  for (int k = 0; k < kViews; ++k) {
    const double z = 1 - (2.0 * k + 1) / kViews;
    const double turn = 2.399963229728653 * k;
    const Vec3 direction(std::sqrt(1 - z * z) * std::cos(turn), std::sqrt(1 - z * z) * std::sin(turn), z);
    for (int i = 0; i < 3; ++i) words.push_back(unit(direction[i]));
    const SeenBoxes afar = seen_from(boxes, bounds, direction, 0);
    const SeenBoxes near = seen_from(boxes, bounds, direction, static_cast<double>(kNearView));
    for (const SeenBoxes* seen : {&afar, &near}) {
      for (int i = 0; i < 3; ++i) words.push_back(length(seen->middle[i]));
    }
    for (const SeenBoxes* seen : {&afar, &near}) words.push_back(length(seen->median));
  }
  return words;
}

// Half turns about the first box's axes.
Words symmetry_words(const BoxModel& box) {
  Words words;
  for (int axis = 0; axis < 3; ++axis) {
    for (int i = 0; i < 4; ++i) words.push_back(unit(i == axis ? 1 : 0));
    for (int i = 0; i < 3; ++i) words.push_back(length(i == axis ? 0 : 2 * box.center[i]));
  }
  return words;
}

}  // namespace lasso::test
