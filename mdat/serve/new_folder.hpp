// Folders that the page makes below the served one. Inside of serve's answers.
#pragma once

#include <filesystem>
#include <string>

#include "mdat/serve/folder.hpp"

namespace lasso::mdat::serve {

// Letters, digits, - and _: of which names from a client may be made.
constexpr char kPlainSigns[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789_-";

// Where a folder of this name would stand. Throws Refusal: 400 unless it has 1 to 64 plain signs, 409 where nothing may be written here.
std::filesystem::path new_folder_path(const Folder& folder, const std::string& name);

}  // namespace lasso::mdat::serve
