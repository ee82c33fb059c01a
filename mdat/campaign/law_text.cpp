#include "mdat/campaign/law_text.hpp"

#include <algorithm>
#include <cmath>

#include "mdat/campaign/figures.hpp"
#include "mdat/common/text.hpp"

namespace lasso::mdat {
namespace {

std::string list_text(const std::vector<double>& values) {
  std::string text;
  for (const double value : values) text += (text.empty() ? "" : ", ") + cell_text(value);
  return text;
}

std::string from_to(double low, double high) { return cell_text(low) + " to " + cell_text(high); }

struct LawWords {
  std::string operator()(const NumberLaw& law) const { return std::visit(*this, law); }
  std::string operator()(const Fixed& law) const { return cell_text(law.value) + " in every case"; }
  std::string operator()(const Uniform& law) const { return "uniform, " + from_to(law.low, law.high); }
  std::string operator()(const LogUniform& law) const { return "uniform in the logarithm, " + from_to(law.low, law.high); }
  std::string operator()(const Normal& law) const {
    const std::string text = "normal, mean " + cell_text(law.mean) + ", sigma " + cell_text(law.sigma);
    return std::isinf(law.low) && std::isinf(law.high) ? text : text + ", within " + from_to(law.low, law.high);
  }
  std::string operator()(const OneOf& law) const {
    const bool equal = std::all_of(law.weights.begin(), law.weights.end(), [&](double weight) { return weight == law.weights.front(); });
    return "one of " + list_text(law.values) + (equal ? "" : ", weights " + list_text(law.weights));
  }
  std::string operator()(const AnyDirection& law) const { return "any direction, length " + (*this)(law.length); }
  std::string operator()(const AnyAttitude&) const { return "any attitude"; }
  std::string operator()(const Correlated& law) const {
    return "normal together, mean " + list_text(law.mean) + ", covariance by rows " + list_text(law.covariance);
  }
  std::string operator()(const Rows& law) const { return "rows of " + law.file + (law.in_order ? ", in order" : ", drawn"); }
};

}  // namespace

std::string law_text(const Law& law) { return std::visit(LawWords(), law); }

}  // namespace lasso::mdat
