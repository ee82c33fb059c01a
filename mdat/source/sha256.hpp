// SHA-256 of files, by OpenSSL.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace lasso::mdat {

// Lower-case hex, 64 characters.
std::string sha256_of(std::string_view bytes);

// Of a file's bytes, which are read piece by piece. Throws std::runtime_error as read_file.
std::string sha256_of_file(const std::filesystem::path& file);

// The file's bytes. Throws std::runtime_error with the reason, without the file's name.
std::string read_file(const std::filesystem::path& file);

}  // namespace lasso::mdat
