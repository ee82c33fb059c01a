#include "mdat/run/navigation.hpp"

#include "mdat/run/case.hpp"

namespace lasso::mdat {
namespace {

constexpr std::uint64_t kStream = 0x6e617669;  // other numbers than the scanner's

}  // namespace

NavigationSystem::NavigationSystem(const Scenario& scenario, const sim::Trajectory& truth, std::uint64_t seed)
    : scenario_(scenario), truth_(truth), random_(seed ^ kStream), next_us_(kEpochUs + to_us(scenario.navigation_from_s)) {}

void NavigationSystem::offer(TimeUs now_us, Component& component) {
  if (now_us < next_us_) return;
  (void)component.offer_start(InitialPoseSource::kNavigation, measure(now_us));
  next_us_ += to_us(scenario_.navigation_period_s);
}

StartOffer NavigationSystem::measure(TimeUs t_us) {
  const sim::TruthState truth = truth_.at(t_us);
  StartOffer offer;
  offer.t_us = t_us;
  offer.T_sensor_target.q = normalized(exp_so3(draw(scenario_.navigation_sigma_rad)) * truth.T_sensor_target.q);
  offer.T_sensor_target.p = truth.T_sensor_target.p + draw(scenario_.navigation_sigma_m);
  offer.rates = truth.rates;
  offer.covariance.diagonal().head<3>().setConstant(scenario_.navigation_sigma_rad * scenario_.navigation_sigma_rad);
  offer.covariance.diagonal().tail<3>().setConstant(scenario_.navigation_sigma_m * scenario_.navigation_sigma_m);
  return offer;
}

Vec3 NavigationSystem::draw(double sigma) {
  Vec3 error;
  for (int i = 0; i < 3; ++i) error[i] = sigma * random_.gaussian();
  return error;
}

}  // namespace lasso::mdat
