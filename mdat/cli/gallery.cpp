#include "mdat/report/gallery.hpp"

#include <cstdio>
#include <memory>

#include "mdat/cli/commands.hpp"
#include "mdat/common/errors.hpp"
#include "mdat/common/output.hpp"

namespace lasso::mdat {
namespace {

struct GalleryArguments {
  std::vector<std::string> folders;
  std::string out;
};

void write(const GalleryArguments& options) {
  const std::filesystem::path out =
      options.out.empty() ? std::filesystem::path(options.folders.front()) / "index.html" : std::filesystem::path(options.out);
  if (std::filesystem::exists(out) && !is_gallery(file_content(out))) refuse_to_replace({out}, "it is no gallery; --out writes elsewhere");
  std::vector<std::string> skipped;
  const std::vector<GalleryEntry> runs = find_runs({options.folders.begin(), options.folders.end()}, skipped);
  for (const std::string& why : skipped) std::fprintf(stderr, "warning: %s; left out\n", why.c_str());
  if (runs.empty()) throw InputError(options.folders.front() + ": no run below it: mdat run leaves a results.json");
  write_file(out, gallery_html(runs, std::filesystem::absolute(out).parent_path()));
  std::printf("%zu runs: %s\n", runs.size(), out.c_str());
}

}  // namespace

void add_gallery_command(CLI::App& app) {
  const auto options = std::make_shared<GalleryArguments>();
  CLI::App* command =
      app.add_subcommand("gallery", "write a page of all runs below a folder: pictures, verdicts, and links to their reports");
  command->add_option("FOLDER", options->folders, "folders with runs below them")->required();
  command->add_option("-o,--out", options->out, "page to write (index.html in the first folder); an earlier gallery is replaced");
  command->callback([options] { write(*options); });
}

}  // namespace lasso::mdat
