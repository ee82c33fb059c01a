#include "mdat/recording/recording_edit.hpp"

#include <cmath>
#include <cstdio>
#include <map>
#include <memory>
#include <set>

#include "mdat/cli/commands.hpp"
#include "mdat/common/errors.hpp"
#include "mdat/common/output.hpp"
#include "mdat/common/text.hpp"
#include "mdat/recording/recording_export.hpp"

namespace lasso::mdat {
namespace {

struct EditArguments {
  std::vector<std::string> files, prefixes = {"a", "b"};
  std::string out, format, topic, epoch = ExportOptions().epoch;
  std::optional<double> from_s, to_s;
  bool force = false, keep_times = false, different_targets = false;
};
using SharedEdit = std::shared_ptr<EditArguments>;

void check_output(const EditArguments& options) {
  refuse_same_files({options.out}, options.files);
  if (!options.force) refuse_to_replace({options.out}, "--force replaces it");
  check_writable(options.out);
}

void tell_lost(const std::string& file, const std::vector<mcap::Damage>& damage) {
  for (const mcap::Damage& part : damage) {
    std::string when;
    if (part.after_ns > 0) when += format(" after %.3f s", 1e-9 * static_cast<double>(part.after_ns));
    if (part.before_ns > 0) when += format(" before %.3f s", 1e-9 * static_cast<double>(part.before_ns));
    std::fprintf(stderr, "warning: %s: lost at byte %llu,%s: %s\n", file.c_str(), static_cast<unsigned long long>(part.at),
                 when.empty() ? " at no known time" : when.c_str(), part.why.c_str());
  }
}

void tell_written(const EditArguments& options, const EditReport& report) {
  tell_lost(options.files[0], report.damage);
  std::printf("%s: written, %llu messages\n", options.out.c_str(), static_cast<unsigned long long>(report.kept));
}

void cut(const EditArguments& options) {
  check_output(options);
  const EditReport report = cut_recording(options.files[0], span_of(options.from_s, options.to_s), options.out);
  tell_written(options, report);
  if (options.from_s) std::printf("a cut with a begin of its own is for viewers and exports: mdat replay needs the run's begin\n");
}

void recover(const EditArguments& options) {
  check_output(options);
  const EditReport report = recover_recording(options.files[0], options.out);
  tell_written(options, report);
  if (report.damage.empty()) std::printf("nothing is damaged\n");
}

void merge(const EditArguments& options) {
  check_output(options);
  if (options.prefixes.size() != 2) throw InputError("--prefix: expected two names, such as a,b");
  const MergeOptions merge{{options.prefixes[0], options.prefixes[1]}, options.keep_times, options.different_targets};
  const EditReport report = merge_recordings({options.files[0], options.files[1]}, merge, options.out);
  tell_written(options, report);
  std::printf("topics and frames of %s begin with %s, those of %s with %s; its times moved by %.6f s\n", options.files[0].c_str(),
              options.prefixes[0].c_str(), options.files[1].c_str(), options.prefixes[1].c_str(),
              1e-9 * static_cast<double>(report.shift_ns));
}

using ManyExport = ExportedFiles (*)(const std::filesystem::path&, const ExportOptions&);
using OneExport = std::string (*)(const std::filesystem::path&, const ExportOptions&);

struct ExportFormat {
  const char* name;
  ManyExport many;  // into a folder
  OneExport one;    // as one file
};
constexpr ExportFormat kExportFormats[] = {{"scans", export_scans, nullptr},    {"csv", export_csv, nullptr}, {"tum", export_tum, nullptr},
                                           {"ply", export_ply, nullptr},        {"pcd", export_pcd, nullptr}, {"glb", nullptr, export_glb},
                                           {"hdf5", nullptr, export_h5},        {"oem", nullptr, export_oem}, {"aem", nullptr, export_aem},
                                           {"packets", nullptr, export_packets}};

constexpr char kBagFormat[] = "rosbag2";  // a folder whose messages may be more than memory holds

std::vector<std::string> format_names() {
  std::vector<std::string> names = {kBagFormat};
  for (const ExportFormat& format : kExportFormats) names.emplace_back(format.name);
  return names;
}

// Files of an earlier export that this one does not have: who reads the folder would read them, too.
void remove_earlier(const EditArguments& options, const ExportedFiles& exported) {
  std::set<std::string> folders;
  for (const auto& [name, content] : exported.files) folders.insert(std::filesystem::path(name).parent_path());
  for (const std::string& folder : folders) {
    const std::filesystem::path place = std::filesystem::path(options.out) / folder;
    std::error_code none;
    for (const auto& entry : std::filesystem::directory_iterator(place, none)) {
      const bool kind = entry.path().extension() == std::filesystem::path(exported.files.begin()->first).extension();
      if (!kind || entry.is_directory()) continue;
      if (!options.force) throw InputError(entry.path().string() + ": is there already: --force replaces all files of its kind");
      std::filesystem::remove(entry.path());
    }
  }
}

void write_folder(const EditArguments& options, const ExportedFiles& exported) {
  remove_earlier(options, exported);
  std::map<std::string, std::unique_ptr<OutputFolder>> folders;
  for (const auto& [name, content] : exported.files) {
    const std::filesystem::path place = std::filesystem::path(options.out) / name;
    std::unique_ptr<OutputFolder>& folder = folders[place.parent_path()];
    if (!folder) folder = std::make_unique<OutputFolder>(place.parent_path());
    folder->write(place.filename(), content);
  }
  for (const auto& [name, folder] : folders) folder->commit();
  for (const std::string& note : exported.notes) std::fprintf(stderr, "note: %s\n", note.c_str());
  std::printf("%s: written, %zu files\n", options.out.c_str(), exported.files.size());
}

void write_bag(const EditArguments& options, const ExportOptions& what) {
  if (!options.topic.empty()) throw InputError("--topic " + options.topic + ": a bag has all topics: leave it out");
  if (!options.force) refuse_to_replace({std::filesystem::path(options.out) / "metadata.yaml"}, "--force replaces that bag");
  export_bag(options.files[0], what, options.out);
  std::printf("%s: written: ros2 bag info %s\n", options.out.c_str(), options.out.c_str());
}

void export_to(const EditArguments& options) {
  const ExportOptions what{options.topic, span_of(options.from_s, options.to_s), options.epoch};
  if (options.format == kBagFormat) return write_bag(options, what);
  for (const ExportFormat& format : kExportFormats) {
    if (options.format != format.name) continue;
    if (format.many != nullptr) return write_folder(options, format.many(options.files[0], what));
    check_output(options);
    write_file(options.out, format.one(options.files[0], what));
    std::printf("%s: written\n", options.out.c_str());
  }
}

SharedEdit add_edit(CLI::App* command, int files) {
  const auto options = std::make_shared<EditArguments>();
  command->add_option(files == 1 ? "FILE" : "FILES", options->files, files == 1 ? "recording (.mcap), of any program" : "two recordings")
      ->required()
      ->expected(files);
  command->add_option("-o,--out", options->out, "what to write")->required();
  command->add_flag("--force", options->force, "replace what is there");
  return options;
}

void add_span(CLI::App* command, const SharedEdit& options) {
  command->add_option("--from", options->from_s, "first second, of the recording's own times");
  command->add_option("--to", options->to_s, "second before which it ends");
}

void add_export(CLI::App* group) {
  CLI::App* command = group->add_subcommand("export", "a recording in the files of other programs");
  const SharedEdit options = add_edit(command, 1);
  add_span(command, options);
  command
      ->add_option("--format", options->format,
                   "scans (CSV and poses, for mdat replay --scans), csv (a table a topic), tum (trajectories, for evo), ply or pcd (a file "
                   "a scan, all fields), glb (first scan of the span, with "
                   "the target), hdf5, oem, aem (CCSDS ephemerides), packets (CCSDS, for mdat decode), rosbag2 (a folder with "
                   "metadata.yaml, for ros2 bag)")
      ->required()
      ->check(CLI::IsMember(format_names()));
  command->add_option("--topic", options->topic, "which one, where there are several");
  command->add_option("--epoch", options->epoch, "of the recording's second 0, in oem and aem")->capture_default_str();
  command->callback([options] { export_to(*options); });
}

}  // namespace

void add_recording_edits(CLI::App* group) {
  CLI::App* span = group->add_subcommand("cut", "a span of a recording");
  const SharedEdit cut_options = add_edit(span, 1);
  add_span(span, cut_options);
  span->callback([cut_options] { cut(*cut_options); });
  CLI::App* whole = group->add_subcommand("recover", "what is whole of a damaged recording, and what was lost");
  const SharedEdit recover_options = add_edit(whole, 1);
  whole->callback([recover_options] { recover(*recover_options); });
  CLI::App* both = group->add_subcommand("merge", "two recordings in one, to be seen one over the other");
  const SharedEdit merge_options = add_edit(both, 2);
  both->add_option("--prefix", merge_options->prefixes, "of the topics and frames of each")
      ->delimiter(',')
      ->expected(2)
      ->capture_default_str();
  both->add_flag("--keep-times", merge_options->keep_times, "otherwise the second one begins when the first does");
  both->add_flag("--different-targets", merge_options->different_targets, "merge runs of two targets");
  both->callback([merge_options] { merge(*merge_options); });
  add_export(group);
}

}  // namespace lasso::mdat
