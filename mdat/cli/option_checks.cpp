// What options of several subcommands are checked for.
#include <cmath>
#include <filesystem>

#include "mdat/cli/commands.hpp"
#include "mdat/common/errors.hpp"
#include "mdat/common/text.hpp"

namespace lasso::mdat {
namespace {

std::string numbers_span(double low, double high) { return format("%.10g to %.10g", low, high); }

bool are_same(const std::string& a, const std::string& b) {
  std::error_code error;
  namespace fs = std::filesystem;
  return !a.empty() && !b.empty() && fs::weakly_canonical(a, error) == fs::weakly_canonical(b, error);
}

}  // namespace

CLI::Validator number_between(double low, double high) {
  const auto check = [low, high](const std::string& text) -> std::string {
    double value = 0;
    const bool good = CLI::detail::lexical_cast(text, value) && value >= low && value <= high;
    return good ? "" : "'" + text + "' is no number from " + numbers_span(low, high);
  };
  return CLI::Validator(check, numbers_span(low, high));
}

CLI::Option* add_apid(CLI::App& command, std::uint16_t& apid) {
  return command.add_option("--apid", apid, "application process of the component, as its host has given it (977 is 0x3D1)")
      ->capture_default_str()
      ->check(number_between(kLeastApid, kLargestApid));
}

void refuse_same_files(const std::vector<std::string>& outputs, const std::vector<std::string>& inputs) {
  for (std::size_t i = 0; i < outputs.size(); ++i) {
    for (const std::string& input : inputs) {
      if (are_same(outputs[i], input)) throw InputError(outputs[i] + ": is read as well; write to another file");
    }
    for (std::size_t k = 0; k < i; ++k) {
      if (are_same(outputs[i], outputs[k])) throw InputError(outputs[i] + ": is named twice; write to another file");
    }
  }
}

}  // namespace lasso::mdat
