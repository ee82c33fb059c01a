#include "ut/support/box_image.hpp"

#include <algorithm>
#include <cmath>

#include "fsw/core/byte_codec.hpp"
#include "fsw/core/crc.hpp"
#include "fsw/mission/image_format.hpp"
#include "ut/support/box_tables.hpp"

namespace lasso::test {
namespace {

constexpr double kNearBandCells = 5;

struct Grid {
  Vec3 origin;
  double cell;
  std::uint32_t bricks[3];
  Vec3 brick_center(std::uint32_t x, std::uint32_t y, std::uint32_t z) const {
    return origin + 8 * cell * (Vec3(x, y, z) + Vec3::Constant(0.5));
  }
};

bool face_crosses(const Face& face, const Vec3& center, double reach) {
  for (int i = 0; i < 3; ++i) {
    const double a = i == face.axis ? face.place : low(face.box, i);
    const double b = i == face.axis ? face.place : high(face.box, i);
    if (b < center[i] - reach || a > center[i] + reach) return false;
  }
  return true;
}

Grid make_grid(const BoxModel& m) {
  Grid grid;
  grid.cell = m.cell_m;
  for (int i = 0; i < 3; ++i) {
    grid.origin[i] = low(m, i) - m.margin_m - 0.0011;  // no face on a cell boundary
    grid.bricks[i] = static_cast<std::uint32_t>(std::ceil((2 * m.half[i] + 2 * m.margin_m) / (8 * m.cell_m)) + 1);
  }
  return grid;
}

Words geometry_words(const Boxes& boxes, const BoxModel& m, const Grid& g) {
  double radius = 0;
  for (const BoxModel& box : boxes) radius = std::max(radius, (box.center.cwiseAbs() + box.half).norm());
  return {kBits,
          length(g.origin[0]),
          length(g.origin[1]),
          length(g.origin[2]),
          length(g.cell),
          g.bricks[0],
          g.bricks[1],
          g.bricks[2],
          length(radius),
          length(m.center[0]),
          length(m.center[1]),
          length(m.center[2]),
          length(kNearBandCells * g.cell)};
}

void push_plane(Words& words, int axis, double sign, double offset) {
  for (int i = 0; i < 3; ++i) words.push_back(unit(i == axis ? sign : 0));
  words.push_back(length(offset));
}

// The sides of a face: low and high ends of the two other axes, normals by component, then offsets.
void push_sides(const BoxModel& m, int face_axis, Words& words) {
  const int first = (face_axis + 1) % 3;
  const int second = (face_axis + 2) % 3;
  for (int component = 0; component < 3; ++component) {
    for (int axis : {first, second}) {
      words.push_back(unit(component == axis ? 1 : 0));
      words.push_back(unit(component == axis ? -1 : 0));
    }
  }
  for (int axis : {first, second}) {
    words.push_back(length(low(m, axis) - 1e-6));
    words.push_back(length(-high(m, axis) - 1e-6));
  }
}

Words element_words(const Boxes& boxes) {
  Words words;
  for (int f = 0; f < face_count(boxes); ++f) {
    const Face face = face_of(boxes, f);
    push_plane(words, face.axis, face.sign, face.sign * face.place);
    words.push_back(0);
    words.push_back(0);
    push_sides(face.box, face.axis, words);
  }
  return words;
}

// One box is convex: whatever a ray hits first in the list is what it hits first.
std::uint32_t ray_cell(const Boxes& boxes, const Grid& g, const Vec3& center, Words& lists) {
  const auto offset = static_cast<std::uint32_t>(lists.size());
  for (int f = 0; f < face_count(boxes); ++f) {
    if (face_crosses(face_of(boxes, f), center, g.cell + 1e-6))
      lists.push_back(static_cast<std::uint32_t>(f) | (boxes.size() == 1 ? kFinalEntry : 0));
  }
  const auto count = static_cast<std::uint32_t>(lists.size()) - offset;
  return count == 0 ? kEmptyBit | 1u : count << kListOffsetBits | offset;  // a distance of 1 is never too large
}

// The brick's word 0.
std::uint32_t push_ray_brick(const Boxes& boxes, const Grid& g, const Vec3& corner, Words& cells, Words& lists) {
  const std::size_t before = lists.size();
  Words brick;
  for (std::uint32_t k = 0; k < kRayCellsPerBrick; ++k) {
    const Vec3 center = corner + g.cell * (Vec3(k & 7, k >> 3 & 7, k >> 6) + Vec3::Constant(0.5));
    brick.push_back(ray_cell(boxes, g, center, lists));
  }
  if (lists.size() == before) return kEmptyBit | 1u;
  cells.insert(cells.end(), brick.begin(), brick.end());
  return static_cast<std::uint32_t>(cells.size() / kRayCellsPerBrick - 1);
}

// Its word 1.
std::uint32_t push_near_brick(const Boxes& boxes, const Grid& g, const Vec3& corner, Words& near) {
  const double half = 4 * g.cell;
  const auto is_near = [&](int f) {
    return face_crosses(face_of(boxes, f), corner + Vec3::Constant(half), half + kNearBandCells * g.cell);
  };
  int f = 0;
  while (f < face_count(boxes) && !is_near(f)) ++f;
  if (f == face_count(boxes)) return 0;
  for (std::uint32_t k = 0; k < 64; ++k) {
    const Vec3 center = corner + 2 * g.cell * (Vec3(k & 3, k >> 2 & 3, k >> 4) + Vec3::Constant(0.5));
    const int first = closest_face(boxes, center, -1, 1e9);
    near.push_back(static_cast<std::uint32_t>(first + 1));
    near.push_back(static_cast<std::uint32_t>(closest_face(boxes, center, first, kNearBandCells * g.cell) + 1));
  }
  return static_cast<std::uint32_t>(near.size() / kNearWordsPerBrick);
}

void push_foot(const Boxes& boxes, const Vec3& center, Words& feet) {
  const Vec3 foot = closest_on_face(face_of(boxes, closest_face(boxes, center, -1, 1e9)), center);
  for (int i = 0; i < 3; ++i) feet.push_back(length(foot[i]));
}

// Edge along `axis` between the faces of the two other axes.
void push_edge(const BoxModel& m, int axis, double sign1, double sign2, Words& edges) {
  const int i1 = (axis + 1) % 3;
  const int i2 = (axis + 2) % 3;
  Vec3 a = m.center;
  a[i1] += sign1 * m.half[i1];
  a[i2] += sign2 * m.half[i2];
  Vec3 b = a;
  a[axis] = low(m, axis);
  b[axis] = high(m, axis);
  for (int i = 0; i < 3; ++i) edges.push_back(length(a[i]));
  for (int i = 0; i < 3; ++i) edges.push_back(length(b[i]));
  push_plane(edges, i1, sign1, sign1 * a[i1]);
  push_plane(edges, i2, sign2, sign2 * a[i2]);
  edges.push_back(0);
}

Words edge_words(const Boxes& boxes) {
  Words words;
  for (const BoxModel& box : boxes) {
    for (int k = 0; k < 12; ++k) push_edge(box, k / 4, (k & 1) == 0 ? -1 : 1, (k & 2) == 0 ? -1 : 1, words);
  }
  return words;
}

Words hull_words(const Boxes& boxes) {
  Words words;
  for (const BoxModel& box : boxes) {
    for (int k = 0; k < 8; ++k) {
      for (int i = 0; i < 3; ++i) words.push_back(length((k >> i & 1) == 0 ? low(box, i) : high(box, i)));
    }
  }
  return words;
}

constexpr std::uint32_t kRecordWords[kTableCount] = {2, 13, 22, 15, 2, 512, 1, 128, 3, 15, 3, 9, 1, 11, 7, 30, 1, 30, 52, 28};

void put_u32(std::uint8_t* p, std::uint32_t v) {
  for (int i = 0; i < 4; ++i) p[i] = static_cast<std::uint8_t>(v >> (24 - 8 * i));
}
std::uint32_t get_u32(const std::uint8_t* p) {
  return static_cast<std::uint32_t>(p[0]) << 24 | static_cast<std::uint32_t>(p[1]) << 16 | static_cast<std::uint32_t>(p[2]) << 8 | p[3];
}

std::uint8_t* directory_entry(TestImage& image, std::uint32_t id) {
  return image.data() + 4 * (kImageHeaderWords + kDirectoryEntryWords * (id - 1));
}

Words parameter_words(const MissionParameters& parameters) {
  Words words;
  for (const ParameterRow& row : parameter_rows()) {
    std::uint8_t bytes[8];
    ByteWriter writer{Bytes(bytes)};
    writer.f64(parameters.*row.member);
    words.push_back(get_u32(bytes));
    words.push_back(get_u32(bytes + 4));
  }
  return words;
}

bool same(const BoxModel& a, const BoxModel& b) {
  return a.center == b.center && a.half == b.half && a.cell_m == b.cell_m && a.margin_m == b.margin_m;
}

BoxTables compute_box_tables(const Boxes& boxes) {
  const BoxModel bounds = bounds_of(boxes);
  const Grid g = make_grid(bounds);
  BoxTables tables;
  tables[1] = geometry_words(boxes, bounds, g);
  tables[2] = element_words(boxes);
  tables[3] = Words(kCurvatureWords, 0);
  for (std::uint32_t z = 0; z < g.bricks[2]; ++z) {
    for (std::uint32_t y = 0; y < g.bricks[1]; ++y) {
      for (std::uint32_t x = 0; x < g.bricks[0]; ++x) {
        const Vec3 center = g.brick_center(x, y, z);
        const Vec3 corner = center - Vec3::Constant(4 * g.cell);
        tables[4].push_back(push_ray_brick(boxes, g, corner, tables[5], tables[6]));
        tables[4].push_back(push_near_brick(boxes, g, corner, tables[7]));
        push_foot(boxes, center, tables[8]);
      }
    }
  }
  tables[9] = edge_words(boxes);
  tables[10] = hull_words(boxes);
  tables[11] = search_grid_words(bounds);
  tables[12] = distance_words(boxes, bounds);
  tables[13] = view_words(boxes, bounds);
  tables[14] = symmetry_words(boxes[0]);
  return tables;
}

}  // namespace

// Most tests of a program want the tables of the test before them, and to make them takes longer than most tests.
BoxTables make_box_tables(const Boxes& boxes) {
  static Boxes made_of;
  static BoxTables made;
  if (!std::equal(boxes.begin(), boxes.end(), made_of.begin(), made_of.end(), same)) {
    made = compute_box_tables(boxes);
    made_of = boxes;
  }
  return made;
}

TestImage make_image(const MissionParameters& parameters, const BoxTables& given) {
  BoxTables tables = given;
  tables[0] = parameter_words(parameters);
  const std::uint32_t count = tables.back().empty() ? kLeastTables : kTableCount;
  std::size_t size = (4 * (kImageHeaderWords + count * kDirectoryEntryWords) + 7) / 8 * 8;
  std::size_t offsets[kTableCount];
  for (std::size_t i = 0; i < count; ++i) {
    offsets[i] = size;
    size = (size + 4 * tables[i].size() + 7) / 8 * 8;
  }
  TestImage image;
  image.size = size + 4;
  image.storage.resize((image.size + 7) / 8);
  const std::uint32_t header[7] = {
      kImageMagic, kImageVersion, static_cast<std::uint32_t>(image.size), count, 7, 3, static_cast<std::uint32_t>(parameter_rows().size())};
  for (std::size_t i = 0; i < 7; ++i) put_u32(image.data() + 4 * i, header[i]);
  for (std::uint32_t i = 0; i < count; ++i) {
    std::uint8_t* entry = directory_entry(image, i + 1);
    put_u32(entry, i + 1);
    put_u32(entry + 4, kRecordWords[i]);
    put_u32(entry + 8, static_cast<std::uint32_t>(tables[i].size()) / kRecordWords[i]);
    put_u32(entry + 12, static_cast<std::uint32_t>(offsets[i]));
    for (std::size_t k = 0; k < tables[i].size(); ++k) put_u32(image.data() + offsets[i] + 4 * k, tables[i][k]);
  }
  repair_crcs(image);
  return image;
}

std::size_t table_offset(TestImage& image, std::uint32_t id) { return get_u32(directory_entry(image, id) + 12); }

void repair_crcs(TestImage& image) {
  const std::uint32_t count = get_u32(image.data() + 12);
  for (std::uint32_t id = 1; id <= count && id <= kTableCount; ++id) {
    std::uint8_t* entry = directory_entry(image, id);
    const std::size_t bytes = 4u * get_u32(entry + 4) * get_u32(entry + 8);
    if (table_offset(image, id) + bytes > image.size - 4) continue;  // a test made the table too long
    put_u32(entry + 16, crc32c(ConstBytes(image.data() + table_offset(image, id), bytes)));
  }
  put_u32(image.data() + image.size - 4, crc32c(ConstBytes(image.data(), image.size - 4)));
}

double cast_box(const BoxModel& m, const Vec3& origin, const Vec3& u) {
  double enter = 0;
  double leave = 1e9;
  for (int i = 0; i < 3; ++i) {
    const double a = (low(m, i) - origin[i]) / u[i];
    const double b = (high(m, i) - origin[i]) / u[i];
    enter = std::max(enter, std::min(a, b));
    leave = std::min(leave, std::max(a, b));
  }
  return enter <= leave ? enter : -1;
}

double cast_boxes(const Boxes& boxes, const Vec3& origin, const Vec3& u) {
  double nearest = -1;
  for (const BoxModel& box : boxes) {
    const double range = cast_box(box, origin, u);
    if (range >= 0 && (nearest < 0 || range < nearest)) nearest = range;
  }
  return nearest;
}

}  // namespace lasso::test
