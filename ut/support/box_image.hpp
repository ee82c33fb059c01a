// A flight image of a box or of several, made by brute force and independently of the mission compiler: the flight rooms' tests run on it,
// on the host and on the emulated target. Everything is axis-aligned, so each table has a closed form.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "fsw/geometry/types.hpp"
#include "fsw/mission/image_format.hpp"
#include "fsw/mission/parameters.hpp"

namespace lasso::test {

struct BoxModel {
  Vec3 center{0.02, -0.01, 0.03};
  Vec3 half{0.30, 0.20, 0.12};
  double cell_m = 0.02;
  double margin_m = 0.20;
};

using Boxes = std::vector<BoxModel>;  // apart from each other; the first one says cell and margin
// A target without symmetry.
inline Boxes uneven_boxes() {
  BoxModel main;
  BoxModel tower{{0.20, 0.10, 0.25}, {0.06, 0.05, 0.08}, 0.02, 0.2};
  BoxModel arm{{-0.45, -0.08, 0.05}, {0.10, 0.05, 0.04}, 0.02, 0.2};
  return {main, tower, arm};
}
using Words = std::vector<std::uint32_t>;

// The tables in the order of TableId, without the parameters (table 1, index 0 stays empty).
using BoxTables = std::array<Words, kTableCount>;
BoxTables make_box_tables(const Boxes& boxes);  // the last ones are kept: not for two threads at once
inline BoxTables make_box_tables(const BoxModel& model) { return make_box_tables(Boxes{model}); }

// A complete image. Its memory is aligned for load_image (std::vector<std::uint64_t> behind the bytes).
struct TestImage {
  std::vector<std::uint64_t> storage;
  std::size_t size = 0;
  std::uint8_t* data() { return reinterpret_cast<std::uint8_t*>(storage.data()); }
};
TestImage make_image(const MissionParameters& parameters, const BoxTables& tables);
inline TestImage make_box_image(const MissionParameters& parameters, const BoxModel& model = {}) {
  return make_image(parameters, make_box_tables(model));
}

// Recomputes the checksums after a test has changed bytes.
void repair_crcs(TestImage& image);
// Byte offset of a table (1-based id) in the image.
std::size_t table_offset(TestImage& image, std::uint32_t id);

// Where a ray from `origin` along `u` (target frame) first meets the box: its range, or a negative number. Slab method.
double cast_box(const BoxModel& model, const Vec3& origin, const Vec3& u);
double cast_boxes(const Boxes& boxes, const Vec3& origin, const Vec3& u);  // the first of them that is met

}  // namespace lasso::test
