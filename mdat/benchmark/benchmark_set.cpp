#include "mdat/benchmark/benchmark_set.hpp"

#include <cerrno>
#include <cstdlib>
#include <cstring>

#include "hal_sim/scan_file.hpp"
#include "mdat/benchmark/still_scans.hpp"
#include "mdat/common/errors.hpp"
#include "mdat/common/output.hpp"
#include "mdat/common/progress_bar.hpp"
#include "mdat/common/text.hpp"
#include "mdat/common/version.hpp"
#include "mdat/replay/scan_notes.hpp"
#include "mdat/source/sha256.hpp"

namespace lasso::mdat {
namespace {

namespace fs = std::filesystem;

constexpr char kStartsHeader[] = "scan,qx,qy,qz,qw,x_m,y_m,z_m\n";

// A folder that is removed with all that is in it, unless it was renamed.
class PassingFolder {
 public:
  explicit PassingFolder(fs::path folder) : folder_(std::move(folder)) {}
  ~PassingFolder() {
    std::error_code ignored;
    fs::remove_all(folder_, ignored);
  }
  PassingFolder(const PassingFolder&) = delete;
  PassingFolder& operator=(const PassingFolder&) = delete;
  const fs::path& path() const { return folder_; }

 private:
  fs::path folder_;
};

std::string start_row(const std::string& scan, const Pose& pose) {
  return format("%s,%.12f,%.12f,%.12f,%.12f,%.9f,%.9f,%.9f\n", scan.c_str(), pose.q.x(), pose.q.y(), pose.q.z(), pose.q.w(), pose.p.x(),
                pose.p.y(), pose.p.z());
}

void make_folder(const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) throw InputError(folder.string() + ": cannot be made: " + error.message());
}

// Writes the files of one body, and takes down their digests.
class BodyWriter {
 public:
  BodyWriter(const SetPlan& plan, std::uint64_t seed, fs::path set) : plan_(plan), seed_(seed), set_(std::move(set)) {}

  void write(bool cached, BenchmarkSet& set) {
    const std::string name = body_name(seed_);
    make_folder(set_ / name / kScansFolder);
    const Subject subject = make_subject(request(cached));
    for (const char* file : {kMeshFile, kMissionFile}) set.protocol.files[name + "/" + file] = sha256_of_file(set_ / name / file);
    set.protocol.bodies.push_back({name, subject.mission.source.sensor, subject.noise, subject.truth.size_m});
    set.truth.push_back({name, body_kind_name(subject.body.kind), subject.body.what, subject.truth.size_m, subject.truth.symmetry, {}});
    write_scans(subject, set);
  }

 private:
  SubjectRequest request(bool cached) const {
    SubjectRequest request;
    request.seed = seed_;
    request.sensor = plan_.sensor;
    request.mission = set_ / body_name(seed_) / kMissionFile;
    request.model = set_ / body_name(seed_) / kMeshFile;
    request.name = body_name(seed_);
    request.cached = cached;
    return request;
  }

  void write_scans(const Subject& subject, BenchmarkSet& set) const {
    StillScans scans(subject, ScanStream::kBenchmark);
    std::string starts = kStartsHeader;
    for (std::size_t i = 1; i <= plan_.scans; ++i) {
      const std::string scan = scan_name(plan_, i);
      const Pose truth = scans.draw_pose();
      const Pose start = scans.draw_start(truth, plan_.start_deg * kRadPerDeg, plan_.start_share() * subject.truth.size_m);
      const RangeImage& image = scans.scan(subject.target->surface(), truth, start);
      put(std::string(kScansFolder) + "/" + scan + ".csv", sim::scan_csv(image), set.protocol);
      starts += start_row(scan, start);
      set.truth.back().scans.push_back({scan, truth, is_determined(subject, truth, {image.samples.begin(), image.samples.size()})});
    }
    put(kStartsFile, starts, set.protocol);
  }

  void put(const std::string& file, const std::string& text, Protocol& protocol) const {
    const std::string name = body_name(seed_) + "/" + file;
    write_file(set_ / name, text);
    protocol.files[name] = sha256_of(text);
  }

  const SetPlan& plan_;
  std::uint64_t seed_;
  fs::path set_;
};

BenchmarkSet write_set(const SetPlan& plan, const fs::path& folder, bool cached, const char* label) {
  BenchmarkSet set;
  set.protocol.plan = plan;
  set.protocol.made_by = std::string("mdat ") + kVersion;
  ProgressBar bar(label, plan.bodies, "bodies", kQuietReplay_s);
  for (std::size_t i = 0; i < plan.bodies; ++i) {
    BodyWriter(plan, plan.seed + i, folder).write(cached, set);
    bar.show(i + 1);
  }
  bar.finish();
  write_file(folder / kProtocolFile, protocol_json(set.protocol));
  return set;
}

void check_new(const fs::path& folder) {
  std::error_code error;
  if (!fs::exists(folder, error) || (fs::is_directory(folder, error) && fs::is_empty(folder, error))) return;
  throw InputError(folder.string() + ": is there already; a set needs a new folder: name another one, or remove it");
}

fs::path temporary_folder() {
  std::string name = (fs::temp_directory_path() / "mdat-benchmark-XXXXXX").string();
  if (mkdtemp(name.data()) == nullptr) throw RunError(name + ": cannot be made: set TMPDIR to a folder that you may write");
  return name;
}

// Of a name that nobody else has, on the same disk.
fs::path new_folder_beside(const fs::path& folder) {
  const fs::path plain = (fs::absolute(folder).lexically_normal() / "").parent_path();
  make_folder(plain.parent_path());
  std::string name = plain.string() + ".XXXXXX";
  if (mkdtemp(name.data()) == nullptr) throw InputError(folder.string() + ": cannot be made: " + std::strerror(errno));
  fs::permissions(name,
                  fs::perms::owner_all | fs::perms::group_read | fs::perms::group_exec | fs::perms::others_read | fs::perms::others_exec);
  return name;
}

}  // namespace

BenchmarkSet make_set(const SetPlan& plan, const fs::path& folder, bool cached) {
  check_new(folder);
  const PassingFolder partial(new_folder_beside(folder));
  std::error_code error;
  BenchmarkSet set = write_set(plan, partial.path(), cached, "make");
  fs::remove(folder, error);  // an empty one
  fs::rename(partial.path(), folder, error);
  if (error) throw InputError(folder.string() + ": cannot be made: " + error.message());
  return set;
}

BenchmarkSet open_set(const fs::path& folder, bool cached) {
  const Protocol protocol = read_protocol(folder);
  check_files(folder, protocol);
  const PassingFolder beside(temporary_folder());
  BenchmarkSet set = write_set(protocol.plan, beside.path(), cached, "make the truth again");
  check_made_again(folder, protocol, set.protocol);
  return set;
}

}  // namespace lasso::mdat
