#include "hal_sim/scan_file.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <fstream>
#include <set>

#include "hal_sim/scan_text.hpp"

namespace lasso::sim {
namespace {

namespace fs = std::filesystem;

constexpr std::uintmax_t kLargestFileBytes = std::uintmax_t{4} << 30;

using Reader = RawScan (*)(const std::string&, std::string_view);

constexpr std::string_view kImage = ".png";

struct Kind {
  std::string_view extension;
  Reader read;
};
constexpr Kind kKinds[] = {{".csv", read_csv}, {".ply", read_ply}, {".pcd", read_pcd},
                           {".asc", read_xyz}, {".xyz", read_xyz}, {".pts", read_xyz}};

std::string expected_kinds() { return "expected " + scan_extensions() + " (an image with a depth camera)"; }

std::string extension_of(const fs::path& file) {
  std::string extension = file.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](char c) { return static_cast<char>(std::tolower(static_cast<unsigned char>(c))); });
  return extension;
}

Reader reader_of(const fs::path& file) {
  const std::string extension = extension_of(file);
  for (const Kind& kind : kKinds) {
    if (kind.extension == extension) return kind.read;
  }
  return nullptr;
}

bool is_image(const fs::path& file, const DepthCamera& camera) { return camera.fx > 0 && extension_of(file) == kImage; }

std::string contents_of(const fs::path& file) {
  std::error_code error;
  const bool regular = fs::is_regular_file(file, error);
  const std::uintmax_t size = regular ? fs::file_size(file, error) : 0;
  if (!regular || error) fail(file.string(), "is not a file that can be read; check its name");
  if (size > kLargestFileBytes) fail(file.string(), "has " + std::to_string(size) + " bytes, expected at most 4 GiB; is it a scan?");
  std::ifstream in(file, std::ios::binary);
  std::string text(static_cast<std::size_t>(size), '\0');
  if (!in.read(text.data(), static_cast<std::streamsize>(size))) fail(file.string(), "cannot be read; check your rights to it");
  return text;
}

// Digits from `i` on, without zeros before them.
std::string_view number_at(std::string_view name, std::size_t i) {
  std::string_view digits = name.substr(i, std::min(name.find_first_not_of("0123456789", i), name.size()) - i);
  while (digits.size() > 1 && digits.front() == '0') digits.remove_prefix(1);
  return digits;
}

bool is_digit(char c) { return c >= '0' && c <= '9'; }

// The length of the digits, or of the one other character, at i.
std::size_t step_at(std::string_view text, std::size_t i) {
  return is_digit(text[i]) ? std::min(text.find_first_not_of("0123456789", i), text.size()) - i : 1;
}

// What stands there, in the order of numbers where both are numbers.
int compared(std::string_view x, std::string_view y) {
  if (is_digit(x[0]) && is_digit(y[0])) {
    x = number_at(x, 0);
    y = number_at(y, 0);
    if (x.size() != y.size()) return x.size() < y.size() ? -1 : 1;
  }
  return x.compare(y);
}

// Natural order: numbers in names compare as numbers, all else by its bytes; names that are then alike by their bytes.
bool is_before(std::string_view a, std::string_view b) {
  std::size_t i = 0, k = 0;
  while (i < a.size() && k < b.size()) {
    const bool numbers = is_digit(a[i]) && is_digit(b[k]);
    const std::size_t step_a = numbers ? step_at(a, i) : 1, step_b = numbers ? step_at(b, k) : 1;
    const int order = compared(a.substr(i, step_a), b.substr(k, step_b));
    if (order != 0) return order < 0;
    i += step_a;
    k += step_b;
  }
  const std::size_t left_a = a.size() - i, left_b = b.size() - k;
  return left_a != left_b ? left_a < left_b : a < b;
}

std::vector<fs::path> scans_in(const fs::path& folder, const DepthCamera& camera) {
  std::vector<fs::path> files;
  std::error_code error;
  for (fs::directory_iterator entry(folder, error), end; !error && entry != end; entry.increment(error)) {
    if (entry->path().filename().string().starts_with('.')) continue;  // hidden: of an editor, or of another system (._a.csv)
    if ((reader_of(entry->path()) != nullptr || is_image(entry->path(), camera)) && entry->is_regular_file())
      files.push_back(entry->path());
  }
  if (error) fail(folder.string(), "is not a folder that can be read (" + error.message() + ")");
  std::sort(files.begin(), files.end(),
            [](const fs::path& a, const fs::path& b) { return is_before(a.filename().string(), b.filename().string()); });
  return files;
}

double median_range_m(const RangeImage& image) {
  std::vector<float> ranges_m;
  for (const RangeSample& sample : image.samples) {
    if (sample.state == RayState::kHit) ranges_m.push_back(sample.range_m);
  }
  if (ranges_m.empty()) return 0;
  const auto middle = ranges_m.begin() + static_cast<std::ptrdiff_t>(ranges_m.size() / 2);
  std::nth_element(ranges_m.begin(), middle, ranges_m.end());
  return static_cast<double>(*middle);
}

ScanFacts facts_of(const RawScan& scan, const RangeImage& image) {
  ScanFacts facts;
  facts.hits = static_cast<std::size_t>(std::count_if(scan.rays.begin(), scan.rays.end(), [](const RawRay& ray) { return ray.hit; }));
  facts.misses = scan.rays.size() - facts.hits;
  facts.unmeasured = scan.unmeasured;
  facts.directions = has_directions(scan) ? count_directions(scan) : 0;
  facts.warnings = scan.warnings;
  for (const RangeSample& sample : image.samples) {
    facts.kept_hits += sample.state == RayState::kHit ? 1U : 0U;
    facts.kept_misses += sample.state == RayState::kMiss ? 1U : 0U;
  }
  facts.median_range_m = median_range_m(image);
  facts.has_times = scan.has_times;
  facts.first_time = scan.rays.empty() ? scan.first_time : scan.rays.front().time;
  facts.last_time = scan.rays.empty() ? scan.first_time : scan.rays.back().time;
  facts.unit_s = scan.unit_s;
  facts.seconds_named = scan.seconds_named;
  facts.viewpoint = !scan.T_file_sensor.p.isZero(0) || std::abs(scan.T_file_sensor.q.w()) < 1;
  return facts;
}

class FolderScans final : public ScanSource {
 public:
  FolderScans(std::vector<fs::path> files, const DepthCamera& camera) : files_(std::move(files)), camera_(camera) {}
  std::size_t size() const override { return files_.size(); }
  fs::path place(std::size_t i) const override { return files_.at(i); }
  RawScan read(std::size_t i) const override { return read_raw_scan(files_.at(i), camera_); }

 private:
  std::vector<fs::path> files_;
  DepthCamera camera_;
};

RangeImage image_of(const RawScan& scan, ScanFrame frame) {
  if (scan.unit_s > 0) frame.unit_s = scan.unit_s;
  return to_image(scan, frame);
}

}  // namespace

std::string scan_extensions() {
  std::string text;
  for (const Kind& kind : kKinds) text.append(kind.extension).append(", ");
  return text.append(kImage);
}

std::string scan_stem(const std::string& name) {
  const fs::path file(name);
  return reader_of(file) != nullptr || extension_of(file) == kImage ? file.stem().string() : name;
}

RawScan read_raw_scan(const fs::path& file, const DepthCamera& camera) {
  if (is_image(file, camera)) return read_depth_image(file.string(), contents_of(file), camera);
  const Reader reader = reader_of(file);
  if (reader == nullptr) fail(file.string(), "is no scan file, " + expected_kinds());
  return reader(file.string(), contents_of(file));
}

RangeImage read_scan_file(const fs::path& file, const ScanFrame& frame) { return image_of(read_raw_scan(file), frame); }

RecordedScans::RecordedScans(const fs::path& folder, const ScanFrame& frame, const DepthCamera& camera) : frame_(frame) {
  const std::vector<fs::path> files = scans_in(folder, camera);
  source_ = std::make_shared<FolderScans>(files, camera);
  if (files.empty()) fail(folder.string(), "holds no scan, " + expected_kinds());
  std::set<std::string> stems;
  for (const fs::path& file : files) {
    if (!stems.insert(file.stem().string()).second) {
      fail(file.string(), "another scan of this folder has the stem " + shown(file.stem().string()) + " too; rename one of them");
    }
  }
}

RangeImage RecordedScans::read(std::size_t i) const {
  RangeImage image = image_of(source_->read(i), frame_);
  image.scan_id = static_cast<std::uint32_t>(i);
  return image;
}

std::vector<ScanFacts> RecordedScans::survey() const {
  std::vector<ScanFacts> facts;
  ScanFrame frame = frame_;
  frame.unit_s = 0;  // what a time is in seconds is not known yet
  for (std::size_t i = 0; i < size(); ++i) {
    const RawScan scan = source_->read(i);
    facts.push_back(facts_of(scan, to_image(scan, frame)));
  }
  return facts;
}

void RecordedScans::set_time_unit(double unit_s, const std::vector<ScanFacts>& facts) {
  frame_.unit_s = unit_s;
  for (std::size_t i = 0; i < facts.size(); ++i) {
    const double last_s =
        std::max(std::abs(facts[i].first_time), std::abs(facts[i].last_time)) * (facts[i].unit_s > 0 ? facts[i].unit_s : unit_s);
    if (last_s > kLatest_s)
      fail(file(i).string(), "its times are up to " + text_of(last_s) + " s, expected at most 1e11; check their unit");
  }
}

}  // namespace lasso::sim
