// The named frames of a scene: a flat list of nodes, each in its parent, and the poses, rates and covariances between any two of them.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "mdat/scene/attitude_laws.hpp"
#include "mdat/scene/motion.hpp"

namespace lasso::mdat::scene {

// Where a node stands in its parent: T_parent_node(t) = T_parent_base * T_base_node(t). `motion` is the second factor; without it the node
// stays at its base. A lens, a docking port, a solar array, a chaser and a target are all nodes.
struct Node {
  std::string name;
  std::string parent;   // another node, or the root
  Pose T_parent_base;   // fixed
  MotionPtr motion;     // none: still
  std::string towards;  // a node to which the axis of `pointing` points, in place of the motion's attitude; empty: none
  Pointing pointing;    // its roll reference in the base's axes
  Place place;          // where a mission says it
};

class Tree {
 public:
  // Throws MissionError with every problem of all nodes: a name that is empty, doubled or the root's, a parent or a node to point to that
  // there is not, parents in a circle, a node that points to itself or to what moves with it, a pose or a pointing that is none.
  Tree(std::string root, std::vector<Node> nodes);

  std::size_t size() const { return nodes_.size(); }  // with the root, which is number 0
  const std::string& name(std::size_t node) const { return nodes_[node].name; }
  std::optional<std::size_t> find(std::string_view name) const;
  std::size_t need(std::string_view name) const;  // throws MissionError: there is none; with the nearest name

  // Whether two nodes stand still against each other by themselves: neither of them, nor what they stand in up to where their ways to the
  // root meet, has a motion or points somewhere.
  bool are_rigid(std::size_t a, std::size_t b) const;

  // Whether nothing between the two costs more than a ray may ask for (Motion::is_quick).
  bool is_quick(std::size_t node, std::size_t frame) const;

  // Pose of `node` in `frame`, and how it moves there: rates relative to `frame`, in its axes, of the node's origin. Both of any branch.
  MotionState state(std::size_t node, std::size_t frame, TimeUs t_us) const;

 private:
  MotionState in_parent(std::size_t node, TimeUs t_us) const;
  MotionState in_ancestor(std::size_t node, std::size_t ancestor, TimeUs t_us) const;
  std::size_t common_ancestor(std::size_t a, std::size_t b) const;
  bool is_quick_in(std::size_t node, std::size_t ancestor) const;
  bool stands_in(std::size_t node, std::size_t ancestor) const;

  std::vector<Node> nodes_;
  std::vector<std::size_t> parents_, towards_, depths_;  // by number; a node that points to none has itself
};

// Covariance of a pose, rotation before translation (se3.hpp, pose_difference: errors in the axes of the frame that it is stated in).
//
// The same knowledge of T_a_b, of which `covariance` is that of its error in a's axes, said of other frames that are known without error.
Mat6 covariance_in_frame(const Mat6& covariance, const Pose& T_c_a);                     // of T_c_b = T_c_a T_a_b
Mat6 covariance_of_point(const Mat6& covariance, const Pose& T_a_b, const Pose& T_b_d);  // of T_a_d = T_a_b T_b_d: lever arm of d
Mat6 covariance_of_inverse(const Mat6& covariance, const Pose& T_a_b);                   // of T_b_a: lever arm of the whole distance

}  // namespace lasso::mdat::scene
