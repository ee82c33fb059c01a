#include "mdat/modelc/view_table.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "mdat/modelc/embree_scene.hpp"
#include "mdat/modelc/parallel.hpp"

namespace lasso::mdat {
namespace {

constexpr int kRays = 2304;
constexpr double kNearSpread = 1.5;  // parts of the model before the plane look larger
constexpr double kFarthest = 8;      // radii: beyond all that a ray can meet

// What is seen, each place with the area that it stands for.
class Seen {
 public:
  explicit Seen(const Vec3d& direction) : direction_(direction) {}
  void add(const Vec3d& point, double weight) {
    places_.emplace_back(-direction_.dot(point), weight);
    sum_ += weight * point;
    weight_ += weight;
  }
  bool nothing() const { return places_.empty(); }
  Vec3d centroid() const { return sum_ / weight_; }
  // Of the depth, from the centroid.
  double median() {
    std::sort(places_.begin(), places_.end());
    double below = 0;
    for (const auto& [depth, weight] : places_) {
      below += weight;
      if (2 * below >= weight_) return depth + direction_.dot(centroid());
    }
    return 0;
  }

 private:
  Vec3d direction_;
  std::vector<std::pair<double, double>> places_;  // depth, weight
  Vec3d sum_ = Vec3d::Zero();
  double weight_ = 0;
};

// Rays through a square of the plane through the model's middle, across `direction`: parallel, or from one place before it.
class Looker {
 public:
  Looker(const EmbreeScene& scene, const Surface& surface)
      : scene_(scene),
        middle_((surface.low + surface.high) / 2),
        radius_((surface.high - surface.low).norm() / 2),
        extent_(surface.extent) {}

  View see(const Vec3d& direction) const {
    View view{direction, middle_, middle_, 0, 0, {}};
    Seen seen(direction), near_seen(direction);
    const Vec3d eye = middle_ + static_cast<double>(kNearView) * extent_ * direction;
    for (int i = 0; i < kRays; ++i) {
      const Vec3d across = place(direction, i);
      if (const Vec3d from = middle_ + 2 * radius_ * direction + across; hits(from, -direction)) {
        view.seen.push_back(point_);
        seen.add(point_, 1);
      }
      if (hits(eye, (middle_ + kNearSpread * across - eye).normalized())) near_seen.add(point_, (point_ - eye).squaredNorm());
    }
    if (!seen.nothing()) {
      view.centroid = view.near_centroid = seen.centroid();
      view.median = view.near_median = seen.median();
    }
    if (!near_seen.nothing()) {
      view.near_centroid = near_seen.centroid();
      view.near_median = near_seen.median();
    }
    return view;
  }

 private:
  // Rows and columns would meet a thin part seen edge-on along all its length, or not at all: the places lie on a Fibonacci lattice.
  Vec3d place(const Vec3d& direction, int i) const {
    const Vec3d right = direction.unitOrthogonal();
    const double x = (2.0 * i + 1) / kRays - 1;
    const double turns = i * std::numbers::phi;
    const double y = 2 * (turns - std::floor(turns)) - 1;
    return radius_ * (x * right + y * direction.cross(right));
  }
  bool hits(const Vec3d& from, const Vec3d& direction) const {
    const double range = scene_.first_hit(from, direction);
    point_ = from + range * direction;
    return range < kFarthest * radius_;
  }

  const EmbreeScene& scene_;
  Vec3d middle_;
  double radius_, extent_;
  mutable Vec3d point_;
};

}  // namespace

std::vector<Vec3d> spread_directions(std::size_t count) {
  std::vector<Vec3d> directions;
  for (std::size_t i = 0; i < count; ++i) {
    const double z = 1 - (2 * static_cast<double>(i) + 1) / static_cast<double>(count);
    const double angle = 2 * std::numbers::pi * static_cast<double>(i) / std::numbers::phi;
    const double r = std::sqrt(1 - z * z);
    directions.emplace_back(r * std::cos(angle), r * std::sin(angle), z);
  }
  return directions;
}

std::vector<View> make_views(const Surface& surface) {
  EmbreeScene scene;
  scene.add_triangles(surface);
  scene.commit();
  const std::vector<Vec3d> directions = spread_directions(kViewCount);
  std::vector<View> views(directions.size());
  parallel_for(views.size(), [&](std::size_t i) { views[i] = Looker(scene, surface).see(directions[i]); });
  return views;
}

std::vector<std::uint32_t> view_words(const std::vector<View>& views, const LengthScale& scale) {
  std::vector<std::uint32_t> words;
  for (const View& view : views) {
    for (int i = 0; i < 3; ++i) words.push_back(static_cast<std::uint32_t>(unit_word(view.direction[i])));
    for (const Vec3d* p : {&view.centroid, &view.near_centroid}) {
      for (int i = 0; i < 3; ++i) words.push_back(static_cast<std::uint32_t>(scale.to_word((*p)[i])));
    }
    for (const double median : {view.median, view.near_median}) words.push_back(static_cast<std::uint32_t>(scale.to_word(median)));
  }
  return words;
}

}  // namespace lasso::mdat
