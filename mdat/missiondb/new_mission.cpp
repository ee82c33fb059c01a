#include "mdat/missiondb/new_mission.hpp"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <optional>
#include <utility>

#include "mdat/missiondb/guesses.hpp"
#include "mdat/missiondb/mesh_faults.hpp"
#include "mdat/missiondb/mesh_import.hpp"
#include "mdat/missiondb/mission_writer.hpp"
#include "mdat/missiondb/model_file.hpp"
#include "mdat/missiondb/scenario_writer.hpp"
#include "mdat/missiondb/sections.hpp"
#include "mdat/missiondb/simplify.hpp"
#include "mdat/source/mission_error.hpp"
#include "mdat/source/sha256.hpp"

namespace lasso::mdat {
namespace {

namespace fs = std::filesystem;

// Sizes between the mesh's centre and its file's origin beyond which the target gets an origin of its own: a pose of a far point is poorly
// known where the attitude is.
constexpr double kFarOrigin = 0.8;
constexpr std::size_t kSimplifyMost = 20000;  // triangles: images of some 10 MB
constexpr int kCellTries = 4;
constexpr double kCellShrink = 0.75, kCellGrow = 1.5;  // from one try to the next

[[noreturn]] void refuse(const fs::path& file, const std::string& reason) { throw MissionError({file.string(), 0, 0, "", "", reason}); }

// `remarks` gets what of the file was left out.
Mesh read_model(const NewMissionRequest& request, std::vector<std::string>& remarks) {
  const fs::path& model = request.model;
  const double scale = request.scale;
  const ValueRow& row = *find_row(mission_rows(), "target.scale");
  if (!(scale >= row.minimum && scale <= row.maximum)) {
    throw MissionError({model.string(), 0, 0, "scale", number_text(scale), expectation(row) + " (" + row.meaning + ")"});
  }
  try {
    if (model.extension() != ".toml") {
      std::vector<std::string> left_out;
      Mesh mesh = import_mesh(model, scale, &left_out);
      for (const std::string& what : left_out) remarks.push_back("file: not read: " + what);
      return mesh;
    }
    Mesh mesh = request.model_text.empty() ? build_model(model, {}) : build_model_text(request.model_text, {});
    for (Eigen::Vector3d& v : mesh.vertices) v *= scale;
    check_extent(mesh);
    return mesh;
  } catch (const MeshError& error) {
    refuse(model, error.what());
  }
}

double first_cell_m(double largest_m) {
  const ValueRow& cell = *find_row(mission_rows(), "target.cell_size_m");
  return std::clamp(rounded(sized_preset("estimation.gate_first_m", largest_m) / 0.010 * cell.preset[0]), cell.minimum, cell.maximum);
}

std::size_t coarser_count(std::size_t triangles) { return std::min(kSimplifyMost, std::max<std::size_t>(4, triangles / 4)); }

struct Trial {
  ModelTables tables;
  CompileReport report;
  double cell_m = 0;
};

// The first cell that the compiler takes: smaller ones where too many elements meet in one, larger ones where the field is too large.
Trial compile_for_trial(const NewMissionRequest& request, const Mesh& mesh, double cell_m) {
  Trial trial;
  ModelOptions options;
  options.crease_angle_deg = find_row(mission_rows(), "target.crease_angle_deg")->preset[0];
  double factor = 1;
  for (int left = kCellTries;; --left, cell_m = rounded(factor * cell_m)) {
    trial.cell_m = options.cell_size_m = cell_m;
    try {
      trial.tables = request.compile(mesh, options, trial.report);
      return trial;
    } catch (const CrowdedCellError&) {
      if (left == 0 || factor > 1) throw;
      factor = kCellShrink;
    } catch (const LargeFieldError&) {
      if (left == 0 || factor < 1) throw;
      factor = kCellGrow;
    }
  }
}

Trial trial_of(const NewMissionRequest& request, const Mesh& mesh) {
  try {
    return compile_for_trial(request, mesh, first_cell_m(size_of(mesh).largest_m));
  } catch (const CompileError& error) {
    const std::string why = error.what();
    refuse(request.model, "no cell fits this mesh: " + why.substr(0, why.find(": take ")) + ": make it coarser: --simplify " +
                              std::to_string(coarser_count(mesh.triangles.size())) + " (it has " + std::to_string(mesh.triangles.size()) +
                              " triangles)");
  }
}

Simplified simplified(const NewMissionRequest& request, const Mesh& mesh) {
  try {
    return simplify(mesh, request.simplify == kSimplifyChosen ? coarser_count(mesh.triangles.size()) : request.simplify);
  } catch (const CompileError& error) {
    refuse(request.model, std::string("--simplify: ") + error.what());
  }
}

struct NewFile {
  fs::path file;
  std::string bytes;
  fs::path part() const { return file.string() + ".part"; }
};

void write_part(const NewFile& whole) {
  std::error_code error;
  if (fs::is_directory(whole.file, error)) refuse(whole.file, "cannot be written: it is a folder");
  std::ofstream stream(whole.part(), std::ios::binary);
  stream << whole.bytes;
  stream.close();
  if (!stream) refuse(whole.file, "cannot be written: does the folder exist, and may you write there?");
}

// All of them are complete before the first one replaces what is there: a failure leaves that as it is.
void write_whole(const std::vector<NewFile>& files) {
  try {
    for (const NewFile& whole : files) write_part(whole);
    for (const NewFile& whole : files) {
      std::error_code error;
      fs::rename(whole.part(), whole.file, error);
      if (error) refuse(whole.file, "cannot be written: " + error.message());
    }
  } catch (...) {
    std::error_code error;
    for (const NewFile& whole : files) fs::remove(whole.part(), error);
    throw;
  }
}

std::string path_from(const fs::path& out, const fs::path& model) {
  std::error_code error;
  const fs::path relative = fs::relative(fs::absolute(model), fs::absolute(out).parent_path(), error);
  return (error || relative.empty() ? fs::absolute(model) : relative).generic_string();
}

// About which point the target's frame lies, and what is then its size.
void place(NewMission& mission, const Mesh& mesh) {
  mission.size = size_of(mesh);
  if (mission.size.center.norm() <= kFarOrigin * mission.size.largest_m) return;
  mission.origin_m = mission.size.center;
  mission.size.center.setZero();
}

Mesh moved(Mesh mesh, const Eigen::Vector3d& origin_m) {
  const std::vector<double> written = list_of(origin_m);
  for (Eigen::Vector3d& v : mesh.vertices) v -= Eigen::Vector3d(written.data());
  return mesh;
}

std::string name_of(const NewMissionRequest& request) {
  if (!request.name.empty()) return request.name;
  return (request.model_text.empty() ? request.model : request.out).stem().string();
}

}  // namespace

std::vector<std::string> write_new_mission(const NewMissionRequest& request) {
  NewMission mission;
  Mesh mesh = read_model(request, mission.remarks);
  mission.name = name_of(request);
  mission.sensor = request.sensor;
  mission.scale = request.scale;  // of the file that was given, in what is said
  place(mission, mesh);
  const SurfaceFacts surface = surface_facts(mesh);
  const std::vector<MeshRemark> faults = mesh_remarks(request.model, mesh, request.model.extension() == ".toml");
  std::optional<Simplified> coarser;
  if (request.simplify > 0) coarser = simplified(request, mesh);
  if (coarser) mesh = coarser->mesh;
  mesh = moved(std::move(mesh), mission.origin_m);
  const Trial trial = trial_of(request, mesh);
  mission.cell_size_m = trial.cell_m;
  mission.surface_sigma_m = guessed_surface_sigma_m(mission.size, surface, coarser);
  const std::vector<std::string> guessed = guesses({mission, surface, coarser, part_widths_m(mesh), trial.tables, trial.report});
  mission.remarks.insert(mission.remarks.end(), guessed.begin(), guessed.end());
  for (const MeshRemark& fault : faults) mission.remarks.push_back(fault.text);

  const fs::path simplified_file = request.out.parent_path() / (request.out.stem().string() + "_simplified.stl");
  const bool made = !request.model_text.empty();
  const std::string bytes = coarser ? stl_bytes(coarser->mesh) : made ? request.model_text : read_file(request.model);
  if (coarser && !request.replace && fs::exists(simplified_file)) refuse(simplified_file, "is there already; --force replaces it");
  if (made && !request.replace && fs::exists(request.model)) refuse(request.model, "is there already; --force replaces it");
  mission.path = path_from(request.out, coarser ? simplified_file : request.model);
  mission.sha256 = sha256_of(bytes);
  mission.parametric = !coarser && request.model.extension() == ".toml";
  mission.scale = coarser ? 1 : request.scale;
  std::vector<NewFile> files;
  if (made) files.push_back({request.model, request.model_text});
  if (coarser) files.push_back({simplified_file, bytes});
  files.push_back({request.out, new_mission_text(mission)});
  write_whole(files);
  return mission.remarks;
}

}  // namespace lasso::mdat
