// The guarantees of image_format.hpp on whole compiled models, against brute force in double precision.
#include <gtest/gtest.h>

#include <limits>

#include "mdat/modelc/model.hpp"
#include "ut/mdat/modelc/meshes.hpp"
#include "ut/mdat/modelc/tables.hpp"
#include "ut/support/verifies.hpp"

namespace lasso::mdat {
namespace {

using Eigen::Vector3d;

struct Compiled {
  std::string name;
  Mesh mesh;
  CompileReport report;
  ModelTables tables;
};

// Coarse cells keep brute force short.
const std::vector<Compiled>& models() {
  static const std::vector<Compiled> all = [] {
    std::vector<Compiled> result;
    for (const auto& [name, mesh] : shapes::property_meshes()) {
      ModelOptions options;
      options.cell_size_m = 0.013;
      Compiled& c = result.emplace_back(Compiled{name, mesh, {}, {}});
      c.tables = compile_model(mesh, options, c.report);
    }
    return result;
  }();
  return all;
}

struct TestRay {
  Vector3d from, u;
};

// Towards a point near the model, from outside the grid.
TestRay random_ray(Random& random) {
  const Vector3d target = Vector3d(0.11, -0.07, 0.05) + 0.35 * shapes::random_vector(random);
  const Vector3d u = shapes::random_unit(random);
  return {target - 1.5 * u, u};
}

void expect_samples_list_hits(const DecodedTables& tables, const TestRay& ray, double offset, std::size_t& hits) {
  const double h = tables.cell();
  for (std::size_t i = 0; i < tables.elements().size(); ++i) {
    const double t = tables.crossing(i, ray.from, ray.u);
    if (!std::isfinite(t)) continue;
    const double sample = offset + h * std::round((t - offset) / h);  // within half a spacing of the hit
    std::array<std::uint32_t, 3> cell{};
    ASSERT_TRUE(tables.locate(ray.from + sample * ray.u, cell));
    const std::uint32_t word = tables.ray_word(cell);
    ASSERT_EQ(word & kEmptyBit, 0u) << "element " << i;
    const auto list = tables.list(word);
    ASSERT_TRUE(std::binary_search(list.begin(), list.end(), i)) << "element " << i;
    ++hits;
  }
}

TEST(CompileModel, CellsOfSamplesListEveryElementHitWithinHalfASpacing) {
  VERIFIES("LASSO-MDL-001~1");
  for (const Compiled& model : models()) {
    SCOPED_TRACE(model.name);
    const DecodedTables tables(model.tables);
    Random random(11);
    std::size_t hits = 0;
    for (int i = 0; i < 4000; ++i) {
      const TestRay ray = random_ray(random);
      ASSERT_NO_FATAL_FAILURE(expect_samples_list_hits(tables, ray, tables.cell() * random.uniform(), hits));
    }
    EXPECT_GT(hits, 400u);
  }
}

// Walks as the flight component does: one cell on, or as far as the distance of an empty cell allows.
double walk(const DecodedTables& tables, const TestRay& ray, double from, double to) {
  const double h = tables.cell();
  for (double t = from; t <= to;) {
    std::array<std::uint32_t, 3> cell{};
    const std::uint32_t word = tables.locate(ray.from + t * ray.u, cell) ? tables.ray_word(cell) : kEmptyBit | 1;
    double best = std::numeric_limits<double>::infinity();
    if ((word & kEmptyBit) == 0) {
      for (const std::uint32_t i : tables.list(word)) {
        const double x = tables.crossing(i, ray.from, ray.u);
        if (std::abs(x - t) <= h / 2) best = std::min(best, x);
      }
    }
    if (std::isfinite(best)) return best;
    t += (word & kEmptyBit) != 0 ? h * (word & ~kEmptyBit) : h;
  }
  return std::numeric_limits<double>::infinity();
}

TEST(CompileModel, AWalkWithJumpsFindsTheFirstElementOfEveryRay) {
  VERIFIES("LASSO-MDL-002~1");
  for (const Compiled& model : models()) {
    SCOPED_TRACE(model.name);
    const DecodedTables tables(model.tables);
    Random random(12);
    int hits = 0;
    for (int k = 0; k < 3000; ++k) {
      const TestRay ray = random_ray(random);
      const double start = 0.4 * random.uniform();
      double truth = std::numeric_limits<double>::infinity();
      for (std::size_t i = 0; i < tables.elements().size(); ++i) {
        const double t = tables.crossing(i, ray.from, ray.u);
        if (t >= start) truth = std::min(truth, t);
      }
      const double found = walk(tables, ray, start + tables.cell() / 2, 3.5);
      if (std::isfinite(truth)) ++hits;
      ASSERT_TRUE(found == truth || std::abs(found - truth) < 1e-12) << found << " instead of " << truth;
    }
    EXPECT_GT(hits, 150);
  }
}

TEST(CompileModel, ASearchThatEndsAtAFinalEntryFindsWhatAWholeListHolds) {
  VERIFIES("LASSO-MDL-021~2");
  for (const Compiled& model : models()) {
    SCOPED_TRACE(model.name);
    const DecodedTables tables(model.tables);
    Random random(14);
    int ended = 0;
    for (int k = 0; k < 20000; ++k) {
      const TestRay ray = random_ray(random);
      const double t = 0.4 + 2 * random.uniform();
      std::array<std::uint32_t, 3> cell{};
      const std::uint32_t word = tables.locate(ray.from + t * ray.u, cell) ? tables.ray_word(cell) : kEmptyBit | 1;
      if ((word & kEmptyBit) != 0) continue;
      double truth = std::numeric_limits<double>::infinity(), found = truth, slope = 1;
      bool final = false;
      for (const std::uint32_t entry : tables.entries(word)) {
        const DecodedElement& e = tables.elements()[entry & ~kFinalEntry];
        const double tilt = e.n.dot(ray.u);
        const double x = tables.crossing(entry & ~kFinalEntry, ray.from, ray.u);
        if (std::abs(x - t) > tables.cell() / 2 || (tilt > 0 && (e.flags & kElementTwoSided) == 0)) continue;
        truth = std::min(truth, x);
        if (final) continue;
        found = std::min(found, x);
        slope = std::abs(tilt);
        final = (entry & kFinalEntry) != 0;
        ended += final ? 1 : 0;
      }
      if (std::isinf(truth)) continue;
      ASSERT_LE((found - truth) * slope, 3e-3 * tables.cell());
    }
    EXPECT_GT(ended, 20);
  }
}

std::vector<std::array<std::uint32_t, 3>> occupied_cells(const DecodedTables& tables) {
  std::vector<std::array<std::uint32_t, 3>> all;
  for (std::uint32_t z = 0; z < 8 * tables.geometry(kBricksZ); ++z) {
    for (std::uint32_t y = 0; y < 8 * tables.geometry(kBricksY); ++y) {
      for (std::uint32_t x = 0; x < 8 * tables.geometry(kBricksX); ++x) {
        if (tables.occupied({x, y, z})) all.push_back({x, y, z});
      }
    }
  }
  return all;
}

std::uint32_t chessboard(const std::array<std::uint32_t, 3>& a, const std::array<std::uint32_t, 3>& b) {
  std::uint32_t distance = 0;
  for (std::size_t i = 0; i < 3; ++i) distance = std::max(distance, a[i] > b[i] ? a[i] - b[i] : b[i] - a[i]);
  return distance;
}

TEST(CompileModel, DistancesOfEmptyCellsAreExactAndOfEmptyBricksNeverTooLarge) {
  VERIFIES("LASSO-MDL-002~1");
  for (const Compiled& model : models()) {
    SCOPED_TRACE(model.name);
    const DecodedTables tables(model.tables);
    const auto occupied = occupied_cells(tables);
    ASSERT_EQ(occupied.size(), model.report.ray_lists.count);
    Random random(13);
    for (int k = 0; k < 400; ++k) {
      std::array<std::uint32_t, 3> cell{};
      for (std::uint32_t i = 0; i < 3; ++i) cell[i] = static_cast<std::uint32_t>(random.uniform() * 8 * tables.geometry(kBricksX + i));
      std::uint32_t truth = kEmptyBit;
      for (const auto& other : occupied) truth = std::min(truth, chessboard(cell, other));
      const std::uint32_t word = tables.ray_word(cell);
      if (truth == 0) continue;
      ASSERT_NE(word & kEmptyBit, 0u);
      const bool whole_brick = (model.tables[TableId::kBricks][kBrickWords * tables.brick(cell)] & kEmptyBit) != 0;
      EXPECT_LE(word & ~kEmptyBit, truth);
      if (!whole_brick) {
        EXPECT_EQ(word & ~kEmptyBit, truth);
      }
      if (whole_brick) {
        EXPECT_GE((word & ~kEmptyBit) + 7, truth);
      }
    }
  }
}

// Closest point of a triangle, by its plane and its three edges.
double distance_to_triangle(const Vector3d& a, const Vector3d& b, const Vector3d& c, const Vector3d& p) {
  const Vector3d corners[] = {a, b, c};
  const Vector3d n = (b - a).cross(c - a).normalized();
  bool inside = true;
  double best = std::numeric_limits<double>::infinity();
  for (int i = 0; i < 3; ++i) {
    const Vector3d& q = corners[i];
    const Vector3d edge = corners[(i + 1) % 3] - q;
    inside = inside && n.cross(edge).dot(p - q) >= 0;
    const double s = std::clamp(edge.dot(p - q) / edge.squaredNorm(), 0.0, 1.0);
    best = std::min(best, (p - q - s * edge).norm());
  }
  return inside ? std::abs(n.dot(p - a)) : best;
}

double distance_to_mesh(const Mesh& mesh, const Vector3d& p) {
  double best = std::numeric_limits<double>::infinity();
  for (const auto& t : mesh.triangles) {
    best = std::min(best, distance_to_triangle(mesh.vertices[t[0]], mesh.vertices[t[1]], mesh.vertices[t[2]], p));
  }
  return best;
}

TEST(CompileModel, FootPointsAreTheClosestSurfacePointsOfAllBrickCentres) {
  VERIFIES("LASSO-MDL-004~1");
  for (const Compiled& model : models()) {
    SCOPED_TRACE(model.name);
    const DecodedTables tables(model.tables);
    const std::uint32_t nx = tables.geometry(kBricksX), ny = tables.geometry(kBricksY), nz = tables.geometry(kBricksZ);
    ASSERT_EQ(model.tables[TableId::kFootPoints].size(), std::size_t{kFootWords} * nx * ny * nz);
    for (std::uint32_t i = 0; i < nx * ny * nz; ++i) {
      const Vector3d center = tables.origin() + 8 * tables.cell() * Vector3d(i % nx + 0.5, i / nx % ny + 0.5, i / nx / ny + 0.5);
      const Vector3d foot = tables.point(TableId::kFootPoints, std::size_t{kFootWords} * i);
      EXPECT_NEAR((foot - center).norm(), distance_to_mesh(model.mesh, center), 1e-6);
      EXPECT_LT(distance_to_mesh(model.mesh, foot), 1e-6);
    }
  }
}

TEST(CompileModel, EveryPointWithinTheBandLiesInANearBrick) {
  VERIFIES("LASSO-MDL-003~1");
  for (const Compiled& model : models()) {
    SCOPED_TRACE(model.name);
    const DecodedTables tables(model.tables);
    const double band = tables.length(tables.geometry(kNearBand));
    Random random(14);
    int inside = 0;
    for (int k = 0; k < 3000; ++k) {
      const Vector3d p = Vector3d(0.11, -0.07, 0.05) + 0.5 * shapes::random_vector(random);
      std::array<std::uint32_t, 3> cell{};
      if (distance_to_mesh(model.mesh, p) > band) continue;
      ASSERT_TRUE(tables.locate(p, cell));
      EXPECT_NE(model.tables[TableId::kBricks][kBrickWords * tables.brick(cell) + 1], 0u);
      ++inside;
    }
    EXPECT_GT(inside, 50);
  }
}

TEST(CompileModel, ElementsCoverTheMeshAndNothingElse) {
  VERIFIES("LASSO-MDL-005~2");
  for (const Compiled& model : models()) {
    SCOPED_TRACE(model.name);
    const DecodedTables tables(model.tables);
    Random random(15);
    for (const auto& t : model.mesh.triangles) {
      const double root = std::sqrt(random.uniform()), v = random.uniform();
      const Vector3d p =
          (1 - root) * model.mesh.vertices[t[0]] + root * (1 - v) * model.mesh.vertices[t[1]] + root * v * model.mesh.vertices[t[2]];
      const bool covered = std::any_of(tables.elements().begin(), tables.elements().end(),
                                       [&](const DecodedElement& e) { return std::abs(e.n.dot(p) - e.d) < 1e-6 && e.contains(p, 0); });
      EXPECT_TRUE(covered);
    }
    double mesh_area = 0, covered_area = 0;
    for (const auto& t : model.mesh.triangles) {
      const Vector3d a = model.mesh.vertices[t[0]];
      mesh_area += (model.mesh.vertices[t[1]] - a).cross(model.mesh.vertices[t[2]] - a).norm() / 2;
    }
    // Samples the plane of each element on a jittered raster that holds the whole model.
    const int rows = tables.elements().size() > 20 ? 40 : 200;
    const double step = 1.4 / rows;
    for (const DecodedElement& e : tables.elements()) {
      const Vector3d u = e.n.unitOrthogonal(), w = e.n.cross(u), middle = Vector3d(0.11, -0.07, 0.05);
      const Vector3d corner = middle - (e.n.dot(middle) - e.d) * e.n - 0.7 * u - 0.7 * w;
      for (int k = 0; k < rows * rows; ++k) {
        const double x = k % rows + random.uniform(), y = k / rows + random.uniform();
        const Vector3d p = corner + x * step * u + y * step * w;
        if (!e.contains(p, 0)) continue;
        covered_area += step * step;
        ASSERT_LT(distance_to_mesh(model.mesh, p), 1e-5);
      }
    }
    EXPECT_NEAR(covered_area / mesh_area, 1, 0.05);
  }
}

TEST(CompileModel, SameInputGivesTheSameWords) {
  VERIFIES("LASSO-MDL-006~2");
  for (const Compiled& model : models()) {
    ModelOptions options;
    options.cell_size_m = 0.013;
    CompileReport report;
    EXPECT_EQ(compile_model(model.mesh, options, report).words, model.tables.words) << model.name;
  }
}

// One whose parts cross, and one that is open, as options say what is turned and seen from both sides.
TEST(CompileModel, SameInputGivesTheSameWordsByOtherOptions) {
  VERIFIES("LASSO-MDL-006~2");
  ModelOptions oriented;
  oriented.oriented = true;
  for (const Compiled* model : {&models().at(3), &models().at(4)}) {
    for (const ModelOptions& options : {ModelOptions{}, oriented}) {
      CompileReport report;
      const auto first = compile_model(model->mesh, options, report).words;
      EXPECT_EQ(compile_model(model->mesh, options, report).words, first) << model->name << (options.oriented ? ", oriented" : "");
    }
  }
}

TEST(CompileModel, SaysTheGridItChose) {
  VERIFIES("LASSO-MDL-023~1");
  Mesh mesh = shapes::box({-0.1, -0.2, 0.3}, {0.2, 0.46, 0.4});
  CompileReport report;
  std::vector<double> fractions;
  const ModelTables compiled = compile_model(mesh, {}, report, [&](const std::string&, double f) { fractions.push_back(f); });
  const DecodedTables tables(compiled);
  EXPECT_NEAR(report.cell_size_m, 0.66 / 110, 1e-8);
  EXPECT_EQ(tables.cell(), report.cell_size_m);
  EXPECT_NEAR(tables.length(tables.geometry(kNearBand)), 5 * report.cell_size_m, 1e-7);
  EXPECT_NEAR(tables.length(tables.geometry(kModelRadius)), Vector3d(0.2, 0.46, 0.4).norm(), 1e-8);
  EXPECT_LT((tables.point(TableId::kFieldGeometry, kCenterX) - Vector3d(0.05, 0.13, 0.35)).norm(), 1e-8);
  for (int i = 0; i < 3; ++i) {
    const double high = tables.origin()[i] + 8 * tables.cell() * tables.geometry(kBricksX + static_cast<std::uint32_t>(i));
    EXPECT_LE(tables.origin()[i], Vector3d(-0.1, -0.2, 0.3)[i] - 0.35 * 0.66 + 1e-8);
    EXPECT_GE(high, Vector3d(0.2, 0.46, 0.4)[i] + 0.35 * 0.66 - 1e-8);
  }
  EXPECT_TRUE(std::is_sorted(fractions.begin(), fractions.end()));
  EXPECT_EQ(fractions.back(), 1);
  EXPECT_EQ(report.elements, 6u);
  EXPECT_EQ(report.edges, 12u);
  EXPECT_EQ(static_cast<std::uint32_t>(report.length_fraction_bits), tables.geometry(kLengthFractionBits));
  std::size_t total = 0;
  for (std::size_t id = 0; id < compiled.words.size(); ++id) {
    EXPECT_EQ(report.table_bytes[id], 4 * compiled.words[id].size()) << id;
    total += 4 * compiled.words[id].size();
  }
  EXPECT_EQ(report.total_bytes, total);
}

}  // namespace
}  // namespace lasso::mdat
