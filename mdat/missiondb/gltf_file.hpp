// The JSON of a glTF 2.0 file and the numbers in its buffers. Inside of missiondb.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "mdat/missiondb/raw_number.hpp"

namespace lasso::mdat {

// Members of the JSON are read through it: what is missing is null or the preset. Throws MeshError: of another type.
using GltfJson = nlohmann::json;
const GltfJson& gltf_list(const GltfJson& object, const char* name);
const GltfJson& gltf_entry(const GltfJson& root, const char* list, std::size_t index);  // throws where there is none
std::size_t gltf_index(const GltfJson& object, const char* name, std::size_t preset);
double gltf_number(const GltfJson& object, const char* name, double preset);
// The same of a value itself, which `name` is said to hold.
std::size_t gltf_index(const GltfJson& number, const char* name);
double gltf_number(const GltfJson& number, const char* name);

class GltfFile {
 public:
  // Text (.gltf) or binary (.glb), whatever the name says; buffers beside the file are read from `folder`. Throws MeshError: not glTF 2.0,
  // truncated, corrupt, a buffer that cannot be read, or a required extension that is not known.
  GltfFile(const std::filesystem::path& folder, std::string_view bytes);

  const GltfJson& root() const { return root_; }
  // Of its buffers.
  const std::vector<std::filesystem::path>& files() const { return files_; }
  // Extensions that are used, change the shape, and are not read.
  const std::vector<std::string>& extensions_not_read() const { return extensions_not_read_; }
  // The numbers of an accessor, entry after entry of `width` each. Integers of KHR_mesh_quantization are decoded. Throws MeshError: of
  // another width, or out of its buffer.
  std::vector<double> numbers(std::size_t accessor, std::size_t width) const;

 private:
  std::string buffer_bytes(const GltfJson& buffer, const std::filesystem::path& folder, std::string_view binary);
  void read_buffers(const std::filesystem::path& folder, std::string_view binary);
  void check_extensions();
  std::string_view view(const GltfJson& accessor) const;
  std::vector<double> plain_numbers(const GltfJson& accessor, std::size_t count, std::size_t width) const;
  void replace_sparse(const GltfJson& accessor, std::size_t width, std::vector<double>& numbers) const;

  GltfJson root_;
  std::vector<std::string> buffers_;
  std::vector<std::filesystem::path> files_;
  std::vector<std::string> extensions_not_read_;
};

// The bytes of a data URI. Throws MeshError: not base64.
std::string data_uri_bytes(std::string_view uri);
// With %20 and the like as the characters that they stand for.
std::string percent_decoded(std::string_view uri);

}  // namespace lasso::mdat
