#include "mdat/link/upload.hpp"

#include <algorithm>

#include "fsw/core/byte_codec.hpp"
#include "fsw/link/choices.hpp"
#include "mdat/common/errors.hpp"
#include "mdat/common/flight_image.hpp"
#include "mdat/common/progress_bar.hpp"
#include "mdat/common/text.hpp"
#include "mdat/link/decode.hpp"
#include "mdat/link/station.hpp"

namespace lasso::mdat {
namespace {

constexpr std::size_t kOnTheWay = 12;  // blocks that no answer has come for: more than a frame takes
constexpr int kIdleRounds = 3;         // without a block that arrives, before it is given up
constexpr double kPoll_s = 0.5;
constexpr double kCheckLeast_s = 30, kCheckPerByte_s = 40e-6;  // a component takes 8 us a byte

std::string number(std::uint64_t value) { return std::to_string(value); }

class Upload {
 public:
  Upload(ByteLink& link, const std::string& name, const std::vector<std::uint8_t>& image, const UploadOptions& options)
      : name_(name),
        image_(image),
        options_(options),
        station_(
            link, name, [this](const DecodedPacket& packet) { note(packet); }, options.apid) {
    if (options.key) station_.sign_with(*options.key);
    if (options.ended) station_.end_where(options.ended);
  }

  UploadEnd run() {
    if (is_ready(ask_for_report())) return options_.activate ? activate() : UploadEnd::kReady;
    command("begin_image", {{"bytes", number(image_.size())}, {"crc", number(image_crc(image_))}});
    load();
    command("check_image", {});
    wait_until_ready();
    return options_.activate ? activate() : UploadEnd::kReady;
  }

 private:
  struct Gap {
    std::uint32_t first = 0, blocks = 0;
  };
  // The packet `image`.
  struct Report {
    std::string state;
    std::uint32_t crc = 0;
    std::uint32_t blocks = 0, loaded = 0;
    std::vector<Gap> gaps;
  };

  [[noreturn]] void fail(const std::string& why) const { throw RunError(name_ + ": " + why); }

  void command(const std::string& command, const Station::Values& values, bool arm = false) {
    const CommandAnswer answer = station_.command(command_row(command), values, arm, options_.answer_s);
    if (answer.outcome == Outcome::kOpen)
      fail("no answer to " + command + " within " + real_text(options_.answer_s) + " s; is a component there?");
    if (answer.outcome != Outcome::kDone) fail(command + " is not carried out: " + answer.why);
  }

  bool is_ready(const Report& report) const { return report.state == "ready" && report.crc == image_crc(image_); }

  const Report& ask_for_report() {
    reported_ = false;
    command("report_structure", {{"structure", "image"}});
    if (!station_.listen(options_.answer_s, [this] { return reported_; })) fail("the packet image does not come");
    return report_;
  }

  // The component says which blocks it lacks, as long as there are any. What is lost on the way is sent with the next round.
  void load() {
    ProgressBar bar("upload", (image_.size() + kMemoryBlockBytes - 1) / kMemoryBlockBytes, "blocks");
    int idle = 0;
    for (std::uint32_t before = ask_for_report().loaded; report_.loaded < report_.blocks; before = report_.loaded) {
      arm_loading();
      const std::vector<Gap> gaps = report_.gaps;
      for (const Gap& gap : gaps) send(gap, bar);
      static_cast<void>(station_.listen(options_.answer_s, [this] { return station_.unanswered() == 0; }));
      check_answers();
      idle = ask_for_report().loaded > before ? 0 : idle + 1;
      if (idle >= kIdleRounds)
        fail(format("no block arrives any more, %u of %u have: the same command goes on from there", report_.loaded, report_.blocks));
      bar.show(report_.loaded);
    }
    bar.finish();
  }

  void arm_loading() {
    const PacketRow& row = command_row("load_memory");
    command("arm", {{"service", number(row.service)}, {"subservice", number(row.subservice)}, {"number", number(row.number)}});
  }

  void send(const Gap& gap, ProgressBar& bar) {
    for (std::uint32_t i = 0; i < gap.blocks; ++i) {
      if (!station_.listen(options_.answer_s, [this] { return station_.unanswered() < kOnTheWay; }))
        return;  // many are lost: ask what is missing
      check_answers();
      send_block(gap.first + i);
      bar.show(report_.loaded + ++sent_);
    }
  }

  void send_block(std::uint32_t block) {
    const std::size_t offset = std::size_t{block} * kMemoryBlockBytes;
    const std::size_t bytes = std::min(kMemoryBlockBytes, image_.size() - offset);
    std::string data;
    for (std::size_t i = 0; i < kMemoryBlockBytes; ++i) data += (i > 0 ? "," : "") + number(i < bytes ? image_[offset + i] : 0U);
    station_.send(command_row("load_memory"),
                  {{"area", "other_image"}, {"offset", number(offset)}, {"bytes", number(bytes)}, {"data", data}});
  }

  void check_answers() {
    const std::string why = station_.failure();
    if (!why.empty()) fail("a block is not taken: " + why);
  }

  void wait_until_ready() {
    ProgressBar bar("check", 1, "image");
    double left_s = kCheckLeast_s + kCheckPerByte_s * static_cast<double>(image_.size());
    const auto over = [this] { return ready_ || !refused_.empty(); };
    while (!station_.listen(kPoll_s, over)) {
      left_s -= kPoll_s;
      if (left_s < 0) fail("neither image_ready nor image_refused comes; the other buffer is " + ask_for_report().state);
      look_at(ask_for_report().state);  // an event may be lost
    }
    if (!refused_.empty()) fail("the component refuses the image: " + refused_);
    bar.finish();
  }

  void look_at(const std::string& state) {
    if (state == "ready") ready_ = true;
    if (state == "refused" && refused_.empty()) refused_ = "see the packet image";
  }

  UploadEnd activate() {
    command("activate_image", {{"crc", number(image_crc(image_))}}, true);
    const auto over = [this] { return confirmed_ || taken_back_; };
    if (!station_.listen(options_.answer_s, [&] { return active_ || over(); })) fail("the image does not become active");
    if (!station_.listen(options_.trial_s, over)) return UploadEnd::kOnTrial;
    if (taken_back_) fail("the image was active, failed its first scans, and was taken back: the one before is active again");
    return UploadEnd::kConfirmed;
  }

  void note(const DecodedPacket& packet) {
    const std::string kind = packet.name();
    if (kind == "image") note_report(packet);
    const bool ours = static_cast<std::uint32_t>(item_value(packet, "image_crc")) == image_crc(image_);
    if (kind == "image_ready" && ours) ready_ = true;
    if (kind == "image_refused")
      refused_ = format("%s, table %.0f, record %.0f", item_name(packet, "status").c_str(), item_value(packet, "table"),
                        item_value(packet, "record"));
    if (kind == "image_confirmed" && ours) confirmed_ = true;
    if (kind != "image_active") return;
    active_ = ours;
    taken_back_ = !ours && item_value(packet, "rolled_back") > 0;
  }

  void note_report(const DecodedPacket& packet) {
    Report report;
    report.state = item_name(packet, "other_state");
    report.crc = static_cast<std::uint32_t>(item_value(packet, "other_crc"));
    report.blocks = static_cast<std::uint32_t>(item_value(packet, "blocks"));
    report.loaded = static_cast<std::uint32_t>(item_value(packet, "loaded"));
    for (std::size_t i = 0; i < kMissingRuns; ++i) {
      report.gaps.push_back({static_cast<std::uint32_t>(item_value(packet, "missing_first", i)),
                             static_cast<std::uint32_t>(item_value(packet, "missing_blocks", i))});
    }
    report_ = report;
    reported_ = true;
    sent_ = 0;
  }

  std::string name_;
  const std::vector<std::uint8_t>& image_;
  const UploadOptions& options_;
  Report report_;
  bool reported_ = false;
  std::size_t sent_ = 0;  // blocks since the last report
  bool ready_ = false, active_ = false, confirmed_ = false, taken_back_ = false;
  std::string refused_;
  Station station_;  // last: its listener uses all of the above
};

// Before anything is sent.
void check_blocks(const std::vector<std::uint8_t>& image, std::uint16_t apid) {
  for (std::size_t offset = 0; offset < image.size(); offset += kMemoryBlockBytes) {
    const HeldCommand held = held_command({image.data() + offset, std::min(kMemoryBlockBytes, image.size() - offset)}, apid);
    if (held.name == nullptr) continue;
    throw InputError(
        format("the image holds a command (%s) at byte %zu: were that block damaged on its way, the component would carry it "
               "out. A mission with another version or cell size has other bytes there",
               held.name, offset + held.offset));
  }
}

}  // namespace

std::uint32_t image_crc(const std::vector<std::uint8_t>& image) {
  const std::size_t end = image.size() - (has_signature(image) ? kImageSignatureBytes : 0);
  return ByteReader(ConstBytes(image.data() + end - 4, 4)).u32();
}

std::vector<std::uint8_t> image_to_send(const std::vector<std::uint8_t>& image, const std::optional<Key>& key) {
  return key && key->number == 0 && !has_signature(image) ? sign_image(image, *key) : image;
}

void check_signature(const std::string& name, const std::vector<std::uint8_t>& image, const std::optional<Key>& key) {
  const std::string remedy = "; mdat mission sign or compile, with the --key that the component has, signs it";
  if (!key) return;
  if (key->number != 0 && !has_signature(image))
    throw InputError(name + format(": is not signed, and key %u signs commands alone", key->number) + remedy);
  if (key->number == 0 && has_signature(image) && !is_signed_by(image, *key))
    throw InputError(name + ": is signed with another key" + remedy);
}

UploadEnd upload(ByteLink& link, const std::string& name, const std::vector<std::uint8_t>& image, const UploadOptions& options) {
  if (image.size() < kMemoryBlockBytes)
    throw InputError(format("%zu bytes are no flight image; mdat mission compile makes one", image.size()));
  check_blocks(image, options.apid);
  return Upload(link, name, image, options).run();
}

}  // namespace lasso::mdat
