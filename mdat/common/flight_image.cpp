#include "mdat/common/flight_image.hpp"

#include <cstring>
#include <fstream>

#include "mdat/common/errors.hpp"
#include "mdat/common/output.hpp"
#include "mdat/modelc/image_writer.hpp"

namespace lasso::mdat {

CompiledMission compile_mission(const std::filesystem::path& file, const std::function<void(const std::string&, double)>& progress) {
  CompiledMission result;
  result.source = load_mission(file);
  result.mesh = load_target(result.source);
  ModelOptions options;
  options.cell_size_m = result.source.target.cell_size_m;
  options.crease_angle_deg = result.source.target.crease_angle_rad / kRadPerDeg;
  try {
    result.tables = compile_model(result.mesh, options, result.report, progress);
  } catch (const CompileError& error) {
    throw InputError(result.source.target.file.string() + ": " + error.what());
  }
  return result;
}

std::vector<std::uint8_t> image_bytes(const CompiledMission& mission, const MissionParameters& parameters) {
  try {
    return write_image(mission.source.id, mission.source.version, parameters, mission.tables);
  } catch (const CompileError& error) {
    throw InputError(mission.source.file.string() + ": " + error.what());
  }
}

std::vector<std::uint64_t> aligned_copy(const std::vector<std::uint8_t>& bytes) {
  std::vector<std::uint64_t> memory(bytes.size() / 8 + 1);
  std::memcpy(memory.data(), bytes.data(), bytes.size());
  return memory;
}

Bytes view(std::vector<std::uint64_t>& memory, std::size_t size) { return {reinterpret_cast<std::uint8_t*>(memory.data()), size}; }

std::string to_string(const LoadFailure& failure) {
  std::string text = std::string(to_string(failure.status)) + ": " + failure.what;
  if (failure.table != 0) text += " (table " + std::to_string(failure.table) + ", record " + std::to_string(failure.record) + ")";
  return text;
}

LoadedImage::LoadedImage(const std::string& name, const std::vector<std::uint8_t>& bytes) : memory_(aligned_copy(bytes)) {
  const LoadFailure failure = load_image(view(memory_, bytes.size()), mission_);
  if (failure.status != Status::kOk) throw InputError(name + ": not a valid flight image: " + to_string(failure));
}

bool is_image_file(const std::filesystem::path& file) {
  if (file.extension() == ".3dli") return true;
  std::ifstream in(file, std::ios::binary);
  char magic[4] = {};
  in.read(magic, 4);
  return in && std::string_view(magic, 4) == "3DLI";
}

std::vector<std::uint8_t> read_bytes(const std::filesystem::path& file) {
  const std::string content = file_content(file);
  return {content.begin(), content.end()};
}

}  // namespace lasso::mdat
