#include "fsw/mission/image_check.hpp"

#include "cfg/capacities.hpp"
#include "fsw/core/byte_codec.hpp"
#include "fsw/core/crc.hpp"
#include "fsw/geometry/portable_math.hpp"

namespace lasso {
namespace {

using N = FlightNumber;
constexpr std::uint32_t kDirectoryBytes = 4 * (kImageHeaderWords + kTableCount * kDirectoryEntryWords);
constexpr std::uint32_t kMaxBricksPerAxis = 1023;
constexpr N::Length kSmallestCell_m = 1e-6F;
constexpr std::uint32_t kRecordWords[kTableCount] = {
    2, kFieldGeometryWords, kElementWords,  kCurvatureWords, kBrickWords, kRayCellsPerBrick,
    1, kNearWordsPerBrick,  kFootWords,     kEdgeWords,      3,           kSearchGridWords,
    1, kViewWords,          kSymmetryWords, kPartWords,      1,           kSensorWords};
static_assert(kSensorWords == 2 * kSensorValues, "two words a value");

// Header, sizes and whole CRC.
LoadFailure check_header(const FlightImage& image) {
  if (image.bytes.size() < kDirectoryBytes + 4) return failure(Status::kTruncated, "shorter than header and directory");
  ByteReader reader(image.bytes);
  if (reader.u32() != kImageMagic) return failure(Status::kBadMagic, "no flight image");
  if (reader.u32() != kImageVersion)
    return failure(Status::kBadVersion, "image format version of another build: compile the mission again");
  if (reader.u32() != image.bytes.size()) return failure(Status::kBadLength, "length field is not the image's length");
  if (image.bytes.size() > kMaxImageBytes) return failure(Status::kOverCapacity, "larger than the image buffer");
  if (reader.u32() != kTableCount) return failure(Status::kBadLength, "number of tables");
  (void)reader.u32();  // mission id and version say nothing about validity
  (void)reader.u32();
  if (reader.u32() != parameter_rows().size()) return failure(Status::kBadVersion, "parameter count of another build");
  ByteReader trailer(image.bytes.subspan(image.bytes.size() - 4, 4));
  if (trailer.u32() != crc32c(image.bytes.first(image.bytes.size() - 4))) return failure(Status::kBadCrc, "image check sum");
  return {};
}

LoadFailure read_directory(FlightImage& image) {
  ByteReader reader(
      ConstBytes(image.bytes).subspan(std::size_t{4} * kImageHeaderWords, std::size_t{4} * kTableCount * kDirectoryEntryWords));
  std::size_t free_from = kDirectoryBytes;
  const std::size_t end = image.bytes.size() - 4;
  for (std::uint32_t i = 0; i < kTableCount; ++i) {
    const std::uint32_t id = reader.u32();
    ImageTable& table = image.tables[i];
    table.words = reader.u32();
    table.records = reader.u32();
    const std::size_t offset = reader.u32();
    const std::uint32_t crc = reader.u32();
    if (id != i + 1) return failure(Status::kBadOrder, "tables out of order", i + 1);
    if (table.words != kRecordWords[i]) return failure(Status::kBadLength, "record length", i + 1);
    if (offset % 8 != 0 || offset < free_from || offset > end) return failure(Status::kBadIndex, "table offset", i + 1);
    if (table.records > (end - offset) / (std::size_t{4} * table.words))
      return failure(Status::kTruncated, "table ends past the image", i + 1);
    table.data = image.bytes.data() + offset;
    free_from = offset + table.bytes();
    if (crc != crc32c(ConstBytes(table.data, table.bytes()))) return failure(Status::kBadCrc, "table check sum", i + 1);
  }
  return {};
}

LoadFailure check_parameters(const ImageTable& table, MissionParameters& parameters) {
  if (table.records != parameter_rows().size()) return failure(Status::kBadLength, "number of parameters", TableId::kParameters);
  parameters = parameters_of(table);
  std::size_t bad_row = 0;
  const Status status = validate(parameters, bad_row);
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
  if (!(N::length(geometry.signed_word(0, kCellSize), static_cast<int>(bits)) > kSmallestCell_m))
    return failure(Status::kBadValue, "cell size", TableId::kFieldGeometry);
  if (geometry.signed_word(0, kModelRadius) <= 0) return failure(Status::kBadValue, "model radius", TableId::kFieldGeometry);
  return {};
}

struct Limit {
  TableId id;
  std::uint32_t minimum, maximum;
};

LoadFailure check_counts(const FlightImage& image) {
  const std::uint32_t bricks = brick_count(image);
  const Limit limits[] = {
      {TableId::kBricks, bricks, bricks},        {TableId::kFootPoints, bricks, bricks},   {TableId::kElements, 1, kMaxElements},
      {TableId::kCurvatures, 1, kMaxElements},   {TableId::kEdges, 0, kMaxEdges},          {TableId::kHull, 4, kMaxHullPoints},
      {TableId::kRayCells, 1, kEmptyBit - 1},    {TableId::kRayLists, 1, kListOffsetMask}, {TableId::kViews, kMinViews, kMaxViews},
      {TableId::kSymmetries, 0, kMaxSymmetries}, {TableId::kParts, 0, kMaxParts},          {TableId::kSensors, 0, kMaxSensors - 1}};
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

LoadFailure check_bricks(const FlightImage& image) {
  const ImageTable& bricks = image[TableId::kBricks];
  const std::uint32_t occupied = image[TableId::kRayCells].records;
  const std::uint32_t near = image[TableId::kNearCells].records;
  for (std::uint32_t i = 0; i < bricks.records; ++i) {
    const std::uint32_t word = bricks.word(i, 0);
    const bool ok = (word & kEmptyBit) != 0 ? is_distance(word) : word < occupied;
    if (!ok || bricks.word(i, 1) > near) return failure(Status::kBadIndex, "brick", TableId::kBricks, i);
  }
  return {};
}

bool is_ray_cell(std::uint32_t word, std::uint32_t list_words) {
  if ((word & kEmptyBit) != 0) return is_distance(word);
  const std::uint32_t count = word >> kListOffsetBits;
  return count >= 1 && count <= kMaxElementsPerCell && (word & kListOffsetMask) + count <= list_words;
}

LoadFailure check_ray_cells(const FlightImage& image) {
  const ImageTable& cells = image[TableId::kRayCells];
  for (std::uint32_t i = 0; i < cells.records; ++i) {
    for (std::uint32_t k = 0; k < kRayCellsPerBrick; ++k) {
      if (!is_ray_cell(cells.word(i, k), image[TableId::kRayLists].records)) {
        return failure(Status::kBadIndex, "ray cell", TableId::kRayCells, i);
      }
    }
  }
  return {};
}

// Every word of the table is at most `maximum`.
LoadFailure check_indices(const FlightImage& image, TableId id, std::uint32_t flags, std::uint32_t maximum) {
  const ImageTable& table = image[id];
  for (std::uint32_t i = 0; i < table.records; ++i) {
    for (std::uint32_t k = 0; k < table.words; ++k) {
      if ((table.word(i, k) & ~flags) > maximum) return failure(Status::kBadIndex, "element index", id, i);
    }
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

LoadFailure check_elements(const FlightImage& image) {
  const ImageTable& elements = image[TableId::kElements];
  for (std::uint32_t i = 0; i < elements.records; ++i) {
    bool ok = is_unit(squared_unit(elements, i, 0)) && elements.word(i, 4) < image[TableId::kCurvatures].records;
    for (std::uint32_t side = 0; side < 3; ++side) ok = ok && is_unit(squared_unit(elements, i, 6 + side, 4));
    if (!ok || elements.word(i, 5) > kElementTwoSided) return failure(Status::kBadValue, "element", TableId::kElements, i);
  }
  return {};
}

LoadFailure check_edges(const FlightImage& image) {
  const ImageTable& edges = image[TableId::kEdges];
  for (std::uint32_t i = 0; i < edges.records; ++i) {
    const bool ok = is_unit(squared_unit(edges, i, 6)) && is_unit(squared_unit(edges, i, 10));
    if (!ok || edges.word(i, 14) > kEdgeBoundary) return failure(Status::kBadValue, "edge", TableId::kEdges, i);
  }
  return {};
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

// Every record of the table begins with a unit vector of `size` components.
LoadFailure check_units(const FlightImage& image, TableId id, std::uint32_t size) {
  const ImageTable& table = image[id];
  for (std::uint32_t i = 0; i < table.records; ++i) {
    if (!is_unit(squared_unit(table, i, 0, 1, size))) return failure(Status::kBadValue, "not of unit length", id, i);
  }
  return {};
}

LoadFailure check_sensors(const FlightImage& image) {
  const ImageTable& table = image[TableId::kSensors];
  for (std::uint32_t i = 0; i < table.records; ++i) {
    std::size_t bad_row = 0;
    const Status status = validate(sensor_of(table, i), bad_row);
    if (status != Status::kOk) return failure(status, sensor_rows()[bad_row].key, TableId::kSensors, i);
  }
  return {};
}

LoadFailure check_tables(const FlightImage& image) {
  LoadFailure result = check_geometry(image);
  if (!failed(result)) result = check_counts(image);
  if (!failed(result)) result = check_bricks(image);
  if (!failed(result)) result = check_ray_cells(image);
  if (!failed(result)) result = check_indices(image, TableId::kRayLists, kFinalEntry, image[TableId::kElements].records - 1);
  if (!failed(result)) result = check_indices(image, TableId::kNearCells, 0, image[TableId::kElements].records);
  if (!failed(result)) result = check_elements(image);
  if (!failed(result)) result = check_edges(image);
  if (!failed(result)) result = check_search_grid(image);
  if (!failed(result)) result = check_units(image, TableId::kViews, 3);
  if (!failed(result)) result = check_units(image, TableId::kSymmetries, 4);
  if (!failed(result)) result = check_sensors(image);
  return result;
}

}  // namespace

LoadFailure check_image(FlightImage& image, MissionParameters& parameters) {
  LoadFailure result = check_header(image);
  if (!failed(result)) result = read_directory(image);
  if (!failed(result)) result = check_parameters(image[TableId::kParameters], parameters);
  if (!failed(result)) result = check_tables(image);
  return result;
}

SensorParameters sensor_of(const ImageTable& table, std::uint32_t record) {
  SensorParameters sensor{};
  ByteReader reader(ConstBytes(table.data + std::size_t{4} * kSensorWords * record, std::size_t{4} * kSensorWords));
  for (const ParameterRow& row : sensor_rows()) sensor.*sensor_member(row) = reader.f64();
  return sensor;
}

MissionParameters parameters_of(const ImageTable& table) {
  MissionParameters parameters{};
  ByteReader reader(ConstBytes(table.data, table.bytes()));
  for (const ParameterRow& row : parameter_rows()) parameters.*row.member = reader.f64();
  return parameters;
}

}  // namespace lasso
