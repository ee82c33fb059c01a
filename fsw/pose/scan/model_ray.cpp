#include "fsw/pose/scan/model_ray.hpp"

#include "fsw/pose/scan/clip.hpp"

namespace lasso {

// One copy for all: a walk is several kilobytes of a flight image.
FieldHit<FlightNumber> meet_model(const Mission& mission, const PathPose<FlightNumber>& pose, const ScanRay<FlightNumber>& ray) {
  FieldRay<FlightNumber> r{};
  transform(pose, ray.o, r.m);
  rotate(pose, ray.u, r.u);
  return cast_ray(mission.field, r);
}

}  // namespace lasso
