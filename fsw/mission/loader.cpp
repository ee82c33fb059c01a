#include <cstring>

#include "cfg/capacities.hpp"
#include "fsw/core/byte_codec.hpp"
#include "fsw/core/crc.hpp"
#include "fsw/geometry/portable_math.hpp"
#include "fsw/mission/image_format.hpp"
#include "fsw/mission/mission.hpp"

namespace lasso {
namespace {

using N = FlightNumber;
static_assert(sizeof(Element<N>) == std::size_t{4} * kElementWords, "elements are converted in place");
static_assert(sizeof(Curvature<N>) == std::size_t{4} * kCurvatureWords, "curvatures are converted in place");
static_assert(sizeof(ModelEdge<N>) == std::size_t{4} * kEdgeWords, "edges are converted in place");
static_assert(sizeof(HullPointOf<N>) == std::size_t{4} * 3, "hull points are converted in place");
static_assert(sizeof(ModelView<N>) == std::size_t{4} * kViewWords, "views are converted in place");
static_assert(sizeof(NearSymmetry<N>) == std::size_t{4} * kSymmetryWords, "near-symmetries are converted in place");

// Each letter is a word of a record: u plain, L length, U unit vector, K curvature.
constexpr const char* kElementLayout = "UUULuuUUUUUUUUUUUULLLL";
constexpr const char* kCurvatureLayout = "UUULLLKKKKKKKKK";
constexpr const char* kEdgeLayout = "LLLLLLUUULUUULu";
constexpr std::uint32_t kDirectoryBytes = 4 * (kImageHeaderWords + kTableCount * kDirectoryEntryWords);
constexpr std::uint32_t kMaxBricksPerAxis = 1023;
constexpr N::Length kSmallestCell_m = 1e-6F;

struct TableShape {
  std::uint32_t words;  // per record
  const char* layout;
};
constexpr TableShape kShapes[kTableCount] = {{2, ""},
                                             {kFieldGeometryWords, "uuuuuuuuuuuuu"},
                                             {kElementWords, kElementLayout},
                                             {kCurvatureWords, kCurvatureLayout},
                                             {kBrickWords, "uu"},
                                             {kRayCellsPerBrick, ""},
                                             {1, "u"},
                                             {kNearWordsPerBrick, ""},
                                             {kFootWords, "LLL"},
                                             {kEdgeWords, kEdgeLayout},
                                             {3, "LLL"},
                                             {kSearchGridWords, "uuuuuuuuu"},
                                             {1, "u"},
                                             {kViewWords, "UUULLLLLL"},
                                             {kSymmetryWords, "UUUULLL"}};

struct Table {
  std::uint8_t* data = nullptr;
  std::uint32_t words = 0;
  std::uint32_t records = 0;

  std::uint32_t bytes() const { return 4 * words * records; }
  std::uint32_t word(std::uint32_t record, std::uint32_t index) const {
    const std::uint8_t* p = data + 4 * (static_cast<std::size_t>(record) * words + index);
    return static_cast<std::uint32_t>(p[0]) << 24 | static_cast<std::uint32_t>(p[1]) << 16 | static_cast<std::uint32_t>(p[2]) << 8 | p[3];
  }
  std::int32_t signed_word(std::uint32_t record, std::uint32_t index) const { return static_cast<std::int32_t>(word(record, index)); }
};

struct Image {
  Bytes bytes;
  Table tables[kTableCount];
  const Table& operator[](TableId id) const { return tables[static_cast<std::uint32_t>(id) - 1]; }
};

LoadFailure failure(Status status, const char* what, std::uint32_t table = 0, std::uint32_t record = 0) {
  return {status, table, record, what};
}
LoadFailure failure(Status status, const char* what, TableId table, std::uint32_t record = 0) {
  return {status, static_cast<std::uint32_t>(table), record, what};
}
bool failed(const LoadFailure& f) { return f.status != Status::kOk; }

// Header, sizes and whole CRC.
LoadFailure check_header(const Image& image) {
  if (image.bytes.size() < kDirectoryBytes + 4) return failure(Status::kTruncated, "shorter than header and directory");
  ByteReader reader(image.bytes);
  if (reader.u32() != kImageMagic) return failure(Status::kBadMagic, "no flight image");
  if (reader.u32() != kImageVersion) return failure(Status::kBadVersion, "image format version");
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

LoadFailure read_directory(Image& image) {
  ByteReader reader(
      ConstBytes(image.bytes).subspan(std::size_t{4} * kImageHeaderWords, std::size_t{4} * kTableCount * kDirectoryEntryWords));
  std::size_t free_from = kDirectoryBytes;
  const std::size_t end = image.bytes.size() - 4;
  for (std::uint32_t i = 0; i < kTableCount; ++i) {
    const std::uint32_t id = reader.u32();
    Table& table = image.tables[i];
    table.words = reader.u32();
    table.records = reader.u32();
    const std::size_t offset = reader.u32();
    const std::uint32_t crc = reader.u32();
    if (id != i + 1) return failure(Status::kBadOrder, "tables out of order", i + 1);
    if (table.words != kShapes[i].words) return failure(Status::kBadLength, "record length", i + 1);
    if (offset % 8 != 0 || offset < free_from || offset > end) return failure(Status::kBadIndex, "table offset", i + 1);
    if (table.records > (end - offset) / (std::size_t{4} * table.words))
      return failure(Status::kTruncated, "table ends past the image", i + 1);
    table.data = image.bytes.data() + offset;
    free_from = offset + table.bytes();
    if (crc != crc32c(ConstBytes(table.data, table.bytes()))) return failure(Status::kBadCrc, "table check sum", i + 1);
  }
  return {};
}

LoadFailure read_parameters(const Table& table, MissionParameters& parameters) {
  const Span<const ParameterRow> rows = parameter_rows();
  if (table.records != rows.size()) return failure(Status::kBadLength, "number of parameters", TableId::kParameters);
  ByteReader reader(ConstBytes(table.data, table.bytes()));
  for (const ParameterRow& row : rows) parameters.*row.member = reader.f64();
  std::size_t bad_row = 0;
  const Status status = validate(parameters, bad_row);
  if (status == Status::kOk) return {};
  return failure(status, rows[bad_row].key, TableId::kParameters, static_cast<std::uint32_t>(bad_row));
}

std::uint32_t brick_count(const Image& image) {
  const Table& geometry = image[TableId::kFieldGeometry];
  return geometry.word(0, kBricksX) * geometry.word(0, kBricksY) * geometry.word(0, kBricksZ);
}

LoadFailure check_geometry(const Image& image) {
  const Table& geometry = image[TableId::kFieldGeometry];
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

LoadFailure check_counts(const Image& image) {
  const std::uint32_t bricks = brick_count(image);
  const Limit limits[] = {{TableId::kBricks, bricks, bricks},      {TableId::kFootPoints, bricks, bricks},
                          {TableId::kElements, 1, kMaxElements},   {TableId::kCurvatures, 1, kMaxElements},
                          {TableId::kEdges, 0, kMaxEdges},         {TableId::kHull, 4, kMaxHullPoints},
                          {TableId::kRayCells, 1, kEmptyBit - 1},  {TableId::kRayLists, 1, kListOffsetMask},
                          {TableId::kViews, kMinViews, kMaxViews}, {TableId::kSymmetries, 0, kMaxSymmetries}};
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

LoadFailure check_bricks(const Image& image) {
  const Table& bricks = image[TableId::kBricks];
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

LoadFailure check_ray_cells(const Image& image) {
  const Table& cells = image[TableId::kRayCells];
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
LoadFailure check_indices(const Image& image, TableId id, std::uint32_t flags, std::uint32_t maximum) {
  const Table& table = image[id];
  for (std::uint32_t i = 0; i < table.records; ++i) {
    for (std::uint32_t k = 0; k < table.words; ++k) {
      if ((table.word(i, k) & ~flags) > maximum) return failure(Status::kBadIndex, "element index", id, i);
    }
  }
  return {};
}

// |v|^2 of the unit vector of `size` words k, k + stride, ..., in double: close to 1 where it is one.
double squared_unit(const Table& table, std::uint32_t record, std::uint32_t k, std::uint32_t stride = 1, std::uint32_t size = 3) {
  double sum = 0;
  for (std::uint32_t i = k; i < k + size * stride; i += stride) {
    const double x = static_cast<double>(table.signed_word(record, i)) / static_cast<double>(1 << kUnitFractionBits);
    sum += x * x;
  }
  return sum;
}
bool is_unit(double squared) { return squared > 0.999 && squared < 1.001; }

LoadFailure check_elements(const Image& image) {
  const Table& elements = image[TableId::kElements];
  for (std::uint32_t i = 0; i < elements.records; ++i) {
    bool ok = is_unit(squared_unit(elements, i, 0)) && elements.word(i, 4) < image[TableId::kCurvatures].records;
    for (std::uint32_t side = 0; side < 3; ++side) ok = ok && is_unit(squared_unit(elements, i, 6 + side, 4));
    if (!ok || elements.word(i, 5) > kElementTwoSided) return failure(Status::kBadValue, "element", TableId::kElements, i);
  }
  return {};
}

LoadFailure check_edges(const Image& image) {
  const Table& edges = image[TableId::kEdges];
  for (std::uint32_t i = 0; i < edges.records; ++i) {
    const bool ok = is_unit(squared_unit(edges, i, 6)) && is_unit(squared_unit(edges, i, 10));
    if (!ok || edges.word(i, 14) > kEdgeBoundary) return failure(Status::kBadValue, "edge", TableId::kEdges, i);
  }
  return {};
}

LoadFailure check_search_grid(const Image& image) {
  const Table& grid = image[TableId::kSearchGrid];
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
LoadFailure check_units(const Image& image, TableId id, std::uint32_t size) {
  const Table& table = image[id];
  for (std::uint32_t i = 0; i < table.records; ++i) {
    if (!is_unit(squared_unit(table, i, 0, 1, size))) return failure(Status::kBadValue, "not of unit length", id, i);
  }
  return {};
}

LoadFailure check_tables(const Image& image) {
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
  return result;
}

template <class T>
void store(std::uint8_t* place, T value) {
  static_assert(sizeof(T) == 4, "a converted word keeps its size");
  std::memcpy(place, &value, 4);
}

void convert_word(std::uint8_t* place, std::uint32_t word, char kind, int length_bits) {
  const auto value = static_cast<std::int32_t>(word);
  switch (kind) {
    case 'L':
      return store(place, N::length(value, length_bits));
    case 'U':
      return store(place, N::unit(value));
    case 'K':
      return store(place, N::ratio(value, kCurvatureFractionBits));
    default:
      return store(place, word);
  }
}

// An empty layout means plain words throughout.
void convert_table(const Table& table, const char* layout, int length_bits) {
  const bool plain = layout[0] == '\0';
  for (std::uint32_t i = 0; i < table.records; ++i) {
    for (std::uint32_t k = 0; k < table.words; ++k) {
      std::uint8_t* place = table.data + 4 * (static_cast<std::size_t>(i) * table.words + k);
      convert_word(place, table.word(i, k), plain ? 'u' : layout[k], length_bits);
    }
  }
}

template <class T>
const T* records_of(const Image& image, TableId id) {
  return reinterpret_cast<const T*>(image[id].data);  // aligned to 8 bytes, checked; words were written by memcpy
}

void set_grid(const Table& geometry, int bits, Mission& mission) {
  Field<N>& field = mission.field;
  field.cell = N::length(geometry.signed_word(0, kCellSize), bits);
  field.cells_per_m = 1 / field.cell;
  for (std::uint32_t i = 0; i < 3; ++i) {
    field.origin[i] = N::length(geometry.signed_word(0, kOriginX + i), bits);
    field.bricks[i] = geometry.word(0, kBricksX + i);
    field.cells[i] = 8 * field.bricks[i];
    mission.center_m[static_cast<int>(i)] = static_cast<double>(N::length(geometry.signed_word(0, kCenterX + i), bits));
  }
  mission.radius_m = static_cast<double>(N::length(geometry.signed_word(0, kModelRadius), bits));
}

void set_views(const Image& image, Mission& mission) {
  Field<N>& field = mission.field;
  field.element_count = image[TableId::kElements].records;
  field.brick_words = records_of<std::uint32_t>(image, TableId::kBricks);
  field.ray_cells = records_of<std::uint32_t>(image, TableId::kRayCells);
  field.ray_lists = records_of<std::uint32_t>(image, TableId::kRayLists);
  field.near_cells = records_of<std::uint32_t>(image, TableId::kNearCells);
  field.foot_points = records_of<N::Length>(image, TableId::kFootPoints);
  field.elements = records_of<Element<N>>(image, TableId::kElements);
  field.curvatures = records_of<Curvature<N>>(image, TableId::kCurvatures);
  mission.edges = {records_of<ModelEdge<N>>(image, TableId::kEdges), image[TableId::kEdges].records};
  mission.hull = {records_of<HullPointOf<N>>(image, TableId::kHull), image[TableId::kHull].records};
}

void set_search(const Image& image, int bits, Mission& mission) {
  const Table& grid = image[TableId::kSearchGrid];
  SearchTables<N>& search = mission.search;
  for (std::uint32_t i = 0; i < 3; ++i) {
    search.origin[i] = N::length(grid.signed_word(0, kSearchOriginX + i), bits);
    search.cells[i] = grid.word(0, kSearchCellsX + i);
  }
  search.cells_per_m = 1 / N::length(grid.signed_word(0, kSearchCellSize), bits);
  search.truncation = N::length(grid.signed_word(0, kSearchTruncation), bits);
  search.size = N::length(grid.signed_word(0, kSearchSize), bits);
  search.distances = records_of<std::uint32_t>(image, TableId::kDistances);
  search.views = {records_of<ModelView<N>>(image, TableId::kViews), image[TableId::kViews].records};
  search.symmetries = {records_of<NearSymmetry<N>>(image, TableId::kSymmetries), image[TableId::kSymmetries].records};
}

// From here on nothing can fail.
void activate(const Image& image, const MissionParameters& parameters, Mission& mission) {
  const Table& geometry = image[TableId::kFieldGeometry];
  const int bits = static_cast<int>(geometry.word(0, kLengthFractionBits));
  ByteReader header(image.bytes);
  (void)header.bytes(16);
  mission.id = header.u32();
  mission.version = header.u32();
  ByteReader trailer(image.bytes.subspan(image.bytes.size() - 4, 4));
  mission.image_crc = trailer.u32();
  mission.parameters = parameters;
  set_grid(geometry, bits, mission);
  set_search(image, bits, mission);
  for (std::uint32_t i = 2; i < kTableCount; ++i) convert_table(image.tables[i], kShapes[i].layout, bits);
  set_views(image, mission);
}

}  // namespace

LoadFailure load_image(Bytes bytes, Mission& mission) {
  Image image{bytes, {}};
  if (reinterpret_cast<std::uintptr_t>(bytes.data()) % 8 != 0) return failure(Status::kBadValue, "image buffer is not aligned to 8");
  MissionParameters parameters{};
  LoadFailure result = check_header(image);
  if (!failed(result)) result = read_directory(image);
  if (!failed(result)) result = read_parameters(image[TableId::kParameters], parameters);
  if (!failed(result)) result = check_tables(image);
  if (!failed(result)) activate(image, parameters, mission);
  return result;
}

}  // namespace lasso
