#include "fsw/mission/image_slot.hpp"

#include "fsw/core/crc.hpp"
#include "fsw/mission/mission_fit.hpp"

namespace lasso {

void ImageSlot::open(std::uint32_t bytes) {
  invariant(bytes <= buffer_.size(), "an image larger than its buffer");
  bytes_ = bytes;
  state_ = ImageState::kLoading;
  result_ = LoadFailure{};
}

void ImageSlot::begin_check() {
  load_.begin(image());
  state_ = ImageState::kChecking;
}

void ImageSlot::refuse(Status status, const char* what) {
  result_ = failure(status, what);
  state_ = ImageState::kRefused;
}

void ImageSlot::step(std::uint32_t words, std::size_t sensors) {
  if (state_ == ImageState::kConverting) return convert(words, sensors);
  if (state_ == ImageState::kSealing) return seal(words);
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
