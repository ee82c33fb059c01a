#include "mdat/report/about_view.hpp"

#include <map>

#include "mdat/common/text.hpp"
#include "mdat/common/version.hpp"
#include "mdat/report/page.hpp"

namespace lasso::mdat {
namespace {

std::string line(const std::string& what, const std::string& text) { return "<dt>" + what + "</dt><dd>" + text + "</dd>\n"; }

// Variants that flew the same image stand together.
std::string images_text(const SimulationResult& result) {
  std::map<std::uint32_t, std::string> variants;
  for (const TableResult& table : result.tables) {
    for (const VariantResult& variant : table.variants) {
      std::string& names = variants[variant.image_crc];
      if (names.find(variant.variant.title) == std::string::npos) names += (names.empty() ? "" : "; ") + std::string(variant.variant.title);
    }
  }
  std::string text;
  for (const auto& [crc, names] : variants)
    text += (text.empty() ? "" : "<br>") + format("%08X", crc) + (variants.size() > 1 ? " (" + names + ")" : "");
  return text;
}

std::string settings_text(const SimulationResult& result) {
  std::string text;
  for (const std::string& setting : result.settings) text += (text.empty() ? "" : "<br>") + ("<code>" + escape(setting) + "</code>");
  return text;
}

std::string deviations_table(const SimulationResult& result) {
  HtmlTable html;
  html.head = {"key", "value", "unit", "preset", "from"};
  for (const auto& [value, preset] : result.deviations)
    html.rows.push_back({escape(value.key), escape(value.value), value.unit, preset.empty() ? "–" : escape(preset), escape(value.place)});
  return format("<details><summary>%zu values that are not presets, or are stated of a laser</summary>", result.deviations.size()) +
         to_html(html) +
         "<p class='note'>–: the key has no preset, or takes another one's value. A value that is not listed is its preset; "
         "<code>mdat mission info</code> prints all.</p></details>\n";
}

}  // namespace

std::string about_section(const CompiledMission& mission, const SimulationResult& result) {
  const MissionSource& source = mission.source;
  std::string text = "<section>\n<h2>What was flown</h2>\n<dl>\n";
  text += line("Mission", format("%s, number %u, version %u, %s", escape(source.name).c_str(), source.id, source.version,
                                 escape(source.file.filename().string()).c_str()));
  text += line("Target", escape(source.target.file.filename().string()) + ", SHA-256 " + source.target.sha256.substr(0, 16) + "…");
  text += line("Scenario", format("%s, seed %llu, %u frames", escape(result.scenario).c_str(), static_cast<unsigned long long>(result.seed),
                                  result.frames));
  text += line("Sensor", escape(result.sensor));
  text += line("Flight image, CRC-32C", images_text(result));
  text += line("Program", std::string("mdat ") + kVersion + (result.commit.empty() ? "" : ", commit " + escape(result.commit)));
  if (!result.settings.empty()) text += line("Set by --set", settings_text(result));
  return text + "</dl>\n" + deviations_table(result) + "</section>\n";
}

}  // namespace lasso::mdat
