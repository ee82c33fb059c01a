#include "mdat/cli/recorded_flight.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "mdat/common/errors.hpp"
#include "mdat/missiondb/calibration_file.hpp"
#include "mdat/run/camera.hpp"

namespace lasso::mdat {
namespace {

constexpr std::uint64_t kMostFrames = 1'000'000;
constexpr std::uint64_t kBoundariesOfLastFrame = 2;  // a run passes so many more than it has frames

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find('\n', at), text.size());
    lines.push_back(text.substr(at, end - at));
    at = end + 1;
  }
  return lines;
}

void tell_damage(const std::string& file, const std::vector<mcap::Damage>& damage) {
  for (const mcap::Damage& part : damage)
    std::fprintf(stderr, "warning: %s: damaged at byte %llu: %s\n", file.c_str(), static_cast<unsigned long long>(part.at),
                 part.why.c_str());
}

// The heads that the run had on lines: the component is told so, and their scans come from the recording.
std::optional<lcs::Device> wire_in(const std::string& sensor) {
  for (const lcs::Device device : {lcs::Device::kLaserCamera, lcs::Device::kLidar, lcs::Device::kTridar}) {
    if (sensor.rfind(wire_name(device), 0) == 0) return device;
  }
  return std::nullopt;
}

// What somebody ended before has fewer frames than it was to have.
std::uint32_t frames_of_boundaries(std::uint64_t boundaries) {
  return static_cast<std::uint32_t>(std::clamp<std::uint64_t>(boundaries - std::min(boundaries, kBoundariesOfLastFrame), 1, kMostFrames));
}

}  // namespace

RecordedFlight::RecordedFlight(const std::string& file, const std::string& key)
    : file_(file), run_(read_recorded_run(file)), folder_(run_) {
  tell_damage(file_, run_.damage);
  options_.scenario = word("scenario");
  options_.seed = number("seed");
  options_.frames = static_cast<std::uint32_t>(std::clamp<std::uint64_t>(number("frames"), 1, kMostFrames));
  if (run_.about.count("range") > 0) options_.range = std::min<std::uint64_t>(number("range"), 1000);
  options_.wire = wire_in(word("sensor"));
  options_.replay = std::make_shared<sim::SensorRecording>(run_.scans);
  options_.plain = true;
  if (run_.files.count(kCalibrationAttachment) > 0) options_.calibration = load_calibration(folder_.file(kCalibrationAttachment));
  if (!word(kOfApid).empty()) options_.apid = static_cast<std::uint16_t>(number(kOfApid));
  set_commands(key);
  if (word(kFlownImage) != kAttachedImage) return;
  const std::string& image = run_.files[kImageAttachment];
  image_.assign(image.begin(), image.end());
  options_.image = &image_;
}

void RecordedFlight::set_commands(const std::string& key) {
  const bool is_signed = !word(kSigned).empty();
  if (is_signed && key.empty())
    throw InputError(file_ + ": its component took signed commands alone, and recordings hold no keys: give it by --key FILE");
  if (!is_signed && !key.empty()) throw InputError("--key " + key + ": the commands of " + file_ + " needed none");
  if (is_signed) check_signatures(load_master_key(key));
  if (!word(kLinkForm).empty()) options_.commands = std::make_shared<const CommandStream>(run_.commands);
  if (!word(kHasStore).empty()) options_.store = folder_.store();
}

// As they were checked in the run. Recordings of old say "yes" instead of the number that it began with, which was 0.
void RecordedFlight::check_signatures(const Key& master) {
  SignatureState state;
  if (word(kSigned) != "yes") state.number = number(kSigned);
  if (!word(kHasStore).empty()) state.key = load_signature_state(folder_.store()).key;
  signatures_ = std::make_unique<SignatureCheck>(master, state);
  options_.authenticator = signatures_.get();
  options_.sign_image = [master](const std::vector<std::uint8_t>& image) { return sign_image(image, master); };
}

MissionInput RecordedFlight::mission(const std::vector<std::string>& more) const {
  std::vector<std::string> all = lines_of(word("settings"));
  all.insert(all.end(), more.begin(), more.end());
  try {
    return load_mission_input(folder_.mission(), all, options_.scenario);
  } catch (const MissionError& error) {
    throw MissionError(problems_in_recording(error, more.empty()));
  }
}

// Places in the files that are attached: those that were read are gone when this is. `as_flown`: nobody has changed anything, so that
// another version has recorded it.
std::vector<Problem> RecordedFlight::problems_in_recording(const MissionError& error, bool as_flown) const {
  std::vector<Problem> problems = error.problems();
  const std::string folder = folder_.file("").string();
  for (Problem& problem : problems) {
    const bool attached = problem.file.rfind(folder, 0) == 0;
    if (attached) problem.file.erase(0, folder.size());
    if (attached || as_flown) problem.file = file_ + ": " + problem.file;
  }
  if (as_flown)
    problems.push_back(
        {file_, 0, 0, "", "", "this mdat refuses its mission; that of commit " + word("commit") + " flew it, and flies it again"});
  return problems;
}

std::vector<std::string> RecordedFlight::changed_settings() const { return lines_of(word(kChangedSettings)); }

void RecordedFlight::limit_to_recorded(const MissionInput& input) {
  if (options_.range.value_or(0) >= scenario_of(input.source, options_.scenario).runs_m().size())
    throw InputError(file_ + ": is of a range that its scenario does not have: the recording is not whole");
  std::uint32_t most = UINT32_MAX;
  if (run_.boundaries) most = frames_of_boundaries(*run_.boundaries);
  if (!run_.whole) most = std::min(most, frames_until(parameters_for(input.source, options_.scenario).period_s));
  options_.frames = std::min(options_.frames.value_or(UINT32_MAX), most);
}

// Up to that of the last boundary.
std::uint32_t RecordedFlight::frames_until(double period_s) const {
  const double frames = std::ceil((1e-9 * static_cast<double>(run_.last_packet_ns) - to_seconds(kEpochUs)) / period_s);
  return static_cast<std::uint32_t>(std::clamp(frames, 1.0, static_cast<double>(kMostFrames)));
}

std::size_t RecordedFlight::comparable_bytes(std::size_t now) const {
  const bool ended_early = run_.boundaries.value_or(UINT64_MAX) <= kBoundariesOfLastFrame;
  return run_.whole && !ended_early ? now : std::min(now, run_.telemetry.size());
}

bool RecordedFlight::knows_truth() const { return word("sensor").find(':') == std::string::npos; }

std::string RecordedFlight::word(const char* key) const {
  const auto found = run_.about.find(key);
  return found != run_.about.end() ? found->second : "";
}

std::uint64_t RecordedFlight::number(const char* key) const {
  const std::string text = word(key);
  if (text.empty() || text.size() > 18 || text.find_first_not_of("0123456789") != std::string::npos)
    throw InputError(file_ + ": its metadata says no " + std::string(key) + ": the recording is not whole");
  return std::stoull(text);
}

}  // namespace lasso::mdat
