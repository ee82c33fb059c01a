#include "fsw/mission/image_keeper.hpp"

#include "fsw/core/byte_codec.hpp"
#include "fsw/core/crc.hpp"
#include "fsw/mission/mission_fit.hpp"
#include "fsw/mission/stored_record.hpp"

namespace lasso {
namespace {

constexpr std::size_t kPieceBytes = 256;  // read from the store at a time for a repair

std::uint32_t crc_at_end(ConstBytes image) { return ByteReader(image.subspan(image.size() - 4, 4)).u32(); }

bool is_there(ConstBytes bytes) { return bytes.data() != nullptr || bytes.empty(); }

bool usable(ConstBytes buffer) { return is_there(buffer) && reinterpret_cast<std::uintptr_t>(buffer.data()) % 8 == 0; }

// Do they share a byte?
bool overlap(ConstBytes a, ConstBytes b) {
  const auto at_a = reinterpret_cast<std::uintptr_t>(a.data()), at_b = reinterpret_cast<std::uintptr_t>(b.data());
  return !a.empty() && !b.empty() && at_a < at_b + b.size() && at_b < at_a + a.size();
}

}  // namespace

Status ImageKeeper::use_buffers(Bytes first, Bytes second) {
  if (first.size() != second.size() || first.size() > kMaxImageBytes || !usable(first) || !usable(second)) return Status::kBadValue;
  if (overlap(first, second)) return Status::kBadValue;
  slots_[0].use(first);
  slots_[1].use(second);
  return Status::kOk;
}

Status ImageKeeper::watch_code(ConstBytes code) {
  if (code.size() > kMaxCodeChunks * kChunkBytes) return Status::kOverCapacity;
  code_ = code;
  for (std::size_t i = 0; i * kChunkBytes < code.size(); ++i) code_sums_[i] = crc32c(chunk_of(code, i));
  return Status::kOk;
}

void ImageKeeper::use_parameters(const ParameterArea& changed) {
  for (ImageSlot& slot : slots_) slot.use_parameters(changed);
}

void ImageKeeper::use_authenticator(Authenticator& authenticator) {
  for (ImageSlot& slot : slots_) slot.use_authenticator(authenticator);
}

void ImageKeeper::accept_unsigned() {
  for (ImageSlot& slot : slots_) slot.accept_unsigned();
}

LoadFailure ImageKeeper::start(Bytes image, std::size_t sensors) {
  started_ = false;  // whatever follows, the image that was loaded before may have been overwritten
  if (!is_there(image)) return failure(Status::kBadValue, "image buffer is null");
  select(!image.empty() && image.data() == slots_[1].buffer().data() ? 1 : 0);
  ImageSlot& slot = slots_[active_index()];
  if (overlap(image, spare().buffer())) return failure(Status::kBadValue, "the image lies in the buffer of the other one, too");
  if (image.data() != slot.buffer().data() || image.size() > slot.buffer().size()) slot.use(image);
  slot.open(static_cast<std::uint32_t>(image.size()));
  slot.begin_check();
  while (slot.state() == ImageState::kChecking) slot.step(kAllWords, sensors);
  stored_bytes_ = 0;
  while (slot.state() == ImageState::kStoring) store_slice(active_index());
  slot.step(kAllWords, sensors);
  slot.step(kAllWords, sensors);
  started_ = slot.state() == ImageState::kReady;
  if (started_) confirm();
  return slot.result();
}

// The one that was selected last, or else the other one; where both are right, the other one is the one before.
LoadFailure ImageKeeper::start_stored(std::size_t sensors) {
  started_ = false;
  const Newer newer = store_ == nullptr ? Newer::kNone : newer_of(*store_, area_of(0), area_of(1));
  if (newer == Newer::kNone) return failure(Status::kNoData, "no image in the store");
  const auto first = static_cast<std::size_t>(newer);
  const bool first_right = start_from(first, sensors), second_right = start_from(1 - first, sensors);
  select(first_right ? first : 1 - first);
  started_ = first_right || second_right;
  before_ = first_right && second_right;
  confirmed_ = true;
  return slots_[active_index()].result();
}

bool ImageKeeper::start_from(std::size_t number, std::size_t sensors) {
  StoredHeader header;
  ImageSlot& slot = slots_[number];
  if (read_header(*store_, area_of(number), header) != Status::kOk || header.sequence == 0 || header.bytes > slot.buffer().size()) {
    slot.refuse(Status::kNoData, "no image in the area of the store");
    return false;
  }
  slot.open(header.bytes);
  if (read_record(*store_, area_of(number), 0, slot.image()) != Status::kOk) {
    slot.refuse(Status::kNoData, "the store cannot be read");
    return false;
  }
  slot.run(sensors);
  stored_[number] = slot.state() == ImageState::kReady;
  stored_sums_[number] = header.crc;
  return stored_[number];
}

ImageRefusal ImageKeeper::open(std::uint32_t bytes, std::uint32_t crc) {
  ImageSlot& slot = spare();
  if (slot.buffer().empty()) return ImageRefusal::kNoBuffer;
  if (bytes > slot.buffer().size() || bytes < kLoadBlockBytes) return ImageRefusal::kTooLong;
  const bool works = slot.state() >= ImageState::kStoring && slot.state() <= ImageState::kSealing;
  if (works || slot.state() == ImageState::kChecking) return ImageRefusal::kBusy;
  if (!confirmed_ && slot.state() == ImageState::kReady) return ImageRefusal::kBusy;  // it may be wanted back
  if (slot.state() == ImageState::kLoading && slot.bytes() == bytes && crc_ == crc) return ImageRefusal::kNone;
  slot.open(bytes);
  map_.begin((bytes + kLoadBlockBytes - 1) / kLoadBlockBytes);
  crc_ = crc;
  before_ = false;
  stored_[1 - active_index()] = false;
  scrub_.forget(active_index() == 0 ? ScrubArea::kImage1 : ScrubArea::kImage0);
  scrub_.forget(active_index() == 0 ? ScrubArea::kViews1 : ScrubArea::kViews0);
  return ImageRefusal::kNone;
}

ImageRefusal ImageKeeper::put(std::uint32_t offset, ConstBytes part) {
  const ImageSlot& slot = spare();
  if (slot.state() != ImageState::kLoading) return ImageRefusal::kNotOpen;
  if (offset > slot.bytes() || part.size() > slot.bytes() - offset) return ImageRefusal::kOutside;
  const std::size_t end = offset + part.size();
  const bool whole = offset % kLoadBlockBytes == 0 && (end % kLoadBlockBytes == 0 || end == slot.bytes());
  if (!whole) return ImageRefusal::kNotWhole;
  spare().repair(offset, part);
  for (std::uint32_t block = offset / kLoadBlockBytes; std::size_t{block} * kLoadBlockBytes < end; ++block) map_.mark(block);
  return ImageRefusal::kNone;
}

ImageRefusal ImageKeeper::begin_check() {
  ImageSlot& slot = spare();
  if (slot.state() != ImageState::kLoading) return ImageRefusal::kNotOpen;
  if (!map_.complete()) return ImageRefusal::kIncomplete;
  if (crc_at_end(slot.body()) != crc_) return ImageRefusal::kOtherImage;
  slot.begin_check();
  stored_bytes_ = 0;
  return ImageRefusal::kNone;
}

ImageRefusal ImageKeeper::can_activate(std::uint32_t crc) const {
  if (other().state() != ImageState::kReady) return ImageRefusal::kNotReady;
  if (other().view(0).mission.image_crc != crc) return ImageRefusal::kOtherImage;
  return other_fits() ? ImageRefusal::kNone : ImageRefusal::kDoesNotFit;
}

// The store may hold two images that were never active one after the other.
ImageRefusal ImageKeeper::can_roll_back() const {
  if (!before_ || other().state() != ImageState::kReady) return ImageRefusal::kNotReady;
  return other_fits() ? ImageRefusal::kNone : ImageRefusal::kDoesNotFit;
}

bool ImageKeeper::other_fits() const { return fault_of_change(view(0).mission, other().view(0).mission) == nullptr; }

void ImageKeeper::select(std::size_t number) {
  active_ = number;
  selected_.set(static_cast<std::uint32_t>(number));
}

bool ImageKeeper::keep_selection() {
  const std::size_t voted = active_index();
  const bool right = selected_.agreed() && voted == active_ && slots_[voted].state() == ImageState::kReady;
  select(voted);
  slots_[voted].keep_ready();
  return right;
}

void ImageKeeper::swap() {
  invariant(other().state() == ImageState::kReady, "an image that is not ready becomes active");
  select(1 - active_index());
  before_ = true;
  confirmed_ = false;
}

// Nothing is written where the store would select it anyway. A header that cannot be written leaves the selection as it is.
void ImageKeeper::confirm() {
  confirmed_ = true;
  const std::size_t number = active_index();
  if (store_ == nullptr || !stored_[number]) return;
  if (newer_of(*store_, area_of(0), area_of(1)) == static_cast<Newer>(number)) return;
  const std::uint32_t sequence = next_sequence(*store_, area_of(0), area_of(1));
  stored_[number] = write_header(*store_, area_of(number), {sequence, active().bytes(), stored_sums_[number]}) == Status::kOk;
}

void ImageKeeper::step(std::size_t sensors) {
  if (spare().state() == ImageState::kStoring) return store_slice(1 - active_index());
  spare().step(kImageWordsPerSlot, sensors);
}

// Whether the image may take the place of what its area holds: not of the only one that the next start could take.
bool ImageKeeper::may_store(std::size_t number) const {
  if (store_ == nullptr || store_->size(area_of(number)) < kStoredHeaderBytes + slots_[number].bytes()) return false;
  if (!started_ || (confirmed_ && stored_[1 - number])) return true;
  return newer_of(*store_, area_of(0), area_of(1)) != static_cast<Newer>(number);  // what a start would take stays
}

// A write: of the cleared header, of a piece, of the new header.
void ImageKeeper::store_slice(std::size_t number) {
  const ConstBytes image = slots_[number].image();
  if (stored_bytes_ == 0) {
    if (!may_store(number) || clear_header(*store_, area_of(number)) != Status::kOk) return end_storing(number, false);
    stored_sums_[number] = 0;
  }
  if (stored_bytes_ == image.size()) {
    const StoredHeader header{0, static_cast<std::uint32_t>(image.size()), stored_sums_[number]};
    return end_storing(number, write_header(*store_, area_of(number), header) == Status::kOk);
  }
  const std::size_t left = image.size() - stored_bytes_;
  const ConstBytes piece = image.subspan(stored_bytes_, left < kMaxStoreWriteBytes ? left : kMaxStoreWriteBytes);
  if (write_record(*store_, area_of(number), stored_bytes_, piece) != Status::kOk) return end_storing(number, false);
  stored_sums_[number] = crc32c(piece, stored_sums_[number]);
  stored_bytes_ += piece.size();
}

void ImageKeeper::end_storing(std::size_t number, bool stored) {
  stored_[number] = stored;
  slots_[number].begin_conversion();
}

void ImageKeeper::take_places(ScrubPlace (&places)[kScrubAreas]) const {
  for (std::size_t i = 0; i < 2; ++i) {
    places[2 * i] = {slots_[i].sealed_image(), slots_[i].image_sums()};
    places[2 * i + 1] = {slots_[i].sealed_views(), slots_[i].views_sums()};
  }
  places[static_cast<std::size_t>(ScrubArea::kCode)] = {code_, Span<const std::uint32_t>(code_sums_)};
}

bool ImageKeeper::scrub(DurationUs slot_us) {
  ScrubPlace places[kScrubAreas];
  take_places(places);
  std::size_t all = 0;
  for (const ScrubPlace& place : places) all += place.bytes.size();
  const std::uint32_t passes = scrub_.passes();
  const bool found = scrub_.step(places, all / static_cast<std::size_t>(kScrubPeriod_us / slot_us) + 1);
  since_pass_us_ += slot_us;
  if (scrub_.passes() == passes) return found;
  pass_us_ = since_pass_us_;
  since_pass_us_ = 0;
  return found;
}

MemoryFinding ImageKeeper::repair() {
  invariant(scrub_.found(), "a repair of what is right");
  MemoryFinding finding{scrub_.area(), scrub_.chunk(), false};
  const std::size_t number = static_cast<std::size_t>(finding.area) / 2;
  if (finding.area == ScrubArea::kImage0 || finding.area == ScrubArea::kImage1) {
    finding.repaired = repair_image(number, finding.chunk);
    if (finding.repaired) slots_[number].make_views();  // they may have been made of what was wrong
    if (!finding.repaired && number != active_index()) slots_[number].refuse(Status::kBadCrc, "the image has decayed in memory");
  } else if (finding.area != ScrubArea::kCode) {
    slots_[number].make_views();
    finding.repaired = true;
  }
  scrub_.resume();
  return finding;
}

// Twice over what the store has: first only its sum is taken, so that nothing gets worse.
bool ImageKeeper::repair_image(std::size_t number, std::uint32_t chunk) {
  std::uint32_t sum = 0;
  if (!stored_[number] || !rewrite(number, chunk, false, sum)) return false;
  return sum == slots_[number].image_sums()[chunk] && rewrite(number, chunk, true, sum);
}

bool ImageKeeper::rewrite(std::size_t number, std::uint32_t chunk, bool write, std::uint32_t& sum) {
  ImageSlot& slot = slots_[number];
  const std::size_t begin = std::size_t{chunk} * kChunkBytes, size = slot.chunk(chunk).size();
  std::uint8_t buffer[kPieceBytes];
  for (std::size_t at = 0; at < size; at += kPieceBytes) {
    const Bytes piece(buffer, size - at < kPieceBytes ? size - at : kPieceBytes);
    if (read_record(*store_, area_of(number), begin + at, piece) != Status::kOk) return false;
    slot.convert_piece(begin + at, piece);
    if (write) slot.repair(begin + at, piece);
    sum = crc32c(piece, sum);
  }
  return true;
}

}  // namespace lasso
