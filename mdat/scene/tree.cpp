#include "mdat/scene/tree.hpp"

#include <utility>

#include "mdat/scene/tree_check.hpp"
#include "mdat/source/nearest.hpp"

namespace lasso::mdat::scene {
namespace {

// Both rows of a 6 x 6 matrix that turns rotations and translations by R, and adds rotation x lever to translations before.
Mat6 turned_with_lever(const Mat3& R, const Vec3& lever_m) {
  Mat6 adjoint = Mat6::Zero();
  adjoint.topLeftCorner<3, 3>() = R;
  adjoint.bottomRightCorner<3, 3>() = R;
  adjoint.bottomLeftCorner<3, 3>() = -R * skew(lever_m);
  return adjoint;
}

Mat6 moved(const Mat6& covariance, const Mat6& adjoint) { return adjoint * covariance * adjoint.transpose(); }

}  // namespace

Tree::Tree(std::string root, std::vector<Node> nodes) : nodes_(std::move(nodes)) {
  Node first;
  first.name = std::move(root);
  nodes_.insert(nodes_.begin(), std::move(first));
  TreeLinks links = checked_links(nodes_);
  parents_ = std::move(links.parents);
  towards_ = std::move(links.towards);
  for (std::size_t i = 0; i < nodes_.size(); ++i) {
    std::size_t depth = 0;
    for (std::size_t node = i; node != 0; node = parents_[node]) ++depth;
    depths_.push_back(depth);
  }
}

std::optional<std::size_t> Tree::find(std::string_view name) const {
  for (std::size_t i = 0; i < nodes_.size(); ++i) {
    if (nodes_[i].name == name) return i;
  }
  return std::nullopt;
}

std::size_t Tree::need(std::string_view name) const {
  if (const auto found = find(name)) return *found;
  std::vector<std::string> names;
  for (const Node& node : nodes_) names.push_back(node.name);
  Problems problems({});
  problems.add("frame", '"' + std::string(name) + '"', "there is no such node" + did_you_mean(std::string(name), names));
  problems.throw_if_any();
  return 0;
}

MotionState Tree::state(std::size_t node, std::size_t frame, TimeUs t_us) const {
  const std::size_t ancestor = common_ancestor(node, frame);  // of what both share, nothing is lost to rounding
  if (ancestor == frame) return in_ancestor(node, ancestor, t_us);
  return inverse(in_ancestor(frame, ancestor, t_us)) * in_ancestor(node, ancestor, t_us);
}

std::size_t Tree::common_ancestor(std::size_t a, std::size_t b) const {
  while (a != b) {
    std::size_t& deeper = depths_[a] >= depths_[b] ? a : b;
    deeper = parents_[deeper];
  }
  return a;
}

bool Tree::stands_in(std::size_t node, std::size_t ancestor) const {
  while (node != ancestor && nodes_[node].motion == nullptr && nodes_[node].towards.empty()) node = parents_[node];
  return node == ancestor;
}

bool Tree::are_rigid(std::size_t a, std::size_t b) const {
  const std::size_t ancestor = common_ancestor(a, b);
  return stands_in(a, ancestor) && stands_in(b, ancestor);
}

bool Tree::is_quick_in(std::size_t node, std::size_t ancestor) const {
  const auto is_quick = [](const Node& of) { return of.towards.empty() && (of.motion == nullptr || of.motion->is_quick()); };
  while (node != ancestor && is_quick(nodes_[node])) node = parents_[node];
  return node == ancestor;
}

bool Tree::is_quick(std::size_t node, std::size_t frame) const {
  const std::size_t ancestor = common_ancestor(node, frame);
  return is_quick_in(node, ancestor) && is_quick_in(frame, ancestor);
}

MotionState Tree::in_ancestor(std::size_t node, std::size_t ancestor, TimeUs t_us) const {
  if (node == ancestor) return {};
  MotionState state = in_parent(node, t_us);
  for (node = parents_[node]; node != ancestor; node = parents_[node]) state = in_parent(node, t_us) * state;
  return state;
}

// Where it points to another node, that node is asked where it is in the base; no chain of nodes comes back to this one (checked_links).
MotionState Tree::in_parent(std::size_t node, TimeUs t_us) const {
  const Node& of = nodes_[node];
  const MotionState base{of.T_parent_base, Twist{}};
  MotionState moving = of.motion != nullptr ? of.motion->at(t_us) : MotionState{};
  if (!of.towards.empty()) {
    const MotionState other = inverse(base) * state(towards_[node], parents_[node], t_us);
    const MotionState law = point_along(of.pointing, other.T_a_b.p - moving.T_a_b.p, other.rates.v_mps - moving.rates.v_mps);
    moving.T_a_b.q = law.T_a_b.q;
    moving.rates.omega_radps = law.rates.omega_radps;
  }
  return base * moving;
}

Mat6 covariance_in_frame(const Mat6& covariance, const Pose& T_c_a) {
  return moved(covariance, turned_with_lever(to_matrix(T_c_a.q), Vec3::Zero()));
}

Mat6 covariance_of_point(const Mat6& covariance, const Pose& T_a_b, const Pose& T_b_d) {
  return moved(covariance, turned_with_lever(Mat3::Identity(), rotate(T_a_b.q, T_b_d.p)));
}

// With T = (exp(r) q, p + d): the inverse is (q* exp(-r), -q* exp(-r) (p + d)), so -R r and -R (d - r x p) to first order, R that of q*.
Mat6 covariance_of_inverse(const Mat6& covariance, const Pose& T_a_b) {
  return moved(covariance, turned_with_lever(to_matrix(T_a_b.q.conjugate()), -T_a_b.p));
}

}  // namespace lasso::mdat::scene
