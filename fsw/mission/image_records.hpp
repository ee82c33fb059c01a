// Values of a flight image's tables, record by record.
#pragma once

#include <cstdint>

#include "fsw/mission/calibration.hpp"
#include "fsw/mission/image_check.hpp"
#include "fsw/mission/named_frame.hpp"
#include "fsw/mission/parameters.hpp"

namespace lasso {

// Of a table whose size and counts are right. Values are as they stand: numbers of another range, and none at all, are the caller's to
// refuse.
MissionParameters parameters_of(const ImageTable& table);
SensorParameters sensor_of(const ImageTable& table, std::uint32_t record);
TriangulationCalibration calibration_of(const ImageTable& table, std::uint32_t record);
NamedFrame named_frame_of(const ImageTable& table, std::uint32_t record);

}  // namespace lasso
