#include "mdat/serve/new_folder.hpp"

#include "mdat/serve/http.hpp"

namespace lasso::mdat::serve {

std::filesystem::path new_folder_path(const Folder& folder, const std::string& name) {
  constexpr std::size_t kLongest = 64;
  if (name.empty() || name.size() > kLongest || name.find_first_not_of(kPlainSigns) != std::string::npos)
    throw Refusal{400, "this is no name for a folder", "take up to 64 letters, digits, - and _"};
  if (!folder.takes_files()) throw Refusal{409, "mdat serve shows one recording alone", "start it with a folder: mdat serve FOLDER"};
  return folder.path() / name;
}

}  // namespace lasso::mdat::serve
