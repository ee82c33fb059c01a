// Scans for search_replay: what `search` found in view, as a sensor would have handed it over (ft/golden/trace.hpp).
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "fsw/sense/range_image.hpp"

namespace lasso::search {

class Recording {
 public:
  void add(const RangeImage& scan);
  // Writes image.3dli and scans.bin, whole or not at all.
  void write(const std::filesystem::path& folder, const std::vector<std::uint8_t>& image) const;

 private:
  std::string scans_;
};

}  // namespace lasso::search
