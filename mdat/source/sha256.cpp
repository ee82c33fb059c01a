#include "mdat/source/sha256.hpp"

#include <openssl/evp.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <iterator>
#include <memory>
#include <stdexcept>
#include <vector>

namespace lasso::mdat {

namespace {

using Digest = std::unique_ptr<EVP_MD_CTX, decltype(&EVP_MD_CTX_free)>;

void require(bool done) {
  if (!done) throw std::runtime_error("SHA-256 is not available in this OpenSSL");
}

Digest begin() {
  Digest digest(EVP_MD_CTX_new(), &EVP_MD_CTX_free);
  require(digest != nullptr && EVP_DigestInit_ex(digest.get(), EVP_sha256(), nullptr) == 1);
  return digest;
}

std::string end(const Digest& digest) {
  std::array<unsigned char, EVP_MAX_MD_SIZE> bytes{};
  unsigned int length = 0;
  require(EVP_DigestFinal_ex(digest.get(), bytes.data(), &length) == 1);
  constexpr char kHex[] = "0123456789abcdef";
  std::string text;
  for (unsigned int i = 0; i < length; ++i) {
    text += kHex[bytes[i] >> 4];
    text += kHex[bytes[i] & 15];
  }
  return text;
}

std::ifstream open_file(const std::filesystem::path& file) {
  std::error_code error;  // what cannot be looked at (a name that is too long) cannot be opened, which says why
  const std::filesystem::file_status status = std::filesystem::status(file, error);
  if (std::filesystem::is_directory(status)) throw std::runtime_error("is a folder, expected a file");
  if (std::filesystem::exists(status) && !std::filesystem::is_regular_file(status)) throw std::runtime_error("is not a file");
  errno = 0;
  std::ifstream stream(file, std::ios::binary);
  if (!stream) throw std::runtime_error(std::string("cannot be read: ") + std::strerror(errno == 0 ? ENOENT : errno));
  return stream;
}

}  // namespace

std::string sha256_of(std::string_view bytes) {
  const Digest digest = begin();
  require(EVP_DigestUpdate(digest.get(), bytes.data(), bytes.size()) == 1);
  return end(digest);
}

std::string sha256_of_file(const std::filesystem::path& file) {
  std::ifstream stream = open_file(file);
  const Digest digest = begin();
  std::vector<char> piece(std::size_t{1} << 16);
  while (stream.read(piece.data(), static_cast<std::streamsize>(piece.size())), stream.gcount() > 0)
    require(EVP_DigestUpdate(digest.get(), piece.data(), static_cast<std::size_t>(stream.gcount())) == 1);
  return end(digest);
}

std::string read_file(const std::filesystem::path& file) {
  std::ifstream stream = open_file(file);
  return {std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
}

}  // namespace lasso::mdat
