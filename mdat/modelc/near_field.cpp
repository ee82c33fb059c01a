#include "mdat/modelc/near_field.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "mdat/modelc/embree_scene.hpp"
#include "mdat/modelc/parallel.hpp"

namespace lasso::mdat {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();
constexpr double kRadiusSlack = 1e-5;  // Embree prunes in single precision: look a little farther than the best so far
constexpr double kOpposing = -1e-6;

struct Query {
  const std::vector<Element>* elements;
  Vec3d p;
  const Vec3d* against;  // null: any normal
  double radius_m;
  double tie_m;
  double plane_distance = 0;
  NearestElement best;
};

void element_bounds(const RTCBoundsFunctionArguments* arguments) {
  const auto& e = (*static_cast<const std::vector<Element>*>(arguments->geometryUserPtr))[arguments->primID];
  Vec3d low = e.corners[0], high = e.corners[0];
  for (std::size_t i = 1; i < static_cast<std::size_t>(e.sides); ++i) {
    low = low.cwiseMin(e.corners[i]);
    high = high.cwiseMax(e.corners[i]);
  }
  const auto down = [](double x) { return std::nextafter(static_cast<float>(x), -kInfinity); };
  const auto up = [](double x) { return std::nextafter(static_cast<float>(x), kInfinity); };
  RTCBounds& bounds = *arguments->bounds_o;
  bounds.lower_x = down(low.x());
  bounds.lower_y = down(low.y());
  bounds.lower_z = down(low.z());
  bounds.upper_x = up(high.x());
  bounds.upper_y = up(high.y());
  bounds.upper_z = up(high.z());
}

bool is_better(const Query& q, std::uint32_t index, double distance, double plane_distance) {
  if (q.best.element == kNone) return true;
  if (distance < q.best.distance_m - q.tie_m) return true;
  if (distance > q.best.distance_m + q.tie_m) return false;
  if (plane_distance > q.plane_distance + q.tie_m) return true;
  return plane_distance > q.plane_distance - q.tie_m && index < q.best.element;
}

bool visit_element(RTCPointQueryFunctionArguments* arguments) {
  Query& q = *static_cast<Query*>(arguments->userPtr);
  const Element& e = (*q.elements)[arguments->primID];
  if (q.against != nullptr && e.n.dot(*q.against) >= kOpposing) return false;
  const Vec3d point = closest_point(e, q.p);
  const double distance = (point - q.p).norm();
  const double plane_distance = std::abs(e.n.dot(q.p) - e.d);
  if (distance > q.radius_m || !is_better(q, arguments->primID, distance, plane_distance)) return false;
  q.best = {arguments->primID, distance, point};
  q.plane_distance = plane_distance;
  const auto radius = static_cast<float>(distance * (1 + kRadiusSlack) + 2 * q.tie_m);
  if (!(radius < arguments->query->radius)) return false;
  arguments->query->radius = radius;
  return true;
}

}  // namespace

class NearestSearch::Impl {
 public:
  explicit Impl(const std::vector<Element>& elements) : elements_(elements) {
    scene_.add_user(static_cast<unsigned>(elements.size()), element_bounds, visit_element, const_cast<std::vector<Element>*>(&elements));
    scene_.commit();
    for (const Element& e : elements) size_m_ = std::max(size_m_, e.corners[0].cwiseAbs().maxCoeff());
  }

  NearestElement search(const Vec3d& p, const Vec3d* against, double radius_m) const {
    Query query{&elements_, p, against, radius_m, 1e-9 * size_m_, 0, {}};
    RTCPointQuery place{};
    place.x = static_cast<float>(p.x());
    place.y = static_cast<float>(p.y());
    place.z = static_cast<float>(p.z());
    place.radius = static_cast<float>(radius_m * (1 + kRadiusSlack) + kRadiusSlack * size_m_);
    RTCPointQueryContext context;
    rtcInitPointQueryContext(&context);
    rtcPointQuery(scene_.scene(), &place, &context, nullptr, &query);
    return query.best;
  }

 private:
  const std::vector<Element>& elements_;
  EmbreeScene scene_;
  double size_m_ = 0;
};

NearestSearch::NearestSearch(const std::vector<Element>& elements) : impl_(std::make_unique<Impl>(elements)) {}
NearestSearch::~NearestSearch() = default;

NearestElement NearestSearch::closest(const Vec3d& p) const { return impl_->search(p, nullptr, std::numeric_limits<double>::infinity()); }

NearestElement NearestSearch::closest_opposing(const Vec3d& p, const Vec3d& normal, double radius_m) const {
  return impl_->search(p, &normal, radius_m);
}

namespace {

constexpr std::uint32_t kNearCellsPerAxis = 4;
constexpr std::uint32_t kNearCellCount = kNearCellsPerAxis * kNearCellsPerAxis * kNearCellsPerAxis;
static_assert(2 * kNearCellCount == kNearWordsPerBrick);

// Half of a cube's diagonal over its edge.
constexpr double kHalfDiagonal = std::numbers::sqrt3 / 2;

Vec3d near_center(const Grid& grid, std::uint32_t brick, std::uint32_t cell) {
  const double edge = 2 * grid.cell_m;
  return grid.brick_corner(brick) + edge * Vec3d((cell & 3) + 0.5, (cell >> 2 & 3) + 0.5, (cell >> 4) + 0.5);
}

struct NearBrick {
  std::uint32_t brick = 0;
  bool within_band = false;  // some near cell may hold a point of the band
  std::array<std::uint32_t, kNearWordsPerBrick> words{};
};

NearBrick make_near_brick(const NearestSearch& search, const std::vector<Element>& elements, const Grid& grid, std::uint32_t brick,
                          double band_m) {
  NearBrick result;
  result.brick = brick;
  const double cell_reach = band_m + kHalfDiagonal * 2 * grid.cell_m;
  for (std::uint32_t cell = 0; cell < kNearCellCount; ++cell) {
    const Vec3d center = near_center(grid, brick, cell);
    const NearestElement nearest = search.closest(center);
    const NearestElement other = search.closest_opposing(center, elements[nearest.element].n, band_m);
    result.within_band = result.within_band || nearest.distance_m <= cell_reach;
    result.words[2 * cell] = 1 + nearest.element;
    result.words[2 * cell + 1] = other.element == kNone ? 0 : 1 + other.element;
  }
  return result;
}

}  // namespace

NearField make_near_field(const std::vector<Element>& elements, const Grid& grid, const LengthScale& scale, double band_m,
                          CompileReport& report) {
  const NearestSearch search(elements);
  std::vector<NearestElement> feet(grid.brick_count());
  parallel_for(feet.size(), [&](std::size_t i) { feet[i] = search.closest(grid.brick_center(static_cast<std::uint32_t>(i))); });
  const double brick_reach = band_m + kHalfDiagonal * grid.brick_m();
  std::vector<NearBrick> near;
  NearField field;
  for (std::uint32_t brick = 0; brick < feet.size(); ++brick) {
    for (int i = 0; i < 3; ++i) field.foot_points.push_back(static_cast<std::uint32_t>(scale.to_word(feet[brick].point[i])));
    if (feet[brick].distance_m <= brick_reach) near.emplace_back().brick = brick;
  }
  parallel_for(near.size(), [&](std::size_t i) { near[i] = make_near_brick(search, elements, grid, near[i].brick, band_m); });
  field.brick_words.assign(feet.size(), 0);
  for (const NearBrick& brick : near) {
    if (!brick.within_band) continue;
    field.brick_words[brick.brick] = static_cast<std::uint32_t>(1 + field.cells.size() / kNearWordsPerBrick);
    field.cells.insert(field.cells.end(), brick.words.begin(), brick.words.end());
  }
  report.bricks = feet.size();
  report.near_bricks = field.cells.size() / kNearWordsPerBrick;
  return field;
}

}  // namespace lasso::mdat
