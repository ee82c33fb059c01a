// A page of the runs below some folders, each with a picture, its verdict and a link to its report.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace lasso::mdat {

// What the page shows of one run.
struct GalleryEntry {
  std::filesystem::path folder;
  std::string title, scenario, verdict, errors;  // plain text
  std::string judgement;                         // good; partly: frames are lost, or without a valid pose; bad: poses are wrong
  std::string picture;                           // the first one of its report, as it stands there; empty: none
  bool has_report = false;
};

// Every folder with a results.json in it, by name. One that is no result of mdat run is left out, and named in `skipped`.
std::vector<GalleryEntry> find_runs(const std::vector<std::filesystem::path>& folders, std::vector<std::string>& skipped);

// Of a page in `folder`, to which its links are relative.
std::string gallery_html(const std::vector<GalleryEntry>& runs, const std::filesystem::path& folder);
bool is_gallery(const std::string& page);

}  // namespace lasso::mdat
