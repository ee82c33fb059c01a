// SHA-256 of files, by OpenSSL.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace lasso::mdat {

// Lower-case hex, 64 characters.
std::string sha256_of(std::string_view bytes);

// The file's bytes. Throws std::runtime_error with the reason, without the file's name.
std::string read_file(const std::filesystem::path& file);

}  // namespace lasso::mdat
