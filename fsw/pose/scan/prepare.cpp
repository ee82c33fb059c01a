#include "fsw/pose/scan/prepare.hpp"

#include "fsw/geometry/portable_math.hpp"
#include "fsw/pose/scan/point_maker.hpp"

namespace lasso {
namespace {

using N = FlightNumber;

PointSettings<N> settings_for(const MissionParameters& p, const StartPoint& start, TimeUs reference_us) {
  PointSettings<N> s{};
  s.sigma0 = N::to<N::Sigma>(p.sigma0_m);
  s.surface = N::to<N::Sigma>(p.surface_sigma_m);
  s.k = N::to<N::SigmaRate>(p.sigma_k_per_m);
  s.angle = N::to<N::SigmaRate>(p.sigma_angle_rad);
  s.width = N::to<N::Kernel>(p.kernel_width);
  s.range_min = N::to<N::Length>(p.range_min_m);
  s.range_max = N::to_length(clamp(p.range_max_m, 0.0, N::kFarthest_m));
  s.reference_us = reference_us;
  const bool moving = !start.rates.omega_radps.isZero(0.0) || !start.rates.v_mps.isZero(0.0);
  s.moving = p.deskew > 0.5 && moving;
  for (int i = 0; i < 3; ++i) {
    s.minus_half_rate[i] = N::to<N::Tangent>(-0.5 * start.rates.omega_radps[i]);
    s.origin[i] = N::to_length(start.T_sensor_target.p[i]);
    s.velocity[i] = N::to<N::Length>(start.rates.v_mps[i]);
  }
  return s;
}

}  // namespace

void prepare_rays(const Mission& mission, const RangeImage& scan, const StartPoint& start, Workspace& workspace) {
  make_points(settings_for(mission.parameters, start, scan.reference_time_us()), scan, start.partial, workspace);
}

}  // namespace lasso
