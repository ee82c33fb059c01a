#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <map>
#include <set>

#include "mdat/bodies/body.hpp"
#include "mdat/missiondb/mesh_faults.hpp"
#include "mdat/missiondb/solid.hpp"
#include "ut/mdat/bodies/surface_distance.hpp"
#include "ut/support/verifies.hpp"

namespace lasso::mdat {
namespace {

constexpr std::uint64_t kSeeds = 200;

bool is_closed(const Mesh& mesh) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> edges;
  for (const auto& t : mesh.triangles) {
    for (std::size_t k = 0; k < 3; ++k) ++edges[{t[k], t[(k + 1) % 3]}];
  }
  return std::all_of(edges.begin(), edges.end(), [&](const auto& edge) {
    const auto opposite = edges.find({edge.first.second, edge.first.first});
    return edge.second == 1 && opposite != edges.end() && opposite->second == 1;
  });
}

Body part_of(const Body& body, std::size_t i) {
  Body one = body;
  one.parts = {body.parts[i]};
  return one;
}

// Whether the half line from the point in a fixed direction leaves the closed surface an odd number of times.
bool is_inside(const Mesh& mesh, const Eigen::Vector3d& p) {
  const Eigen::Vector3d u = Eigen::Vector3d(0.3127, 0.5719, 0.7586).normalized();
  int crossings = 0;
  for (const auto& t : mesh.triangles) {
    const Eigen::Vector3d a = mesh.vertices[t[0]] - p, b = mesh.vertices[t[1]] - p, c = mesh.vertices[t[2]] - p;
    const double x = u.dot(b.cross(c)), y = u.dot(c.cross(a)), z = u.dot(a.cross(b));
    if (!((x > 0 && y > 0 && z > 0) || (x < 0 && y < 0 && z < 0))) continue;
    crossings += (x * a + y * b + z * c).dot(u) / (x + y + z) > 0 ? 1 : 0;
  }
  return crossings % 2 == 1;
}

bool boxes_touch(const Mesh& a, const Mesh& b) {
  Eigen::AlignedBox3d one, two;
  for (const Eigen::Vector3d& v : a.vertices) one.extend(v);
  for (const Eigen::Vector3d& v : b.vertices) two.extend(v);
  return one.intersects(two);
}

// A point of an edge of one lies inside of the other.
bool reaches_into(const Mesh& a, const Mesh& b) {
  for (const auto& t : a.triangles) {
    for (std::size_t k = 0; k < 3; ++k) {
      for (const double s : {0.0, 0.25, 0.5, 0.75}) {
        if (is_inside(b, (1 - s) * a.vertices[t[k]] + s * a.vertices[t[(k + 1) % 3]])) return true;
      }
    }
  }
  return false;
}

bool hang_together(const Mesh& a, const Mesh& b) { return boxes_touch(a, b) && (reaches_into(a, b) || reaches_into(b, a)); }

// Names of the parts that hang on no chain of parts from the first.
std::string floating_parts(const Body& body) {
  std::vector<Mesh> meshes;
  for (std::size_t i = 0; i < body.parts.size(); ++i) meshes.push_back(mesh_of(part_of(body, i)));
  std::vector<std::size_t> held{0};
  std::set<std::size_t> left;
  for (std::size_t i = 1; i < meshes.size(); ++i) left.insert(i);
  for (std::size_t k = 0; k < held.size(); ++k) {
    for (auto i = left.begin(); i != left.end();) {
      const bool holds = hang_together(meshes[*i], meshes[held[k]]);
      if (holds) held.push_back(*i);
      i = holds ? left.erase(i) : std::next(i);
    }
  }
  std::string names;
  for (const std::size_t i : left) names += body.parts[i].name + "; ";
  return names;
}

TEST(MakeBody, SameSeedGivesTheSameBytesAndAnotherOneOthers) {
  VERIFIES("LASSO-GND-110~1");
  std::set<std::string> texts;
  for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
    const std::string text = model_text(make_body(seed));
    EXPECT_EQ(text, model_text(make_body(seed)));
    texts.insert(text);
  }
  EXPECT_EQ(texts.size(), kSeeds);
}

TEST(MakeBody, NothingIsOddAboutItsSurface) {
  VERIFIES("LASSO-GND-166~3");
  for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
    for (const MeshRemark& remark : mesh_remarks("body", mesh_of(make_body(seed)), true)) ADD_FAILURE() << seed << ": " << remark.text;
  }
}

TEST(MakeBody, SolidsAreClosedAndOfTheStatedSizes) {
  VERIFIES("LASSO-GND-110~1");
  double least = 1e9, largest = 0;
  for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
    const Body body = make_body(seed);
    const Mesh mesh = mesh_of(body);
    EXPECT_TRUE(is_closed(mesh)) << seed;
    EXPECT_LT(mesh.triangles.size(), 12000u) << seed;
    for (std::size_t i = 0; i < body.parts.size(); ++i)
      EXPECT_GT(signed_volume(mesh_of(part_of(body, i))), 0) << seed << body.parts[i].name;
    Eigen::AlignedBox3d box;
    for (const Eigen::Vector3d& v : mesh.vertices) box.extend(v);
    least = std::min(least, box.sizes().maxCoeff());
    largest = std::max(largest, box.sizes().maxCoeff());
  }
  EXPECT_GT(least, 0.45);
  EXPECT_LT(least, 0.7);
  EXPECT_GT(largest, 20);
  EXPECT_LT(largest, 33);
}

TEST(MakeBody, NothingFloatsInSpace) {
  VERIFIES("LASSO-GND-110~1");
  for (std::uint64_t seed = 1; seed <= 24; ++seed) EXPECT_EQ(floating_parts(make_body(seed)), "") << seed;
  Body loose = make_body(4);
  loose.parts.push_back({"balloon", "balloon", "kind = \"rod\"\nfrom = [90, 0, 0]\nto = [91, 0, 0]\nradius = 1\n"});
  EXPECT_EQ(floating_parts(loose), "balloon; ");
}

TEST(MakeBody, KindsComeInTheStatedShares) {
  VERIFIES("LASSO-GND-110~1");
  std::array<int, kBodyKinds> counts{};
  for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) ++counts[static_cast<std::size_t>(make_body(seed).kind)];
  for (std::size_t i = 0; i < kBodyKinds; ++i) {
    const double expected = 0.01 * kBodyShares[i] * static_cast<double>(kSeeds);
    EXPECT_NEAR(counts[i], expected, 3.5 * std::sqrt(expected)) << body_kind_name(static_cast<BodyKind>(i));
  }
}

TEST(MakeBody, AKindThatIsAskedForIsMade) {
  VERIFIES("LASSO-GND-110~1");
  for (const std::string& name : body_kind_names()) EXPECT_EQ(make_body(5, body_kind_of(name)).kind, body_kind_of(name));
  EXPECT_FALSE(body_kind_of("saucer").has_value());
}

TEST(MakeBody, StatedTurnsBringTheSurfaceOnItselfAndOthersDoNot) {
  VERIFIES("LASSO-GND-111~1");
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    const Body body = make_body(seed, BodyKind::kSymmetric);
    const BodyTruth truth = truth_of(body);
    const Mesh mesh = mesh_of(body);
    ASSERT_GE(truth.symmetry.turns.size(), 2u) << seed;
    for (const Eigen::Quaterniond& turn : truth.symmetry.turns)
      EXPECT_LT(farthest_after(mesh, turn, truth.symmetry.center, 60), 1e-4 * truth.size_m) << seed;
    const Eigen::Quaterniond other(Eigen::AngleAxisd(0.3, Eigen::Vector3d(0.3, -0.5, 0.8).normalized()));
    EXPECT_GT(farthest_after(mesh, other, truth.symmetry.center, 60), 5e-3 * truth.size_m) << seed;
  }
}

// The part that breaks the symmetry is left out: then it is there.
TEST(MakeBody, OneSmallPartBreaksASymmetry) {
  VERIFIES("LASSO-GND-111~1");
  for (std::uint64_t seed = 1; seed <= 12; ++seed) {
    const Body body = make_body(seed, BodyKind::kNearlySymmetric);
    const std::string odd = body.parts.back().assembly;
    const BodyTruth whole = truth_of(body), rest = truth_of(without(body, odd));
    EXPECT_LT(whole.symmetry.turns.size(), rest.symmetry.turns.size()) << seed;
    EXPECT_LT(whole.size_m, 1.1 * rest.size_m) << seed;
  }
}

TEST(MakeBody, WhatCannotBeKnownIsSaid) {
  VERIFIES("LASSO-GND-111~1");
  for (std::uint64_t seed = 1; seed <= 12; ++seed) {
    const Body body = make_body(seed, BodyKind::kUnknowable);
    const BodyTruth truth = truth_of(body);
    EXPECT_FALSE(truth.determined()) << body.what;
    EXPECT_EQ(truth.symmetry.sphere, body.what == "sphere");
    EXPECT_NE(commented_model_text(body, truth).find("cannot be known"), std::string::npos);
  }
  EXPECT_TRUE(truth_of(make_body(3, BodyKind::kRock)).determined());
}

}  // namespace
}  // namespace lasso::mdat
