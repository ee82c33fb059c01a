// A mission of its own for each kind of mesh: written, checked, compiled and flown, by the command line alone. MESHES=all takes all kinds.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <functional>
#include <numbers>

#include "ft/mdat/command.hpp"
#include "ut/support/verifies.hpp"

namespace lasso::ft {
namespace {

using Point = std::array<double, 3>;
using Triangles = std::vector<std::array<Point, 3>>;
constexpr double kTurn = 2 * std::numbers::pi;

Triangles operator+(Triangles a, const Triangles& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

// A patch over the unit square.
Triangles patch(int n, int m, const std::function<Point(double, double)>& at) {
  Triangles result;
  for (int i = 0; i < n; ++i) {
    for (int k = 0; k < m; ++k) {
      const auto corner = [&](int di, int dk) { return at(static_cast<double>(i + di) / n, static_cast<double>(k + dk) / m); };
      result.push_back({corner(0, 0), corner(1, 0), corner(1, 1)});
      result.push_back({corner(0, 0), corner(1, 1), corner(0, 1)});
    }
  }
  return result;
}

Triangles box(const Point& low, const Point& high) {
  Triangles result;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    for (const bool far : {false, true}) {
      result = result + patch(1, 1, [&](double u, double v) {
                 Point p{};
                 p[axis] = far ? high[axis] : low[axis];
                 const std::size_t one = (axis + (far ? 1 : 2)) % 3, two = (axis + (far ? 2 : 1)) % 3;
                 p[one] = low[one] + u * (high[one] - low[one]);
                 p[two] = low[two] + v * (high[two] - low[two]);
                 return p;
               });
    }
  }
  return result;
}

// A body of revolution about z, by its radius and height along t.
Triangles turned(int n, int m, const std::function<std::array<double, 2>(double)>& profile) {
  return patch(n, m, [&](double u, double t) {
    const auto [radius, z] = profile(t);
    return Point{radius * std::cos(kTurn * u), radius * std::sin(kTurn * u), z};
  });
}

Triangles changed(Triangles triangles, const std::function<Point(const Point&)>& change) {
  for (auto& triangle : triangles) {
    for (Point& p : triangle) p = change(p);
  }
  return triangles;
}

Triangles scaled(const Triangles& triangles, double factor, const Point& shift = {0, 0, 0}) {
  return changed(triangles, [&](const Point& p) {
    return Point{factor * p[0] + shift[0], factor * p[1] + shift[1], factor * p[2] + shift[2]};
  });
}

Triangles satellite() {
  return box({-0.5, -0.4, -0.3}, {0.5, 0.4, 0.3}) + box({-0.2, 0.4, -0.01}, {0.2, 1.6, 0.01}) +
         box({-0.2, -1.6, -0.01}, {0.2, -0.4, 0.01}) + box({0.5, -0.1, 0.1}, {0.8, 0.1, 0.25});
}

Triangles ball(double radius, int n, int m) {
  return turned(n, m, [&](double t) { return std::array{radius * std::sin(kTurn / 2 * t), -radius * std::cos(kTurn / 2 * t)}; });
}

// The same everywhere, and not regular.
double noise(double x) { return std::sin(12.9898 * x) * 43758.5453 - std::floor(std::sin(12.9898 * x) * 43758.5453) - 0.5; }

Triangles scan() {
  return changed(patch(90, 45,
                       [](double u, double v) {
                         const double rise = kTurn / 2 * v, bump = 0.6 + 0.1 * std::cos(3 * kTurn * u) * std::sin(rise);
                         return Point{bump * std::sin(rise) * std::cos(kTurn * u), 1.3 * bump * std::sin(rise) * std::sin(kTurn * u),
                                      -bump * std::cos(rise)};
                       }),
                 [](const Point& p) {
                   const double part =
                       1 + 0.002 * noise(std::round(1e4 * p[0]) + 3.1 * std::round(1e4 * p[1]) + 7.7 * std::round(1e4 * p[2]));
                   return Point{part * p[0], part * p[1], part * p[2]};
                 });
}

Triangles truss() {
  Triangles result;
  for (int i = 0; i < 8; ++i) {
    const double x = 0.25 * i - 1;
    for (const double y : {-0.15, 0.15}) {
      for (const double z : {-0.15, 0.15}) result = result + box({x, y - 0.015, z - 0.015}, {x + 0.25, y + 0.015, z + 0.015});
      result = result + box({x - 0.015, y - 0.015, -0.15}, {x + 0.015, y + 0.015, 0.15});
      result = result + box({x - 0.015, -0.15, y - 0.015}, {x + 0.015, 0.15, y + 0.015});
    }
  }
  return result + box({-0.9, -0.15, 0.15}, {-0.3, 0.15, 0.35});
}

Triangles many_boxes() {
  Triangles result;
  for (int i = 0; i < 120; ++i) {
    const Point p{noise(i), noise(i + 200.5), 0.8 * noise(i + 400.25)};
    result = result + box(p, {p[0] + 0.09, p[1] + 0.07, p[2] + 0.05});
  }
  return result;
}

// Cubes that share edges and vertices: a surface of high genus.
Triangles sponge() {
  Triangles result;
  for (int i = 0; i < 64; ++i) {
    const double x = 0.2 * (i % 4), y = 0.2 * (i / 4 % 4), z = 0.2 * (i / 16);
    if ((i % 4 + i / 4 % 4 + i / 16) % 2 == 0 && i != 5) result = result + box({x, y, z}, {x + 0.2, y + 0.2, z + 0.2});
  }
  return result;
}

Triangles knobs() {
  Triangles result = box({-0.5, -0.4, -0.3}, {0.5, 0.4, 0.3});
  for (int i = 0; i < 12; ++i) result = result + scaled(ball(0.011, 24, 14), 1, {0.5, -0.35 + 0.06 * i, 0.1});
  return result;
}

Triangles fan() {
  return box({-0.4, -0.3, -0.5}, {0.4, 0.3, -0.1}) + turned(1800, 1, [](double t) { return std::array{0.5 * t, 0.2 - 0.2 * t}; });
}

Triangles layers() {
  Triangles result;
  for (int i = 0; i < 20; ++i) {
    const double z = 0.002 * i;
    result = result + box({-1, -0.6, z}, {1 - 0.03 * i, 0.6, z + 0.0005});
  }
  return result;
}

struct Kind {
  const char* name;
  std::function<Triangles()> make;
  const char* options = "";
  bool landing = false;      // one of the few that each landing flies
  bool followed = true;      // without a warning, with valid poses: not of bodies that few rays meet, or that turn without a change
  bool has_attitude = true;  // a ball, or a rod's roll, can hardly be known, and some poses are valid and wrong (docs/limits.md)
};

const std::vector<Kind>& kinds() {
  static const std::vector<Kind> list = {
      {"satellite", satellite, "", true},
      {"off_origin",
       [] {
         return scaled(satellite(), 1, {2.5, 2.2, -1});
       },
       "", true},
      {"a_bit_off",
       [] {
         return scaled(satellite(), 1, {0.9, -0.7, 0.4});
       }},
      {"far_off",
       [] {
         return scaled(satellite(), 1, {300, -250, 120});
       }},
      {"millimetres", [] { return scaled(satellite(), 1000); }, "--scale 0.001"},
      {"small", [] { return scaled(satellite(), 0.1); }},
      {"huge", [] { return scaled(satellite(), 60); }},
      {"plate",
       [] {
         return box({-1, -0.6, -0.0005}, {1, 0.6, 0.0005});
       }},
      {"rod",
       [] {
         return box({-2, -0.02, -0.03}, {2, 0.02, 0.03});
       },
       "", false, false, false},
      {"sheet",
       [] { return patch(20, 10, [](double u, double v) {
              return Point{2 * u - 1, 1.2 * v - 0.6, 0.1 * std::sin(5 * u + v)};
            }); }},
      {"dish",
       [] {
         return turned(60, 20, [](double t) { return std::array{t, 0.4 * t * t}; }) + box({-0.2, -0.3, -0.5}, {0.3, 0.2, 0});
       }},
      {"ball", [] { return ball(0.5, 32, 16); }, "", false, false, false},
      {"torus",
       [] {
         return patch(60, 30, [](double u, double v) {
           const double r = 1 + 0.3 * std::cos(kTurn * v);
           return Point{r * std::cos(kTurn * u), r * std::sin(kTurn * u), 0.3 * std::sin(kTurn * v)};
         });
       },
       "", false, false},
      {"truss", truss},
      {"many_boxes", many_boxes},
      {"sponge", sponge},
      {"knobs", knobs},
      {"fan", fan, "--simplify 300"},
      {"layers", layers},
      {"scan", scan, "--simplify 3000", true},
  };
  return list;
}

std::string stl_of(const Triangles& triangles) {
  std::string bytes(80, ' ');
  const auto append = [&](const auto& value) { bytes.append(reinterpret_cast<const char*>(&value), sizeof value); };
  append(static_cast<std::uint32_t>(triangles.size()));
  for (const auto& triangle : triangles) {
    for (int i = 0; i < 3; ++i) append(0.0F);
    for (const Point& p : triangle) {
      for (const double x : p) append(static_cast<float>(x));
    }
    bytes.append(2, '\0');
  }
  return bytes;
}

void expect_flies(const WorkFolder& work, const Kind& kind) {
  work.write("target.stl", stl_of(kind.make()));
  const Answer written = work.mdat(std::string("mission new --model target.stl -o target.toml ") + kind.options);
  ASSERT_EQ(written.exit_code, 0) << written.err;
  for (const char* line :
       {"size: ", "surface: ", "sensor: ", "symmetry: ", "image: ", "mdat mission check target.toml", "mdat run target.toml"})
    EXPECT_NE(written.out.find(line), std::string::npos) << line << "\n" << written.out;
  const Answer checked = work.mdat("mission check target.toml");
  EXPECT_EQ(checked.exit_code, 0) << checked.err;
  if (kind.followed) {
    EXPECT_EQ((checked.out + checked.err).find("warning"), std::string::npos) << checked.out << checked.err;
  }
  const Answer compiled = work.mdat("mission compile target.toml -o target.3dli");
  ASSERT_EQ(compiled.exit_code, 0) << compiled.err;
  const Answer flown = work.mdat("run target.toml --scenario spin --frames 70 --no-report --out out/spin");
  ASSERT_EQ(flown.exit_code, 0) << flown.err;
  const Json noisy = Json::parse(work.read("out/spin/results.json")).at("noisy");
  EXPECT_EQ(noisy.at("frames"), 70);
  if (kind.has_attitude) {
    EXPECT_LE(noisy.at("wrong"), 1) << "of a track's first scans, before its rates are known, one may be (docs/limits.md)\n" << flown.out;
  }
  if (kind.followed) {
    EXPECT_LT(noisy.at("invalid").get<int>(), 55) << "the check of the start takes some 25, of a symmetric body twice as many\n"
                                                  << flown.out;
  }
}

TEST(MissionSchema, IsPrintedAsItIsShipped) {
  VERIFIES("LASSO-GND-001~1");
  const Answer answer = WorkFolder().mdat("mission schema");
  EXPECT_EQ(answer.exit_code, 0) << answer.err;
  EXPECT_EQ(answer.out, read_text(source_path("cfg/mission.schema.json")));
}

TEST(NewMission, FliesWhateverTheMesh) {
  VERIFIES("LASSO-NEED-011~1 LASSO-GND-012~1 LASSO-GND-040~1 LASSO-GND-041~1 LASSO-GND-042~1 LASSO-GND-043~1");
  const char* meshes = std::getenv("MESHES");
  const bool all = meshes != nullptr && std::string(meshes) == "all";
  for (const Kind& kind : kinds()) {
    if (!all && !kind.landing) continue;
    SCOPED_TRACE(kind.name);
    expect_flies(WorkFolder(), kind);
  }
}

TEST(NewMission, SaysTheSizeByItsScaleAndAsksAboutOneThatIsNoSpacecrafts) {
  VERIFIES("LASSO-GND-043~1");
  const WorkFolder work;
  work.write("mm.stl", stl_of(scaled(satellite(), 200)));  // 0.64 m, in millimetres
  const auto size_line = [&](const std::string& options) {
    const std::string text = work.mdat("mission new --model mm.stl -o m.toml --force " + options).out;
    const std::size_t at = text.find("size: ");
    return text.substr(at, text.find('\n', at) - at);
  };
  EXPECT_EQ(size_line(""), "size: 260 x 640 x 120 m, by --scale 1: large for a spacecraft: in millimetres? --scale 0.001 makes it 0.64 m");
  EXPECT_EQ(size_line("--scale 0.5"),
            "size: 130 x 320 x 60 m, by --scale 0.5: large for a spacecraft: in millimetres? --scale 0.0005 makes it 0.32 m");
  EXPECT_EQ(size_line("--scale 0.001"), "size: 0.26 x 0.64 x 0.12 m, by --scale 0.001");
  EXPECT_EQ(size_line("--scale 1e-4"),
            "size: 0.026 x 0.064 x 0.012 m, by --scale 0.0001: small for a spacecraft: another --scale may be needed; the file's lengths "
            "times it are metres");
}

// A box without two of its triangles, and the same box with two of them wound the other way.
TEST(NewMission, TellsWhatIsOddAboutAMesh) {
  VERIFIES("LASSO-GND-166~3");
  const WorkFolder work;
  const Triangles whole = satellite();
  work.write("hole.stl", stl_of(Triangles(whole.begin() + 2, whole.end())));
  Triangles turned_over = whole;
  std::swap(turned_over[3][0], turned_over[3][1]);
  work.write("winding.stl", stl_of(turned_over));
  work.write("whole.stl", stl_of(whole));
  const std::string told[][4] = {
      {"hole", "  open: 4 edges belong to one triangle, and ", "warning: ", "does not fit: close the mesh"},
      {"winding", "  winding: 3 pairs of neighbours are wound against each other", "note: ", "make the normals consistent"},
      {"whole", "  size: 1.3 x 3.2 x 0.6 m, by --scale 1", "", ""}};
  for (const auto& [name, line, kind, remedy] : told) {
    const Answer written = work.mdat("mission new --model " + name + ".stl -o " + name + ".toml");
    EXPECT_EQ(written.exit_code, 0) << written.err;
    EXPECT_NE(written.out.find(line), std::string::npos) << written.out;
    const Answer checked = work.mdat("mission check " + name + ".toml");
    EXPECT_EQ(checked.exit_code, 0) << checked.err;
    EXPECT_EQ(lines_of(checked.out).size(), kind.empty() ? 1U : 2U) << checked.out;
    EXPECT_EQ(checked.out.find(kind), 0U) << checked.out;
    for (const std::string& out : {written.out, checked.out}) EXPECT_NE(out.find(remedy), std::string::npos) << out;
  }
}

}  // namespace
}  // namespace lasso::ft
