#include "fsw/mission/image_check.hpp"

#include "cfg/capacities.hpp"
#include "fsw/core/byte_codec.hpp"
#include "fsw/core/crc.hpp"
#include "fsw/mission/image_layout.hpp"
#include "fsw/mission/image_records.hpp"
#include "fsw/mission/number_fit.hpp"

namespace lasso {
namespace {

// Of header and directory.
constexpr std::uint32_t directory_bytes(std::uint32_t tables) { return 4 * (kImageHeaderWords + tables * kDirectoryEntryWords); }

constexpr std::uint32_t kMaxBricksPerAxis = 1023;
constexpr std::uint32_t kRecordWords[kTableCount] = {2,
                                                     kFieldGeometryWords,
                                                     kElementWords,
                                                     kCurvatureWords,
                                                     kBrickWords,
                                                     kRayCellsPerBrick,
                                                     1,
                                                     kNearWordsPerBrick,
                                                     kFootWords,
                                                     kEdgeWords,
                                                     3,
                                                     kSearchGridWords,
                                                     1,
                                                     kViewWords,
                                                     kSymmetryWords,
                                                     kPartWords,
                                                     1,
                                                     kSensorWords,
                                                     kCalibrationWords,
                                                     kNamedFrameWords};
static_assert(kSensorWords == 2 * kSensorValues, "two words a value");
static_assert(kCalibrationWords == 2 + 2 * (kCalibrationRealCount + kResidualTerms), "two words a value");

// Header and sizes.
LoadFailure check_header(FlightImage& image) {
  if (image.bytes.size() < directory_bytes(kLeastTables) + 4) return failure(Status::kTruncated, "shorter than header and directory");
  ByteReader reader(image.bytes);
  if (reader.u32() != kImageMagic) return failure(Status::kBadMagic, "no flight image");
  if (reader.u32() != kImageVersion)
    return failure(Status::kBadVersion, "image format version of another build: compile the mission again");
  if (reader.u32() != image.bytes.size()) return failure(Status::kBadLength, "length field is not the image's length");
  if (image.bytes.size() > kMaxImageBytes) return failure(Status::kOverCapacity, "larger than the image buffer");
  image.table_count = reader.u32();
  if (image.table_count != kLeastTables && image.table_count != kTableCount) return failure(Status::kBadLength, "number of tables");
  if (image.bytes.size() < directory_bytes(image.table_count) + 4) return failure(Status::kTruncated, "shorter than its directory");
  (void)reader.u32();  // mission id and version say nothing about validity
  (void)reader.u32();
  if (reader.u32() != parameter_rows().size()) return failure(Status::kBadVersion, "parameter count of another build");
  return {};
}

LoadFailure check_parameters(const ImageTable& table) {
  if (table.records != parameter_rows().size()) return failure(Status::kBadLength, "number of parameters", TableId::kParameters);
  std::size_t bad_row = 0;
  const Status status = validate(parameters_of(table), bad_row);
  if (status == Status::kOk) return {};
  return failure(status, parameter_rows()[bad_row].key, TableId::kParameters, static_cast<std::uint32_t>(bad_row));
}

std::uint32_t brick_count(const FlightImage& image) {
  const ImageTable& geometry = image[TableId::kFieldGeometry];
  return geometry.word(0, kBricksX) * geometry.word(0, kBricksY) * geometry.word(0, kBricksZ);
}

LoadFailure check_geometry(const FlightImage& image) {
  const ImageTable& geometry = image[TableId::kFieldGeometry];
  if (geometry.records != 1) return failure(Status::kBadLength, "field geometry records", TableId::kFieldGeometry);
  const std::uint32_t bits = geometry.word(0, kLengthFractionBits);
  if (bits < 8 || bits > 30) return failure(Status::kBadValue, "length fraction bits", TableId::kFieldGeometry);
  for (std::uint32_t i = kBricksX; i <= kBricksZ; ++i) {
    const std::uint32_t n = geometry.word(0, i);
    if (n == 0 || n > kMaxBricksPerAxis) return failure(Status::kBadValue, "bricks along an axis", TableId::kFieldGeometry);
  }
  if (const char* wrong = misfit_of_grid(geometry)) return failure(Status::kBadValue, wrong, TableId::kFieldGeometry);
  if (geometry.signed_word(0, kModelRadius) <= 0) return failure(Status::kBadValue, "model radius", TableId::kFieldGeometry);
  return {};
}

struct Limit {
  TableId id;
  std::uint32_t minimum, maximum;
};

LoadFailure check_counts(const FlightImage& image) {
  const std::uint32_t bricks = brick_count(image);
  const Limit limits[] = {{TableId::kBricks, bricks, bricks},
                          {TableId::kFootPoints, bricks, bricks},
                          {TableId::kElements, 1, kMaxElements},
                          {TableId::kCurvatures, 1, kMaxElements},
                          {TableId::kEdges, 0, kMaxEdges},
                          {TableId::kHull, 4, kMaxHullPoints},
                          {TableId::kRayCells, 1, kEmptyBit - 1},
                          {TableId::kRayLists, 1, kListOffsetMask},
                          {TableId::kViews, kMinViews, kMaxViews},
                          {TableId::kSymmetries, 0, kMaxSymmetries},
                          {TableId::kParts, 0, kMaxParts},
                          {TableId::kSensors, 0, kMaxSensors - 1},
                          {TableId::kCalibrations, 0, kMaxSensors * kMaxCalibrations},
                          {TableId::kNamedFrames, 0, kMaxNamedFrames}};
  for (const Limit& limit : limits) {
    const std::uint32_t n = image[limit.id].records;
    if (n < limit.minimum || n > limit.maximum) return failure(Status::kOverCapacity, "number of records", limit.id);
  }
  return {};
}

bool is_distance(std::uint32_t word) {
  const std::uint32_t distance = word & ~kEmptyBit;
  return distance >= 1 && distance <= kMaxCellDistance;
}

LoadFailure check_brick(const FlightImage& image, std::uint32_t i) {
  const ImageTable& bricks = image[TableId::kBricks];
  const std::uint32_t word = bricks.word(i, 0);
  const bool ok = (word & kEmptyBit) != 0 ? is_distance(word) : word < image[TableId::kRayCells].records;
  if (ok && bricks.word(i, 1) <= image[TableId::kNearCells].records) return {};
  return failure(Status::kBadIndex, "brick", TableId::kBricks, i);
}

bool is_ray_cell(std::uint32_t word, std::uint32_t list_words) {
  if ((word & kEmptyBit) != 0) return is_distance(word);
  const std::uint32_t count = word >> kListOffsetBits;
  return count >= 1 && count <= kMaxElementsPerCell && (word & kListOffsetMask) + count <= list_words;
}

LoadFailure check_ray_cells(const FlightImage& image, std::uint32_t i) {
  const ImageTable& cells = image[TableId::kRayCells];
  const std::uint32_t list_words = image[TableId::kRayLists].records;
  for (std::uint32_t k = 0; k < kRayCellsPerBrick; ++k) {
    if (!is_ray_cell(cells.word(i, k), list_words)) return failure(Status::kBadIndex, "ray cell", TableId::kRayCells, i);
  }
  return {};
}

// Every word of the record is at most `maximum`.
LoadFailure check_indices(const FlightImage& image, TableId id, std::uint32_t i, std::uint32_t flags, std::uint32_t maximum) {
  const ImageTable& table = image[id];
  for (std::uint32_t k = 0; k < table.words; ++k) {
    if ((table.word(i, k) & ~flags) > maximum) return failure(Status::kBadIndex, "element index", id, i);
  }
  return {};
}

// |v|^2 of the unit vector of `size` words k, k + stride, ..., in double: close to 1 where it is one.
double squared_unit(const ImageTable& table, std::uint32_t record, std::uint32_t k, std::uint32_t stride = 1, std::uint32_t size = 3) {
  double sum = 0;
  for (std::uint32_t i = k; i < k + size * stride; i += stride) {
    const double x = static_cast<double>(table.signed_word(record, i)) / static_cast<double>(1 << kUnitFractionBits);
    sum += x * x;
  }
  return sum;
}

// A triangle has no fourth one: no direction, and no place.
bool is_fourth_side(double squared, bool absent) { return absent ? !(squared > 0) : is_unit(squared); }

LoadFailure check_element(const FlightImage& image, std::uint32_t i) {
  const ImageTable& elements = image[TableId::kElements];
  bool ok = is_unit(squared_unit(elements, i, 0)) && elements.word(i, 4) < image[TableId::kCurvatures].records;
  for (std::uint32_t side = 0; side < 3; ++side) ok = ok && is_unit(squared_unit(elements, i, 6 + side, 4));
  ok = ok && is_fourth_side(squared_unit(elements, i, 9, 4), elements.signed_word(i, 21) == kNoSide);
  if (ok && elements.word(i, 5) <= kElementTwoSided) return {};
  return failure(Status::kBadValue, "element", TableId::kElements, i);
}

LoadFailure check_edge(const FlightImage& image, std::uint32_t i) {
  const ImageTable& edges = image[TableId::kEdges];
  const bool ok = is_unit(squared_unit(edges, i, 6)) && is_unit(squared_unit(edges, i, 10));
  if (ok && edges.word(i, 14) <= kEdgeBoundary) return {};
  return failure(Status::kBadValue, "edge", TableId::kEdges, i);
}

LoadFailure check_search_grid(const FlightImage& image) {
  const ImageTable& grid = image[TableId::kSearchGrid];
  if (grid.records != 1) return failure(Status::kBadLength, "search grid records", TableId::kSearchGrid);
  std::uint32_t cells = 1;
  for (std::uint32_t i = kSearchCellsX; i <= kSearchCellsZ; ++i) {
    const std::uint32_t n = grid.word(0, i);
    if (n == 0 || n > kMaxSearchCells) return failure(Status::kBadValue, "search cells along an axis", TableId::kSearchGrid);
    cells *= n;
  }
  if (grid.word(0, kSearchCellsX) % 4 != 0) return failure(Status::kBadValue, "search cells along x", TableId::kSearchGrid);
  for (const std::uint32_t length : {kSearchCellSize, kSearchTruncation, kSearchSize}) {
    if (grid.signed_word(0, length) <= 0) return failure(Status::kBadValue, "search grid length", TableId::kSearchGrid);
  }
  if (image[TableId::kDistances].records != cells / 4) return failure(Status::kBadLength, "number of distances", TableId::kDistances);
  return {};
}

// The record begins with a unit vector of `size` components.
LoadFailure check_unit(const FlightImage& image, TableId id, std::uint32_t i, std::uint32_t size) {
  return is_unit(squared_unit(image[id], i, 0, 1, size)) ? LoadFailure{} : failure(Status::kBadValue, "not of unit length", id, i);
}

LoadFailure check_sensor(const FlightImage& image, std::uint32_t i) {
  std::size_t bad_row = 0;
  const Status status = validate(sensor_of(image[TableId::kSensors], i), bad_row);
  if (status != Status::kOk) return failure(status, sensor_rows()[bad_row].key, TableId::kSensors, i);
  return check_sensor_fit(image, i);
}

// Of one of the sensors, not before the one before, and no more of one than fit.
LoadFailure check_calibration(const FlightImage& image, std::uint32_t i) {
  const ImageTable& table = image[TableId::kCalibrations];
  const std::uint32_t sensor = table.word(i, 0);
  const bool in_order = i == 0 || sensor >= table.word(i - 1, 0);
  constexpr std::uint32_t kMost = kMaxCalibrations;
  const bool fits = i < kMost || sensor != table.word(i - kMost, 0);
  if (sensor > image[TableId::kSensors].records || !in_order || !fits)
    return failure(Status::kBadIndex, "sensor of a calibration", TableId::kCalibrations, i);
  const Status status = validate(calibration_of(table, i));
  return status == Status::kOk ? LoadFailure{} : failure(status, "calibration", TableId::kCalibrations, i);
}

LoadFailure check_named_frame(const FlightImage& image, std::uint32_t i) {
  if (is_valid(named_frame_of(image[TableId::kNamedFrames], i))) return {};
  return failure(Status::kBadValue, "pose of a named frame", TableId::kNamedFrames, i);
}

// Parameters, and what tables say of each other's sizes.
LoadFailure check_numbers(const FlightImage& image) {
  LoadFailure result = check_parameters(image[TableId::kParameters]);
  if (!failed(result)) result = check_geometry(image);
  if (!failed(result)) result = check_counts(image);
  if (!failed(result)) result = check_search_grid(image);
  if (!failed(result)) result = check_parameters_fit(image);
  return result;
}

// Tables whose records are checked one by one, in this order.
constexpr TableId kChecked[] = {TableId::kBricks,       TableId::kRayCells,   TableId::kRayLists,   TableId::kNearCells,
                                TableId::kElements,     TableId::kCurvatures, TableId::kFootPoints, TableId::kEdges,
                                TableId::kHull,         TableId::kViews,      TableId::kSymmetries, TableId::kSensors,
                                TableId::kCalibrations, TableId::kNamedFrames};
constexpr std::uint32_t kCheckedTables = sizeof(kChecked) / sizeof(kChecked[0]);

LoadFailure check_record(const FlightImage& image, TableId id, std::uint32_t record) {
  const LoadFailure misfit = check_lengths_fit(image, id, record);
  if (failed(misfit)) return misfit;
  if (id == TableId::kBricks) return check_brick(image, record);
  if (id == TableId::kRayCells) return check_ray_cells(image, record);
  if (id == TableId::kRayLists) return check_indices(image, id, record, kFinalEntry, image[TableId::kElements].records - 1);
  if (id == TableId::kNearCells) return check_indices(image, id, record, 0, image[TableId::kElements].records);
  if (id == TableId::kElements) return check_element(image, record);
  if (id == TableId::kEdges) return check_edge(image, record);
  if (id == TableId::kViews) return check_unit(image, id, record, 3);
  if (id == TableId::kSymmetries) return check_unit(image, id, record, 4);
  if (id == TableId::kSensors) return check_sensor(image, record);
  if (id == TableId::kCalibrations) return check_calibration(image, record);
  return id == TableId::kNamedFrames ? check_named_frame(image, record) : LoadFailure{};
}

}  // namespace

void ImageCheck::begin(Bytes bytes) {
  *this = ImageCheck{};
  image_.bytes = bytes;
  stage_ = Stage::kHeader;
}

bool ImageCheck::step(std::uint32_t words) {
  std::uint32_t left = words;
  while (!done() && left > 0) {
    const std::uint32_t used = advance(left);
    left -= used < left ? used : left;
  }
  return done();
}

// The words that it took; at least one.
std::uint32_t ImageCheck::advance(std::uint32_t words) {
  switch (stage_) {
    case Stage::kSum:
      return check_whole_sum(words);
    case Stage::kTableSum:
      return check_table_sum(words);
    case Stage::kRecords:
      return check_records(words);
    case Stage::kHeader:
      enter(Stage::kSum, check_header(image_));
      return kImageHeaderWords;
    case Stage::kDirectory:
      read_entry();
      return kDirectoryEntryWords;
    default:
      table_ = 0;
      enter(Stage::kRecords, check_numbers(image_));
      if (!done()) image_.length_bits = static_cast<int>(image_[TableId::kFieldGeometry].word(0, kLengthFractionBits));
      return image_[TableId::kParameters].bytes() / 4;
  }
}

void ImageCheck::enter(Stage next, const LoadFailure& found) {
  result_ = found;
  stage_ = failed(found) ? Stage::kDone : next;
  record_ = 0;
  summed_ = 0;
  sum_ = 0;
}

std::uint32_t ImageCheck::check_sum(ConstBytes bytes, std::uint32_t words) {
  const std::size_t left = bytes.size() - summed_;
  const std::size_t size = left < std::size_t{4} * words ? left : std::size_t{4} * words;
  sum_ = crc32c(bytes.subspan(summed_, size), sum_);
  summed_ += size;
  return static_cast<std::uint32_t>(size / 4 + 1);
}

std::uint32_t ImageCheck::check_whole_sum(std::uint32_t words) {
  const ConstBytes summed = ConstBytes(image_.bytes).first(image_.bytes.size() - 4);
  const std::uint32_t used = check_sum(summed, words);
  if (summed_ < summed.size()) return used;
  ByteReader trailer(image_.bytes.subspan(image_.bytes.size() - 4, 4));
  free_from_ = directory_bytes(image_.table_count);
  enter(Stage::kDirectory, trailer.u32() == sum_ ? LoadFailure{} : failure(Status::kBadCrc, "image checksum"));
  return used;
}

// The entry of the next table.
void ImageCheck::read_entry() {
  const std::size_t at = std::size_t{4} * (kImageHeaderWords + std::size_t{kDirectoryEntryWords} * table_);
  ByteReader reader(image_.bytes.subspan(at, std::size_t{4} * kDirectoryEntryWords));
  const std::size_t end = image_.bytes.size() - 4;
  ImageTable& table = image_.tables[table_];
  const std::uint32_t number = table_ + 1;
  const std::uint32_t id = reader.u32();
  table.words = reader.u32();
  table.records = reader.u32();
  const std::size_t offset = reader.u32();
  stated_sum_ = reader.u32();
  LoadFailure found;
  if (id != number) {
    found = failure(Status::kBadOrder, "tables out of order", number);
  } else if (table.words != kRecordWords[table_]) {
    found = failure(Status::kBadLength, "record length", number);
  } else if (offset % 8 != 0 || offset < free_from_ || offset > end) {
    found = failure(Status::kBadIndex, "table offset", number);
  } else if (std::uint64_t{4} * table.words * table.records > end - offset) {
    found = failure(Status::kTruncated, "table ends past the image", number);
  } else {
    table.data = image_.bytes.data() + offset;
    free_from_ = offset + table.bytes();
  }
  enter(Stage::kTableSum, found);
}

std::uint32_t ImageCheck::check_table_sum(std::uint32_t words) {
  const ImageTable& table = image_.tables[table_];
  const std::uint32_t used = check_sum(ConstBytes(table.data, table.bytes()), words);
  if (summed_ < table.bytes()) return used;
  ++table_;
  const LoadFailure found = sum_ == stated_sum_ ? LoadFailure{} : failure(Status::kBadCrc, "table checksum", table_);
  enter(table_ < image_.table_count ? Stage::kDirectory : Stage::kNumbers, found);
  return used;
}

std::uint32_t ImageCheck::check_records(std::uint32_t words) {
  const TableId id = kChecked[table_];
  const ImageTable& table = image_[id];
  std::uint32_t used = 0;
  LoadFailure found;
  for (; record_ < table.records && used < words && !failed(found); ++record_) {
    found = check_record(image_, id, record_);
    used += table.words;
  }
  if (failed(found)) {
    enter(Stage::kDone, found);
  } else if (record_ == table.records) {
    record_ = 0;
    if (++table_ == kCheckedTables) stage_ = Stage::kDone;
  }
  return used + 1;
}

}  // namespace lasso
