// What single pixels of the left picture truly show, and how bright it is in a head's exposure: without rendering the pictures.
#pragma once

#include <cstdint>

#include "mdat/render/shading.hpp"
#include "mdat/stereo/stereo_head.hpp"

namespace lasso::mdat {

enum class PixelRegion : std::uint8_t {
  kInside = 0,    // of a surface
  kNearEdge = 1,  // within the band about an edge of depth, on the nearer side
  kFarEdge = 2,   // there, and something nearer is beside it
  kHidden = 3,    // the right camera does not see it
  kSky = 4,       // nothing, with the target beside it
  kEmpty = 5,     // nothing
};
constexpr std::size_t kPixelRegions = 5;  // without kEmpty

struct PixelSight {
  PixelRegion region = PixelRegion::kEmpty;
  double disparity_px = 0;  // that the pair truly has there, 0 where nothing is
  double nearer_px = 0;     // the greatest within the band: what a matcher may spread over this pixel
  double level = 0;         // root of the share of the full well, 0 to 1: without noise, blur and glare
  bool dark = false;        // the matcher leaves it out as such: it, or a window beside it, is not above the noise
};

class PairSight {
 public:
  // Keeps both by reference.
  PairSight(const StereoHead& head, const StereoView& view);

  // As the camera's control chooses it (exposure_control.hpp), by a grid of pixels: settled before a view at rest, or the next one after a
  // frame of `exposure_s`.
  double settled_exposure_s() const;
  double next_exposure_s(double exposure_s) const;

  PixelSight at(int column, int row, double exposure_s) const;

 private:
  struct Seen;
  Seen seen_at(double column, double row) const;
  double disparity_of(double column, const Vec3& point_m) const;
  bool is_hidden(const Vec3& point_m) const;
  double electrons_of(const Seen& seen, double exposure_s) const;
  RawFrame grid_frame(double exposure_s) const;

  const StereoHead& head_;
  const StereoView& view_;
  Pose T_target_sensor_;
  Shader shader_;
  double electrons_;          // a second, for each W/m2/sr of the band
  std::vector<double> grid_;  // radiance
};

}  // namespace lasso::mdat
