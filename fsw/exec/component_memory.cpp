// What the component does with mission images in flight, and with memory that must not change.
#include "fsw/core/crc.hpp"
#include "fsw/exec/component.hpp"
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

// All but what the component counts.
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

LoadFailure Component::load_image(Bytes image) {
  const Running running(identity_);
  if (executive_.begun()) return {Status::kBadOrder, 0, 0, "the component has begun"};
  return images_.start(image, acquisition_.sensors());
}

LoadFailure Component::load_stored_image() {
  const Running running(identity_);
  if (executive_.begun()) return {Status::kBadOrder, 0, 0, "the component has begun"};
  return images_.start_stored(acquisition_.sensors());
}

Status Component::use_memory(const BoardMemory& memory) {
  if (executive_.begun()) return Status::kBadOrder;
  Status status = images_.use_buffers(memory.image_buffers[0], memory.image_buffers[1]);
  if (status == Status::kOk) status = images_.watch_code(memory.code);
  if (status != Status::kOk || memory.store == nullptr) return status;
  store_ = memory.store;
  images_.use_store(*memory.store);
  log_.use(*memory.store);
  return status;
}

ImageRefusal Component::activate_image(std::uint32_t crc) {
  const ImageRefusal refusal = images_.can_activate(crc);
  if (refusal != ImageRefusal::kNone) return refusal;
  image_request_ = ImageRequest::kActivate;
  requested_crc_ = crc;
  return refusal;
}

ImageRefusal Component::roll_back_image() {
  const ImageRefusal refusal = images_.can_roll_back();
  if (refusal == ImageRefusal::kNone) image_request_ = ImageRequest::kRollBack;
  return refusal;
}

void Component::tend_memory() {
  log_.step();
  const ImageState before = images_.other().state();
  images_.step(acquisition_.sensors());
  const ImageSlot& other = images_.other();
  if (other.state() != before && other.state() == ImageState::kReady) {
    events_.raise<EventId::kImageReady>(other.view(0).mission.image_crc, images_.other_stored());
  }
  if (other.state() != before && other.state() == ImageState::kRefused) {
    events_.raise<EventId::kImageRefused>(other.result().status, other.result().table, other.result().record);
  }
  static_cast<void>(images_.scrub(executive_.slot_us()));  // not by the mission's parameters, which it looks after
}

// An estimate that overran still reads the active image: what would change it waits.
void Component::pass_memory_boundary() {
  if (!estimation_.idle()) return;
  if (images_.found()) {
    const MemoryFinding finding = images_.repair();
    if (finding.repaired) {
      ++memory_.repairs;
      parameters_due_ = true;
    }
    events_.raise<EventId::kMemoryCorrupt>(finding.area, finding.chunk, finding.repaired);
    seen_.add(fault_of(finding, images_.active_number()));
  }
  judge_image();
  const ImageRequest request = image_request_;
  image_request_ = ImageRequest::kNone;
  if (request != ImageRequest::kNone && may_change(request)) change_image(request == ImageRequest::kRollBack);
}

// What was ready when the command came may have decayed since, or given place to another image.
bool Component::may_change(ImageRequest request) const {
  const bool back = request == ImageRequest::kRollBack;
  return (back ? images_.can_roll_back() : images_.can_activate(requested_crc_)) == ImageRefusal::kNone;
}

// A track that is lost shows no more scans.
void Component::judge_image() {
  const bool bearing = track_.mode == TrackingMode::kBearing && before_trial_.filter.initialised;
  if (track_.mode == TrackingMode::kLost || bearing) trial_.note_lost();
  const TrialVerdict verdict = trial_.verdict();
  if (verdict == TrialVerdict::kPassed) {
    trial_.end();
    images_.confirm();
    events_.raise<EventId::kImageConfirmed>(mission().image_crc);
  }
  if (verdict != TrialVerdict::kFailed) return;
  trial_.end();
  if (images_.can_roll_back() == ImageRefusal::kNone) image_request_ = ImageRequest::kRollBack;
}

// The scan that is on its way was planned by the image that goes, and is not reported.
void Component::change_image(bool back) {
  const MissionView& present = images_.view(0);
  const MissionView& next = images_.other().view(0);
  const bool kept = keeps_track(present.mission, present.parts, next.mission, next.parts) && !properties(track_.mode).searches;
  const bool undone = back && kept && !images_.confirmed() && before_trial_.filter.initialised;
  const auto scans = static_cast<std::uint32_t>(present.mission.parameters.image_trial_scans);
  const auto valid_min = static_cast<std::uint32_t>(present.mission.parameters.image_trial_valid_min);
  images_.swap();
  const std::uint32_t choices = acquisition_.choices();
  acquisition_.set_choices(back ? choices_before_ : 0);  // an image that comes back has what was selected with it
  choices_before_ = choices;
  parameters_due_ = true;  // what was changed since it was converted
  ++memory_.activations;
  if (back) ++memory_.roll_backs;
  trial_.begin(scans, valid_min);
  if (back || scans == 0) trial_.end();
  if (back || scans == 0) images_.confirm();
  track_.check = StartCheck{};  // a search of the other image's tables
  if (undone) take_up_again();
  before_trial_ = TrackState{};
  if (kept && !back) before_trial_ = track_;
  leave_track();
  if (!kept) leave_target();
  events_.raise<EventId::kImageActive>(mission().image_crc, back, kept);
}

// What the image that failed made of the track is forgotten; what was commanded since has made before_trial_ forgotten instead. The mode is
// its own: a track that was lost is looked for again.
void Component::take_up_again() {
  track_.filter = before_trial_.filter;
  track_.parts = before_trial_.parts;
  track_.missed = 0;
  if (track_.mode == TrackingMode::kLost) take(ModeEvent::kReacquire);
}

// What was known of the target, and of the sensors, is of no use with an image of another one.
void Component::leave_target() {
  sources_ = InitialPoseSources{};
  chooser_ = SensorChooser{};
  sensor_ = SensorChoice{};
  track_.filter = FilterState{};
  track_.sensor = 0;  // the other image may have fewer
  if (track_.mode == TrackingMode::kSafe || !has_transition(track_.mode, ModeEvent::kStop)) return;
  note_change({track_.mode, ModeEvent::kStop, next_mode(track_.mode, ModeEvent::kStop)});
  change_mode(ModeEvent::kStop, track_);
}

ServiceRefusal Component::serve_memory(const Command& command, TimeUs now_us) {
  if (command.kind == CommandKind::kLoadMemory) return load_memory(command.load);
  if (command.kind == CommandKind::kDumpMemory) return dump_memory(command.memory, now_us);
  if (command.kind == CommandKind::kCheckMemory) return check_memory(command.memory, now_us);
  if (command.kind == CommandKind::kBeginImage) return refusal_of(open_image(command.image.bytes, command.image.crc));
  if (command.kind == CommandKind::kActivateImage) return refusal_of(activate_image(command.image.crc));
  return refusal_of(command.kind == CommandKind::kCheckImage ? check_image() : roll_back_image());
}

ServiceRefusal Component::load_memory(const LoadCommand& load) {
  if (load.area != static_cast<std::uint8_t>(MemoryArea::kOtherImage)) return ServiceRefusal::kNotAllowed;
  return refusal_of(put_image(load.offset, ConstBytes(load.data).first(load.bytes)));
}

// Empty: there is nothing.
ConstBytes Component::memory_of(std::uint8_t area) const {
  if (area == static_cast<std::uint8_t>(MemoryArea::kOtherImage)) return images_.other().image();
  return area == static_cast<std::uint8_t>(MemoryArea::kActiveImage) ? images_.active().sealed_image() : images_.code();
}

ServiceRefusal Component::find_memory(const MemoryCommand& range, std::size_t most, ConstBytes& bytes) const {
  const ConstBytes area = memory_of(range.area);
  if (range.bytes > most) return ServiceRefusal::kTooLong;
  if (range.offset >= area.size() || range.bytes > area.size() - range.offset) return ServiceRefusal::kOutside;
  bytes = area.subspan(range.offset, range.bytes);
  return ServiceRefusal::kNone;
}

ServiceRefusal Component::dump_memory(const MemoryCommand& range, TimeUs now_us) {
  ConstBytes bytes;
  const ServiceRefusal refusal = find_memory(range, kMemoryBlockBytes, bytes);
  if (refusal != ServiceRefusal::kNone) return refusal;
  LoadCommand dumped{range.area, range.offset, static_cast<std::uint8_t>(range.bytes), {}};
  for (std::size_t i = 0; i < bytes.size(); ++i) dumped.data[i] = bytes[i];
  downlink_.send({kServiceMemory, kSubserviceDumped}, kDumped, dumped, now_us);
  return refusal;
}

ServiceRefusal Component::check_memory(const MemoryCommand& range, TimeUs now_us) {
  ConstBytes bytes;
  const ServiceRefusal refusal = find_memory(range, kChunkBytes, bytes);
  if (refusal == ServiceRefusal::kNone) {
    downlink_.send({kServiceMemory, kSubserviceChecked}, kChecked, MemorySum{range.area, range.offset, range.bytes, crc32c(bytes)}, now_us);
  }
  return refusal;
}

// At a boundary, when there is news.
void Component::send_image(TimeUs now_us) {
  memory_.other_state = static_cast<std::uint8_t>(images_.other().state());
  memory_.confirmed = images_.confirmed() ? 1 : 0;
  memory_.findings = images_.scrub_state().findings();
  if (!housekeeping_.due(kImageStructureId, differ(memory_, memory_told_))) return;
  memory_told_ = memory_;
  ImageTelemetry report = describe(images_);
  report.activations = memory_.activations;
  report.roll_backs = memory_.roll_backs;
  report.repairs = memory_.repairs;
  std::uint8_t packet[kMaxImagePacketBytes];
  const PacketHeader header = downlink_.next_header(kHousekeepingReport, now_us);
  downlink_.send({packet, encode_image(report, header, Bytes(packet))});
}

}  // namespace lasso
