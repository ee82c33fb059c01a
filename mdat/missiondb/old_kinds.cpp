#include "mdat/missiondb/old_kinds.hpp"

#include <algorithm>
#include <iterator>
#include <vector>

namespace lasso::mdat {
namespace {

// A line that says today what the kind said, where the scenario does not say it by itself.
struct NewLine {
  const char* path;  // in the scenario's table
  const char* line;
};

struct OldKind {
  const char* name;
  std::vector<NewLine> lines;
  std::vector<const char*> idle;  // keys that had no effect, and have one today
};

const std::vector<OldKind>& old_kinds() {
  static const std::vector<OldKind> kinds = {
      {"paper",
       {{"variants", "variants = true"},
        {"step_deg", "step_deg = 1"},
        {"override.estimation.deskew", "override.estimation.deskew = false"}},
       {"spin_degps", "drift_mps", "times_s"}},
      {"spin", {}, {"step_deg", "times_s"}},
      {"approach", {{"autonomous", "autonomous = true"}, {"times_s", "times_s = [0]"}}, {"step_deg", "drift_mps"}},
      {"pass", {{"times_s", "times_s = [0]"}}, {"step_deg", "drift_mps"}},
      {"scene", {}, {}},
  };
  return kinds;
}

std::string joined(const std::vector<std::string>& items, const char* between) {
  std::string text;
  for (const std::string& item : items) text += (text.empty() ? "" : between) + item;
  return text;
}

std::string remedy_of(const OldKind& kind, const toml::table& scenario) {
  std::vector<std::string> lines, idle;
  for (const NewLine& line : kind.lines) {
    if (!scenario.at_path(line.path)) lines.emplace_back(line.line);
  }
  for (const char* key : kind.idle) {
    if (scenario.contains(key)) idle.emplace_back(key);
  }
  const std::string leave = idle.empty() ? "" : "; and delete " + joined(idle, ", ") + ", which had no effect";
  return lines.empty() ? "delete this line" + leave : "write instead of this line: " + joined(lines, "; ") + leave;
}

}  // namespace

void refuse_kind(const toml::table& scenario, const std::string& prefix, ProblemList& problems) {
  const toml::node* node = scenario.get("kind");
  if (node == nullptr) return;
  const std::string written = node->value_or(std::string());
  const auto kind = std::find_if(old_kinds().begin(), old_kinds().end(), [&](const OldKind& known) { return written == known.name; });
  problems.add(*node, prefix + "kind",
               "scenarios have no kinds: " + (kind == old_kinds().end() ? "delete this line" : remedy_of(*kind, scenario)));
}

}  // namespace lasso::mdat
