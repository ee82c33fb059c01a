#include "mdat/missiondb/mesh_faults.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "mdat/missiondb/mission_source.hpp"
#include "mdat/source/mission_error.hpp"
#include "ut/mdat/missiondb/support.hpp"
#include "ut/mdat/modelc/meshes.hpp"
#include "ut/support/verifies.hpp"

namespace lasso::mdat {
namespace {

Mesh craft() {
  Mesh mesh = shapes::box({0, 0, 0}, {1, 0.8, 0.5});
  shapes::append(mesh, shapes::box({2, 0, 0}, {3, 0.4, 0.02}));
  return mesh;
}

std::vector<std::string> topics(const MeshFaults& faults) {
  std::vector<std::string> topics;
  for (const MeshRemark& remark : mesh_remarks(faults)) topics.push_back(remark.text.substr(0, remark.text.find(':')));
  return topics;
}

using Topics = std::vector<std::string>;

TEST(MeshFaults, ClosedSolidsHaveNone) {
  VERIFIES("LASSO-GND-166~3");
  EXPECT_EQ(topics(mesh_faults(craft())), Topics{});
  EXPECT_EQ(topics(mesh_faults(shapes::sphere(0.5, 12, 20))), Topics{});
}

// Triangles as an STL has them, each with corners of its own: the same surface.
TEST(MeshFaults, AreCountedOnceVerticesAreJoined) {
  VERIFIES("LASSO-GND-166~3");
  const Mesh mesh = craft();
  Mesh apart;
  for (const auto& t : mesh.triangles) {
    const auto first = static_cast<std::uint32_t>(apart.vertices.size());
    for (const std::uint32_t v : t) apart.vertices.push_back(mesh.vertices[v]);
    apart.triangles.push_back({first, first + 1, first + 2});
  }
  EXPECT_EQ(topics(mesh_faults(apart)), Topics{});
}

TEST(MeshFaults, AHoleIsWarnedOfByItsEdgesAndTheInsideThatShows) {
  VERIFIES("LASSO-GND-166~3");
  Mesh mesh = craft();
  mesh.triangles.erase(mesh.triangles.begin());
  const MeshFaults faults = mesh_faults(mesh);
  EXPECT_EQ(faults.open_edges, 3U);
  EXPECT_GE(faults.seen_behind, 0.2) << "the sides across the hole";
  EXPECT_LE(faults.seen_behind, 0.8) << "of the box, which has 3.4 of 4.256 m2";
  EXPECT_EQ(faults.sheets, 0);
  ASSERT_EQ(topics(faults), Topics{"open"});
  EXPECT_TRUE(mesh_remarks(faults)[0].follows);
  EXPECT_NE(mesh_remarks(faults)[0].text.find("3 edges belong to one triangle"), std::string::npos);
}

// Each face by itself, with vertices between those of the others, so that none are joined; closed, and without one of them.
TEST(MeshFaults, AHoleInAShellOfSheetsIsTold) {
  VERIFIES("LASSO-GND-166~3");
  const Mesh box = shapes::box({0, 0, 0}, {1, 0.8, 0.5});
  Mesh shell;
  for (const auto& t : box.triangles) {
    const auto& v = box.vertices;
    const auto first = static_cast<std::uint32_t>(shell.vertices.size());
    for (std::size_t i = 0; i < 3; ++i) shell.vertices.push_back(v[t[i]] + 2e-5 * (v[t[(i + 1) % 3]] - v[t[i]]));
    shell.triangles.push_back({first, first + 1, first + 2});
  }
  EXPECT_EQ(mesh_faults(shell).open_edges, 36U);
  EXPECT_EQ(topics(mesh_faults(shell)), Topics{});
  shell.triangles.erase(shell.triangles.begin(), shell.triangles.begin() + 2);
  EXPECT_EQ(topics(mesh_faults(shell)), Topics{"sheets"});
  EXPECT_GT(mesh_faults(shell).sheets, 0.9);
}

// 128 rays from each of a million triangles would take minutes. A coarse box with a hole beside a fine sphere has few triangles and much
// area.
TEST(MeshFaults, OfManyTrianglesAShareIsAsked) {
  VERIFIES("LASSO-GND-166~3");
  Mesh mesh = shapes::sphere(0.1, 200, 300);
  Mesh box = shapes::box({1, 0, 0}, {2, 0.8, 0.5});
  box.triangles.erase(box.triangles.begin());
  shapes::append(mesh, box);
  ASSERT_GT(mesh.triangles.size(), 100000U);
  EXPECT_EQ(topics(mesh_faults(mesh)), Topics{"open"});
  EXPECT_NEAR(mesh_faults(mesh).seen_behind, mesh_faults(box).seen_behind * 3.2 / (3.2 + 0.126), 0.03);
}

Mesh sheet() {
  Mesh mesh;
  mesh.vertices = {{-2, 0, 0.1}, {-1, 0, 0.1}, {-1, 1, 0.1}, {-2, 1, 0.1}};
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  return mesh;
}

// Where three triangles meet the surface is taken apart: the piece with the hole ends there without an edge of one triangle.
TEST(MeshFaults, AHoleWhoseRimHasTwoFlangesIsToldWithoutACount) {
  VERIFIES("LASSO-GND-166~3");
  Mesh mesh = shapes::box({0, 0, 0}, {1, 0.8, 0.5});
  const auto rim = mesh.triangles.front();
  mesh.triangles.erase(mesh.triangles.begin());
  for (std::size_t i = 0; i < 3; ++i) {
    for (const double side : {0.2, -0.2}) {
      const std::uint32_t from = rim[i], to = rim[(i + 1) % 3];
      const auto tip = static_cast<std::uint32_t>(mesh.vertices.size());
      mesh.vertices.push_back(0.5 * (mesh.vertices[from] + mesh.vertices[to]) + side * shapes::Vec3d(0.3, 0.5, 0.8));
      mesh.triangles.push_back({from, to, tip});
    }
  }
  const MeshFaults faults = mesh_faults(mesh);
  EXPECT_EQ(faults.hole_edges, 0U);
  EXPECT_GT(faults.seen_behind, 0.1);
  const MeshRemark open = mesh_remarks(faults)[0];
  EXPECT_EQ(open.text.rfind("open: ", 0), 0U);
  EXPECT_EQ(open.text.find("edges belong"), std::string::npos) << open.text;
}

TEST(MeshFaults, AFlatSheetIsNoHole) {
  VERIFIES("LASSO-GND-166~3");
  Mesh mesh = craft();
  shapes::append(mesh, sheet());
  const MeshFaults faults = mesh_faults(mesh);
  EXPECT_EQ(faults.open_edges, 4U);
  EXPECT_EQ(faults.hole_edges, 0U);
  EXPECT_NEAR(faults.sheets, 1 / (3.4 + 0.856 + 1), 1e-9);
  EXPECT_EQ(topics(faults), Topics{"sheets"});
  EXPECT_FALSE(mesh_remarks(faults)[0].follows);
}

TEST(MeshFaults, AHoleBesideASheetIsToldByItsOwnEdges) {
  VERIFIES("LASSO-GND-166~3");
  Mesh mesh = craft();
  mesh.triangles.erase(mesh.triangles.begin());
  shapes::append(mesh, sheet());
  const MeshFaults faults = mesh_faults(mesh);
  EXPECT_EQ(faults.open_edges, 7U);
  ASSERT_EQ(topics(faults), (Topics{"open", "sheets"}));
  EXPECT_EQ(mesh_remarks(faults)[0].text.find("open: 3 edges belong to one triangle"), 0U) << mesh_remarks(faults)[0].text;
}

// A scan's mesh has small ones, of a triangle or two.
TEST(MeshFaults, ACrackIsNoHole) {
  VERIFIES("LASSO-GND-166~3");
  Mesh mesh = shapes::sphere(0.5, 40, 80);
  mesh.triangles.erase(mesh.triangles.begin() + 3000);
  EXPECT_EQ(mesh_faults(mesh).open_edges, 3U);
  EXPECT_EQ(topics(mesh_faults(mesh)), Topics{});
}

// z = depth r^2: a shallow one is a dish, a deep one encloses space.
Mesh bowl(double depth) {
  constexpr std::uint32_t kRings = 12, kAround = 24;
  Mesh mesh;
  mesh.vertices.emplace_back(0, 0, 0);
  for (std::uint32_t ring = 1; ring <= kRings; ++ring) {
    for (std::uint32_t i = 0; i < kAround; ++i) {
      const double r = static_cast<double>(ring) / kRings, angle = 2 * M_PI * i / kAround;
      mesh.vertices.emplace_back(r * std::cos(angle), r * std::sin(angle), depth * r * r);
      const std::uint32_t a = 1 + (ring - 1) * kAround + i, b = 1 + (ring - 1) * kAround + (i + 1) % kAround;
      if (ring == 1) mesh.triangles.push_back({0, a, b});
      if (ring == 1) continue;
      mesh.triangles.push_back({a - kAround, a, b});
      mesh.triangles.push_back({a - kAround, b, b - kAround});
    }
  }
  return mesh;
}

TEST(MeshFaults, ADishIsNoHoleAndADeepCupIs) {
  VERIFIES("LASSO-GND-166~3");
  EXPECT_EQ(topics(mesh_faults(bowl(0.4))), Topics{"sheets"});
  EXPECT_EQ(mesh_faults(bowl(3)).open_edges, 24U);
  EXPECT_EQ(topics(mesh_faults(bowl(3))), Topics{"open"});
}

TEST(MeshFaults, AnInnerWallHasEdgesOfThreeAndNoHole) {
  VERIFIES("LASSO-GND-166~3");
  Mesh mesh = shapes::box({0, 0, 0}, {1, 0.8, 0.5});
  const auto corner = [&](double x, double y, double z) {
    const auto at = std::find_if(mesh.vertices.begin(), mesh.vertices.end(),
                                 [&](const Eigen::Vector3d& v) { return (v - Eigen::Vector3d(x, y, z)).norm() < 1e-12; });
    return static_cast<std::uint32_t>(at - mesh.vertices.begin());
  };
  // From edge to opposite edge: two of its edges are the box's, and two are diagonals of its faces.
  mesh.triangles.push_back({corner(0, 0, 0), corner(1, 0.8, 0), corner(1, 0.8, 0.5)});
  mesh.triangles.push_back({corner(0, 0, 0), corner(1, 0.8, 0.5), corner(0, 0, 0.5)});
  const MeshFaults faults = mesh_faults(mesh);
  EXPECT_EQ(faults.crowded_edges, 4U);
  EXPECT_EQ(faults.open_edges, 0U);
  EXPECT_EQ(faults.seen_behind, 0U);
  EXPECT_EQ(topics(faults), Topics{"edges"});
  EXPECT_FALSE(mesh_remarks(faults)[0].follows);
}

TEST(MeshFaults, OppositeWindingIsCountedByPairs) {
  VERIFIES("LASSO-GND-166~3");
  Mesh mesh = craft();
  std::swap(mesh.triangles[4][0], mesh.triangles[4][1]);
  EXPECT_EQ(mesh_faults(mesh).opposite_pairs, 3U);
  EXPECT_EQ(topics(mesh_faults(mesh)), Topics{"winding"});
  for (auto& t : mesh.triangles) std::swap(t[0], t[1]);
  EXPECT_EQ(mesh_faults(mesh).opposite_pairs, 3U) << "all inside out: the same pairs";
}

// A box on another one: both have the face between them.
TEST(MeshFaults, OfAParametricModelFacesInCommonAreNoRemark) {
  VERIFIES("LASSO-GND-166~3");
  Mesh mesh = shapes::box({0, 0, 0}, {1, 0.8, 0.5});
  shapes::append(mesh, shapes::box({0, 0, 0.5}, {1, 0.8, 0.9}));
  EXPECT_EQ(mesh_remarks("m.stl", mesh, false).size(), 2U) << "edges, and triangles";
  EXPECT_TRUE(mesh_remarks("m.stl", mesh, true).empty());
  mesh.triangles.pop_back();
  mesh.triangles.pop_back();  // a face of the upper one
  ASSERT_EQ(mesh_remarks("m.stl", mesh, true).size(), 1U);
  EXPECT_EQ(mesh_remarks("m.stl", mesh, true)[0].text.substr(0, 5), "open:");
}

TEST(MeshFaults, TrianglesThatAreLeftOutAreCounted) {
  VERIFIES("LASSO-GND-166~3");
  Mesh mesh = craft();
  const auto t = mesh.triangles[0];
  mesh.triangles.push_back({t[1], t[2], t[0]});
  mesh.triangles.push_back({t[1], t[0], t[2]});
  mesh.triangles.push_back({t[0], t[0], t[1]});
  const MeshFaults faults = mesh_faults(mesh);
  EXPECT_EQ(faults.duplicates, 2U);
  EXPECT_EQ(faults.degenerate, 1U);
  EXPECT_EQ(topics(faults), Topics{"triangles"});
}

struct Told {
  MeshFaults faults;
  const char* count;
  const char* follows;
  const char* remedy;
};

MeshFaults some(std::size_t MeshFaults::*count) {
  MeshFaults faults;
  faults.*count = 7;
  return faults;
}

TEST(MeshFaults, EachRemarkSaysWhatFollowsAndTheRemedy) {
  VERIFIES("LASSO-GND-166~3");
  MeshFaults hole = some(&MeshFaults::hole_edges), sheets;
  hole.seen_behind = 0.25;
  sheets.sheets = 0.4;
  const char* const as_good = "poses are as good";
  const Told told[] = {
      {hole, "open: 7 edges belong to one triangle, and 25 % of the surface", "a target that is closed there does not fit",
       "close the mesh"},
      {sheets, "sheets: 40 % of the surface", "the shell of a body that is closed on the target does not fit", "close the mesh"},
      {some(&MeshFaults::crowded_edges), "edges: 7 belong to more than two triangles", as_good,
       "a union of the solids without inner walls"},
      {some(&MeshFaults::opposite_pairs), "winding: 7 pairs of neighbours are", as_good, "let its program make the normals consistent"},
      {some(&MeshFaults::degenerate), "triangles: 7 without area and 0 given twice", as_good, "the clean-up of any modelling program"},
      {some(&MeshFaults::duplicates), "triangles: 0 without area and 7 given twice", as_good, "the clean-up of any modelling program"}};
  for (const Told& t : told) {
    const std::vector<MeshRemark> remarks = mesh_remarks(t.faults);
    ASSERT_EQ(remarks.size(), 1U) << t.count;
    EXPECT_EQ(remarks[0].text.find(t.count), 0U) << remarks[0].text;
    const std::size_t follows = remarks[0].text.find(t.follows);
    EXPECT_NE(follows, std::string::npos) << remarks[0].text;
    EXPECT_NE(remarks[0].text.find(t.remedy, follows), std::string::npos) << remarks[0].text;
  }
}

TEST(MeshFaults, AMeshThatCannotBeCompiledIsRefusedByName) {
  VERIFIES("LASSO-GND-166~3");
  Mesh mesh;
  mesh.vertices = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}};
  mesh.triangles = {{0, 1, 2}};
  try {
    mesh_remarks("line.stl", mesh, false);
    FAIL() << "no triangle has an area";
  } catch (const MissionError& error) {
    EXPECT_EQ(std::string(error.what()).find("line.stl: the mesh cannot be compiled: all 1 triangles are thinner"), 0U) << error.what();
  }
}

TEST(MeshFaults, ShippedModelsHaveNone) {
  VERIFIES("LASSO-GND-166~3");
  for (const char* name : {"hubble_tenth", "hubble", "hubble_near", "hubble_stereo", "day_and_night", "laboratory", "rendezvous"}) {
    const MissionSource source = load_mission(kSourceFolder / "cfg/missions" / (std::string(name) + ".toml"));
    for (const MeshRemark& remark : mesh_remarks(name, load_target(source), source.target.parametric))
      ADD_FAILURE() << name << ": " << remark.text;
  }
}

}  // namespace
}  // namespace lasso::mdat
