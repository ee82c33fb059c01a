#include "mdat/source/nearest.hpp"

#include <algorithm>
#include <numeric>

namespace lasso::mdat {
namespace {

// Levenshtein distance.
std::size_t edit_distance(const std::string& a, const std::string& b) {
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 0; i < a.size(); ++i) {
    std::size_t diagonal = row[0];
    row[0] = i + 1;
    for (std::size_t j = 0; j < b.size(); ++j) {
      const std::size_t substitute = diagonal + (a[i] == b[j] ? 0 : 1);
      diagonal = row[j + 1];
      row[j + 1] = std::min({row[j] + 1, row[j + 1] + 1, substitute});
    }
  }
  return row.back();
}

std::string last_part(const std::string& key) { return key.substr(key.rfind('.') + 1); }

// A key without its unit, or in the wrong section, is as good as a spelling mistake.
std::size_t dissimilarity(const std::string& written, const std::string& candidate) {
  const std::string a = last_part(written);
  const std::string b = last_part(candidate);
  const std::size_t whole = edit_distance(written, candidate);
  if (a == b || (a.size() > 3 && b.rfind(a, 0) == 0) || (b.size() > 3 && a.rfind(b, 0) == 0)) return std::min<std::size_t>(whole, 1);
  return whole;
}

}  // namespace

std::string nearest(const std::string& written, const std::vector<std::string>& candidates) {
  if (written.empty()) return "";
  std::string best;
  std::size_t least = std::max<std::size_t>(2, written.size() / 4) + 1;
  for (const std::string& candidate : candidates) {
    if (written.size() <= 4 && written[0] != candidate[0]) continue;  // two letters of "fast" make it "lost"
    const std::size_t distance = dissimilarity(written, candidate);
    if (distance < least) {
      least = distance;
      best = candidate;
    }
  }
  return best;
}

std::string did_you_mean(const std::string& written, const std::vector<std::string>& candidates) {
  const std::string meant = nearest(written, candidates);
  return meant.empty() ? "" : "; did you mean " + meant + "?";
}

}  // namespace lasso::mdat
