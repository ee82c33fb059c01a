// What a scan will tell, from a few rays that stand for those of its pattern.
#pragma once

#include "fsw/pose/silhouette/contour.hpp"

namespace lasso {

// On the tangent plane z = 1: x, y.
struct ScanRectangle {
  float low[2] = {1e30F, 1e30F};
  float high[2] = {-1e30F, -1e30F};
};

// Around the model's outline.
ScanRectangle outline_of(const Mission& mission, const View<FlightNumber>& view);
// The same within the sensor's field of view; low is not below high where nothing of it is.
ScanRectangle visible_outline(const Mission& mission, const View<FlightNumber>& view);

struct InformationForecast {
  Mat6 information = Mat6::Zero();  // of the pose: rotation about the target's origin and translation, target axes
  int met = 0;                      // of the kForecastRays: how many meet the model
};
constexpr int kForecastColumns = 8, kForecastRows = 12;
constexpr int kForecastRays = kForecastColumns * kForecastRows;

// What a return along one ray will tell: the residual's row, and its variance.
struct SeenPoint {
  bool met = false;           // the ray meets the model
  Vec3 point = Vec3::Zero();  // where, target frame
  Vec6 row = Vec6::Zero();
  double weight = 0;  // 1/m^2; 0: nothing met, or grazed
};
// The ray in the middle of field `index` of the kForecastRays that the rectangle is divided into. Bound: a walk.
SeenPoint look_at(const Mission& mission, const View<FlightNumber>& view, const ScanRectangle& rectangle, int index);

// The returns of `rays` rays spread over the rectangle. Rays that graze the surface tell nothing. Bound: kForecastRays walks.
InformationForecast forecast_information(const Mission& mission, const View<FlightNumber>& view, const ScanRectangle& rectangle,
                                         double rays);

// The sensor's range noise, without its pointing.
double range_variance(const MissionParameters& parameters, double range_m);

}  // namespace lasso
