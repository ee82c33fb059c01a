#include <algorithm>
#include <cstdio>
#include <iterator>
#include <memory>
#include <optional>
#include <utility>

#include "mdat/bodies/body.hpp"
#include "mdat/cli/commands.hpp"
#include "mdat/common/errors.hpp"
#include "mdat/common/flight_image.hpp"
#include "mdat/common/output.hpp"
#include "mdat/link/signature.hpp"
#include "mdat/missiondb/mission_schema.hpp"
#include "mdat/missiondb/mission_text.hpp"
#include "mdat/missiondb/new_mission.hpp"

namespace lasso::mdat {
namespace {

struct MissionOptions {
  std::string file, scenario, out, model, kind, sensor, key;
  std::optional<std::uint64_t> seed;  // of a target that is generated
  std::vector<std::string> settings;
  double scale = 1;
  std::string simplify;
  std::size_t triangles = 0;  // of the coarser mesh
  bool replace = false, cached = true;
};

void print_text(const std::string& text) { std::fputs(text.c_str(), stdout); }

std::string parts_text(const LoadedImage& image) {
  std::string text;
  for (const Part& part : image.parts()) {
    char line[240];
    std::snprintf(line, sizeof line, "part %td: origin at %.4g, %.4g, %.4g m, serves from %.4g m to %.4g m, priority %.4g, radius %.3f m\n",
                  &part - image.parts().begin() + 1, part.T_target_part.p.x(), part.T_target_part.p.y(), part.T_target_part.p.z(),
                  part.range_min_m, part.range_max_m, part.priority, part.mission.radius_m);
    text += line;
  }
  return text;
}

std::string sensors_text(const LoadedImage& image) {
  std::string text;
  const auto& sensors = image.mission().sensors;
  for (std::size_t i = 0; i < sensors.size() && sensors.size() > 1; ++i) {
    const SensorParameters& s = sensors[i];
    char line[240];
    std::snprintf(line, sizeof line, "sensor %zu: used from %.4g m to %.4g m, measures %.4g m to %.4g m, field of +-%.4g x %.4g deg\n", i,
                  s.use_from_m, s.use_to_m, s.range_min_m, s.range_max_m, s.fov_half_x_rad / kRadPerDeg, s.fov_half_y_rad / kRadPerDeg);
    text += line;
  }
  return text;
}

// Throws InputError where the key is given, and has not signed the image.
std::string signature_text(const std::string& file, const std::vector<std::uint8_t>& image, const std::string& key) {
  if (!key.empty() && !is_signed_by(image, load_master_key(key)))
    throw InputError(file + (has_signature(image) ? ": its signature is not that of " : ": is not signed with ") + key +
                     "; mdat mission sign " + file + " --key " + key + " signs it");
  if (!has_signature(image)) return "";
  return key.empty() ? "signed; --key FILE says whether with that key\n" : "signed with " + key + "\n";
}

std::string image_text(const std::string& file, const std::string& key = "") {
  const std::vector<std::uint8_t> bytes = read_bytes(file);
  const LoadedImage image(file, bytes);
  const Mission& mission = image.mission();
  char text[400];
  std::snprintf(
      text, sizeof text,
      "%s: flight image, mission %u version %u, %zu bytes, CRC-32C %08X, radius %.3f m, %zu edges, %zu hull points; for the search: "
      "%zu views, %zu near-symmetries, distances on %u x %u x %u cells\n",
      file.c_str(), mission.id, mission.version, bytes.size(), mission.image_crc, mission.radius_m, mission.edges.size(),
      mission.hull.size(), mission.search.views.size(), mission.search.symmetries.size(), mission.search.cells[0], mission.search.cells[1],
      mission.search.cells[2]);
  return text + sensors_text(image) + parts_text(image) + signature_text(file, bytes, key);
}

std::string parameters_text(const std::string& file) {
  const LoadedImage image(file, read_bytes(file));
  std::string text;
  for (const ParameterRow& row : parameter_rows()) {
    char line[240];
    std::snprintf(line, sizeof line, "%-42s %-14.9g %-7s %s\n", row.key, image.mission().parameters.*row.member / row.to_si, row.unit,
                  row.meaning);
    text += line;
  }
  return text;
}

void check(const MissionOptions& options) {
  if (is_image_file(options.file)) return print_text(image_text(options.file, options.key));
  if (!options.key.empty()) throw InputError("--key " + options.key + ": of a flight image (.3dli); a mission file is not signed");
  const MissionInput input = load_mission_input(options.file);
  print_text(check_text(input.source, input.mesh));
}

void info(const MissionOptions& options) {
  if (is_image_file(options.file)) {
    print_text(image_text(options.file) + parameters_text(options.file));
  } else {
    print_text(info_text(load_mission(options.file), options.scenario));
  }
}

std::string parts_text(const CompiledMission& mission) {
  std::string text;
  for (std::size_t i = 0; i < mission.parts.size(); ++i) {
    const CompileReport& r = mission.parts[i].report;
    text += "part " + std::to_string(i + 1) + ", " + mission.source.parts[i].name + ": " + std::to_string(r.elements) + " elements\n";
  }
  return text;
}

// Empty where all were compiled.
std::string cache_text(const CompiledMission& mission, const ModelCache& cache) {
  if (mission.cached == 0) return "";
  return std::to_string(mission.cached) + " of " + std::to_string(1 + mission.parts.size()) + " models came from the cache, " +
         cache.folder().string() + ", with what was said of them then; --no-cache compiles them anew\n";
}

std::string report_text(const CompiledMission& mission, const std::string& out, std::size_t bytes) {
  const CompileReport& r = mission.report;
  char text[900];
  std::snprintf(
      text, sizeof text,
      "mesh: %zu vertices, %zu triangles, %zu parts (%zu open)\n"
      "repaired: %zu vertices welded, %zu degenerate and %zu double triangles dropped, %zu triangles turned outwards, %zu seen from both "
      "sides\n"
      "model: %zu elements (%zu curved), %zu edges, cells of %.4g m with %.1f elements on average, %zu at most\n"
      "search: %zu views, %zu near-symmetries\n"
      "%s: %zu bytes, compiled in %.1f s\n",
      r.vertices, r.triangles, r.components, r.open_components, r.welded_vertices, r.dropped_degenerate, r.dropped_duplicates,
      r.flipped_triangles, r.two_sided_triangles, r.elements, r.curved_elements, r.edges, r.cell_size_m, r.ray_lists.mean, r.ray_lists.max,
      r.views, r.symmetries, out.c_str(), bytes, r.seconds);
  return parts_text(mission) + text;
}

std::string_view content(const std::vector<std::uint8_t>& bytes) { return {reinterpret_cast<const char*>(bytes.data()), bytes.size()}; }

// In its place, unless another one is named: what was signed before is signed anew.
void sign(const MissionOptions& options) {
  const std::string out = options.out.empty() ? options.file : options.out;
  refuse_same_files({out}, {options.key});
  if (out != options.file && !options.replace) refuse_to_replace({out}, "--force replaces it");
  const std::vector<std::uint8_t> image = read_bytes(options.file);
  const LoadedImage loads_in_flight(options.file, image);
  const std::vector<std::uint8_t> bytes = sign_image(image, load_master_key(options.key));
  write_file(out, content(bytes));
  std::printf("%s: image %08x, %zu bytes and a signature of %zu\n", out.c_str(), loads_in_flight.mission().image_crc,
              bytes.size() - kImageSignatureBytes, kImageSignatureBytes);
}

// An image is made from its mission again at any time: it is replaced, and that is told. Another file is kept. Throws InputError.
std::string replaced_text(const std::filesystem::path& out, const MissionOptions& options) {
  std::error_code ignored;
  if (!std::filesystem::exists(out, ignored)) return "";
  if (!options.replace && !is_image(out)) refuse_to_replace({out}, "it is no flight image; --force replaces it");
  return "the file that was there is replaced\n";
}

void compile(const MissionOptions& options) {
  const std::filesystem::path out =
      options.out.empty() ? std::filesystem::path(options.file).filename().replace_extension(".3dli") : std::filesystem::path(options.out);
  check_writable(out);
  const std::string replaced = replaced_text(out, options);
  std::optional<Key> key;
  if (!options.key.empty()) key = load_master_key(options.key);
  MissionInput input = load_mission_input(options.file, options.settings, options.scenario);
  tell_idle_settings(input.source, options.scenario);
  const MissionParameters parameters = parameters_for(input.source, options.scenario);
  const ModelCache cache = ModelCache::of_user_if(options.cached);
  const CompiledMission mission = compile_mission(std::move(input), cache);
  for (const std::string& warning : warnings_for(mission.source, options.scenario)) std::fprintf(stderr, "warning: %s\n", warning.c_str());
  std::vector<std::uint8_t> bytes = image_bytes(mission, parameters);
  if (key) bytes = sign_image(bytes, *key);
  const LoadedImage loads_in_flight(out.string(), bytes);
  write_file(out, content(bytes));
  print_text(report_text(mission, out.string(), bytes.size()) + replaced + cache_text(mission, cache));
}

// Empty for a good number, and for none: what stands for it depends on the command line's library.
std::string check_triangles(const std::string& text) {
  if (text.empty() || text == "true") return "";
  const bool number = text.size() <= 6 && text.find_first_not_of("0123456789") == std::string::npos;
  const unsigned long value = number ? std::stoul(text) : 0;
  return value >= 4 && value <= 500000 ? "" : "--simplify: " + text + ": expected a number of triangles from 4 to 500000, or none";
}

std::string next_steps(const std::string& mission) {
  const std::string folder = std::filesystem::path(mission).stem().string() + "_run";
  return "next:\n  mdat mission check " + mission + "\n  mdat run " + mission + " --scenario spin --out " + folder +
         "      # or paper, search, approach; the report is " + folder + "/report.html\n";
}

// Beside the mission, by its name.
std::filesystem::path generated_model(const std::filesystem::path& mission) {
  return mission.parent_path() / (mission.stem().string() + "_model.toml");
}

// The target of the seed, and a few lines on it.
std::string generate(std::uint64_t seed, const MissionOptions& options, NewMissionRequest& request) {
  const Body body = make_body(seed, body_kind_of(options.kind));
  const BodyTruth truth = truth_of(body);
  request.model = generated_model(options.out);
  request.model_text = commented_model_text(body, truth);
  std::string text = request.model.string() + ": written\n";
  for (const std::string& line : body_lines(body, truth)) text += "  " + line + '\n';
  return text;
}

std::optional<SensorKind> sensor_of(const std::string& name) {
  if (name.empty()) return std::nullopt;
  const auto found = std::find(std::begin(kSensorKindNames), std::end(kSensorKindNames), name);
  return static_cast<SensorKind>(found - std::begin(kSensorKindNames));
}

// Throws InputError: neither of the two that a mission can begin with, or both.
void check_target_of(const MissionOptions& options) {
  if (options.seed.has_value() == !options.model.empty())
    throw InputError("mission new: expected one of --model FILE, your target, and --generate SEED, a target made from a number");
  if (options.out.empty() && !options.seed) throw InputError("mission new: expected --out MISSION.toml, the mission to write");
  if (!options.kind.empty() && !options.seed) throw InputError("--kind " + options.kind + ": of a generated target; add --generate SEED");
}

void write_new(const MissionOptions& given) {
  MissionOptions options = given;
  check_target_of(options);
  if (options.out.empty()) options.out = "body_" + std::to_string(options.seed.value_or(0)) + ".toml";
  if (!options.replace) refuse_to_replace({options.out}, "--force replaces it");
  check_writable(options.out);
  ModelCache cache = ModelCache::of_user_if(options.cached);
  NewMissionRequest request;
  request.model = options.model;
  request.out = options.out;
  request.sensor = sensor_of(options.sensor);
  const std::string generated = options.seed ? generate(*options.seed, options, request) : "";
  request.scale = options.scale;
  request.simplify = options.triangles;
  request.replace = options.replace;
  request.compile = [&](const Mesh& mesh, const ModelOptions& model, CompileReport& report) { return cache.compile(mesh, model, report); };
  std::string text = generated + options.out + ": written\n";
  for (const std::string& remark : write_new_mission(request)) text += "  " + remark + '\n';
  print_text(text + next_steps(options.out));
}

CLI::App* add(CLI::App& parent, const char* name, const char* meaning, void (*action)(const MissionOptions&),
              const std::shared_ptr<MissionOptions>& options) {
  CLI::App* command = parent.add_subcommand(name, meaning);
  command->callback([action, options] { action(*options); });
  return command;
}

void add_new_command(CLI::App& mission, const std::shared_ptr<MissionOptions>& options) {
  CLI::App* command = add(mission, "new", "write a commented mission for any mesh, ready to compile", write_new, options);
  command->add_option("--model", options->model, "mesh (STL, OBJ, PLY, glTF) or parametric model (.toml)");
  command
      ->add_option("--generate", options->seed, "make a target instead, and its model beside the mission: the same number, the same target")
      ->type_name("SEED")
      ->check(number_between(0.0, 4294967295.0));
  command->add_option("--kind", options->kind, "of the target that is made; otherwise the seed says it")
      ->check(CLI::IsMember(body_kind_names()));
  command
      ->add_option("--sensor", options->sensor,
                   "otherwise guessed from the target's size; for stereo cameras begin with a copy of hubble_stereo.toml")
      ->check(CLI::IsMember({"laser_camera", "time_of_flight", "flash_lidar"}));
  command->add_option("--scale", options->scale, "the file's lengths times this are metres")
      ->capture_default_str()
      ->check(number_between(1e-6, 1e6));
  command->add_option("-o,--out", options->out, "mission to write (of a target that is made: body_SEED.toml, here)");
  CLI::Option* simplify =
      command
          ->add_option(
              "--simplify", options->simplify,
              "first make a coarser mesh of so many triangles, beside the mission; without a number a quarter of them, at most 20000")
          ->expected(0, 1)
          ->check(CLI::Validator(check_triangles, ""));
  command->callback([options, simplify] {
    if (simplify->count() > 0)
      options->triangles = options->simplify.empty() || options->simplify == "true" ? kSimplifyChosen : std::stoul(options->simplify);
    write_new(*options);
  });
  add_no_cache(*command, options->cached);
  command->add_flag("--force", options->replace, "replace a file that is there");
}

}  // namespace

void add_mission_commands(CLI::App& app) {
  const auto options = std::make_shared<MissionOptions>();
  CLI::App* mission = app.add_subcommand("mission", "check, compile, show, change or begin a mission");
  mission->require_subcommand(1);

  CLI::App* check_command = add(*mission, "check", "check a mission (.toml) and its target, or a flight image (.3dli)", check, options);
  check_command->add_option("MISSION", options->file, "mission file or flight image")->required();
  check_command->add_option("--key", options->key, "is the image signed with the master key in this file?");

  CLI::App* compile_command = add(*mission, "compile", "make the flight image of a mission", compile, options);
  compile_command->add_option("MISSION", options->file, "mission file")->required();
  compile_command->add_option("-o,--out", options->out, "flight image to write (the mission's name with .3dli, here)");
  compile_command->add_option("--scenario", options->scenario, "with this scenario's overrides of parameters");
  add_settings(*compile_command, options->settings);
  compile_command->add_flag("--force", options->replace, "replace a file that is there and is no flight image");
  compile_command->add_option("--key", options->key, "sign it with the master key in this file (64 hexadecimal digits)");
  add_no_cache(*compile_command, options->cached);

  CLI::App* sign_command = add(*mission, "sign", "sign a flight image, as a component with a key asks for", sign, options);
  sign_command->add_option("IMAGE", options->file, "flight image (mdat mission compile)")->required();
  sign_command->add_option("--key", options->key, "file with the master key (64 hexadecimal digits)")->required();
  sign_command->add_option("-o,--out", options->out, "signed image to write (in its place)");
  sign_command->add_flag("--force", options->replace, "replace another file that is there");

  CLI::App* info_command =
      add(*mission, "info", "print every value of a mission or a flight image, its unit, meaning and origin", info, options);
  info_command->add_option("MISSION", options->file, "mission file or flight image")->required();
  info_command->add_option("--scenario", options->scenario, "with this scenario's overrides of parameters");
  add(
      *mission, "schema", "print the JSON Schema of missions, by which editors check keys and values",
      [](const MissionOptions&) { print_text(mission_schema_text()); }, options);
  add_new_command(*mission, options);
  add_mission_edits(*mission);
}

}  // namespace lasso::mdat
