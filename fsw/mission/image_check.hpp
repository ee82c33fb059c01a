// A flight image as its check sees it: tables in the format's words, and what each may say. Inside of fsw/mission.
#pragma once

#include "fsw/mission/mission.hpp"

namespace lasso {

struct ImageTable {
  std::uint8_t* data = nullptr;
  std::uint32_t words = 0;  // per record
  std::uint32_t records = 0;

  std::uint32_t bytes() const { return 4 * words * records; }
  std::uint32_t word(std::uint32_t record, std::uint32_t index) const {
    const std::uint8_t* p = data + 4 * (static_cast<std::size_t>(record) * words + index);
    return static_cast<std::uint32_t>(p[0]) << 24 | static_cast<std::uint32_t>(p[1]) << 16 | static_cast<std::uint32_t>(p[2]) << 8 | p[3];
  }
  std::int32_t signed_word(std::uint32_t record, std::uint32_t index) const { return static_cast<std::int32_t>(word(record, index)); }
};

struct FlightImage {
  Bytes bytes;
  ImageTable tables[kTableCount];
  std::uint32_t table_count = kLeastTables;  // of which the image has the first so many
  int length_bits = 0;                       // of its field geometry, once that is checked
  const ImageTable& operator[](TableId id) const { return tables[static_cast<std::uint32_t>(id) - 1]; }
};

inline LoadFailure failure(Status status, const char* what, std::uint32_t table = 0, std::uint32_t record = 0) {
  return {status, table, record, what};
}
inline LoadFailure failure(Status status, const char* what, TableId table, std::uint32_t record = 0) {
  return {status, static_cast<std::uint32_t>(table), record, what};
}
inline bool failed(const LoadFailure& f) { return f.status != Status::kOk; }

inline bool is_unit(double squared) { return squared > 0.999 && squared < 1.001; }

// Everything that one image says by itself (format, checksums, indices, ranges, capacities), some of it at a time; the images of its
// parts are but words to it.
class ImageCheck {
 public:
  // `bytes` do not change before the check is done.
  void begin(Bytes bytes);
  // Goes on for `words` words, and to the end of a record. True when the check is done. Changes no byte. Loop bound: the words, and
  // kLargestRecord_words; a word costs the same few instructions wherever it lies.
  bool step(std::uint32_t words);
  bool done() const { return stage_ == Stage::kDone; }
  const LoadFailure& result() const { return result_; }
  // Its tables, when nothing was found.
  const FlightImage& image() const { return image_; }

 private:
  enum class Stage : std::uint8_t { kHeader, kSum, kDirectory, kTableSum, kNumbers, kRecords, kDone };
  std::uint32_t advance(std::uint32_t words);
  std::uint32_t check_sum(ConstBytes bytes, std::uint32_t words);
  std::uint32_t check_whole_sum(std::uint32_t words);
  std::uint32_t check_table_sum(std::uint32_t words);
  std::uint32_t check_records(std::uint32_t words);
  void enter(Stage next, const LoadFailure& found);
  void read_entry();

  FlightImage image_;
  LoadFailure result_;
  Stage stage_ = Stage::kDone;
  std::uint32_t table_ = 0;       // of the directory; then of those whose records are checked
  std::uint32_t record_ = 0;      // next one
  std::size_t summed_ = 0;        // bytes
  std::uint32_t sum_ = 0;         // of them
  std::uint32_t stated_sum_ = 0;  // of the table
  std::size_t free_from_ = 0;     // where the next table may begin
};
constexpr std::uint32_t kLargestRecord_words = 512;   // kRayCells
constexpr std::uint32_t kAllWords = 0xFFFFFFFFU / 4;  // more than an image has; their bytes fit 32 bits

}  // namespace lasso
