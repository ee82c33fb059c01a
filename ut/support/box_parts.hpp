// Flight images of a box with parts: its two halves, each with a model in a frame of its own, turned and shifted against the target's.
#pragma once

#include <vector>

#include "fsw/core/byte_codec.hpp"
#include "fsw/mission/mission.hpp"
#include "ut/support/box_image.hpp"

namespace lasso::test {

struct BoxPart {
  BoxModel box;  // in the part's frame
  Pose T_target_part;
  double range_min_m = 0.1, range_max_m = 10;
  Vec3 view = Vec3::UnitZ();
  double cone_cosine = -1;
  double priority = 1;
};

// Half of the default box, along x: a quarter turn about x, so that its y and z are the target's z and -y; the left half is turned by half
// a turn more, so that both are open at their low x.
inline BoxPart half_box(bool right) {
  BoxPart part;
  part.box = BoxModel{Vec3::Zero(), Vec3(0.15, 0.12, 0.20), 0.03, 0.04};
  part.T_target_part.q = Quat(0.70710678118654757, 0.70710678118654757, 0, 0);
  if (!right) part.T_target_part.q = part.T_target_part.q * Quat(0, 0, 0, 1);
  part.T_target_part.p = Vec3(right ? 0.17 : -0.13, -0.01, 0.03);
  return part;
}
inline std::vector<BoxPart> two_halves() { return {half_box(false), half_box(true)}; }

inline MissionParameters part_parameters(MissionParameters p) {
  p.silhouettes = 0;
  p.wide_start = 0;
  return p;
}

inline void append_value(double value, Words& words) {
  std::uint8_t bytes[8];
  ByteWriter writer{Bytes(bytes)};
  writer.f64(value);
  ByteReader reader{ConstBytes(bytes)};
  for (int i = 0; i < 2; ++i) words.push_back(reader.u32());
}

inline void append_part(const BoxPart& part, Words& words) {
  const Pose& T = part.T_target_part;
  for (const double value : {T.q.x(), T.q.y(), T.q.z(), T.q.w(), T.p.x(), T.p.y(), T.p.z(), part.range_min_m, part.range_max_m,
                             part.view.x(), part.view.y(), part.view.z(), part.cone_cosine, part.priority}) {
    append_value(value, words);
  }
}

// One image for all parts of the same box: building one takes its time. The search's tables, which nobody asks of a part, are the whole's.
inline TestImage part_image(const MissionParameters& parameters, const BoxModel& box, const BoxTables& whole) {
  BoxTables tables = make_box_tables(box);
  for (std::size_t i = 11; i < 15; ++i) tables[i] = whole[i];
  for (std::size_t i = 18; i < 22; ++i) tables[2][i] = 0x64000000;  // where it was cut there is no face: no point is inside its sides
  return make_image(part_parameters(parameters), tables);
}

inline void append_image(TestImage& image, Words& words) {
  ByteReader reader{ConstBytes(image.data(), image.size)};
  while (reader.remaining() >= 4) words.push_back(reader.u32());
  if (words.size() % 2 != 0) words.push_back(0);
}

// Adds the parts, all of the first one's box, to the tables of the whole.
inline BoxTables with_parts(const BoxTables& whole, const std::vector<BoxPart>& parts, const MissionParameters& parameters) {
  BoxTables tables = whole;
  TestImage image = part_image(parameters, parts[0].box, whole);
  for (const BoxPart& part : parts) {
    append_part(part, tables[15]);
    tables[15].push_back(static_cast<std::uint32_t>(4 * tables[16].size()));
    tables[15].push_back(static_cast<std::uint32_t>(image.size));
    append_image(image, tables[16]);
  }
  return tables;
}

}  // namespace lasso::test
