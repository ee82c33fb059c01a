#include "fsw/exec/image_service.hpp"

#include "fsw/core/crc.hpp"
#include "fsw/link/memory_rows.hpp"
#include "fsw/mission/mission_fit.hpp"

namespace lasso {
namespace {

// What cannot be repaired in the other buffer is refused, and nobody uses it.
Fault fault_of(const MemoryFinding& finding, std::uint8_t active) {
  if (finding.area == ScrubArea::kCode) return Fault::kCodeCorrupt;
  const bool in_use = static_cast<std::uint8_t>(finding.area) / 2 == active;
  return in_use && !finding.repaired ? Fault::kImageLost : Fault::kImageCorrupt;
}

constexpr auto kDumped = codec_of(memory_rows::kDumped);
constexpr auto kChecked = codec_of(memory_rows::kChecked);
static_assert(kMemoryBlockBytes == kLoadBlockBytes, "a command carries a block");

// Both count their reasons in the same order.
constexpr ServiceRefusal refusal_of(ImageRefusal refusal) {
  constexpr auto kBefore = static_cast<std::uint8_t>(ServiceRefusal::kNoImageBuffer) - static_cast<std::uint8_t>(ImageRefusal::kNoBuffer);
  if (refusal == ImageRefusal::kNone) return ServiceRefusal::kNone;
  return static_cast<ServiceRefusal>(static_cast<std::uint8_t>(refusal) + kBefore);
}
static_assert(refusal_of(ImageRefusal::kNotAllowed) == ServiceRefusal::kNotAllowed, "the same order");
static_assert(refusal_of(ImageRefusal::kBusy) == ServiceRefusal::kImageBusy, "the same order");

bool differ(const MemoryCounts& a, const MemoryCounts& b) {
  const bool images = a.other_state != b.other_state || a.activations != b.activations || a.confirmed != b.confirmed;
  return images || a.findings != b.findings;
}

void describe_missing(const LoadMap& map, ImageTelemetry& out) {
  out.blocks = map.blocks();
  out.loaded = map.loaded();
  std::uint32_t from = 0;
  for (std::size_t i = 0; i < kMissingRuns; ++i) {
    const BlockRun run = map.missing(from);
    out.missing_first[i] = run.first;
    out.missing_blocks[i] = run.count;
    from = run.first + run.count;
  }
}

// All but what the service counts.
ImageTelemetry describe(const ImageKeeper& images) {
  ImageTelemetry out;
  const ImageSlot& other = images.other();
  out.active_crc = images.view(0).mission.image_crc;
  out.active_buffer = images.active_number();
  out.confirmed = images.confirmed() ? 1 : 0;
  out.active_stored = static_cast<std::uint8_t>(images.active_stored());
  out.other_state = static_cast<std::uint8_t>(other.state());
  out.other_bytes = other.bytes();
  out.other_crc = images.opened_crc();
  out.other_stored = images.other_stored() ? 1 : 0;
  describe_missing(images.map(), out);
  out.status = static_cast<std::uint8_t>(other.result().status);
  out.table = other.result().table;
  out.record = other.result().record;
  out.scrub_passes = images.scrub_state().passes();
  out.scrub_pass_us = static_cast<std::uint32_t>(images.scrub_pass_us());
  out.findings = images.scrub_state().findings();
  return out;
}

}  // namespace

ImageRefusal ImageService::activate(std::uint32_t crc) {
  const ImageRefusal refusal = images_.can_activate(crc);
  if (refusal != ImageRefusal::kNone) return refusal;
  request_ = Request::kActivate;
  requested_crc_ = crc;
  return refusal;
}

ImageRefusal ImageService::roll_back() {
  const ImageRefusal refusal = images_.can_roll_back();
  if (refusal == ImageRefusal::kNone) request_ = Request::kRollBack;
  return refusal;
}

void ImageService::run_slot() {
  context_.telemetry.stored_log().step();
  const ImageState before = images_.other().state();
  images_.step(acquisition_.sensors());
  const ImageSlot& other = images_.other();
  if (other.state() != before && other.state() == ImageState::kReady) {
    context_.telemetry.raise<EventId::kImageReady>(other.view(0).mission.image_crc, images_.other_stored());
  }
  if (other.state() != before && other.state() == ImageState::kRefused) {
    context_.telemetry.raise<EventId::kImageRefused>(other.result().status, other.result().table, other.result().record);
  }
  static_cast<void>(images_.scrub(context_.executive.slot_us()));  // not by the mission's parameters, which it looks after
}

void ImageService::pass_boundary() {
  if (images_.found()) repair();
  judge();
  const Request request = request_;
  request_ = Request::kNone;
  if (request != Request::kNone && may_change(request)) change(request == Request::kRollBack);
}

void ImageService::repair() {
  const MemoryFinding finding = images_.repair();
  if (finding.repaired) {
    ++counts_.repairs;
    parameters_.make_anew();
  }
  context_.telemetry.raise<EventId::kMemoryCorrupt>(finding.area, finding.chunk, finding.repaired);
  context_.health.see(fault_of(finding, images_.active_number()));
}

// What was ready when the command came may have decayed since, or given place to another image.
bool ImageService::may_change(Request request) const {
  const bool back = request == Request::kRollBack;
  return (back ? images_.can_roll_back() : images_.can_activate(requested_crc_)) == ImageRefusal::kNone;
}

// A track that is lost shows no more scans.
void ImageService::judge() {
  const bool bearing = modes_.mode() == TrackingMode::kBearing && modes_.remembers_track();
  if (modes_.mode() == TrackingMode::kLost || bearing) trial_.note_lost();
  const TrialVerdict verdict = trial_.verdict();
  if (verdict == TrialVerdict::kPassed) {
    trial_.end();
    images_.confirm();
    context_.telemetry.raise<EventId::kImageConfirmed>(mission().image_crc);
  }
  if (verdict != TrialVerdict::kFailed) return;
  trial_.end();
  if (images_.can_roll_back() == ImageRefusal::kNone) request_ = Request::kRollBack;
}

// The scan that is on its way was planned by the image that goes, and is not reported.
void ImageService::change(bool back) {
  const MissionView& present = images_.view(0);
  const MissionView& next = images_.other().view(0);
  const bool searches = properties(modes_.mode()).searches;
  const bool kept = keeps_track(present.mission, present.parts, next.mission, next.parts) && !searches;
  const bool undone = back && kept && !images_.confirmed() && modes_.remembers_track();
  images_.swap();
  const std::uint32_t choices = acquisition_.choices();
  acquisition_.set_choices(back ? choices_before_ : 0);  // an image that comes back has what was selected with it
  choices_before_ = choices;
  parameters_.make_anew();
  ++counts_.activations;
  if (back) ++counts_.roll_backs;
  begin_trial(back, present.mission.parameters);
  if (undone) modes_.restore_track();
  modes_.take_over_track(kept, !back);
  context_.telemetry.raise<EventId::kImageActive>(mission().image_crc, back, kept);
}

// By the parameters of the image before. One that comes back, or has nothing to show, is confirmed at once.
void ImageService::begin_trial(bool back, const MissionParameters& before) {
  const auto scans = static_cast<std::uint32_t>(before.image_trial_scans);
  trial_.begin(scans, static_cast<std::uint32_t>(before.image_trial_valid_min));
  if (!back && scans != 0) return;
  trial_.end();
  images_.confirm();
}

ServiceRefusal ImageService::serve(const Command& command, TimeUs now_us) {
  if (command.kind == CommandKind::kLoadMemory) return load(command.load);
  if (command.kind == CommandKind::kDumpMemory) return dump(command.memory, now_us);
  if (command.kind == CommandKind::kCheckMemory) return check(command.memory, now_us);
  if (command.kind == CommandKind::kBeginImage) return refusal_of(images_.open(command.image.bytes, command.image.crc));
  if (command.kind == CommandKind::kActivateImage) return refusal_of(activate(command.image.crc));
  return refusal_of(command.kind == CommandKind::kCheckImage ? images_.begin_check() : roll_back());
}

ServiceRefusal ImageService::load(const LoadCommand& load) {
  if (load.area != static_cast<std::uint8_t>(MemoryArea::kOtherImage)) return ServiceRefusal::kNotAllowed;
  return refusal_of(images_.put(load.offset, ConstBytes(load.data).first(load.bytes)));
}

// Empty: there is nothing.
ConstBytes ImageService::memory_of(std::uint8_t area) const {
  if (area == static_cast<std::uint8_t>(MemoryArea::kOtherImage)) return images_.other().image();
  return area == static_cast<std::uint8_t>(MemoryArea::kActiveImage) ? images_.active().sealed_image() : images_.code();
}

ServiceRefusal ImageService::find(const MemoryCommand& range, std::size_t most, ConstBytes& bytes) const {
  const ConstBytes area = memory_of(range.area);
  if (range.bytes > most) return ServiceRefusal::kTooLong;
  if (range.offset >= area.size() || range.bytes > area.size() - range.offset) return ServiceRefusal::kOutside;
  bytes = area.subspan(range.offset, range.bytes);
  return ServiceRefusal::kNone;
}

ServiceRefusal ImageService::dump(const MemoryCommand& range, TimeUs now_us) {
  ConstBytes bytes;
  const ServiceRefusal refusal = find(range, kMemoryBlockBytes, bytes);
  if (refusal != ServiceRefusal::kNone) return refusal;
  LoadCommand dumped{range.area, range.offset, static_cast<std::uint8_t>(range.bytes), {}};
  for (std::size_t i = 0; i < bytes.size(); ++i) dumped.data[i] = bytes[i];
  context_.telemetry.downlink().send({kServiceMemory, kSubserviceDumped}, kDumped, dumped, now_us);
  return refusal;
}

ServiceRefusal ImageService::check(const MemoryCommand& range, TimeUs now_us) {
  ConstBytes bytes;
  const ServiceRefusal refusal = find(range, kChunkBytes, bytes);
  if (refusal != ServiceRefusal::kNone) return refusal;
  const MemorySum sum{range.area, range.offset, range.bytes, crc32c(bytes)};
  context_.telemetry.downlink().send({kServiceMemory, kSubserviceChecked}, kChecked, sum, now_us);
  return refusal;
}

void ImageService::send(TimeUs now_us) {
  counts_.other_state = static_cast<std::uint8_t>(images_.other().state());
  counts_.confirmed = images_.confirmed() ? 1 : 0;
  counts_.findings = images_.scrub_state().findings();
  if (!context_.telemetry.housekeeping().due(kImageStructureId, differ(counts_, reported_))) return;
  reported_ = counts_;
  ImageTelemetry report = describe(images_);
  report.activations = counts_.activations;
  report.roll_backs = counts_.roll_backs;
  report.repairs = counts_.repairs;
  context_.telemetry.send_structure<kMaxImagePacketBytes, encode_image>(report, now_us);
}

}  // namespace lasso
