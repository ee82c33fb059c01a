#include <unistd.h>

#include <chrono>
#include <cmath>
#include <cstdio>
#include <memory>
#include <system_error>

#include "fsw/link/choices.hpp"
#include "mdat/cli/commands.hpp"
#include "mdat/cli/live_run.hpp"
#include "mdat/common/errors.hpp"
#include "mdat/common/interruption.hpp"
#include "mdat/common/output.hpp"
#include "mdat/common/text.hpp"
#include "mdat/common/version.hpp"
#include "mdat/link/connection.hpp"
#include "mdat/link/decode_text.hpp"
#include "mdat/link/upload.hpp"
#include "mdat/recording/link_recorder.hpp"

namespace lasso::mdat {
namespace {

constexpr double kStatusEach_s = 1, kSilent_s = 2;

struct MonitorArguments {
  std::string url, mission, record, key;
  std::optional<double> seconds;
  std::uint16_t apid = kApid;
  LiveOptions live;
  bool listens = false, force = false, cached = true;
};

// Lines of the terminal: the last one is written over, unless it is an event's. Into a file or a pipe, all of them stay.
class Terminal {
 public:
  void status(const std::string& text) {
    std::printf(over_ ? "\r\x1b[K%s" : "%s\n", text.c_str());
    (void)std::fflush(stdout);
    open_ = over_;
  }
  void line(const std::string& text) {
    std::printf(open_ ? "\r\x1b[K%s\n" : "%s\n", text.c_str());
    open_ = false;
  }

 private:
  bool over_ = ::isatty(STDOUT_FILENO) != 0, open_ = false;
};

std::string name_among(const Enumeration& enumeration, std::uint8_t value) {
  return value < enumeration.choices.size() ? enumeration.choices[value].name : std::to_string(value);
}

std::string pose_text(const PoseTelemetry& pose) {
  const double* p = pose.p_sensor_target_m;
  const double range_m = std::sqrt(p[0] * p[0] + p[1] * p[1] + p[2] * p[2]);
  const std::string verdict = pose.valid != 0 ? "valid" : "not valid: " + name_among(kPoseReason, pose.reason);
  return name_among(kTrackingMode, pose.mode) + ", " + decimals(range_m, 3) + " m, " + verdict;
}

// What has come until now.
class Monitor {
 public:
  Monitor(LinkRecorderOptions recorder, std::optional<std::uint32_t> image) : recorder_(std::move(recorder)), image_(image) {}

  void take(const DecodedPacket& packet) {
    if (packet.row == nullptr) ++unknown_;
    if (packet.row != nullptr && packet.row->cause[0] != '\0')
      terminal_.line(std::string("  ") + packet.row->name + (packet.items.empty() ? "" : ": ") + items_text(packet));
    const std::size_t files = recorder_.files().size();
    recorder_.take(packet);
    if (recorder_.files().size() > files) terminal_.line("  the component's clock began anew" + goes_on());
    compare_image();
  }

  // Called each second.
  void tell(const Connection& connection) {
    const auto now = std::chrono::steady_clock::now();
    const double rate = static_cast<double>(recorder_.frames() - frames_told_) / kStatusEach_s;
    frames_told_ = recorder_.frames();
    const LinkHealth& health = connection.health();
    std::string text = decimals(rate, 0) + " frames/s, " + decimals(health.rate_per_s(now), 1) + " packets/s; " + counts(connection);
    if (const std::optional<PoseTelemetry>& last = recorder_.last()) text += "; " + pose_text(*last);
    const double age_s = health.age_s(now);
    if (age_s > kSilent_s) text += "; nothing for " + decimals(age_s, 0) + " s";
    if (age_s < 0) text = "nothing has come yet" + others(connection);
    tell_refusal(connection);
    if (!connection.trouble().empty()) text += "; " + connection.trouble() + ", trying again";
    terminal_.status(text);
  }

  void end(const Connection& connection, bool recorded) {
    recorder_.close();
    terminal_.line(counts(connection) + ", " + amount(recorder_.valid_frames(), "valid frame") + " of " +
                   std::to_string(recorder_.frames()));
    if (!recorded) return;
    if (connection.health().packets() == 0) {
      std::error_code ignored;
      std::filesystem::remove(recorder_.files().front(), ignored);
      return terminal_.line("nothing was recorded");
    }
    for (const std::filesystem::path& file : recorder_.files()) terminal_.line("the recording: " + file.string());
  }

 private:
  // Once: who is refused is told nothing but that.
  void tell_refusal(const Connection& connection) {
    const std::string refusal = connection.call_refusal();
    if (refusal == refusal_) return;
    refusal_ = refusal;
    if (!refusal.empty()) terminal_.line("  the component refuses to send its telemetry: " + refusal);
  }
  static std::string others(const Connection& connection) {
    return connection.other_bytes() == 0 ? "" : ", " + amount(connection.other_bytes(), "byte") + " of no packet of this APID";
  }
  std::string counts(const Connection& connection) const {
    std::string text = amount(connection.health().packets(), "packet") + ", " + std::to_string(connection.health().missing()) + " missing";
    text += others(connection);
    if (unknown_ > 0) text += ", " + std::to_string(unknown_) + " not in the dictionary";
    return text;
  }
  std::string goes_on() const {
    return recorder_.files().back().empty() ? "" : "; the recording goes on in " + recorder_.files().back().string();
  }
  // Once: parameters that were set in flight, and those of a scenario, are none of the mission's.
  void compare_image() {
    const std::optional<PoseTelemetry>& last = recorder_.last();
    if (!image_ || !last) return;
    if (last->image_crc != *image_)
      terminal_.line("  the component flies image " + format("%08x", last->image_crc) + ", the mission compiles to " +
                     format("%08x", *image_) + ": limits and shape may be others");
    image_.reset();
  }

  LinkRecorder recorder_;
  std::optional<std::uint32_t> image_;
  std::string refusal_;  // that was told last
  Terminal terminal_;
  std::uint64_t frames_told_ = 0, unknown_ = 0;
};

void check_monitor_record(const MonitorArguments& options) {
  if (options.record.empty()) return;
  if (std::filesystem::path(options.record).extension() != ".mcap") throw InputError("--record " + options.record + ": expected FILE.mcap");
  refuse_same_files({options.record}, {options.mission, options.key});
  if (!options.force) refuse_to_replace({options.record}, "--force replaces it");
  check_writable(options.record);
}

void monitor(const MonitorArguments& options) {
  check_monitor_record(options);
  std::optional<Key> key;
  if (!options.key.empty()) key = load_key(options.key);
  std::optional<CompiledMission> mission;
  if (!options.mission.empty()) mission = compile_mission(options.mission, ModelCache::of_user_if(options.cached));
  LinkRecorderOptions recorder;
  recorder.file = options.record;
  recorder.head = link_recording_head(mission ? &*mission : nullptr, options.url, {{"commit", kCommit}});
  std::optional<std::uint32_t> image;
  if (mission) {
    recorder.target = &mission->mesh;
    image = image_crc(image_bytes(*mission, mission->source.parameters));
  }
  const std::atomic<bool>& interrupted = interruption();
  std::unique_ptr<Monitor> shown;
  Connection connection({options.url, options.listens, key, options.apid}, [&](const DecodedPacket& packet) { shown->take(packet); });
  LiveRun live(options.live, "telemetry of " + options.url, std::nullopt);
  recorder.tap = live.tap();
  shown = std::make_unique<Monitor>(std::move(recorder), image);
  const std::string place = options.listens ? connection.address() : options.url;  // port 0 has become one
  std::printf("telemetry by %s; Ctrl-C ends\n", place.c_str());
  (void)std::fflush(stdout);
  const auto begun = std::chrono::steady_clock::now();
  const auto over = [&] {
    const std::chrono::duration<double> passed = std::chrono::steady_clock::now() - begun;
    return interrupted || (options.seconds && passed.count() >= *options.seconds);
  };
  while (!over()) {
    connection.listen(kStatusEach_s, over);
    shown->tell(connection);
  }
  shown->end(connection, !options.record.empty());
  live.end("the monitor has ended");
}

}  // namespace

void add_monitor_command(CLI::App& app) {
  const auto options = std::make_shared<MonitorArguments>();
  CLI::App* command = app.add_subcommand("monitor", "watch a component's telemetry as it comes: checked, recorded, sent to viewers");
  command
      ->add_option("LINK", options->url, "udp://HOST:PORT, tcp://HOST:PORT, serial:DEVICE or unix:PATH of the component (docs/monitor.md)")
      ->required();
  command->add_option("--mission", options->mission, "mission that it flies: viewers are given the target's surface");
  command->add_option("--record", options->record, "FILE.mcap to write; after a reset of the component FILE-2.mcap follows");
  (void)add_live_option(*command, options->live);
  command->add_flag("--listen", options->listens, "wait at this address for a component that sends by itself, instead of calling it");
  command->add_option("--key", options->key,
                      "file with the key that the component asks commands to be signed with (64 hexadecimal digits)");
  add_apid(*command, options->apid);
  command->add_option("--seconds", options->seconds, "end after so long (until Ctrl-C)")->check(number_between(0.1, 1e9));
  command->add_flag("--force", options->force, "replace FILE.mcap");
  add_no_cache(*command, options->cached);
  command->callback([options] { monitor(*options); });
}

}  // namespace lasso::mdat
