#include <openssl/evp.h>

#include <charconv>

#include "mdat/missiondb/gltf_file.hpp"
#include "mdat/missiondb/mesh_import.hpp"

namespace lasso::mdat {

std::string percent_decoded(std::string_view uri) {
  std::string text;
  for (std::size_t i = 0; i < uri.size(); ++i) {
    unsigned char byte = 0;
    const char* const digits = uri.data() + i + 1;
    if (uri[i] == '%' && i + 2 < uri.size() && std::from_chars(digits, digits + 2, byte, 16).ptr == digits + 2) {
      text += static_cast<char>(byte);
      i += 2;
    } else {
      text += uri[i];
    }
  }
  return text;
}

std::string data_uri_bytes(std::string_view uri) {
  const std::size_t comma = uri.find(',');
  if (comma == std::string_view::npos) throw MeshError("has a data URI without data: the file is truncated or corrupt");
  std::string text = percent_decoded(uri.substr(comma + 1));
  if (!uri.substr(0, comma).ends_with(";base64")) return text;
  std::size_t padding = 0;
  while (text.size() - padding > 0 && padding < 2 && text[text.size() - 1 - padding] == '=') ++padding;
  for (; text.size() % 4 != 0; ++padding) text += '=';
  std::string bytes(text.size() / 4 * 3, '\0');
  const int size = EVP_DecodeBlock(reinterpret_cast<unsigned char*>(bytes.data()), reinterpret_cast<const unsigned char*>(text.data()),
                                   static_cast<int>(text.size()));
  if (size < 0 || static_cast<std::size_t>(size) < padding)
    throw MeshError("has a data URI that is not base64: the file is truncated or corrupt");
  bytes.resize(static_cast<std::size_t>(size) - padding);
  return bytes;
}

}  // namespace lasso::mdat
