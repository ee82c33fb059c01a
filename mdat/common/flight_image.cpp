#include "mdat/common/flight_image.hpp"

#include <bit>
#include <cmath>
#include <cstring>
#include <fstream>
#include <utility>

#include "mdat/common/errors.hpp"
#include "mdat/common/output.hpp"
#include "mdat/missiondb/named_pairs.hpp"
#include "mdat/missiondb/scene_surfaces.hpp"
#include "mdat/modelc/image_writer.hpp"

namespace lasso::mdat {

namespace {

// Relative to the part, how far beyond it the far field reaches: the rest of the target lies there.
constexpr double kPartMargin = 0.1;

// A part is looked at from a track's prediction alone: its gate need not reach as far as that of a start, and must not, as the rest of the
// target lies close by.
constexpr double kPartGate = 0.2;

// A part's surface ends where it was cut: that is no contour, and what lies beyond is the target's. Scans of a part speak by their hits.
MissionParameters part_parameters(MissionParameters parameters) {
  parameters.silhouettes = 0;
  parameters.aimed_share = 0;
  parameters.wide_start = 0;
  parameters.gate_first_m *= kPartGate;
  return parameters;
}

// A solid that is cut shows its inside, which no ray will ever see: what is cut from a mesh that faces outwards does so, too.
bool is_oriented(const PartSource& part, const CompileReport& target) {
  return part.file.empty() && target.flipped_triangles == 0 && target.two_sided_triangles == 0;
}

CompiledPart compile_part(const CompiledMission& mission, const PartSource& part, ModelCache& cache, std::vector<std::string>& warnings) {
  const MissionSource& source = mission.source;
  ModelOptions options;
  options.cell_size_m = part.cell_size_m;
  options.crease_angle_deg = source.target.crease_angle_rad / kRadPerDeg;
  options.far_margin = kPartMargin;
  options.oriented = is_oriented(part, mission.report);
  const Mesh mesh = load_part(source, part, mission.mesh, &warnings);
  CompiledPart result;
  try {
    result.tables = cache.compile(mesh, options, result.report);
  } catch (const CompileError& error) {
    throw InputError(source.file.string() + ": part." + part.name + ": " + error.what());
  }
  return result;
}

void append_value(double value, std::vector<std::uint32_t>& words) {
  const auto bits = std::bit_cast<std::uint64_t>(value);
  words.push_back(static_cast<std::uint32_t>(bits >> 32));
  words.push_back(static_cast<std::uint32_t>(bits));
}

void append_part(const PartSource& part, std::vector<std::uint32_t>& words) {
  for (const auto* list : {&part.quaternion, &part.origin_m, &part.range_m, &part.view}) {
    for (const double value : *list) append_value(value, words);
  }
  append_value(std::cos(part.cone_rad), words);
  append_value(part.priority, words);
}

void append_sensor(const SensorParameters& sensor, std::vector<std::uint32_t>& words) {
  for (const ParameterRow& row : sensor_rows()) append_value(sensor.*sensor_member(row), words);
}

void append_calibration(std::uint8_t sensor, const TriangulationCalibration& calibration, std::vector<std::uint32_t>& words) {
  words.push_back(sensor);
  words.push_back(calibration.serial);
  for (const CalibrationReal& real : kCalibrationReals) append_value(calibration.*real.member, words);
  for (const double term : calibration.residual) append_value(term, words);
}

void append_named_frame(const NamedFrame& frame, std::vector<std::uint32_t>& words) {
  for (const Pose* pose : {&frame.T_target_of, &frame.T_in_sensor}) {
    for (const double term : {pose->q.x(), pose->q.y(), pose->q.z(), pose->q.w(), pose->p.x(), pose->p.y(), pose->p.z()})
      append_value(term, words);
  }
}

// Bytes as words of the image, filled up to a multiple of 8.
void append_bytes(std::vector<std::uint8_t> bytes, std::vector<std::uint32_t>& words) {
  bytes.resize((bytes.size() + 7) / 8 * 8);
  for (std::size_t i = 0; i < bytes.size(); i += 4) {
    words.push_back(static_cast<std::uint32_t>(bytes[i]) << 24 | static_cast<std::uint32_t>(bytes[i + 1]) << 16 |
                    static_cast<std::uint32_t>(bytes[i + 2]) << 8 | bytes[i + 3]);
  }
}

ModelTables with_parts_and_sensors(const CompiledMission& mission, const MissionParameters& parameters) {
  ModelTables tables = mission.tables;
  for (const FurtherSensor& sensor : mission.source.further_sensors) append_sensor(sensor.parameters, tables[TableId::kSensors]);
  for (const auto& [sensor, calibrations] : mission.source.calibrations) {
    for (const TriangulationCalibration& calibration : calibrations)
      append_calibration(sensor, calibration, tables[TableId::kCalibrations]);
  }
  for (const NamedPair& pair : named_pairs(mission.source.scene)) append_named_frame(pair.frame, tables[TableId::kNamedFrames]);
  for (std::size_t i = 0; i < mission.parts.size(); ++i) {
    const std::vector<std::uint8_t> bytes =
        write_image(mission.source.id, mission.source.version, part_parameters(parameters), mission.parts[i].tables);
    append_part(mission.source.parts[i], tables[TableId::kParts]);
    tables[TableId::kParts].push_back(static_cast<std::uint32_t>(4 * tables[TableId::kPartImages].size()));
    tables[TableId::kParts].push_back(static_cast<std::uint32_t>(bytes.size()));
    append_bytes(bytes, tables[TableId::kPartImages]);
  }
  return tables;
}

}  // namespace

MissionInput load_mission_input(const std::filesystem::path& file, const std::vector<std::string>& settings, const std::string& scenario) {
  MissionInput input;
  input.source = load_mission(file, settings);
  check_settings(input.source, scenario);
  input.mesh = load_target(input.source, &input.source.warnings);
  check_target(input.source, input.mesh);
  load_scene(input.source, input.mesh);
  return input;
}

CompiledMission compile_mission(MissionInput input, ModelCache cache) {
  CompiledMission result{std::move(input), {}, {}, {}};
  ModelOptions options;
  options.cell_size_m = result.source.target.cell_size_m;
  options.crease_angle_deg = result.source.target.crease_angle_rad / kRadPerDeg;
  try {
    result.tables = cache.compile(result.mesh, options, result.report);
  } catch (const CompileError& error) {
    throw InputError(result.source.target.file.string() + ": " + error.what());
  }
  for (const PartSource& part : result.source.parts) result.parts.push_back(compile_part(result, part, cache, result.source.warnings));
  result.cached = cache.found();
  if (!cache.warning().empty()) result.source.warnings.push_back(cache.warning());
  return result;
}

CompiledMission compile_mission(const std::filesystem::path& file, ModelCache cache) {
  return compile_mission(load_mission_input(file), std::move(cache));
}

std::vector<std::uint8_t> image_bytes(const CompiledMission& mission, const MissionParameters& parameters) {
  try {
    return write_image(mission.source.id, mission.source.version, parameters, with_parts_and_sensors(mission, parameters));
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

bool has_signature(const std::vector<std::uint8_t>& image) {
  constexpr std::size_t kLengthWord = 8;  // bytes before the image's own length
  if (image.size() < kLengthWord + 4) return false;
  std::size_t length = 0;
  for (std::size_t i = 0; i < 4; ++i) length = length << 8U | image[kLengthWord + i];
  return image.size() == length + kImageSignatureBytes;
}

std::vector<std::uint8_t> without_signature(const std::vector<std::uint8_t>& image) {
  return {image.begin(), image.end() - static_cast<std::ptrdiff_t>(has_signature(image) ? kImageSignatureBytes : 0)};
}

LoadedImage::LoadedImage(const std::string& name, const std::vector<std::uint8_t>& bytes) : memory_(aligned_copy(bytes)) {
  const std::size_t size = bytes.size() - (has_signature(bytes) ? kImageSignatureBytes : 0);
  const LoadFailure failure = load_image(view(memory_, size), mission_, parts_);
  if (failure.status != Status::kOk) throw InputError(name + ": not a valid flight image: " + to_string(failure));
}

bool is_image_file(const std::filesystem::path& file) { return file.extension() == ".3dli" || is_image(file); }

bool is_image(const std::filesystem::path& file) {
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
