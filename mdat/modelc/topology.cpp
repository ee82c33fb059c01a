#include "mdat/modelc/topology.hpp"

#include <algorithm>
#include <tuple>

namespace lasso::mdat {
namespace {

struct Neighbour {
  std::uint32_t triangle = kNone;
  bool agrees = true;  // runs along the edge the other way
};
using Neighbours = std::vector<std::array<Neighbour, 3>>;

Neighbours manifold_neighbours(const Surface& surface, const std::vector<EdgeUse>& uses) {
  Neighbours neighbours(surface.triangles.size());
  for_each_edge(uses, [&](const EdgeUse* first, const EdgeUse* last) {
    if (last - first != 2) return;
    const bool agrees = first[0].forward != first[1].forward;
    neighbours[first[0].triangle][first[0].side] = {first[1].triangle, agrees};
    neighbours[first[1].triangle][first[1].side] = {first[0].triangle, agrees};
  });
  return neighbours;
}

// Breadth-first over one component: each triangle is turned to agree with the one that reached it.
class ComponentWalk {
 public:
  ComponentWalk(const Neighbours& neighbours, std::vector<std::uint32_t>& of_triangle) : neighbours_(neighbours), of_(of_triangle) {
    turned_.assign(of_.size(), 0);
  }

  // Members of the component of `seed`; conflict() tells whether they cannot agree.
  const std::vector<std::uint32_t>& walk(std::uint32_t seed, std::uint32_t component) {
    members_.assign(1, seed);
    conflict_ = false;
    of_[seed] = component;
    for (std::size_t i = 0; i < members_.size(); ++i) {
      for (const Neighbour& neighbour : neighbours_[members_[i]]) visit(neighbour, members_[i]);
    }
    return members_;
  }
  bool conflict() const { return conflict_; }
  bool turned(std::uint32_t triangle) const { return turned_[triangle] != 0; }

 private:
  void visit(const Neighbour& neighbour, std::uint32_t from) {
    if (neighbour.triangle == kNone) return;
    const bool turn = (turned_[from] != 0) == neighbour.agrees;
    if (of_[neighbour.triangle] != kNone) {
      conflict_ = conflict_ || turned(neighbour.triangle) != turn;
      return;
    }
    of_[neighbour.triangle] = of_[from];
    turned_[neighbour.triangle] = turn;
    members_.push_back(neighbour.triangle);
  }

  const Neighbours& neighbours_;
  std::vector<std::uint32_t>& of_;
  std::vector<std::uint8_t> turned_;
  std::vector<std::uint32_t> members_;
  bool conflict_ = false;
};

void mark_boundaries(const std::vector<EdgeUse>& uses, Components& components, CompileReport& report) {
  for_each_edge(uses, [&](const EdgeUse* first, const EdgeUse* last) {
    if (last - first == 1) ++report.boundary_edges;
    if (last - first > 2) ++report.nonmanifold_edges;
    if ((last - first) % 2 == 0) return;
    for (const EdgeUse* use = first; use != last; ++use) components.open[components.of_triangle[use->triangle]] = true;
  });
}

}  // namespace

std::vector<EdgeUse> edge_uses(const Surface& surface) {
  std::vector<EdgeUse> uses;
  uses.reserve(3 * surface.triangles.size());
  for (std::uint32_t t = 0; t < surface.triangles.size(); ++t) {
    for (std::uint8_t i = 0; i < 3; ++i) {
      const std::uint32_t from = surface.triangles[t][i], to = surface.triangles[t][(i + 1u) % 3u];
      uses.push_back({std::min(from, to), std::max(from, to), t, i, from < to});
    }
  }
  std::sort(uses.begin(), uses.end(), [](const EdgeUse& x, const EdgeUse& y) {
    return std::tie(x.a, x.b, x.triangle, x.side) < std::tie(y.a, y.b, y.triangle, y.side);
  });
  return uses;
}

Components orient_consistently(Surface& surface, CompileReport& report) {
  const std::vector<EdgeUse> uses = edge_uses(surface);
  const Neighbours neighbours = manifold_neighbours(surface, uses);
  Components components;
  components.of_triangle.assign(surface.triangles.size(), kNone);
  ComponentWalk walk(neighbours, components.of_triangle);
  for (std::uint32_t seed = 0; seed < surface.triangles.size(); ++seed) {
    if (components.of_triangle[seed] != kNone) continue;
    const auto& members = walk.walk(seed, static_cast<std::uint32_t>(components.count()));
    components.open.push_back(walk.conflict());
    const auto turned = static_cast<std::size_t>(std::count_if(members.begin(), members.end(), [&](auto t) { return walk.turned(t); }));
    const bool turn_the_turned = 2 * turned <= members.size();
    for (const std::uint32_t t : members) {
      if (walk.turned(t) == turn_the_turned) surface.flip(t);
    }
    report.flipped_triangles += std::min(turned, members.size() - turned);
  }
  mark_boundaries(uses, components, report);
  report.components = components.count();
  report.open_components = static_cast<std::size_t>(std::count(components.open.begin(), components.open.end(), 1));
  return components;
}

namespace {

// The other user of the longest edge of a sliver, if that edge has exactly two users.
std::vector<std::uint32_t> across_longest(const Surface& surface, const std::vector<EdgeUse>& uses) {
  std::vector<std::uint32_t> across(surface.triangles.size(), kNone);
  std::vector<double> longest(surface.triangles.size(), 0);
  for_each_edge(uses, [&](const EdgeUse* first, const EdgeUse* last) {
    const double length = (surface.vertices[first->a] - surface.vertices[first->b]).norm();
    for (const EdgeUse* use = first; use != last; ++use) {
      if (length <= longest[use->triangle]) continue;
      longest[use->triangle] = length;
      across[use->triangle] = last - first == 2 ? first[use == first ? 1 : 0].triangle : kNone;
    }
  });
  return across;
}

}  // namespace

std::vector<std::uint32_t> attach_slivers(const Surface& surface, const std::vector<EdgeUse>& uses) {
  constexpr int kMaxChain = 64;  // slivers stacked on slivers
  const std::vector<std::uint32_t> across = across_longest(surface, uses);
  std::vector<std::uint32_t> flap_of(surface.triangles.size());
  for (std::uint32_t t = 0; t < flap_of.size(); ++t) {
    std::uint32_t host = t;
    for (int i = 0; i < kMaxChain && host != kNone && surface.sliver[host] != 0; ++i) host = across[host];
    flap_of[t] = host != kNone && surface.sliver[host] == 0 ? host : kNone;
  }
  return flap_of;
}

}  // namespace lasso::mdat
