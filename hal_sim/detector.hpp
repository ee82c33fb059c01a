// The detector of a simulated laser sensor: what of the returned light is seen, and how well its range is told.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "fsw/core/time.hpp"
#include "fsw/geometry/types.hpp"
#include "fsw/sense/range_image.hpp"

namespace lasso::sim {

// Which of the surfaces in a beam's footprint a range is of. kMixed: a range between them, by the light that each returns.
enum class Returns : std::uint8_t { kMixed = 0, kFirst = 1, kLast = 2, kStrongest = 3 };

struct Sunlight {
  Vec3 direction = -Vec3::UnitZ();  // unit, towards the Sun, in the sensor frame
  double share = 0;                 // of its disc that is not behind the Earth
};
class SunSource {
 public:
  virtual ~SunSource() = default;
  virtual Sunlight at(TimeUs t_us) const = 0;
};

// Solar irradiance outside of the atmosphere at 1550 nm and 1 AU, to two digits (ASTM E490 has 0.27; a black body of 5772 K would give
// 0.23); 1500 nm: 0.30.
constexpr double kSunIrradiance_Wpm2nm = 0.27;

// Light is counted in photo-electrons. A Lambertian surface of reflectance rho_0 at range R_0, which fills the beam at right angles, gives
// `reference_electrons`; any other one, of backscatter b (laser_reflection.hpp) at range R,
//   S = reference_electrons (b / rho_0) (R_0 / R)^2,
// as long as it is wider than the beam. Counts vary by the shot noise of all light and by the electronics:
//   N = sqrt(S + B + noise_electrons^2), with B electrons of sunlight, whose mean is known and taken away.
// The centre of a pulse or spot of root mean square width w, told from S electrons, is uncertain by w / sqrt(S) in its own shot noise, so
//   sigma^2 = sigma0^2 + (k z^2)^2 + (w N / S)^2,   w^2 = width_m^2 + (width_k_per_m z^2)^2:
// w is how wide the pulse (half of its length: there and back) or the spot on the detector is as a range. The first terms hold at any
// signal: clock, speckle, mechanics. The presets simulate no detector: every surface returns, whatever it is made of.
struct DetectorModel {
  double reference_electrons = 0;  // 0: no detector is simulated, and nothing below but `returns` has an effect
  double reference_range_m = 1;
  double reference_reflectance = 1;
  double noise_electrons = 0;       // of the electronics, 1 sigma
  double threshold_electrons = 0;   // a count below it is no return
  double saturation_electrons = 0;  // a count above it tells no range: kInvalid; 0: never
  double width_m = 0;
  double width_k_per_m = 0;
  // Sunlight. The electrons by which the reference laser return is known give the receiver's area and efficiency, so that these are left.
  double bandpass_m = 0;    // of wavelengths that pass the filter; 0: no sunlight
  double energy_J = 0;      // that the laser sends for one sample
  double field_rad = 0;     // half the angle of the cone from which the receiver takes light
  double gate_s = 0;        // in which it gathers light of one sample
  double glare_per_sr = 0;  // radiance by scatter in the optics over irradiance of a Sun at angle a off the ray, times sin^2(a)
  Returns returns = Returns::kMixed;
  std::shared_ptr<const SunSource> sun;  // none: dark
};

inline bool is_simulated(const DetectorModel& model) { return model.reference_electrons > 0; }
inline bool has_sunlight(const DetectorModel& model) { return is_simulated(model) && model.bandpass_m > 0 && model.sun != nullptr; }

// Throws std::invalid_argument that names the member, its value and what was expected.
void validate(const DetectorModel& model);

double signal_electrons(const DetectorModel& model, double backscatter, double range_m);
double noise_electrons(const DetectorModel& model, double signal, double background);
double width_m(const DetectorModel& model, double z_m);
// Probability of a return: Phi((S - threshold) / N).
double return_probability(const DetectorModel& model, double signal, double background);
// Electrons of sunlight in a sample of which the receiver's field shows radiance L = radiance_per_sr * E, E the Sun's irradiance:
//   B = L bandpass pi field^2 gate * (reference_electrons pi R_0^2 / (energy rho_0)).
double sun_electrons(const DetectorModel& model, double radiance_per_sr);
// The same of scatter in the optics, and of the Sun itself where the field shows it; `cos_sun` is that of its angle off the ray.
double glare_radiance_per_sr(const DetectorModel& model, double cos_sun);

// What one surface, or several as one, returns.
struct Echo {
  double range_m = 0;
  double z_m = 0;  // depth along the boresight
  double electrons = 0;
  bool scattered = false;  // by a volume that is no surface
};
constexpr std::size_t kMostEchoes = 3;

// Of a ray, in the order in which they were found.
class Echoes {
 public:
  void add(const Echo& echo) { echoes_[count_++] = echo; }  // at most kMostEchoes
  std::size_t size() const { return count_; }
  Echo& operator[](std::size_t i) { return echoes_[i]; }
  const Echo& operator[](std::size_t i) const { return echoes_[i]; }

 private:
  std::array<Echo, kMostEchoes> echoes_{};
  std::size_t count_ = 0;
};

// All that chance decides in the detector for one ray; a stream of its own, so that the other draws are the same without a detector.
struct DetectorDraws {
  std::array<double, kMostEchoes> counts{};  // standard normal
  double alarm = 1;                          // uniform (0, 1]
};
DetectorDraws draw_detector(std::uint64_t seed, std::uint32_t scan_id, std::uint32_t ray);

// Noise that exceeds the threshold where nothing is. Through a filter that fits a pulse of width w, noise crosses a threshold T upwards
// exp(-T^2 / (2 N^2)) / (2 sqrt(2) pi w) times a metre (Rice 1945), and the first of these within the measured ranges is taken for a
// return.
class FalseAlarms {
 public:
  FalseAlarms(const DetectorModel& model, double range_min_m, double range_max_m);

  // Mean number for a ray.
  double mean(double background) const;
  // The range of one, or a negative number where there is none.
  double range_m(double background, const DetectorDraws& draws) const;

 private:
  DetectorModel model_;
  std::vector<double> ranges_m_, widths_;  // and how many pulses fit in between the first range and each
};

struct Detection {
  RayState state = RayState::kMiss;
  Echo echo;
};

// Which echo the sensor tells, of those that exceed the threshold. Surfaces nearer to each other than 2.35 w, the full width at half of the
// height, are one, at the mean of their ranges by their light; all surfaces where returns are mixed, and then the first return is told.
Detection detect(const DetectorModel& model, Echoes echoes, double background, const DetectorDraws& draws);

// Added in squares to the range noise of the scanner's model; 0 where no detector is simulated.
double detector_sigma_m(const DetectorModel& model, const Echo& echo, double background);

}  // namespace lasso::sim
