// Two cameras beside each other, and the pictures that they take of a simulated target. The left camera's frame is the sensor frame.
#pragma once

#include <optional>

#include "mdat/missiondb/stereo_pair_file.hpp"
#include "mdat/missiondb/stereo_source.hpp"
#include "mdat/pair/grey_picture.hpp"
#include "mdat/render/render.hpp"
#include "mdat/stereo/imager.hpp"

namespace lasso::mdat {

struct StereoHead {
  Camera camera;      // both are alike
  Pose T_left_right;  // where the right one truly stands
  StereoPair stated;  // what its calibration says
  Imager imager;
  StereoSource source;
};

// The field of view, half angles beside and above the boresight, is that of each camera.
StereoHead make_head(const StereoSource& source, double fov_half_x_rad, double fov_half_y_rad);

// What stands before the cameras; lights in the sensor frame.
struct StereoView {
  const ModelSurface& surface;
  std::vector<Material> materials;  // one for each part
  Lights lights;
  Pose T_sensor_target;
};

// Of a mission's light: the orbit's, or else the directions of `source`; without Earth's, and with the lamp, as `source` says; and the
// scene's lamps.
Lights stereo_lights(const StereoSource& source, const std::optional<Lights>& of_orbit, const std::vector<Lamp>& lamps);

// Without relief and shades, where `source` says so.
std::vector<Material> stereo_materials(const StereoSource& source, std::vector<Material> materials);

struct StereoPictures {
  GreyPicture<std::uint8_t> left, right;
  double exposure_s = 0;
  double saturated = 0;  // share of the left picture
};

// Pictures of one head, one after the other. The first is exposed as the control settles before it; each further one as the control has
// chosen by the one before, whatever the light is then.
class StereoCamera {
 public:
  StereoCamera(StereoHead head, std::uint64_t seed) : head_(std::move(head)), seed_(seed) {}

  // `jobs`: rows rendered at a time; no effect on the pictures. `progress`: called with rows done, of two pictures; may be empty.
  StereoPictures take(const StereoView& view, unsigned jobs, const std::function<void(std::size_t)>& progress = {});
  const StereoHead& head() const { return head_; }

 private:
  GreyImage seen_by(const StereoView& view, bool right, unsigned jobs, const std::function<void(std::size_t)>& progress) const;

  StereoHead head_;
  std::uint64_t seed_, frame_ = 0;
  double next_exposure_s_ = 0;  // 0: none was measured yet
};

}  // namespace lasso::mdat
