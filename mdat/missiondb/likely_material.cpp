#include "mdat/missiondb/likely_material.hpp"

#include <cctype>

namespace lasso::mdat {
namespace {

struct MaterialRule {
  const char* word;  // within the part's name, small letters
  const char* material;
};

// The first word that occurs decides: fittings before what they are fitted to.
constexpr MaterialRule kMaterialRules[] = {
    {"spar", "black-anodised"},
    {"hinge", "black-anodised"},
    {"drive", "black-anodised"},
    {"boom", "black-anodised"},
    {"mast", "black-anodised"},
    {"gimbal", "black-anodised"},
    {"handrail", "white-paint"},
    {"rail", "white-paint"},
    {"standoff", "white-paint"},
    {"solar panel", "solar-cells"},
    {"solar array", "solar-cells"},
    {"solar wing", "solar-cells"},
    {"wing", "solar-cells"},
    {"sun sensor", "black-anodised"},
    {"star tracker", "black-anodised"},
    {"magnetometer", "black-anodised"},
    {"trunnion", "black-anodised"},
    {"berthing pin", "black-anodised"},
    {"nozzle", "black-anodised"},
    {"thruster", "black-anodised"},
    {"docking ring", "aluminium-foil"},
    {"radiator", "silver-teflon"},
    {"antenna", "white-paint"},
    {"dish", "white-paint"},
    {"feed", "white-paint"},
    {"horn", "white-paint"},
    {"aperture door", "aluminium-foil"},
    {"bay", "mli"},
    {"bus", "mli"},
    {"upper stage", "mli"},
    {"box", "mli"},
    {"door", "mli"},
    {"tank", "mli"},
    {"mli", "mli"},
    {"body", "silver-teflon"},
    {"shroud", "silver-teflon"},
    {"rock", "regolith"},
    {"asteroid", "regolith"},
    {"stage", "white-paint"},
};

constexpr char kUnknownPart[] = "white-paint";

}  // namespace

const char* likely_material_name(const std::string& part) {
  std::string small = part;
  for (char& c : small) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  for (const MaterialRule& rule : kMaterialRules) {
    if (small.find(rule.word) != std::string::npos) return rule.material;
  }
  return kUnknownPart;
}

}  // namespace lasso::mdat
