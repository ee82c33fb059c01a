// A mission in memory: what the loader makes of a flight image. Views point into the caller's image buffer.
#pragma once

#include <cstdint>

#include "cfg/capacities.hpp"
#include "fsw/core/fixed_vector.hpp"
#include "fsw/core/span.hpp"
#include "fsw/core/status.hpp"
#include "fsw/geometry/fixed_number.hpp"
#include "fsw/geometry/number.hpp"
#include "fsw/geometry/se3.hpp"
#include "fsw/geometry/types.hpp"
#include "fsw/mission/field.hpp"
#include "fsw/mission/parameters.hpp"
#include "fsw/mission/search_tables.hpp"

namespace lasso {

// An edge of the model that can be a contour, with the planes of its two faces (n.p = d); see image_format.hpp.
template <class N>
struct ModelEdge {
  typename N::Length a[3];
  typename N::Length b[3];
  typename N::Unit n0[3];
  typename N::Length d0;
  typename N::Unit n1[3];
  typename N::Length d1;
  std::uint32_t flags;
};

template <class N>
struct HullPointOf {
  typename N::Length p[3];
};

template <class N>
struct MissionOf {
  std::uint32_t id = 0;
  std::uint32_t version = 0;
  std::uint32_t image_crc = 0;  // CRC-32C of the image as received
  MissionParameters parameters{};
  FixedVector<SensorParameters, kMaxSensors> sensors;  // [sensor], then the further ones
  Field<N> field{};
  Span<const ModelEdge<N>> edges;
  Span<const HullPointOf<N>> hull;
  SearchTables<N> search{};
  Vec3 center_m = Vec3::Zero();  // target frame: the geometric centre, where scans are aimed
  double radius_m = 0;           // largest distance of the model from the target's origin
};

// The number type of this build.
#if defined(LASSO_FIXED_POINT)
using FlightNumber = FixedNumber;
#else
using FlightNumber = FloatNumber;
#endif
using Mission = MissionOf<FlightNumber>;

// A part of the target with a model of its own, for scans from close by.
struct Part {
  Mission mission;  // its model in its own frame, and the parameters that hold for its scans
  Pose T_target_part;
  double range_min_m = 0, range_max_m = 0;  // of its centre from the sensor
  Vec3 view = Vec3::UnitZ();                // unit vector in part axes, towards the sensors that see it
  double cone_cosine = -1;
  double priority = 1;
};
using Parts = FixedVector<Part, kMaxParts>;

// The number of a sensor: 0 is [sensor], then the further ones in the image's order.
using SensorNumber = std::uint8_t;

// Mission and parts as the scans of one of the sensors see them: with its noise, field of view and ranges. `sensor` is one of
// mission.sensors.
void use_sensor(SensorNumber sensor, Mission& mission, Parts& parts);

struct LoadFailure {
  Status status = Status::kOk;
  std::uint32_t table = 0;   // TableId, 0: header or directory; in the image of part i (from 0): 100 (i + 1) more
  std::uint32_t record = 0;  // first offending record
  const char* what = "";     // a few words
};

// Validates the whole image (format, CRCs, every index, range and capacity) and only then converts its tables in place to this
// build's number type, so that the image's memory becomes the mission's. `image` must be aligned to 8 bytes. On failure neither `image`
// nor `mission` nor `parts` is changed. A part without a model is kMissing. Loop bound: the image's words.
LoadFailure load_image(Bytes image, Mission& mission, Parts& parts);
// The same for who has no use for the parts, which are validated only.
LoadFailure load_image(Bytes image, Mission& mission);

}  // namespace lasso
