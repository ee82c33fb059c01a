#include <cstdio>
#include <memory>
#include <utility>

#include "mdat/cli/commands.hpp"
#include "mdat/common/interruption.hpp"
#include "mdat/common/version.hpp"
#include "mdat/serve/network.hpp"
#include "mdat/serve/service.hpp"

namespace lasso::mdat {
namespace {

struct ServeArguments {
  std::string place = ".";
  serve::NetworkOptions network;
  serve::LinkRights rights;
  std::string key;
};

bool is_loopback(const std::string& host) { return host == "localhost" || host == "::1" || host == "[::1]" || host.rfind("127.", 0) == 0; }

void serve_page(const ServeArguments& options) {
  serve::LinkRights rights = options.rights;
  if (!options.key.empty()) rights.key = load_key(options.key);
  serve::Folder folder(options.place);
  serve::Network network(options.network);
  const serve::Gate gate(options.network.host, network.port(), serve::random_token());
  serve::Live live(folder, kCommit, std::move(rights));
  serve::Service service(gate, folder, {kCommit, serve::page_files(), &live});
  std::printf("%s\n", gate.address().c_str());
  (void)std::fflush(stdout);
  std::fprintf(stderr, "Open this address in a browser; who has it can read the recordings. Ctrl-C ends.\n");
  if (serve::page_files().empty())
    std::fprintf(stderr,
                 "This mdat has no page: make serve builds it (it needs node 18 or newer, and npm). Programs are answered (/api).\n");
  if (!is_loopback(options.network.host))
    std::fprintf(stderr, "warning: other machines can reach it, and what they read is not encrypted\n");
  network.serve(service, interruption());
}

}  // namespace

void add_serve_command(CLI::App& app) {
  const auto options = std::make_shared<ServeArguments>();
  CLI::App* command = app.add_subcommand("serve", "show recordings in a browser");
  command->add_option("FILE.mcap | FOLDER", options->place, "a recording, or a folder with recordings")->capture_default_str();
  command->add_option("--port", options->network.port, "to listen on; 0: any that is free")
      ->capture_default_str()
      ->check(CLI::Range(0, 65535));
  command->add_option("--host", options->network.host, "address to listen on; another one than loopback's lets other machines in")
      ->capture_default_str();
  command->add_flag("--allow-commands", options->rights.commands, "the page may command a component that it is connected to");
  command->add_option("--key", options->key,
                      "file with the key that the component asks commands to be signed with (64 hexadecimal digits)");
  add_apid(*command, options->rights.apid);
  command->callback([options] { serve_page(*options); });
}

}  // namespace lasso::mdat
