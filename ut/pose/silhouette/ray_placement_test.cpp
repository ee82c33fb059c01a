#include "fsw/pose/silhouette/ray_placement.hpp"

#include <Eigen/LU>
#include <set>

#include "ut/pose/silhouette_fixture.hpp"
#include "ut/support/dense.hpp"
#include "ut/support/verifies.hpp"

namespace lasso {
namespace {

using test::BoxEdge;
using test::OcclusionTest;
using test::RayLine;
using test::SilhouetteTest;

constexpr double kSigmaM = 8e-4;
constexpr double kSigmaRad = 1e-3;

// Aiming at scenes of boxes, whose contours are known in closed form.
template <class Scene>
class AimScene : public Scene {
 protected:
  AimScene() {
    this->parameters().aimed_share = 0.3;
    this->parameters().deskew = 0;
    this->parameters().silhouette_band_m = 0.01;
    request_.scan_id = 3;
    request_.covariance.diagonal() << Vec3::Constant(kSigmaRad * kSigmaRad), Vec3::Constant(kSigmaM * kSigmaM);
  }

  void aim() {
    request_.T_sensor_target = this->scan_.T_sensor_target;
    aim_rays(this->mission_, request_, *this->workspace_, rays_);
  }

  // The ray in the target frame, as `T_target_sensor` has it.
  RayLine line(std::size_t ray, const Pose& T_target_sensor) const {
    const Vec3 through(static_cast<double>(rays_[ray].x), static_cast<double>(rays_[ray].y), 1);
    return {T_target_sensor.p, rotate(T_target_sensor.q, through.normalized())};
  }
  RayLine line(std::size_t ray) const { return line(ray, this->truth()); }

  // The visible contour edge that the rays of a place are spread across: the one nearest to both of its outer rays.
  const BoxEdge* edge_of_place(std::size_t first, const std::vector<BoxEdge>& edges) const {
    const BoxEdge* best = nullptr;
    double least = 0.02;
    for (const BoxEdge& edge : edges) {
      const auto one = test::line_to_edge(line(first), edge);
      const auto other = test::line_to_edge(line(first + kRaysPerPlace - 1), edge);
      if (one.m + other.m > least || !this->is_visible(edge, one.point)) continue;
      least = one.m + other.m;
      best = &edge;
    }
    return best;
  }

  // Rays at contours; those at surfaces follow.
  std::size_t rays_at_contours() const {
    std::size_t places = 0;
    for (const AimPlace& place : this->workspace_->places) places += !place.surface && place.fate == AimPlace::Fate::kChosen ? 1u : 0u;
    return places * kRaysPerPlace;
  }

  // Across edge and ray, to one side of the edge.
  static Vec3 across(const RayLine& line, const BoxEdge& edge) { return (edge.b - edge.a).cross(line.u).normalized(); }

  // Change of the ray's distance from the edge with the pose, by differences, at the point of the edge that it passes.
  Vec6 row(std::size_t ray, const BoxEdge& edge) const {
    constexpr double kStep = 1e-5;
    const Vec3 place = test::line_to_edge(line(ray), edge).point;
    Vec6 a;
    for (int k = 0; k < 6; ++k) {
      const auto side = [&](double step) {
        const RayLine moved = line(ray, step_pose(this->truth(), step * Vec6::Unit(k)));
        return across(line(ray), edge).dot(moved.origin + (place - moved.origin).dot(moved.u) * moved.u - place);
      };
      a[k] = (side(kStep) - side(-kStep)) / (2 * kStep);
    }
    return a;
  }

  Mat6 covariance_in_target_axes() const {
    Mat6 J = Mat6::Zero();
    J.topLeftCorner<3, 3>() = to_matrix(this->scan_.T_sensor_target.q);
    J.bottomRightCorner<3, 3>() = J.topLeftCorner<3, 3>();
    return J.transpose() * request_.covariance * J;
  }

  void expect_places_on_contour() const;

  RayPlacementRequest request_;
  AimedRays rays_;
};

template <class Scene>
void AimScene<Scene>::expect_places_on_contour() const {
  const std::vector<BoxEdge> edges = this->contour_edges();
  ASSERT_LE(rays_at_contours(), rays_.size());
  for (std::size_t first = 0; first < rays_at_contours(); first += kRaysPerPlace) {
    const BoxEdge* edge = edge_of_place(first, edges);
    ASSERT_NE(edge, nullptr) << first;
    double offset[kRaysPerPlace];
    for (std::size_t i = 0; i < kRaysPerPlace; ++i) {
      const auto from_edge = test::line_to_edge(line(first + i), *edge);
      const RayLine ray = line(first + i);
      const Vec3 nearest = ray.origin + (from_edge.point - ray.origin).dot(ray.u) * ray.u;
      offset[i] = across(line(first), *edge).dot(nearest - from_edge.point);
    }
    // Evenly over two sigmas to either side of where the prediction has the edge.
    const Vec6 a = row(first, *edge);
    const double own = this->mission_.parameters.silhouette_sigma_m;
    const double s_pred = std::sqrt(a.dot(covariance_in_target_axes() * a) + own * own);
    const double spacing = 4 * s_pred / kRaysPerPlace;
    for (std::size_t i = 1; i < kRaysPerPlace; ++i) EXPECT_NEAR(std::abs(offset[i] - offset[i - 1]), spacing, 0.02 * spacing);
    EXPECT_LT(std::max(std::abs(offset[0]), std::abs(offset[kRaysPerPlace - 1])), 2.05 * s_pred);
  }
}

using AimTest = AimScene<SilhouetteTest>;
using AimOcclusionTest = AimScene<OcclusionTest>;

TEST_F(AimTest, RaysPassThePredictedContourEvenlyWithinTwoSigma) {
  VERIFIES("LASSO-SNS-014~2 LASSO-MOD-151~2");
  for (int i = 0; i < 8; ++i) {
    scan_.T_sensor_target = test::random_box_pose(random_);
    request_.scan_id = static_cast<std::uint32_t>(i);
    aim();
    EXPECT_EQ(rays_.size(), 306u);  // 0.3 of 1024, in places of six
    EXPECT_GT(rays_at_contours(), 60u);
    expect_places_on_contour();
  }
}

TEST_F(AimOcclusionTest, RaysPassVisibleContoursOnly) {
  VERIFIES("LASSO-SNS-014~2");
  for (int i = 0; i < 8; ++i) {
    scan_.T_sensor_target = over_face();
    aim();
    EXPECT_GT(rays_at_contours(), 60u);
    expect_places_on_contour();
  }
}

// What is left of the variance of the target's points after labels at the places, each as good as its rays are at best.
double left_over(const Mat6& information, const std::vector<Vec6>& rows, double radius_m, double sigma_m) {
  Mat6 sum = information;
  for (const Vec6& a : rows) sum += a * a.transpose() / (sigma_m * sigma_m);
  const Mat6 C = test::inverse_of(sum);
  return radius_m * radius_m * C.topLeftCorner<3, 3>().trace() + C.bottomRightCorner<3, 3>().trace();
}

// One direction is known badly: the places chosen tell more about it than as many spread evenly along the contour do.
TEST_F(AimTest, PlacesAreWhereTheUncertaintyIs) {
  VERIFIES("LASSO-SNS-015~1 LASSO-MOD-151~2");
  parameters().aimed_share = 0.06;  // ten places
  parameters().sigma0_m = 0.5;      // returns tell next to nothing
  int better = 0;
  for (int i = 0; i < 10; ++i) {
    scan_.T_sensor_target = test::random_box_pose(random_);
    const Vec6 loose = test::random_vec6(random_, 3e-3);
    request_.covariance = 1e-8 * Mat6::Identity() + loose * loose.transpose();
    aim();
    ASSERT_EQ(rays_.size(), 60u);
    const std::vector<BoxEdge> edges = contour_edges();
    std::vector<Vec6> chosen;
    for (std::size_t first = 0; first < rays_.size(); first += kRaysPerPlace) chosen.push_back(row(first, *edge_of_place(first, edges)));
    std::vector<Vec6> spread;
    std::vector<Vec6> along;
    for (const AimPlace& place : workspace_->places) {
      if (!place.surface) along.push_back(place.a);
    }
    for (std::size_t k = 0; k < 10; ++k) spread.push_back(along[k * along.size() / 10]);
    const Mat6 information = test::inverse_of(covariance_in_target_axes());
    better += left_over(information, chosen, mission_.radius_m, 5e-4) < left_over(information, spread, mission_.radius_m, 5e-4) ? 1 : 0;
  }
  EXPECT_GE(better, 9);
}

// Where returns tell much, rays go to surfaces as well, and return.
TEST_F(AimTest, SurfacesAreChosenWhereReturnsTellMore) {
  VERIFIES("LASSO-SNS-014~2 LASSO-SNS-015~1 LASSO-MOD-151~2");
  parameters().sigma0_m = 0.5;
  aim();
  EXPECT_EQ(rays_at_contours(), 306u) << "returns tell next to nothing";
  parameters().sigma0_m = 1e-3;
  parameters().silhouette_sigma_m = 5e-3;
  std::size_t at_surfaces = 0;
  std::size_t returned = 0;
  for (int i = 0; i < 8; ++i) {  // where one face is seen, contours alone tell where it ends
    scan_.T_sensor_target = test::random_box_pose(random_);
    aim();
    ASSERT_EQ(rays_.size(), 306u);
    for (std::size_t ray = rays_at_contours(); ray < rays_.size(); ++ray) {
      ++at_surfaces;
      returned += test::cast_box({}, line(ray).origin, line(ray).u) > 0 ? 1u : 0u;
    }
  }
  EXPECT_GT(at_surfaces, 600u);
  EXPECT_GT(returned, at_surfaces * 9 / 10) << "all but a few beside an edge";
}

TEST_F(AimTest, RaysMeetTheirPlacesAtTheirOwnTimes) {
  VERIFIES("LASSO-SNS-014~2 LASSO-REG-004~2");
  request_.rates.omega_radps = Vec3(0.08, -0.06, 0.05);
  request_.rates.v_mps = Vec3(0.06, -0.09, 0.05);
  aim();
  const AimedRays still = rays_;
  parameters().deskew = 1;
  aim();
  const AimedRays moving = rays_;
  ASSERT_EQ(moving.size(), still.size());
  const std::vector<BoxEdge> edges = contour_edges();
  for (std::size_t i = 0; i < rays_at_contours(); ++i) {
    rays_ = still;
    const BoxEdge* edge = edge_of_place(i - i % kRaysPerPlace, edges);
    ASSERT_NE(edge, nullptr);
    const double distance = test::line_to_edge(line(i), *edge).m;
    rays_ = moving;
    const double tau_s = (static_cast<double>(i) - 0.5 * static_cast<double>(moving.size() - 1)) * parameters().duration_s / 1023;
    const Pose then = propagate(scan_.T_sensor_target, request_.rates, tau_s);
    EXPECT_NEAR(test::line_to_edge(line(i, inverse(then)), *edge).m, distance, 1e-5);
  }
  EXPECT_GT(std::abs(moving[0].x - still[0].x), 1e-4F);
}

TEST_F(AimTest, OffsetsDifferFromScanToScan) {
  VERIFIES("LASSO-SNS-014~2");
  aim();
  const AimedRays before = rays_;
  aim();
  std::size_t same = 0;
  for (std::size_t i = 0; i < rays_.size(); ++i) same += rays_[i].x == before[i].x && rays_[i].y == before[i].y ? 1u : 0u;
  EXPECT_EQ(same, rays_.size());
  ++request_.scan_id;
  aim();
  same = 0;
  for (std::size_t i = 0; i < std::min(rays_.size(), before.size()); ++i) same += rays_[i].x == before[i].x ? 1u : 0u;
  EXPECT_LT(same, 10u);
}

TEST_F(AimTest, NoRaysWithoutUseForThem) {
  VERIFIES("LASSO-SNS-016~1");
  parameters().silhouettes = 0;
  aim();
  EXPECT_TRUE(rays_.empty());
  parameters().silhouettes = 1;
  parameters().aimed_share = 0.005;  // fewer than a place's
  aim();
  EXPECT_TRUE(rays_.empty());
  parameters().aimed_share = 0.3;
  parameters().silhouette_band_m = 5e-4;  // the prediction is less certain
  aim();
  EXPECT_TRUE(rays_.empty());
  mission_.edges = {};
  parameters().silhouette_band_m = 0.01;
  aim();
  EXPECT_TRUE(rays_.empty());
}

TEST_F(AimTest, NoRaysFromAPredictionThatCannotBe) {
  VERIFIES("LASSO-SNS-016~1");
  request_.covariance.setZero();
  aim();
  EXPECT_TRUE(rays_.empty());
  request_.covariance = 1e6 * Mat6::Identity();  // far from what the returns will tell: their sum has no inverse
  scan_.T_sensor_target.q = Quat(1, 0, 0, 0);    // one face alone
  aim();
  EXPECT_TRUE(rays_.empty());
}

TEST_F(AimTest, RaysStayInTheFieldOfView) {
  VERIFIES("LASSO-SNS-014~2");
  for (const auto& [half_x, half_y] : {std::pair<double, double>{0.05, 0.5}, {0.5, 0.05}}) {
    parameters().fov_half_x_rad = half_x;
    parameters().fov_half_y_rad = half_y;
    aim();
    EXPECT_GT(rays_.size(), 0u);
    for (const AimedRay& ray : rays_) {
      EXPECT_LT(std::abs(static_cast<double>(ray.x)), std::tan(half_x));
      EXPECT_LT(std::abs(static_cast<double>(ray.y)), std::tan(half_y));
    }
  }
}

TEST_F(AimTest, WhereFewPlacesAreInTheFieldOfViewAllAreTaken) {
  VERIFIES("LASSO-SNS-014~2");
  parameters().fov_half_x_rad = parameters().fov_half_y_rad = 0.07;
  aim();
  EXPECT_GT(rays_.size(), 0u);
  EXPECT_LT(rays_.size(), 306u);
}

TEST_F(AimTest, AScanHasRoomForSoMany) {
  VERIFIES("LASSO-SNS-014~2");
  parameters().points = 4096;
  parameters().aimed_share = 0.5;
  aim();
  EXPECT_EQ(rays_.size(), kMaxAimedRays);
}

// The returns that the scan will have anyway count: grazed faces and a target that is partly behind the sensor do no harm.
TEST_F(AimTest, HardViews) {
  VERIFIES("LASSO-SNS-016~1");
  parameters().incidence_max_rad = 0.8;
  aim();
  EXPECT_EQ(rays_.size(), 306u);
  scan_.T_sensor_target.p = Vec3(0.1, 0.05, 0.02);  // around the sensor
  aim();
  EXPECT_LE(rays_.size(), 306u);
  scan_.T_sensor_target.p = Vec3(0, 0, 1e6);  // beyond where the field can be asked
  aim();
  EXPECT_LE(rays_.size(), 306u);
}

}  // namespace
}  // namespace lasso
