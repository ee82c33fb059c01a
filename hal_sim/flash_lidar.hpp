// A simulated flash LIDAR: one pulse lights the whole field, and each pixel counts the photons that come back to it and times them. All
// pixels are measured at one time. Noise comes of the photons alone, but for the clock's jitter:
//
//   N   = photons_at_10m (10 / R)^2 b / 0.5                        expected counts of a pixel's return; b = rho cos(incidence) (Lambert),
//                                                                 or of a surface with a material its backscatter (laser_reflection.hpp)
//   B                                                             expected background counts within one bin of time, of length `bin_m`
//   P_d = P(Poisson(N + B) >= threshold)                          a return is detected
//   P_f = P(Poisson(B) >= threshold)                              a bin without a return is taken for one; the first detection counts
//   sigma^2 = jitter^2 + (f w^2 + (1 - f) bin^2 / 12) / n         of the range by n counts: their mean, f = N / (N + B)
//
// with w the pulse's rms length in range, and bin_m = 4 w. See Richmond & Cain, Direct-Detection LADAR Systems (2010), ch. 1 and 4.
// A pixel's field is four rays, one through the middle of each quarter. What is within a bin of the strongest is one return, at the mean
// range by photons: so pixels on a contour, and across a step, are mixed.
#pragma once

#include <cstdint>
#include <vector>

#include "fsw/sense/pixel_sensor.hpp"
#include "hal_sim/common_error.hpp"
#include "hal_sim/flash_model.hpp"
#include "hal_sim/other_body.hpp"
#include "hal_sim/random.hpp"
#include "hal_sim/ray_caster.hpp"
#include "hal_sim/scanner_model.hpp"
#include "hal_sim/trajectory.hpp"

namespace lasso::sim {

// N, P(Poisson(mean) >= threshold), and sigma of the equations above.
double expected_photons(const FlashModel& model, double range_m, double cos_incidence);
double detection_probability(double mean, int threshold);
double range_sigma_m(const FlashModel& model, double photons, double counts);

// Of a Poisson distribution; by Knuth's products below a mean of 50, above it by the normal distribution, whose skewness is then below
// 0.15.
double poisson(Random& random, double mean);

class FlashLidar final : public PixelSensor {
 public:
  // Keeps references: target and trajectory outlive it. Of `scanner` it has the field of view, ranges, dropouts, outliers, common errors
  // and the dark. Throws std::invalid_argument as validate(). What a frame returns depends on its number, time and the seed alone.
  FlashLidar(const RayCaster& target, const Trajectory& trajectory, const ScannerModel& scanner, const FlashModel& model,
             std::uint64_t seed, OtherBodies others = {});

  PixelPitch pitch() const override;
  // kBadValue: a plan that validate (pattern.hpp) refuses, or whose window leaves the field of view.
  Status start(const ScanPlan& plan, TimeUs t_start_us) override;
  // Pixels whose middle is within the plan's window, row by row.
  PixelPoll poll(TimeUs now_us, Span<RangeSample> out) override;
  void abort() override { running_ = false; }
  void permit_laser(bool /*permitted*/) override {}  // its light is the simulation's

 private:
  struct Frame {
    Pose T_target_sensor;
    std::vector<Pose> T_others_sensor;
    CommonErrors common;
  };
  struct Echo {
    double range_m = 0, cos_incidence = 0, photons = 0;
    const LaserReflection* material = nullptr;
  };
  double photons_of(const Echo& echo) const;

  bool within_field_of_view(const ScanPlan& plan) const;
  void take_frame(TimeUs t_us);
  Vec3 through(double column, double row) const;
  RangeSample measure(int column, int row) const;
  RangeSample measured(const RangeSample& pixel, const Echo& echo, Random& random) const;
  RangeSample timed(const RangeSample& pixel, const Echo& echo, double counts, Random& random) const;
  double false_range_m(double quiet, double place) const;
  Echo echo_of(const Vec3& direction) const;
  Echo echo_of_pixel(int column, int row) const;

  const RayCaster& target_;
  const Trajectory& trajectory_;
  OtherBodies others_;
  ScannerModel scanner_;
  FlashModel model_;
  std::uint64_t seed_;
  CommonErrorProcess common_;
  double tan_half_x_, tan_half_y_, cos_dropout_incidence_, false_probability_;
  ScanPlan plan_;
  TimeUs t_us_ = 0;
  Frame frame_;
  int next_ = 0;  // pixel
  bool running_ = false;
};

}  // namespace lasso::sim
