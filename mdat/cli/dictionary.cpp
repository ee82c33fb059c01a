#include <cstdio>
#include <filesystem>
#include <map>
#include <memory>

#include "mdat/cli/commands.hpp"
#include "mdat/common/errors.hpp"
#include "mdat/common/output.hpp"
#include "mdat/link/dictionary_cosmos.hpp"
#include "mdat/link/dictionary_text.hpp"

namespace lasso::mdat {
namespace {

std::string text_of(const std::string& format, std::uint16_t apid) {
  if (format == "html") return dictionary_html(apid);
  if (format == "json") return dictionary_json(apid);
  if (format == "xtce") return dictionary_xtce(XtceArrays::kAsArrays, apid);
  if (format == "xtce-flat") return dictionary_xtce(XtceArrays::kWrittenOut, apid);
  return format == "lua" ? dictionary_lua(apid) : dictionary_markdown(apid);
}

struct DictionaryArguments {
  std::string format = "md", out;
  std::uint16_t apid = kApid;
  bool force = false;
};

// A folder of several files: it is new, or empty, or may be written over.
void write_plug_in(const DictionaryArguments& options) {
  namespace fs = std::filesystem;
  const fs::path folder = options.out;
  if (options.out.empty()) throw InputError("--format cosmos: is a folder of files: add --out DIR");
  std::error_code ignored;
  if (!options.force && fs::exists(folder, ignored) && !fs::is_empty(folder, ignored))
    throw InputError(options.out + ": is not empty; --force writes the plug-in into it, --out DIR elsewhere");
  const std::map<std::string, std::string> files = dictionary_cosmos(options.apid);
  for (const auto& [name, content] : files) {
    fs::create_directories((folder / name).parent_path());
    write_file(folder / name, content);
  }
  std::printf("written to %s: a plug-in of OpenC3 COSMOS, %zu files (README.md says what to do with it)\n", options.out.c_str(),
              files.size());
}

void print_dictionary(const DictionaryArguments& options) {
  if (options.format == "cosmos") return write_plug_in(options);
  if (options.out.empty()) {
    std::fputs(text_of(options.format, options.apid).c_str(), stdout);
  } else {
    if (!options.force) refuse_to_replace({options.out}, "--force replaces it");
    write_file(options.out, text_of(options.format, options.apid));
  }
}

}  // namespace

void add_dictionary_command(CLI::App& app) {
  const auto options = std::make_shared<DictionaryArguments>();
  CLI::App* command = app.add_subcommand("dictionary", "print the link's dictionary: packets, items, enumerations, parameters");
  command
      ->add_option(
          "--format", options->format,
          "md (docs/icd/link.md), html, json, xtce, xtce-flat (for readers that know no arrays), lua for Wireshark, or cosmos: the "
          "folder of a plug-in of OpenC3 COSMOS")
      ->capture_default_str()
      ->check(CLI::IsMember({"md", "html", "json", "xtce", "xtce-flat", "lua", "cosmos"}));
  command->add_option("-o,--out", options->out, "file to write instead; of cosmos the folder");
  add_apid(*command, options->apid);
  command->add_flag("--force", options->force, "replace what is there");
  command->callback([options] { print_dictionary(*options); });
}

}  // namespace lasso::mdat
