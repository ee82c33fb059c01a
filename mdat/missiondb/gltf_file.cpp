#include "mdat/missiondb/gltf_file.hpp"

#include <algorithm>
#include <cmath>

#include "mdat/missiondb/mesh_import.hpp"
#include "mdat/missiondb/mesh_text.hpp"
#include "mdat/missiondb/value_row.hpp"
#include "mdat/source/sha256.hpp"

namespace lasso::mdat {
namespace {

constexpr std::size_t kGlbHeader = 12;
constexpr std::size_t kGlbChunkHeader = 8;
constexpr double kMostBytes = 1e15;  // exact in a double, and its product with any stride is exact in 64 bits

std::size_t word_at(std::string_view bytes, std::size_t offset) {
  return static_cast<std::size_t>(raw_number(NumberType::kUint32, &bytes[offset]));
}

struct GlbChunks {
  std::string_view text, binary;
};

// A chunk's bytes, which are taken off `rest`.
std::string_view take_chunk(std::string_view& rest) {
  const std::size_t size = rest.size() < kGlbChunkHeader ? rest.size() : word_at(rest, 0);
  if (rest.size() < kGlbChunkHeader || size > rest.size() - kGlbChunkHeader) {
    throw MeshError("is truncated or corrupt: its header announces more than its bytes");
  }
  const std::string_view chunk = rest.substr(kGlbChunkHeader, size);
  rest.remove_prefix(kGlbChunkHeader + size);
  return chunk;
}

GlbChunks glb_chunks(std::string_view bytes) {
  if (bytes.size() < kGlbHeader) throw MeshError("is truncated: a binary glTF has at least 12 bytes");
  const std::size_t version = word_at(bytes, 4);
  const std::size_t size = word_at(bytes, 8);
  if (version != 2) throw MeshError("is binary glTF " + std::to_string(version) + ", expected version 2: convert it");
  if (size > bytes.size() || size < kGlbHeader) {
    throw MeshError("is truncated or corrupt: its header announces " + std::to_string(size) + " bytes, but it has " +
                    std::to_string(bytes.size()));
  }
  std::string_view rest = bytes.substr(kGlbHeader, size - kGlbHeader);
  GlbChunks chunks;
  chunks.text = take_chunk(rest);
  if (!rest.empty()) chunks.binary = take_chunk(rest);
  return chunks;
}

// What changes colours, lights or the way of looking at it, not the shape.
bool is_no_shape(const std::string& extension) {
  for (const char* begin : {"KHR_materials_", "KHR_texture_", "EXT_texture_", "MSFT_texture_", "KHR_lights_", "EXT_lights_", "KHR_xmp",
                            "KHR_animation_", "EXT_mesh_features", "EXT_structural_metadata", "MSFT_packing_"}) {
    if (extension.starts_with(begin)) return true;
  }
  return false;
}

NumberType component_type(const GltfJson& accessor) {
  const double code = gltf_number(accessor, "componentType", 0);
  if (code == 5120) return NumberType::kInt8;
  if (code == 5121) return NumberType::kUint8;
  if (code == 5122) return NumberType::kInt16;
  if (code == 5123) return NumberType::kUint16;
  if (code == 5125) return NumberType::kUint32;
  if (code == 5126) return NumberType::kFloat;
  throw MeshError("has a glTF accessor of an unknown component type " + number_text(code));
}

// The factor of normalised integers: their largest value stands for 1.
double largest_of(NumberType type) {
  switch (type) {
    case NumberType::kInt8:
      return 127;
    case NumberType::kUint8:
      return 255;
    case NumberType::kInt16:
      return 32767;
    case NumberType::kUint16:
      return 65535;
    default:
      return 1;
  }
}

bool is_normalized(const GltfJson& accessor) {
  const auto found = accessor.find("normalized");
  return found != accessor.end() && *found == true;
}

// `count` entries of `width` numbers in `bytes`.
std::vector<double> raw_numbers(std::string_view bytes, NumberType type, std::size_t count, std::size_t width, std::size_t stride) {
  const std::size_t entry = width * size_of(type);
  if (count > 0 && (bytes.size() < entry || (count - 1) > (bytes.size() - entry) / std::max<std::size_t>(stride, 1))) {
    throw MeshError("has a glTF accessor whose count does not fit its buffer: the file is truncated or corrupt");
  }
  std::vector<double> numbers;
  numbers.reserve(count * width);
  for (std::size_t i = 0; i < count; ++i) {
    for (std::size_t k = 0; k < width; ++k) numbers.push_back(raw_number(type, bytes.data() + i * stride + k * size_of(type)));
  }
  return numbers;
}

std::filesystem::path file_beside(const std::filesystem::path& folder, const std::string& uri) {
  if (uri.find("://") != std::string::npos) throw MeshError("refers to " + excerpt(uri) + ", expected a file beside it: fetch it");
  std::filesystem::path file = folder / percent_decoded(uri);
  std::error_code error;
  return std::filesystem::is_regular_file(file, error) ? file : folder / uri;  // of a program that does not encode
}

std::string read_beside(const std::filesystem::path& file, const std::string& uri) {
  try {
    return read_file(file);
  } catch (const std::runtime_error& why) {
    throw MeshError("refers to " + excerpt(uri) + ", which " + why.what());
  }
}

// Of the asset. Programs have written it as a number, too. Anything else is not looked into: it may be nested deeper than the stack.
std::string version_of(const GltfJson& root) {
  const auto asset = root.find("asset");
  if (asset == root.end() || !asset->is_object()) return "";
  const auto version = asset->find("version");
  if (version != asset->end() && version->is_number()) return number_text(version->get<double>());
  return version != asset->end() && version->is_string() ? version->get<std::string>() : "";
}

}  // namespace

const GltfJson& gltf_list(const GltfJson& object, const char* name) {
  static const GltfJson kEmpty = GltfJson::array();
  const auto found = object.find(name);
  if (found == object.end()) return kEmpty;
  if (!found->is_array()) throw MeshError(std::string("is a corrupt glTF file: \"") + name + "\" is no list");
  return *found;
}

const GltfJson& gltf_entry(const GltfJson& root, const char* list, std::size_t index) {
  const GltfJson& entries = gltf_list(root, list);
  if (index >= entries.size() || !entries[index].is_object()) {
    throw MeshError("is a corrupt glTF file: it refers to " + std::to_string(index) + " of its " + std::to_string(entries.size()) + " " +
                    list);
  }
  return entries[index];
}

double gltf_number(const GltfJson& object, const char* name, double preset) {
  const auto found = object.find(name);
  return found == object.end() ? preset : gltf_number(*found, name);
}

double gltf_number(const GltfJson& number, const char* name) {
  if (!number.is_number()) throw MeshError(std::string("is a corrupt glTF file: \"") + name + "\" is of the wrong type, expected a number");
  return number.get<double>();
}

std::size_t gltf_index(const GltfJson& object, const char* name, std::size_t preset) {
  const auto found = object.find(name);
  return found == object.end() ? preset : gltf_index(*found, name);
}

std::size_t gltf_index(const GltfJson& number, const char* name) {
  const double value = gltf_number(number, name);
  if (!(value >= 0 && value <= kMostBytes && value == std::floor(value))) {
    throw MeshError(std::string("is a corrupt glTF file: \"") + name + "\" is " + number_text(value));
  }
  return static_cast<std::size_t>(value);
}

GltfFile::GltfFile(const std::filesystem::path& folder, std::string_view bytes) {
  const GlbChunks chunks = bytes.starts_with("glTF") ? glb_chunks(bytes) : GlbChunks{plain_text(bytes), {}};
  root_ = GltfJson::parse(chunks.text, nullptr, false);
  if (!root_.is_object()) throw MeshError("is not a glTF file (its JSON is truncated or corrupt)");
  const std::string version = version_of(root_);
  if (version != "2" && !version.starts_with("2."))
    throw MeshError("is glTF of version " + excerpt(version) + ", expected 2.0: convert it");
  check_extensions();
  read_buffers(folder, chunks.binary);
}

void GltfFile::check_extensions() {
  for (const char* list : {"extensionsRequired", "extensionsUsed"}) {
    const bool required = std::string(list) == "extensionsRequired";
    for (const GltfJson& entry : gltf_list(root_, list)) {
      if (!entry.is_string()) throw MeshError(std::string("is a corrupt glTF file: \"") + list + "\" holds what is no name");
      const auto name = entry.get<std::string>();
      if (is_no_shape(name) || name == "KHR_mesh_quantization") continue;
      if (required) throw MeshError("requires the glTF extension " + excerpt(name) + ", which is not read: export without it");
      extensions_not_read_.push_back(name);
    }
  }
}

// One without a name is the binary chunk, or a stand-in of an extension that is not read: an accessor that needs that is refused.
std::string GltfFile::buffer_bytes(const GltfJson& buffer, const std::filesystem::path& folder, std::string_view binary) {
  if (!buffer.is_object()) throw MeshError("is a corrupt glTF file: a buffer is no object");
  const auto uri = buffer.find("uri");
  if (uri == buffer.end() || !uri->is_string()) return std::string(buffers_.empty() ? binary : std::string_view{});
  const auto text = uri->get<std::string>();
  if (text.starts_with("data:")) return data_uri_bytes(text);
  files_.push_back(file_beside(folder, text));
  return read_beside(files_.back(), text);
}

void GltfFile::read_buffers(const std::filesystem::path& folder, std::string_view binary) {
  for (const GltfJson& buffer : gltf_list(root_, "buffers")) {
    buffers_.push_back(buffer_bytes(buffer, folder, binary));
    const std::size_t size = buffers_.back().size();
    const std::size_t announced = gltf_index(buffer, "byteLength", 0);
    const bool stand_in = size == 0 && !buffer.contains("uri");
    if (size >= announced || stand_in) continue;
    throw MeshError("has a glTF buffer of " + std::to_string(size) + " bytes, " + std::to_string(announced) +
                    " are announced: it is truncated or corrupt");
  }
}

std::string_view GltfFile::view(const GltfJson& accessor) const {
  const GltfJson& entry = gltf_entry(root_, "bufferViews", gltf_index(accessor, "bufferView", 0));
  const std::size_t buffer = gltf_index(entry, "buffer", 0);
  const std::size_t begin = gltf_index(entry, "byteOffset", 0);
  const std::size_t size = gltf_index(entry, "byteLength", 0);
  const std::size_t offset = gltf_index(accessor, "byteOffset", 0);
  if (buffer >= buffers_.size() || begin + size > buffers_[buffer].size() || offset > size) {
    throw MeshError("has a glTF accessor whose bytes lie beyond its buffer: the file is truncated or corrupt");
  }
  return std::string_view(buffers_[buffer]).substr(begin + offset, size - offset);
}

std::vector<double> GltfFile::plain_numbers(const GltfJson& accessor, std::size_t count, std::size_t width) const {
  if (!accessor.contains("bufferView")) {
    std::size_t bytes = 0;
    for (const std::string& buffer : buffers_) bytes += buffer.size();
    if (count > bytes) throw MeshError("has a glTF accessor whose count does not fit its buffers: the file is corrupt");
    return std::vector<double>(count * width, 0);
  }
  const NumberType type = component_type(accessor);
  const std::size_t packed = width * size_of(type);
  const std::size_t stride = gltf_index(gltf_entry(root_, "bufferViews", gltf_index(accessor, "bufferView", 0)), "byteStride", packed);
  if (stride < packed) throw MeshError("has a glTF buffer view whose stride is shorter than its entries: the file is corrupt");
  return raw_numbers(view(accessor), type, count, width, stride);
}

// Entries that stand elsewhere: their indices, then their values.
void GltfFile::replace_sparse(const GltfJson& accessor, std::size_t width, std::vector<double>& numbers) const {
  const auto sparse = accessor.find("sparse");
  if (sparse == accessor.end()) return;
  if (!sparse->is_object() || !sparse->contains("indices") || !sparse->contains("values")) throw MeshError("has a corrupt sparse accessor");
  const std::size_t count = gltf_index(*sparse, "count", 0);
  const GltfJson& where = (*sparse)["indices"];
  const GltfJson& what = (*sparse)["values"];
  const NumberType place_type = component_type(where);
  const NumberType type = component_type(accessor);
  const std::vector<double> places = raw_numbers(view(where), place_type, count, 1, size_of(place_type));
  const std::vector<double> values = raw_numbers(view(what), type, count, width, width * size_of(type));
  for (std::size_t i = 0; i < count; ++i) {
    const auto begin = static_cast<std::size_t>(std::max(places[i], 0.0)) * width;
    if (begin + width > numbers.size()) throw MeshError("has a sparse glTF accessor whose indices lie beyond its entries");
    std::copy_n(values.begin() + static_cast<std::ptrdiff_t>(i * width), width, numbers.begin() + static_cast<std::ptrdiff_t>(begin));
  }
}

std::vector<double> GltfFile::numbers(std::size_t accessor, std::size_t width) const {
  const GltfJson& entry = gltf_entry(root_, "accessors", accessor);
  const auto type = entry.find("type");
  if (type == entry.end() || *type != (width == 3 ? "VEC3" : "SCALAR")) {
    throw MeshError("has a glTF accessor that is no " + std::string(width == 3 ? "VEC3" : "SCALAR"));
  }
  std::vector<double> numbers = plain_numbers(entry, gltf_index(entry, "count", 0), width);
  replace_sparse(entry, width, numbers);
  if (!is_normalized(entry)) return numbers;
  for (double& number : numbers) number = std::max(number / largest_of(component_type(entry)), -1.0);
  return numbers;
}

}  // namespace lasso::mdat
