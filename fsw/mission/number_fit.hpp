// What this build's number type cannot hold of an image. Inside of fsw/mission.
#pragma once

#include "fsw/mission/image_check.hpp"

namespace lasso {

// nullptr, or what is wrong and what helps; then the parameter's row.
struct Misfit {
  const char* what = nullptr;
  std::uint32_t row = 0;
};

// Of a field geometry whose length bits and bricks are right.
const char* misfit_of_grid(const ImageTable& geometry);

// Of a sensor that looks at a model of this radius: ranges, and the noise that the estimator assumes at the farthest of them.
Misfit misfit_of(const SensorParameters& sensor, double radius_m);

// Of a mission's parameters besides their sensor.
Misfit misfit_of(const MissionParameters& parameters);

// The same of what lies in an image whose parameters, geometry and sensors are right by themselves, with the place.
LoadFailure check_parameters_fit(const FlightImage& image);
LoadFailure check_sensor_fit(const FlightImage& image, std::uint32_t sensor);

// Is every length of the record one of this build? Loop bound: the record's words.
LoadFailure check_lengths_fit(const FlightImage& image, TableId id, std::uint32_t record);

// A scan's first sample may come that much later than the scan is begun.
constexpr DurationUs kLateStart_us = 100'000;

}  // namespace lasso
