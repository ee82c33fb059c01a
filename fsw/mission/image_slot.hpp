// One of the two image buffers: bytes that are being loaded, checked, converted and sealed, then a mission. Sealed means that CRC-32C of
// each chunk of the image as it lies in memory, and of the views made of it, have been taken: what they are compared with from then on.
#pragma once

#include "fsw/core/authenticator.hpp"
#include "fsw/mission/calibration.hpp"
#include "fsw/mission/loader.hpp"
#include "fsw/mission/named_frame.hpp"
#include "fsw/mission/parameter_area.hpp"

namespace lasso {

constexpr std::uint32_t kChunkBytes = 16384;  // scrubbed, and repaired, as one
constexpr std::size_t kMaxImageChunks = kMaxImageBytes / kChunkBytes;

// The mission as the scans of one sensor see it.
struct MissionView {
  Mission mission;
  Parts parts;
};

enum class ImageState : std::uint8_t {
  kEmpty = 0,
  kLoading = 1,
  kChecking = 2,
  kRefused = 3,  // result() says why
  kStoring = 4,  // checked, still as received: may be written to the store
  kConverting = 5,
  kSealing = 6,
  kReady = 7,
};

class ImageSlot {
 public:
  void use(Bytes buffer) { buffer_ = buffer; }
  // What is changed there holds in the views from the next make_views() on. It outlives the slot.
  void use_parameters(const ParameterArea& changed) { changed_ = &changed; }
  // From the next check on an image needs a right signature. It outlives the slot.
  void use_authenticator(Authenticator& authenticator) { authenticator_ = &authenticator; }
  // One that has none is taken nevertheless.
  void accept_unsigned() { unsigned_too_ = true; }
  Bytes buffer() const { return buffer_; }

  // An image of so many bytes (at most the buffer's) is to come. Whatever was there is gone.
  void open(std::uint32_t bytes);
  void begin_check();
  // Authentication, then checking, converting or sealing goes on for `words` words; in every other state nothing happens. `sensors` are
  // connected. Loop bound: as ImageCheck::step, and the views of all sensors when the last word is converted.
  void step(std::uint32_t words, std::size_t sensors);
  // From kStoring to kConverting.
  void begin_conversion();
  // All of that at once. Loop bound: the image's words.
  void run(std::size_t sensors);
  void refuse(Status status, const char* what);
  // It is active, and therefore ready, whatever state() says.
  void keep_ready() { state_ = ImageState::kReady; }

  ImageState state() const { return state_; }
  const LoadFailure& result() const { return result_; }
  Bytes image() const { return buffer_.first(bytes_); }  // with its signature, if it has one
  // Without it: what the authenticator takes for one, where the image's own length field says that it ends before.
  Bytes body() const;
  std::uint32_t bytes() const { return bytes_; }
  const MissionView& view(SensorNumber sensor) const { return views_[sensor]; }

  // The image's own, whatever was changed; of a ready one.
  const MissionParameters& image_parameters() const { return image_parameters_; }

  // Of a ready image, see ImageLoad.
  bool find_calibration(SensorNumber sensor, std::uint8_t index, TriangulationCalibration& calibration) const {
    return load_.find_calibration(sensor, index, calibration);
  }
  std::uint32_t named_frames() const { return load_.named_frames(); }
  bool find_named_frame(std::uint32_t index, NamedFrame& frame) const { return load_.find_named_frame(index, frame); }

  // What is sealed; empty while nothing is.
  ConstBytes sealed_image() const { return state_ == ImageState::kReady ? ConstBytes(image()) : ConstBytes(); }
  Span<const std::uint32_t> image_sums() const { return {sums_, kMaxImageChunks}; }
  ConstBytes sealed_views() const;
  Span<const std::uint32_t> views_sums() const { return {views_sums_, kMaxViewChunks}; }

  // Received bytes at `offset` as they lie in memory.
  void convert_piece(std::size_t offset, Bytes piece) const { load_.convert_piece(offset, piece); }
  ConstBytes chunk(std::uint32_t number) const;
  // Puts right what differs. Nobody reads the image meanwhile.
  void repair(std::size_t offset, ConstBytes piece);
  // Makes the views again, of an image that is right, with the parameters that were changed.
  void make_views();

 private:
  static constexpr std::size_t kMaxViewChunks = kMaxSensors * sizeof(MissionView) / kChunkBytes + 1;
  bool is_signed() const;
  void judge(std::uint32_t words);
  void convert(std::uint32_t words, std::size_t sensors);
  void seal(std::uint32_t words);
  void seal_views();
  void apply(const ParameterArea& changed);

  Bytes buffer_;
  std::uint32_t bytes_ = 0;
  ImageState state_ = ImageState::kEmpty;
  LoadFailure result_;
  Authenticator* authenticator_ = nullptr;
  bool unsigned_too_ = false;
  bool judging_ = false;    // the check has not come to the image's content yet
  std::size_t judged_ = 0;  // bytes that the authenticator has been given
  ImageLoad load_;
  MissionView views_[kMaxSensors];  // the first so many as the mission has sensors
  const ParameterArea* changed_ = nullptr;
  MissionParameters image_parameters_{};
  std::uint32_t sealed_ = 0;  // chunks
  std::uint32_t sums_[kMaxImageChunks] = {};
  std::uint32_t views_sums_[kMaxViewChunks] = {};
};

// Chunk `number` of what lies there: the last one may be shorter.
inline ConstBytes chunk_of(ConstBytes bytes, std::size_t number) {
  const std::size_t at = number * kChunkBytes;
  return bytes.subspan(at, bytes.size() - at < kChunkBytes ? bytes.size() - at : kChunkBytes);
}

}  // namespace lasso
