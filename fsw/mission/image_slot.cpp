#include "fsw/mission/image_slot.hpp"

#include "fsw/core/byte_codec.hpp"
#include "fsw/core/crc.hpp"
#include "fsw/mission/mission_fit.hpp"

namespace lasso {
namespace {

constexpr std::size_t kLengthWordEnd = 12;  // of the image's header: word 2 is its length

}  // namespace

void ImageSlot::open(std::uint32_t bytes) {
  invariant(bytes <= buffer_.size(), "an image larger than its buffer");
  bytes_ = bytes;
  state_ = ImageState::kLoading;
  result_ = LoadFailure{};
}

Bytes ImageSlot::body() const { return image().first(is_signed() ? bytes_ - authenticator_->image_signature_bytes() : bytes_); }

// What is damaged, and says another length, counts as signed: its signature is not right.
bool ImageSlot::is_signed() const {
  const std::size_t signature = authenticator_ == nullptr ? 0 : authenticator_->image_signature_bytes();
  if (signature == 0 || bytes_ < kLengthWordEnd + signature) return false;
  return ByteReader(image().subspan(kLengthWordEnd - 4, 4)).u32() != bytes_;
}

void ImageSlot::begin_check() {
  state_ = ImageState::kChecking;
  judging_ = authenticator_ != nullptr && (is_signed() || !unsigned_too_);
  judged_ = 0;
  if (!judging_) return load_.begin(image());
  authenticator_->begin_image();
}

// Nothing of an image is believed before its signature is.
void ImageSlot::judge(std::uint32_t words) {
  if (!is_signed()) return refuse(Status::kNotSigned, "the image is not signed: mdat mission sign");
  const Bytes signed_bytes = body();
  const std::size_t left = signed_bytes.size() - judged_, most = std::size_t{4} * words;
  const ConstBytes piece = signed_bytes.subspan(judged_, left < most ? left : most);
  authenticator_->take_image(piece);
  judged_ += piece.size();
  if (judged_ < signed_bytes.size()) return;
  judging_ = false;
  if (!authenticator_->image_authentic(image().subspan(judged_, bytes_ - judged_)))
    return refuse(Status::kNotAuthentic, "the image's signature is not right");
  load_.begin(signed_bytes);
}

void ImageSlot::refuse(Status status, const char* what) {
  result_ = failure(status, what);
  state_ = ImageState::kRefused;
}

void ImageSlot::step(std::uint32_t words, std::size_t sensors) {
  if (state_ == ImageState::kConverting) return convert(words, sensors);
  if (state_ == ImageState::kSealing) return seal(words);
  if (state_ == ImageState::kChecking && judging_) return judge(words);
  if (state_ != ImageState::kChecking || !load_.check(words)) return;
  result_ = load_.result();
  state_ = failed(result_) ? ImageState::kRefused : ImageState::kStoring;
}

void ImageSlot::begin_conversion() {
  invariant(state_ == ImageState::kStoring, "an image is converted before it is checked");
  state_ = ImageState::kConverting;
}

void ImageSlot::convert(std::uint32_t words, std::size_t sensors) {
  if (!load_.convert(words)) return;
  make_views();
  const char* fault = fault_of(views_[0].mission, views_[0].parts, sensors);
  if (fault != nullptr) return refuse(Status::kBadValue, fault);
  sealed_ = 0;
  state_ = ImageState::kSealing;
}

void ImageSlot::make_views() {
  load_.make(views_[0].mission, views_[0].parts);
  image_parameters_ = views_[0].mission.parameters;
  if (changed_ != nullptr) apply(*changed_);
  for (std::size_t i = 1; i < views_[0].mission.sensors.size(); ++i) {
    views_[i] = views_[0];
    use_sensor(static_cast<SensorNumber>(i), views_[i].mission, views_[i].parts);
  }
  seal_views();
}

void ImageSlot::apply(const ParameterArea& changed) {
  changed.apply(views_[0].mission.parameters);
  for (Part& part : views_[0].parts) changed.apply(part.mission.parameters);
}

// A chunk, or as many as the words are.
void ImageSlot::seal(std::uint32_t words) {
  const std::size_t chunks = (bytes_ + kChunkBytes - 1) / kChunkBytes;
  for (std::uint32_t left = words / (kChunkBytes / 4) + 1; left > 0 && sealed_ < chunks; --left, ++sealed_) {
    sums_[sealed_] = crc32c(chunk(sealed_));
  }
  if (sealed_ == chunks) state_ = ImageState::kReady;
}

ConstBytes ImageSlot::sealed_views() const {
  if (state_ != ImageState::kReady) return {};
  return {reinterpret_cast<const std::uint8_t*>(views_), views_[0].mission.sensors.size() * sizeof(MissionView)};
}

void ImageSlot::seal_views() {
  const ConstBytes bytes(reinterpret_cast<const std::uint8_t*>(views_), sizeof views_);
  const std::size_t used = views_[0].mission.sensors.size() * sizeof(MissionView);
  for (std::size_t i = 0; i * kChunkBytes < used; ++i) views_sums_[i] = crc32c(chunk_of(bytes.first(used), i));
}

ConstBytes ImageSlot::chunk(std::uint32_t number) const { return chunk_of(image(), number); }

void ImageSlot::repair(std::size_t offset, ConstBytes piece) {
  const Bytes there = image().subspan(offset, piece.size());
  for (std::size_t i = 0; i < piece.size(); ++i) there[i] = piece[i];
}

void ImageSlot::run(std::size_t sensors) {
  begin_check();
  while (state_ == ImageState::kChecking) step(kAllWords, sensors);
  if (state_ == ImageState::kStoring) begin_conversion();
  step(kAllWords, sensors);
  step(kAllWords, sensors);
}

}  // namespace lasso
