// The small mission that the image fuzzer starts from: a box in cells so large that its image has a few kilobytes, and a scan of it.
#pragma once

#include "ut/support/box_image.hpp"
#include "ut/support/box_parts.hpp"
#include "ut/support/box_scan.hpp"
#include "ut/support/box_sensors.hpp"

namespace lasso::fuzz {

inline test::BoxModel small_box() {
  test::BoxModel box;
  box.cell_m = 0.1;
  box.margin_m = 0.05;
  return box;
}

// The search tables of 64 cells and the fewest views: the whole has to fit into an input.
inline test::BoxTables small_tables() {
  test::BoxTables tables = test::make_box_tables(small_box());
  const auto table = [&](TableId id) -> test::Words& { return tables[static_cast<std::size_t>(id) - 1]; };
  for (const SearchGridWord axis : {kSearchCellsX, kSearchCellsY, kSearchCellsZ}) table(TableId::kSearchGrid)[axis] = 4;
  table(TableId::kDistances).resize(16);
  table(TableId::kViews).resize(kMinViews * kViewWords);
  return tables;
}

// With a part, if asked for: the box once more, in larger cells to fit in; and with a further sensor.
inline test::TestImage small_image(const MissionParameters& parameters, bool with_part) {
  test::BoxTables tables = small_tables();
  if (!with_part) return test::make_image(parameters, tables);
  test::append_sensor(test::sensor_of(parameters, 0, 5), tables[test::kSensorsTable]);
  test::BoxPart part;
  part.box = small_box();
  part.box.cell_m = 0.2;
  return test::make_image(parameters, test::with_parts(tables, {part}, parameters));
}

inline Pose small_start() { return test::generic_box_pose(); }

inline std::unique_ptr<RangeImage> small_scan(int side = 10) {
  test::BoxScan scan;
  scan.model = small_box();
  scan.T_sensor_target = small_start();
  scan.side = side;
  scan.half_angle = 0.12;
  scan.sigma_m = 0.003;
  test::Generator random(1);
  return test::scan_box(scan, random);
}

}  // namespace lasso::fuzz
