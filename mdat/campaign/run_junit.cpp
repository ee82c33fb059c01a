#include "mdat/campaign/run_junit.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

#include "mdat/campaign/conclusion_text.hpp"
#include "mdat/campaign/figures.hpp"
#include "mdat/campaign/junit_text.hpp"
#include "mdat/common/errors.hpp"
#include "mdat/common/text.hpp"
#include "mdat/run/results.hpp"

namespace lasso::mdat {
namespace {

constexpr double kUnbounded = std::numeric_limits<double>::infinity();

// A run of a variant, as people name it.
struct NamedRun {
  std::string class_name, name;
  const CaseResult& result;
};

const Figure& figure_named(const std::string& name) {
  for (const Figure& figure : case_figures()) {
    if (name == figure.name) return figure;
  }
  std::string known;
  for (const Figure& figure : case_figures()) known += (known.empty() ? "" : ", ") + std::string(figure.name);
  throw InputError("a run has no figure '" + name + "'; it has " + known);
}

std::vector<NamedRun> runs_of(const SimulationResult& result) {
  std::vector<NamedRun> runs;
  for (const TableResult& table : result.tables) {
    for (const VariantResult& variant : table.variants) {
      const std::string class_name =
          "run." + result.scenario + (table.name.empty() ? "." : "." + table.name + ".") + std::string(variant.variant.name);
      for (std::size_t i = 0; i < variant.cases.size(); ++i) runs.push_back({class_name, run_text(table.scenario, i), variant.cases[i]});
    }
  }
  return runs;
}

// The first frame whose valid pose is wrong: where to look.
std::string first_wrong_text(const CaseResult& result) {
  const auto wrong = std::find_if(result.frames.begin(), result.frames.end(), [](const FrameError& frame) { return frame.wrong; });
  if (wrong == result.frames.end()) return "No valid pose is wrong.";
  return format("The first wrong pose is that of frame %u, %.3f s after the start at %.3f m: off by %.3f mm and %.4f deg.", wrong->frame,
                wrong->t_s, wrong->range_m, 1e3 * wrong->registration.translation_m.norm(), wrong->registration.rotation_rad / kRadPerDeg);
}

std::string failure_of(const Criterion& criterion, const CaseResult& result) {
  const double value = figure_named(criterion.figure).of(result);
  if (value >= criterion.at_least && value <= criterion.at_most) return "";
  const std::string found = std::isnan(value) ? "there is no valid pose to tell it" : "it is " + cell_text(value);
  return junit_trouble("failure", "failed", bounds_text(criterion) + ": " + found, first_wrong_text(result));
}

}  // namespace

Criterion required_criterion(const std::string& text) {
  std::istringstream words(text);
  std::string figure, relation, rest;
  double bound = 0;
  const bool whole = static_cast<bool>(words >> figure >> relation >> bound) && !(words >> rest);
  if (!whole || (relation != "<=" && relation != ">=") || !std::isfinite(bound))
    throw InputError("--require '" + text + "': expected a figure, <= or >=, and a number, such as 'p95_mm <= 5'");
  try {
    (void)figure_named(figure);
  } catch (const InputError& error) {
    throw InputError("--require '" + text + "': " + error.what());
  }
  const bool most = relation == "<=";
  return {text, figure, most ? -kUnbounded : bound, most ? bound : kUnbounded};
}

std::string run_junit_xml(const SimulationResult& result, const std::vector<Criterion>& required) {
  std::vector<Criterion> criteria = {{"no_wrong_pose", "wrong", -kUnbounded, 0}};
  criteria.insert(criteria.end(), required.begin(), required.end());
  std::string cases;
  std::size_t tests = 0, failures = 0;
  for (const NamedRun& run : runs_of(result)) {
    for (const Criterion& criterion : criteria) {
      const std::string failure = failure_of(criterion, run.result);
      ++tests;
      failures += failure.empty() ? 0U : 1U;
      cases += junit_case(run.class_name, run.name + ": " + criterion.name, failure);
    }
  }
  const std::string counts = format("tests=\"%zu\" failures=\"%zu\" errors=\"0\" time=\"0\"", tests, failures);
  return "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuites " + counts + ">\n  <testsuite name=\"" + xml_text(result.mission) +
         "\" " + counts + " skipped=\"0\">\n" + cases + "  </testsuite>\n</testsuites>\n";
}

}  // namespace lasso::mdat
