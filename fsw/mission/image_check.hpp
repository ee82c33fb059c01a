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

// Everything that one image says by itself (format, check sums, indices, ranges, capacities); the images of its parts are but words to it.
// Fills the tables and the parameters; changes no byte. Loop bound: the image's words.
LoadFailure check_image(FlightImage& image, MissionParameters& parameters);

// The parameters of a table that has been checked.
MissionParameters parameters_of(const ImageTable& table);
SensorParameters sensor_of(const ImageTable& table, std::uint32_t record);

}  // namespace lasso
