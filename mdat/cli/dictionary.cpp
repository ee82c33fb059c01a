#include <cstdio>
#include <memory>

#include "mdat/cli/commands.hpp"
#include "mdat/link/dictionary_text.hpp"

namespace lasso::mdat {
namespace {

std::string text_of(const std::string& format) {
  if (format == "html") return dictionary_html();
  if (format == "json") return dictionary_json();
  if (format == "xtce") return dictionary_xtce();
  return format == "lua" ? dictionary_lua() : dictionary_markdown();
}

}  // namespace

void add_dictionary_command(CLI::App& app) {
  const auto format = std::make_shared<std::string>("md");
  CLI::App* command = app.add_subcommand("dictionary", "print the link's dictionary: packets, items, enumerations, parameters");
  command->add_option("--format", *format, "md (docs/icd/link.md), html, json, xtce, or lua for Wireshark")
      ->capture_default_str()
      ->check(CLI::IsMember({"md", "html", "json", "xtce", "lua"}));
  command->callback([format] { std::fputs(text_of(*format).c_str(), stdout); });
}

}  // namespace lasso::mdat
