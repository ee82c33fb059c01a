#include "mdat/link/key.hpp"

#include <sys/stat.h>

#include <cstdio>
#include <memory>

#include "mdat/cli/commands.hpp"
#include "mdat/common/output.hpp"

namespace lasso::mdat {
namespace {

struct KeyArguments {
  std::string master, out;
  std::uint32_t number = 0;
  bool replace = false;
};

// For its owner's eyes alone.
void write_key(const KeyArguments& options, const Key& key) {
  const mode_t before = umask(S_IRWXG | S_IRWXO);
  write_file(options.out, key_text(key));
  (void)umask(before);
}

void derive(const KeyArguments& options) {
  const Key master = load_master_key(options.master);
  refuse_same_files({options.out}, {options.master});
  if (!options.replace) refuse_to_replace({options.out}, "--force replaces it");
  write_key(options, derive_command_key(master, options.number));
  const std::string number = std::to_string(options.number);
  std::printf(
      "%s: key %s, for commands alone\nnext, while the key before is in use:\n"
      "  mdat command change_key number=%s --arm --key KEY_BEFORE --to URL\n"
      "  mdat command confirm_key number=%s --key %s --to URL      # within 300 frames\n",
      options.out.c_str(), number.c_str(), number.c_str(), number.c_str(), options.out.c_str());
}

}  // namespace

void add_key_command(CLI::App& app) {
  const auto options = std::make_shared<KeyArguments>();
  CLI::App* command =
      app.add_subcommand("key", "derive a new key for commands from a mission's master key (docs/decisions/keys-by-link.md)");
  command->add_option("MASTER", options->master, "file of the master key: 64 hexadecimal digits (openssl rand -hex 32)")->required();
  command
      ->add_option(
          "--number", options->number,
          "of the new key; larger than that of the key in use, which is 0 at first, by a small step: what is stepped over is used up")
      ->required()
      ->check(CLI::Range(1U, UINT32_MAX));
  command->add_option("-o,--out", options->out, "file to write, for its owner's eyes alone")->required();
  command->add_flag("--force", options->replace, "replace a file that is there");
  command->callback([options] { derive(*options); });
}

}  // namespace lasso::mdat
