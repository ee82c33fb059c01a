// Scans of a target without symmetry, three boxes, for the tests of the search's stages.
#pragma once

#include <memory>

#include "fsw/pose/evidence.hpp"
#include "ut/pose/pose_fixture.hpp"

namespace lasso::test {

inline Boxes uneven_boxes() {
  BoxModel main;
  BoxModel tower{{0.20, 0.10, 0.25}, {0.06, 0.05, 0.08}, 0.02, 0.2};
  BoxModel arm{{-0.45, -0.08, 0.05}, {0.10, 0.05, 0.04}, 0.02, 0.2};
  return {main, tower, arm};
}

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
  std::unique_ptr<Evidence> make_evidence() {
    auto maker = std::make_unique<EvidenceMaker>();
    auto evidence = std::make_unique<Evidence>();
    maker->begin(mission_, *workspace_);
    while (maker->step(mission_, *evidence)) {
    }
    return evidence;
  }
};

}  // namespace lasso::test
