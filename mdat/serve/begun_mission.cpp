#include "mdat/serve/begun_mission.hpp"

#include <system_error>

#include "mdat/common/errors.hpp"
#include "mdat/common/model_cache.hpp"
#include "mdat/common/output.hpp"
#include "mdat/common/text.hpp"
#include "mdat/missiondb/new_mission.hpp"
#include "mdat/missiondb/value_row.hpp"
#include "mdat/serve/http.hpp"
#include "mdat/serve/new_folder.hpp"
#include "mdat/serve/problem_words.hpp"
#include "mdat/source/mission_error.hpp"

namespace lasso::mdat::serve {
namespace {

namespace fs = std::filesystem;

// The file's name as it is kept: with an underscore for each sign that is not plain.
std::string kept_name(const std::string& file) {
  constexpr std::size_t kLongest = 80;
  const fs::path name = fs::path(file).filename();
  std::string stem = name.stem().string().substr(0, kLongest), ending = name.extension().string();
  for (char& c : stem) c = std::string_view(kPlainSigns).find(c) == std::string_view::npos ? '_' : c;
  const bool plain = ending.size() > 1 && ending.size() <= 8 && ending.find_first_not_of(kPlainSigns, 1) == std::string::npos;
  if (stem.empty() || !plain) throw Refusal{400, "the file has no name with an ending", "send a mesh: .stl, .obj, .ply, .gltf or .glb"};
  // A parametric model is no mission, and must not take its name.
  return stem + (ending == ".toml" ? "_model" : "") + ending;
}

std::string mesh_words(const MissionError& error) {
  std::string words;
  for (const Problem& problem : error.problems()) words += (words.empty() ? "" : "; ") + problem_words(problem);
  return words;
}

NewMissionRequest mesh_request(const fs::path& folder, const MeshOrder& order, ModelCache& cache) {
  NewMissionRequest request;
  request.model = folder / kept_name(order.file);
  request.out = folder / (order.name + ".toml");
  request.sensor = order.sensor;
  request.scale = order.scale;
  request.simplify = order.simplify;
  request.compile = [&cache](const Mesh& mesh, const ModelOptions& model, CompileReport& report) {
    return cache.compile(mesh, model, report);
  };
  return request;
}

std::string mesh_command(const NewMissionRequest& request) {
  std::string command = "mdat mission new --model " + shell_word(request.model.string());
  if (request.scale != 1) command += " --scale " + number_text(request.scale);
  if (request.sensor) command += std::string(" --sensor ") + kind_name(*request.sensor);
  if (request.simplify > 0) command += " --simplify";
  if (request.simplify > kSimplifyChosen) command += " " + std::to_string(request.simplify);
  return command + " --out " + shell_word(request.out.string());
}

// Gone again with all that is in it, unless it is kept.
class NewFolder {
 public:
  explicit NewFolder(const fs::path& path) : path_(path) {
    std::error_code error;
    made_ = fs::create_directory(path, error);
    if (error) throw Refusal{409, "the folder cannot be made: " + error.message(), "see whether mdat serve may write into its folder"};
    if (!made_) throw Refusal{409, path.filename().string() + " is there already", "take another name"};
  }
  ~NewFolder() {
    std::error_code ignored;
    if (made_) fs::remove_all(path_, ignored);
  }
  NewFolder(const NewFolder&) = delete;
  NewFolder& operator=(const NewFolder&) = delete;
  void keep() { made_ = false; }

 private:
  fs::path path_;
  bool made_ = false;
};

}  // namespace

BegunMission begin_mission(const Folder& folder, const MeshOrder& order) {
  const fs::path path = new_folder_path(folder, order.name);
  ModelCache cache = ModelCache::of_user();
  const NewMissionRequest request = mesh_request(path, order, cache);
  try {
    NewFolder made(path);
    write_file(request.model, order.bytes);
    BegunMission begun{order.name + "/" + order.name + ".toml", write_new_mission(request), mesh_command(request)};
    made.keep();
    return begun;
  } catch (const MissionError& error) {
    throw Refusal{422, mesh_words(error), "change the scale or the triangles here, or mend the file"};
  } catch (const InputError& error) {
    throw Refusal{409, error.what(), "see whether mdat serve may write into its folder"};
  }
}

}  // namespace lasso::mdat::serve
