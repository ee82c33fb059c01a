#include "mdat/campaign/conclusion_text.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "mdat/common/share_text.hpp"
#include "mdat/common/text.hpp"

namespace lasso::mdat {
namespace {

// Two digits, rounded up: it is an estimate.
std::string about(double number) {
  const double unit = std::pow(10, std::max(0.0, std::floor(std::log10(std::max(number, 1.0))) - 1));
  return format("%.0f", std::ceil(number / unit) * unit);
}

// Those that are there, a space apart.
std::string sentences(const std::vector<std::string>& all) {
  std::string text;
  for (const std::string& one : all) text += (text.empty() || one.empty() ? "" : " ") + one;
  return text;
}

}  // namespace

std::string bounds_text(const Criterion& criterion) {
  const bool above = std::isfinite(criterion.at_least), below = std::isfinite(criterion.at_most);
  if (above && below) return format("%g <= %s <= %g", criterion.at_least, criterion.figure.c_str(), criterion.at_most);
  if (above) return format("%s >= %g", criterion.figure.c_str(), criterion.at_least);
  return below ? format("%s <= %g", criterion.figure.c_str(), criterion.at_most) : criterion.figure;
}

std::string criterion_text(const Criterion& criterion) {
  return bounds_text(criterion) + format(" in at least %g %%", 100 * criterion.share_min);
}

std::string what_decides(const Conclusion& conclusion) {
  if (conclusion.verdict != Verdict::kUndecided) return "";
  if (conclusion.cases == 0) return "No case was flown.";
  if (conclusion.criterion.share_min >= 1)
    return "No number of cases shows 100 %; these show " + lower_limit_text(conclusion.limits.lower) + ": ask for no more than that.";
  if (!conclusion.more) return "The share is the one that is asked for: no number of cases tells on which side of it the truth lies.";
  if (conclusion.sequence) return "It needs about " + about(*conclusion.more) + " more cases at this share.";
  return "At this share a campaign of about " + about(conclusion.cases + *conclusion.more) +
         " cases would decide it; one with look_every goes on until it is decided.";
}

std::string unknown_text(const Conclusion& conclusion) {
  if (conclusion.unknown == 0) return "";
  return format("Cases without %s (such as those without a valid pose) count as outside: %u.", conclusion.criterion.figure.c_str(),
                conclusion.unknown);
}

std::string conclusion_text(const Conclusion& conclusion) {
  const std::string within = format(
      "%u of %u cases are within %s. With a confidence of %g %% that shows %s of all cases that could be drawn; at least %g %% is asked "
      "for.",
      conclusion.within, conclusion.cases, bounds_text(conclusion.criterion).c_str(), 100 * conclusion.criterion.confidence,
      limits_text(conclusion.limits).c_str(), 100 * conclusion.criterion.share_min);
  const std::string not_run = conclusion.not_run == 0 ? "" : format("Cases that failed to run count as outside: %u.", conclusion.not_run);
  return sentences({within, not_run, unknown_text(conclusion), what_decides(conclusion)});
}

}  // namespace lasso::mdat
