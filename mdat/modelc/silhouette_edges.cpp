#include "mdat/modelc/silhouette_edges.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "cfg/capacities.hpp"

namespace lasso::mdat {
namespace {

struct Face {
  std::uint32_t element;
  bool forward;
};

class EdgeTable {
 public:
  EdgeTable(const std::vector<Element>& elements, const LengthScale& scale) : elements_(elements), scale_(scale) {}

  void add(const Vec3d& a, const Vec3d& b, std::vector<Face> faces) {
    while (!faces.empty()) {
      const Face face = faces.front();
      faces.erase(faces.begin());
      const auto partner = find_partner(b - a, face, faces);
      if (partner == faces.end()) {
        write(a, b, face, nullptr);
        continue;
      }
      const Face other = *partner;
      faces.erase(partner);
      if (!coplanar(face, other) && !hidden_in_solid(b - a, face, other)) write(a, b, face, &other);
    }
  }
  std::vector<std::uint32_t>& words() { return words_; }

 private:
  // Two faces belong together whatever their windings. Of more, the one that runs the other way at the smallest angle through the solid.
  std::vector<Face>::iterator find_partner(const Vec3d& edge, const Face& face, std::vector<Face>& others) const {
    if (others.size() == 1) return others.begin();
    auto best = others.end();
    double best_angle = 2 * std::numbers::pi + 1;
    for (auto other = others.begin(); other != others.end(); ++other) {
      if (other->forward == face.forward) continue;
      const double angle = angle_through_solid(edge, face, *other);
      if (angle >= best_angle) continue;
      best = other;
      best_angle = angle;
    }
    return best;
  }

  // From the face's inside, turning about the edge into the solid (against its normal), until the other face. 0..2 pi.
  double angle_through_solid(const Vec3d& edge, const Face& face, const Face& other) const {
    const Vec3d& n = elements_[face.element].n;
    const Vec3d direction = edge.normalized();
    const Vec3d into_face = (face.forward ? 1 : -1) * n.cross(direction);
    const Vec3d into_other = (other.forward ? 1 : -1) * elements_[other.element].n.cross(direction);
    const double angle = std::atan2(-n.dot(into_other), into_face.dot(into_other));
    return angle < 0 ? angle + 2 * std::numbers::pi : angle;
  }

  bool coplanar(const Face& x, const Face& y) const {
    if (x.element == y.element) return true;
    const double sign = x.forward != y.forward ? 1 : -1;
    return (elements_[x.element].n - sign * elements_[y.element].n).norm() < kCoplanarAngle_rad;
  }

  // A concave edge of a solid is never seen as a contour: whatever looks at its one face from behind looks through the solid.
  bool hidden_in_solid(const Vec3d& edge, const Face& x, const Face& y) const {
    if (elements_[x.element].two_sided || elements_[y.element].two_sided || x.forward == y.forward) return false;
    return angle_through_solid(edge, x, y) > std::numbers::pi;
  }

  void put(std::int32_t word) { words_.push_back(static_cast<std::uint32_t>(word)); }
  void put_plane(const Element& e, int sign) {
    for (int i = 0; i < 3; ++i) put(sign * unit_word(e.n[i]));
    put(sign * scale_.to_word(e.d));
  }
  // Without a second face: a boundary. Faces whose windings clash get the second plane turned round.
  void write(const Vec3d& a, const Vec3d& b, const Face& face, const Face* other) {
    for (const Vec3d* p : {&a, &b}) {
      for (int i = 0; i < 3; ++i) put(scale_.to_word((*p)[i]));
    }
    const Element& e = elements_[face.element];
    put_plane(e, 1);
    if (other == nullptr) {
      put_plane(e, -1);
    } else {
      put_plane(elements_[other->element], other->forward != face.forward ? 1 : -1);
    }
    words_.push_back(other == nullptr ? kEdgeBoundary : 0);
  }

  const std::vector<Element>& elements_;
  const LengthScale& scale_;
  std::vector<std::uint32_t> words_;
};

}  // namespace

std::vector<std::uint32_t> make_edges(const Surface& surface, const std::vector<EdgeUse>& uses, const Polygons& polygons,
                                      const std::vector<Element>& elements, const LengthScale& scale, CompileReport& report) {
  EdgeTable table(elements, scale);
  for_each_edge(uses, [&](const EdgeUse* first, const EdgeUse* last) {
    std::vector<Face> faces;
    for (const EdgeUse* use = first; use != last; ++use) {
      const std::uint32_t element = polygons.of_triangle[use->triangle];
      if (element != kNone) faces.push_back({element, use->forward});
    }
    table.add(surface.vertices[first->a], surface.vertices[first->b], std::move(faces));
  });
  report.edges = table.words().size() / kEdgeWords;
  if (report.edges > kMaxEdges) fail("the model has ", report.edges, " edges; the limit is ", kMaxEdges, ": ", kCoarserMesh);
  return std::move(table.words());
}

}  // namespace lasso::mdat
