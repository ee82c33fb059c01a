// Scans of a target without symmetry, three boxes, for the tests of the search's stages.
#pragma once

#include <memory>

#include "fsw/pose/recognition/scan_subset.hpp"
#include "ut/pose/pose_fixture.hpp"

namespace lasso::test {

inline const Mission& uneven_mission() {
  static const LoadedImage loaded(uneven_boxes());
  return loaded.mission;
}

class SearchFixture : public PoseFixture {
 protected:
  explicit SearchFixture(const Mission& mission = uneven_mission()) : PoseFixture(mission) {
    scan_.others = {uneven_boxes()[1], uneven_boxes()[2]};
    scan_.half_angle = 0.26;
    scan_.sigma_m = 1e-3;
  }

  // All of a scan's evidence.
  std::unique_ptr<ScanSubset> make_evidence() {
    auto maker = std::make_unique<ScanSubsetMaker>();
    auto subset = std::make_unique<ScanSubset>();
    maker->begin(mission_, *workspace_);
    std::uint32_t work = 0;
    while (maker->step(mission_, *subset, work)) {
    }
    return subset;
  }
};

}  // namespace lasso::test
