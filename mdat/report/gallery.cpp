#include "mdat/report/gallery.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <set>
#include <system_error>

#include "mdat/common/errors.hpp"
#include "mdat/common/output.hpp"
#include "mdat/common/text.hpp"
#include "mdat/report/page.hpp"

namespace lasso::mdat {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr const char* kTitle = "3DLASSO runs";

// The variant that a person looks at first; of an approach its timeline. Null where there is none.
const Json* main_part(const Json& results) {
  for (const char* name : {"noisy", "noise_free", "timeline"}) {
    if (results.contains(name)) return &results.at(name);
  }
  return nullptr;
}

std::size_t count_of(const Json& part, const char* key) { return part.contains(key) ? part.at(key).get<std::size_t>() : 0; }

// ", 3 lost", or nothing of none.
std::string counted(const char* what, std::size_t count) { return count == 0 ? "" : format(", %zu %s", count, what); }

std::string number(const Json& part, const char* key, int digits) {
  return part.contains(key) && part.at(key).is_number() ? decimals(part.at(key).get<double>(), digits) : "–";
}

void judge(const Json& part, GalleryEntry& entry) {
  const std::size_t frames = count_of(part, "frames"), wrong = count_of(part, "wrong"), lost = count_of(part, "lost");
  const std::size_t invalid = part.contains("invalid") ? count_of(part, "invalid") : frames - std::min(frames, count_of(part, "valid"));
  if (frames == 0) {
    entry.judgement = "bad";
    entry.verdict = "never found";
    return;
  }
  entry.judgement = wrong > 0 ? "bad" : lost + invalid > 0 ? "partly" : "good";
  entry.verdict = format("%zu frames", frames) + counted("wrong", wrong) + counted("lost", lost) + counted("without a valid pose", invalid);
  if (wrong + lost + invalid == 0) entry.verdict += ", all right";
  entry.errors = "rms " + number(part, "rms_mm", 2) + " mm, " + number(part, "rms_deg", 3) + "°; NEES " + number(part, "nees", 2);
}

// From `begin` to behind `end`; empty where the page has no such element.
std::string element(const std::string& page, const std::string& begin, const std::string& end) {
  const std::size_t first = page.find(begin);
  const std::size_t last = first == std::string::npos ? first : page.find(end, first);
  return last == std::string::npos ? "" : page.substr(first, last + end.size() - first);
}

// A scan on the target, or else the first figure.
std::string picture_of(const std::string& page) {
  const std::string image = element(page, "<img ", "'>");
  return image.empty() ? element(page, "<svg", "</svg>") : image;
}

GalleryEntry entry_of(const fs::path& file) {
  const Json results = Json::parse(file_content(file), nullptr, false);
  const Json* part = results.is_object() && results.contains("mission") && results.contains("scenario") ? main_part(results) : nullptr;
  if (part == nullptr) throw InputError(file.string() + ": not the results of mdat run");
  GalleryEntry entry;
  entry.folder = file.parent_path();
  entry.title = results.at("mission").get<std::string>();
  entry.scenario = results.at("scenario").get<std::string>() + ", seed " + results.value("seed", Json(0)).dump();
  judge(*part, entry);
  const fs::path report = entry.folder / "report.html";
  entry.has_report = fs::is_regular_file(report);
  if (entry.has_report) entry.picture = picture_of(file_content(report));
  return entry;
}

std::string card(const GalleryEntry& run, const fs::path& folder) {
  const std::string link = (fs::relative(run.folder, folder) / (run.has_report ? "report.html" : "results.json")).generic_string();
  std::string html =
      "<section>\n<h2><a href='" + url(link) + "'>" + escape(fs::relative(run.folder, folder).generic_string()) + "</a></h2>\n";
  html += "<p>" + escape(run.title) + ", " + escape(run.scenario) + "</p>\n";
  html += "<p class='" + run.judgement + "'>" + escape(run.verdict) + "</p>\n<p>" + escape(run.errors) + "</p>\n";
  if (!run.picture.empty()) html += "<figure>" + run.picture + "</figure>\n";
  return html + "</section>\n";
}

}  // namespace

std::vector<GalleryEntry> find_runs(const std::vector<fs::path>& folders, std::vector<std::string>& skipped) {
  std::set<fs::path> files;
  for (const fs::path& folder : folders) {
    if (!fs::is_directory(folder)) throw InputError(folder.string() + ": no such folder");
    const auto options = fs::directory_options::skip_permission_denied;
    for (const auto& entry : fs::recursive_directory_iterator(folder, options)) {
      if (entry.path().filename() == "results.json" && entry.is_regular_file()) files.insert(entry.path().lexically_normal());
    }
  }
  std::vector<GalleryEntry> runs;
  for (const fs::path& file : files) {
    try {
      runs.push_back(entry_of(file));
    } catch (const InputError& error) {
      skipped.emplace_back(error.what());
    } catch (const nlohmann::json::exception&) {
      skipped.push_back(file.string() + ": not the results of mdat run");
    }
  }
  return runs;
}

std::string gallery_html(const std::vector<GalleryEntry>& runs, const fs::path& folder) {
  std::string html = format("<h1>%zu run%s</h1>\n", runs.size(), runs.size() == 1 ? "" : "s");
  html +=
      "<p class='note'>Errors and counts are those of the variant with noise. Wrong: valid, and off by more than 5 of its own σ and by "
      "more "
      "than 20 mm or 1°. Lost: more than 50 mm or 5° off. NEES: 6 when the covariance is honest. –: not known.</p>\n<div class='runs'>\n";
  for (const GalleryEntry& run : runs) html += card(run, folder);
  return page(kTitle, html + "</div>\n");
}

bool is_gallery(const std::string& page) { return page.find(std::string("<title>") + kTitle + "</title>") != std::string::npos; }

}  // namespace lasso::mdat
