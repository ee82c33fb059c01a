// What a mesh tells about itself: size, how its surface was made, how many parts are small.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "mdat/modelc/mesh.hpp"

namespace lasso::mdat {

struct MeshSize {
  Eigen::Vector3d center = Eigen::Vector3d::Zero();  // of the bounding box, to a hundredth of its size
  Eigen::Vector3d sides = Eigen::Vector3d::Zero();   // of the bounding box
  double radius_m = 0;                               // of the sphere about the centre that holds all vertices
  double largest_m = 0;                              // of the sides
};
MeshSize size_of(const Mesh& mesh);

// A designed surface is made of flat faces and of copies; triangles of a measured one are all different.
struct SurfaceFacts {
  std::size_t triangles = 0;
  double area_m2 = 0;
  double regular_share = 0;  // of the triangles: in one plane with a neighbour, or congruent to another triangle
  double roughness_m = 0;    // median distance of a vertex from the mean of its neighbours, along the normal: noise, and curvature
  // Few triangles are drawn, whatever they look like.
  bool measured() const { return triangles >= 2000 && regular_share < 0.5; }
};
SurfaceFacts surface_facts(const Mesh& mesh);

// The second largest side of the bounding box of each part, a part being what is connected by vertices.
std::vector<double> part_widths_m(const Mesh& mesh);

}  // namespace lasso::mdat
