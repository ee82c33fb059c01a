// Spacecraft and other bodies that are made from a seed, so that what is claimed of any target can be tried on many.
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "mdat/missiondb/exact_symmetry.hpp"
#include "mdat/modelc/mesh.hpp"

namespace lasso::mdat {

enum class BodyKind : std::uint8_t {
  kPlain = 0,            // a spacecraft of few parts
  kCluttered = 1,        // one with many small parts
  kSymmetric = 2,        // parts all around, in equal steps
  kNearlySymmetric = 3,  // the same with one small part more
  kSpentStage = 4,       // a rocket's
  kRock = 5,             // an asteroid
  kUnknowable = 6        // a sphere, cylinder or cone: no scan tells how it is turned about its axis
};
constexpr std::size_t kBodyKinds = 7;
// "plain", "cluttered", "symmetric", "nearly-symmetric", "spent-stage", "rock", "unknowable".
const char* body_kind_name(BodyKind kind);
std::optional<BodyKind> body_kind_of(const std::string& name);
std::vector<std::string> body_kind_names();

// A solid of the body, as the model's file says it.
struct BodyPart {
  std::string name;
  std::string assembly;  // what it belongs to: "dish 2" has a mast, a reflector and a feed
  std::string lines;     // kind, shape, place, repeat (cfg/models/README.md)
};

struct BodyParameter {
  std::string name, meaning;
  double preset_deg = 0, minimum_deg = 0, maximum_deg = 0;
};

// The same seed gives the same body, byte for byte, on every machine. A copy may be changed: a part taken out, a parameter's preset moved.
struct Body {
  std::uint64_t seed = 0;
  BodyKind kind = BodyKind::kPlain;
  std::string what;  // a few words: "box with 2 wings, a dish and 12 small parts"
  std::vector<BodyParameter> parameters;
  std::vector<BodyPart> parts;
};

// `kind` where one is asked for; otherwise the seed draws it, by these shares in hundredths.
constexpr int kBodyShares[kBodyKinds] = {22, 25, 12, 13, 12, 10, 6};
Body make_body(std::uint64_t seed, std::optional<BodyKind> kind = std::nullopt);

// A parametric model, without a word on the truth.
std::string model_text(const Body& body);
Mesh mesh_of(const Body& body);
// The body without an assembly.
Body without(const Body& body, const std::string& assembly);

struct AssemblyBox {
  std::string assembly;
  Eigen::AlignedBox3d box_m;
};

// What is true of a body: known from its making, not from a scan.
struct BodyTruth {
  Eigen::Vector3d low_m = Eigen::Vector3d::Zero(), high_m = Eigen::Vector3d::Zero();
  double size_m = 0;  // largest side of its box
  ExactSymmetry symmetry;
  std::vector<AssemblyBox> assemblies;
  // Whether all of its attitude can be known, apart from its exact symmetries.
  bool determined() const { return !symmetry.axis && !symmetry.sphere; }
};
BodyTruth truth_of(const Body& body);

// model_text with the truth as comments, for a person.
std::string commented_model_text(const Body& body, const BodyTruth& truth);

// A line for each: what it is, its symmetry, its parts.
std::vector<std::string> body_lines(const Body& body, const BodyTruth& truth);

}  // namespace lasso::mdat
