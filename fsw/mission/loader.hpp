// A flight image on its way from the bytes that were received to a mission, in steps: check of the image and of its parts' images, then
// conversion in place to this build's number type, then the mission's views.
#pragma once

#include "fsw/mission/calibration.hpp"
#include "fsw/mission/image_check.hpp"
#include "fsw/mission/named_frame.hpp"

namespace lasso {

class ImageLoad {
 public:
  // `bytes` are nobody else's until they are converted, or found to be wrong.
  void begin(Bytes bytes);
  // Goes on with the check, see ImageCheck::step. True when it is done; result() says how it ended, and no byte has changed.
  bool check(std::uint32_t words);
  const LoadFailure& result() const { return result_; }

  // What follows is for an image in which nothing was found. Converts `words` words more, in place; true when all are. Loop bound: words.
  bool convert(std::uint32_t words);
  // Received bytes of the image, `offset` bytes (a multiple of 4) behind its beginning, become what they are in the converted image.
  void convert_piece(std::size_t offset, Bytes piece) const;
  // The mission of the converted image, as often as it is wanted: the image is not changed.
  void make(Mission& mission, Parts& parts) const;
  void make(Mission& mission) const;
  // The calibration that the image has for a sensor; of several the one of this index. False: none.
  bool find_calibration(SensorNumber sensor, std::uint8_t index, TriangulationCalibration& calibration) const;
  // The pairs of frames that the mission names, from 0. False: none, or its bytes have decayed since they were checked.
  std::uint32_t named_frames() const { return whole_[TableId::kNamedFrames].records; }
  bool find_named_frame(std::uint32_t index, NamedFrame& frame) const;

  // All of it at once: begin, check, and conversion of what is right. Loop bound: the image's words.
  LoadFailure run(Bytes bytes);

 private:
  static constexpr std::uint32_t kWholeImage = 0;
  void finish(const LoadFailure& found);
  void take_checked();
  LoadFailure begin_part(std::uint32_t record);

  ImageCheck check_;
  LoadFailure result_;
  bool checked_ = true;
  std::uint32_t checking_ = kWholeImage;  // or part i: i + 1
  std::uint32_t part_count_ = 0;
  std::uint32_t free_from_ = 0;  // of kPartImages: where the next part's image may begin
  std::size_t converted_ = 0;    // bytes
  FlightImage whole_;
  FlightImage parts_[kMaxParts];
};

}  // namespace lasso
