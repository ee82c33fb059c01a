// Whole searches of scans of a target without symmetry.
#pragma once

#include "fsw/geometry/portable_math.hpp"
#include "fsw/pose/recognition/pose_search.hpp"
#include "ut/pose/search_fixture.hpp"

namespace lasso::test {

constexpr std::uint32_t kSlice = 200'000;

class WholeSearch : public SearchFixture {
 protected:
  using SearchFixture::SearchFixture;

  // A scan at `t_s` of the target as its motion has brought it.
  std::unique_ptr<RangeImage> scan_at(double t_s) {
    BoxScan at = scan_;
    at.T_sensor_target = propagate(scan_.T_sensor_target, scan_.rates, t_s);
    auto image = scan_box(at, random_);
    for (RangeSample& sample : image->samples) sample.t_us += static_cast<TimeUs>(1e6 * t_s);
    return image;
  }
  void work() {
    while (!search_->advance(mission_, *workspace_, kSlice)) {
    }
  }
  Status search(double t_s = 0) {
    const Status status = search_->add_scan(mission_, *scan_at(t_s), *workspace_);
    work();
    return status;
  }
  // A search of that scan alone, with that much work.
  const SearchResult& search_within(std::uint32_t work_max, const RangeImage& image) {
    limits_.work_max = work_max;
    search_->begin(limits_);
    EXPECT_EQ(search_->add_scan(mission_, image, *workspace_), Status::kOk);
    work();
    return result();
  }
  bool is_right(const Pose& pose, double t_s = 0) const {
    const Vec6 error = pose_difference(pose, propagate(scan_.T_sensor_target, scan_.rates, t_s));
    return error.head<3>().norm() < 2 * kRadPerDeg && error.tail<3>().norm() < 0.02;
  }
  const SearchResult& result() const { return search_->result(); }
  // Little work, where the pose that is found does not matter.
  void look_from_few_sides() {
    mission_.search.views = mission_.search.views.first(1);
    mission_.search.symmetries = mission_.search.symmetries.first(1);
  }

  SearchLimits limits_;
  std::unique_ptr<PoseSearch> search_ = std::make_unique<PoseSearch>();
};

}  // namespace lasso::test
