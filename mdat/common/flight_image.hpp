// From a mission's source to the bytes that the flight component loads, and back.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "fsw/geometry/portable_math.hpp"
#include "fsw/mission/mission.hpp"
#include "mdat/common/model_cache.hpp"
#include "mdat/missiondb/mission_source.hpp"
#include "mdat/modelc/model.hpp"

namespace lasso::mdat {

struct CompiledPart {
  ModelTables tables;
  CompileReport report;
};

// All that a mission says, and its target as it stands: what can be wrong with either is known before anything is compiled.
struct MissionInput {
  MissionSource source;
  Mesh mesh;
};

// `settings` and `scenario` as those of load_mission and check_settings. Throws MissionError.
MissionInput load_mission_input(const std::filesystem::path& file, const std::vector<std::string>& settings = {},
                                const std::string& scenario = "");

// A mission whose target is compiled; images for different parameters follow from it in no time.
struct CompiledMission : MissionInput {
  ModelTables tables;
  CompileReport report;
  std::vector<CompiledPart> parts;  // of source.parts
  std::size_t cached = 0;           // of these models, how many came from the cache
};

// Throws MissionError, or InputError where the target does not fit the flight component. A model that could not be kept is one of the
// source's warnings.
CompiledMission compile_mission(MissionInput input, ModelCache cache = ModelCache::of_user());
CompiledMission compile_mission(const std::filesystem::path& file, ModelCache cache = ModelCache::of_user());
std::vector<std::uint8_t> image_bytes(const CompiledMission& mission, const MissionParameters& parameters);

// Behind the last byte of a signed image (mdat/link/signature.hpp).
constexpr std::size_t kImageSignatureBytes = 32;
bool has_signature(const std::vector<std::uint8_t>& image);
std::vector<std::uint8_t> without_signature(const std::vector<std::uint8_t>& image);

// The memory of one image, aligned as the loader wants it, and the mission in it.
class LoadedImage {
 public:
  // Of an image with or without signature. Throws InputError that names `name` and what the loader refused.
  LoadedImage(const std::string& name, const std::vector<std::uint8_t>& bytes);
  const Mission& mission() const { return mission_; }
  const Parts& parts() const { return parts_; }

 private:
  std::vector<std::uint64_t> memory_;
  Mission mission_;
  Parts parts_;
};

// A copy of the image in 8-byte aligned memory, and a view of it.
std::vector<std::uint64_t> aligned_copy(const std::vector<std::uint8_t>& bytes);
Bytes view(std::vector<std::uint64_t>& memory, std::size_t size);

std::string to_string(const LoadFailure& failure);

// Is this file meant to be a flight image (by its first bytes, or its name .3dli) and not a mission source?
bool is_image_file(const std::filesystem::path& file);
// By its first bytes alone.
bool is_image(const std::filesystem::path& file);
std::vector<std::uint8_t> read_bytes(const std::filesystem::path& file);

}  // namespace lasso::mdat
