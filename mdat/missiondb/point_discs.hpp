// Clouds of points as surfaces: what lasers and cameras meet of a scan, or of any other PLY file without faces.
#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <string_view>
#include <vector>

#include "mdat/modelc/mesh.hpp"

namespace lasso::mdat {

constexpr std::size_t kMaxCloudPoints = 100000;

// In the file's lengths.
struct PointCloud {
  std::vector<Eigen::Vector3d> points;
  std::vector<Eigen::Vector3d> normals;  // unit; none: the file has none
};

// Vertices x, y, z and normals nx, ny, nz of a PLY file, whatever else it holds. Throws MeshError: it is not PLY, or truncated; it holds no
// point, or more than kMaxCloudPoints; a number is not finite, or a normal has no length.
PointCloud read_ply_points(std::string_view bytes);
PointCloud read_cloud(const std::filesystem::path& file);  // the same of a file; MeshError where it is missing, too

// A flat disc at each point that has a normal: a regular octagon of the disc's area, across the normal. At each other point an octahedron
// whose shadow, in the mean over all directions, has the disc's area: a quarter of its surface. `radius_m` > 0, of points in metres.
Mesh disc_mesh(const PointCloud& cloud, double radius_m);
constexpr std::size_t kDiscTriangles = 6, kGrainTriangles = 8;  // of a point with a normal, and without

}  // namespace lasso::mdat
