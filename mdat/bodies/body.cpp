#include "mdat/bodies/body.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "mdat/missiondb/model_file.hpp"
#include "mdat/missiondb/scenario_writer.hpp"
#include "mdat/missiondb/value_row.hpp"

namespace lasso::mdat {
namespace {

constexpr const char* kKindNames[kBodyKinds] = {"plain", "cluttered", "symmetric", "nearly-symmetric", "spent-stage", "rock", "unknowable"};

std::string parameter_text(const BodyParameter& parameter) {
  return "\n[parameters." + parameter.name + "]\npreset = " + number_text(parameter.preset_deg) +
         "\nminimum = " + number_text(parameter.minimum_deg) + "\nmaximum = " + number_text(parameter.maximum_deg) +
         "\nunit = \"deg\"\nmeaning = \"" + parameter.meaning + "\"\n";
}

std::string part_text(const BodyPart& part) { return "\n[[part]]\nname = \"" + part.name + "\"\n" + part.lines; }

// Of the parts in their order, each once.
std::vector<std::string> assemblies_of(const Body& body) {
  std::vector<std::string> names;
  for (const BodyPart& part : body.parts) {
    if (std::find(names.begin(), names.end(), part.assembly) == names.end()) names.push_back(part.assembly);
  }
  return names;
}

Eigen::AlignedBox3d box_of(const Mesh& mesh) {
  Eigen::AlignedBox3d box;
  for (const Eigen::Vector3d& v : mesh.vertices) box.extend(v);
  return box;
}

Body only(const Body& body, const std::string& assembly) {
  Body part = body;
  std::erase_if(part.parts, [&](const BodyPart& each) { return each.assembly != assembly; });
  return part;
}

std::string place_text(const Eigen::Vector3d& p) {
  const auto text = [](double x) { return number_text(std::round(1000 * x) / 1000 + 0.0); };
  return "(" + text(p.x()) + ", " + text(p.y()) + ", " + text(p.z()) + ")";
}

}  // namespace

const char* body_kind_name(BodyKind kind) { return kKindNames[static_cast<std::size_t>(kind)]; }

std::optional<BodyKind> body_kind_of(const std::string& name) {
  const auto found = std::find(std::begin(kKindNames), std::end(kKindNames), name);
  if (found == std::end(kKindNames)) return std::nullopt;
  return static_cast<BodyKind>(found - std::begin(kKindNames));
}

std::vector<std::string> body_kind_names() { return {std::begin(kKindNames), std::end(kKindNames)}; }

std::string model_text(const Body& body) {
  std::string text = "name = \"body " + std::to_string(body.seed) + "\"\nscale = 1\n";
  for (const BodyParameter& parameter : body.parameters) text += parameter_text(parameter);
  for (const BodyPart& part : body.parts) text += part_text(part);
  return text;
}

Mesh mesh_of(const Body& body) { return build_model_text(model_text(body), {}); }

Body without(const Body& body, const std::string& assembly) {
  Body rest = body;
  std::erase_if(rest.parts, [&](const BodyPart& part) { return part.assembly == assembly; });
  return rest;
}

BodyTruth truth_of(const Body& body) {
  BodyTruth truth;
  const Mesh mesh = mesh_of(body);
  const Eigen::AlignedBox3d box = box_of(mesh);
  truth.low_m = box.min();
  truth.high_m = box.max();
  truth.size_m = box.sizes().maxCoeff();
  truth.symmetry = exact_symmetry(mesh);
  for (const std::string& assembly : assemblies_of(body)) truth.assemblies.push_back({assembly, box_of(mesh_of(only(body, assembly)))});
  return truth;
}

std::vector<std::string> body_lines(const Body& body, const BodyTruth& truth) {
  const std::string determined = truth.determined() ? "" : "; how it is turned about that cannot be known from any scan";
  std::string parts = std::to_string(truth.assemblies.size()) + (truth.assemblies.size() == 1 ? " part" : " parts");
  for (const BodyParameter& parameter : body.parameters) parts += ", " + parameter.name + " = " + number_text(parameter.preset_deg);
  return {"body " + std::to_string(body.seed) + ": " + body_kind_name(body.kind) + ": " + body.what + ", " +
              number_text(rounded(truth.size_m)) + " m",
          "exact symmetry: " + symmetry_text(truth.symmetry) + determined, "model: " + parts};
}

std::string commented_model_text(const Body& body, const BodyTruth& truth) {
  std::string text = "# A target that mdat made from a seed: edit it as you like. Lengths in metres, angles in degrees.\n";
  for (const std::string& line : body_lines(body, truth)) text += "# " + line + '\n';
  text += "# Its parts, with the boxes about them (low x, y, z; high x, y, z in m):\n";
  for (const AssemblyBox& each : truth.assemblies)
    text += "#   " + each.assembly + ": " + place_text(each.box_m.min()) + " " + place_text(each.box_m.max()) + '\n';
  return text + '\n' + model_text(body);
}

}  // namespace lasso::mdat
