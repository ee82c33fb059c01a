#include "mdat/scene/tree_check.hpp"

#include <algorithm>
#include <map>

#include "mdat/source/nearest.hpp"

namespace lasso::mdat::scene {
namespace {

std::string quoted(const std::string& name) { return '"' + name + '"'; }

class TreeCheck {
 public:
  explicit TreeCheck(const std::vector<Node>& nodes) : nodes_(nodes), links_{std::vector<std::size_t>(nodes.size()), {}} {
    for (std::size_t i = 0; i < nodes.size(); ++i) links_.towards.push_back(i);
  }

  TreeLinks check() {
    for (std::size_t i = 1; i < nodes_.size(); ++i) check_name(i);
    for (std::size_t i = 1; i < nodes_.size(); ++i) check_node(i);
    if (all_found_) check_circles();
    if (problems_.empty() && all_found_) check_work();
    problems_.throw_if_any();
    return links_;
  }

 private:
  void complain(std::size_t i, const std::string& key, const std::string& value, const std::string& expected) {
    problems_.add_at(nodes_[i].place, nodes_[i].name.empty() ? key : nodes_[i].name + ", " + key, value, expected);
  }

  void check_name(std::size_t i) {
    const std::string& name = nodes_[i].name;
    if (name.empty()) return complain(i, "name", "", "is empty: every node has a name of its own");
    if (name == nodes_[0].name) return complain(i, "name", "", "is the root's: give the node another name");
    const auto [found, added] = numbers_.emplace(name, i);
    if (added) return;
    const int line = nodes_[found->second].place.line;
    complain(i, "name", "",
             "is another node's" + (line > 0 ? ", in line " + std::to_string(line) : "") + ": every node has a name of its own");
  }

  void check_node(std::size_t i) {
    const Node& node = nodes_[i];
    links_.parents[i] = number_of(i, node.parent, "parent");
    if (!node.towards.empty()) links_.towards[i] = number_of(i, node.towards, "towards");
    if (!is_valid(node.T_parent_base)) {
      complain(i, "pose", "", "is not a pose: expected finite numbers and a quaternion of unit length");
    }
    if (node.towards.empty()) return;
    Problems pointing(node.place);
    check_pointing(node.pointing, pointing);
    for (const Problem& problem : pointing.all()) complain(i, problem.key, problem.value, problem.expected);
  }

  std::size_t number_of(std::size_t i, const std::string& name, const std::string& key) {
    if (name == nodes_[0].name) return 0;
    const auto found = numbers_.find(name);
    if (found != numbers_.end()) return found->second;
    all_found_ = false;
    std::vector<std::string> names{nodes_[0].name};
    for (const auto& [known, number] : numbers_) names.push_back(known);
    complain(i, key, quoted(name), "there is no such node" + did_you_mean(name, names));
    return i;
  }

  // Each circle of parents is told once, at the first of its nodes; then what points to itself or to what moves with it.
  void check_circles() {
    for (std::size_t i = 1; i < nodes_.size(); ++i) {
      std::string circle = quoted(nodes_[i].name);
      std::size_t next = links_.parents[i], least = i;
      std::size_t steps = 0;
      for (; next != i && next != 0 && steps < nodes_.size(); ++steps, next = links_.parents[next]) {
        circle += " in " + quoted(nodes_[next].name);
        least = std::min(least, next);
      }
      if (next == i && least == i) {
        complain(i, "parent", circle + " in " + quoted(nodes_[i].name),
                 "is a circle: one of them has to stand in another node, or the root");
      }
      in_circle_ = in_circle_ || next != 0;
    }
    for (std::size_t i = 1; i < nodes_.size() && !in_circle_; ++i) {
      if (links_.towards[i] != i || !nodes_[i].towards.empty()) check_towards(i);
    }
  }

  // Its attitude decides where all is that stands in it, or that points to it: following what the other node's place depends on, one
  // must not come back.
  void check_towards(std::size_t i) {
    std::vector<bool> seen(nodes_.size(), false);
    std::vector<std::size_t> left{links_.towards[i]};
    while (!left.empty()) {
      const std::size_t node = left.back();
      left.pop_back();
      if (node == i) {
        complain(
            i, "towards", quoted(nodes_[i].towards),
            "moves with this node, or points to it: point to a node that does not, such as one at the same place without an attitude law");
        return;
      }
      if (node == 0 || seen[node]) continue;
      seen[node] = true;
      left.push_back(links_.parents[node]);
      if (!nodes_[node].towards.empty()) left.push_back(links_.towards[node]);
    }
  }

  // Each pose asks where the other node is, and that one the same: states that are computed for one of the node, with its way to the root.
  double work_of(std::size_t i, std::map<std::size_t, double>& known) const {
    if (i == 0) return 0;
    const auto found = known.find(i);
    if (found != known.end()) return found->second;
    double work = 1 + work_of(links_.parents[i], known);
    if (links_.towards[i] != i) work += work_of(links_.towards[i], known) + work_of(links_.parents[i], known);
    known[i] = work;
    return work;
  }

  void check_work() {
    constexpr double kMost = 2000;
    std::map<std::size_t, double> known;
    for (std::size_t i = 1; i < nodes_.size(); ++i) {
      if (work_of(i, known) <= kMost) continue;
      return complain(i, "towards", "",
                      "nodes that point to nodes that point: each of its poses would ask more than 2000 others; let fewer of them point");
    }
  }

  const std::vector<Node>& nodes_;
  TreeLinks links_;
  std::map<std::string, std::size_t> numbers_;
  Problems problems_{Place{}};
  bool all_found_ = true, in_circle_ = false;
};

}  // namespace

TreeLinks checked_links(const std::vector<Node>& nodes) { return TreeCheck(nodes).check(); }

}  // namespace lasso::mdat::scene
