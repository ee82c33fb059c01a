#include <cstring>

#include "cfg/capacities.hpp"
#include "fsw/core/byte_codec.hpp"
#include "fsw/geometry/portable_math.hpp"
#include "fsw/mission/image_check.hpp"

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
constexpr const char* kLayouts[] = {
    "",  "uuuuuuuuuuuuu", kElementLayout, kCurvatureLayout, "uu", "", "u", "", "LLL", kEdgeLayout, "LLL", "uuuuuuuuu",
    "u", "UUULLLLLLLL",   "UUUULLL"};
constexpr std::uint32_t kPartsTables = 100;  // added to the numbers of the first part's tables, and again for each next one

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
void convert_table(const ImageTable& table, const char* layout, int length_bits) {
  const bool plain = layout[0] == '\0';
  for (std::uint32_t i = 0; i < table.records; ++i) {
    for (std::uint32_t k = 0; k < table.words; ++k) {
      std::uint8_t* place = table.data + 4 * (static_cast<std::size_t>(i) * table.words + k);
      convert_word(place, table.word(i, k), plain ? 'u' : layout[k], length_bits);
    }
  }
}

template <class T>
const T* records_of(const FlightImage& image, TableId id) {
  return reinterpret_cast<const T*>(image[id].data);  // aligned to 8 bytes, checked; words were written by memcpy
}

void set_grid(const ImageTable& geometry, int bits, Mission& mission) {
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

void set_views(const FlightImage& image, Mission& mission) {
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

void set_search(const FlightImage& image, int bits, Mission& mission) {
  const ImageTable& grid = image[TableId::kSearchGrid];
  SearchTables<N>& search = mission.search;
  for (std::uint32_t i = 0; i < 3; ++i) {
    search.origin[i] = N::length(grid.signed_word(0, kSearchOriginX + i), bits);
    search.cells[i] = grid.word(0, kSearchCellsX + i);
  }
  search.cells_per_m = 1 / N::length(grid.signed_word(0, kSearchCellSize), bits);
  search.truncation = N::length(grid.signed_word(0, kSearchTruncation), bits);
  search.size = N::length(grid.signed_word(0, kSearchSize), bits);
  search.distances = records_of<std::uint8_t>(image, TableId::kDistances);
  search.views = {records_of<ModelView<N>>(image, TableId::kViews), image[TableId::kViews].records};
  search.symmetries = {records_of<NearSymmetry<N>>(image, TableId::kSymmetries), image[TableId::kSymmetries].records};
}

void set_sensors(const ImageTable& further, Mission& mission) {
  mission.sensors.clear();
  static_cast<void>(mission.sensors.push_back(mission.parameters));
  for (std::uint32_t i = 0; i < further.records; ++i) {
    invariant(mission.sensors.push_back(sensor_of(further, i)), "more sensors than were checked");
  }
}

// From here on nothing can fail.
void activate(const FlightImage& image, Mission& mission) {
  const ImageTable& geometry = image[TableId::kFieldGeometry];
  const int bits = static_cast<int>(geometry.word(0, kLengthFractionBits));
  ByteReader header(image.bytes);
  (void)header.bytes(16);
  mission.id = header.u32();
  mission.version = header.u32();
  ByteReader trailer(image.bytes.subspan(image.bytes.size() - 4, 4));
  mission.image_crc = trailer.u32();
  mission.parameters = parameters_of(image[TableId::kParameters]);
  set_sensors(image[TableId::kSensors], mission);
  set_grid(geometry, bits, mission);
  set_search(image, bits, mission);
  for (std::uint32_t i = 2; i < sizeof(kLayouts) / sizeof(kLayouts[0]); ++i) convert_table(image.tables[i], kLayouts[i], bits);
  set_views(image, mission);
}

double part_value(const ImageTable& parts, std::uint32_t record, std::uint32_t value) {
  ByteReader reader(ConstBytes(parts.data + std::size_t{4} * (std::size_t{record} * kPartWords + std::size_t{2} * value), 8));
  return reader.f64();
}

Vec3 part_vector(const ImageTable& parts, std::uint32_t record, std::uint32_t first) {
  return {part_value(parts, record, first), part_value(parts, record, first + 1), part_value(parts, record, first + 2)};
}

Part read_part(const ImageTable& parts, std::uint32_t record) {
  Part part;
  const Vec3 axis = part_vector(parts, record, kPartQx);
  part.T_target_part.q = Quat(part_value(parts, record, kPartQw), axis.x(), axis.y(), axis.z());
  part.T_target_part.p = part_vector(parts, record, kPartX);
  part.range_min_m = part_value(parts, record, kPartRangeMin);
  part.range_max_m = part_value(parts, record, kPartRangeMax);
  part.view = part_vector(parts, record, kPartViewX);
  part.cone_cosine = part_value(parts, record, kPartConeCosine);
  part.priority = part_value(parts, record, kPartPriority);
  return part;
}

// Comparisons that are false for what is not a number.
const char* fault_of(const Part& part) {
  if (!is_valid(part.T_target_part)) return "pose of a part";
  if (!(part.range_min_m >= 0 && part.range_min_m < part.range_max_m && is_finite(part.range_max_m))) return "range band of a part";
  if (!is_unit(part.view.squaredNorm())) return "view axis of a part";
  if (!(part.cone_cosine >= -1 && part.cone_cosine <= 1)) return "view cone of a part";
  if (!(part.priority > 0 && part.priority <= kMaxPartPriority)) return "priority of a part";
  return nullptr;
}

// An image and its parts' images.
struct Images {
  FlightImage whole;
  FlightImage parts[kMaxParts];
};

LoadFailure find_part_image(const ImageTable& parts, const ImageTable& images, std::uint32_t record, std::uint32_t free_from,
                            FlightImage& image) {
  const std::uint32_t offset = parts.word(record, kPartImageOffset);
  const std::uint32_t size = parts.word(record, kPartImageBytes);
  if (size == 0) return failure(Status::kMissing, "a part without a model", TableId::kParts, record);
  if (offset % 8 != 0 || offset < free_from || offset > images.bytes() || size > images.bytes() - offset) {
    return failure(Status::kBadIndex, "image of a part", TableId::kParts, record);
  }
  image.bytes = Bytes(images.data + offset, size);
  return {};
}

LoadFailure check_part(std::uint32_t record, std::uint32_t free_from, Images& images) {
  const ImageTable& table = images.whole[TableId::kParts];
  const char* fault = fault_of(read_part(table, record));
  if (fault != nullptr) return failure(Status::kBadValue, fault, TableId::kParts, record);
  FlightImage& image = images.parts[record];
  LoadFailure result = find_part_image(table, images.whole[TableId::kPartImages], record, free_from, image);
  if (failed(result)) return result;
  MissionParameters parameters{};
  result = check_image(image, parameters);
  if (!failed(result) && image[TableId::kParts].records != 0) result = failure(Status::kBadValue, "a part with parts", TableId::kParts);
  if (failed(result)) result.table += kPartsTables * (record + 1);
  return result;
}

LoadFailure check_parts(Images& images) {
  const std::uint32_t count = images.whole[TableId::kParts].records;
  std::uint32_t free_from = 0;
  for (std::uint32_t i = 0; i < count; ++i) {
    const LoadFailure result = check_part(i, free_from, images);
    if (failed(result)) return result;
    free_from =
        static_cast<std::uint32_t>(images.parts[i].bytes.data() + images.parts[i].bytes.size() - images.whole[TableId::kPartImages].data);
  }
  return {};
}

LoadFailure check_all(Bytes bytes, Images& images) {
  images.whole.bytes = bytes;
  if (reinterpret_cast<std::uintptr_t>(bytes.data()) % 8 != 0) return failure(Status::kBadValue, "image buffer is not aligned to 8");
  MissionParameters parameters{};
  const LoadFailure result = check_image(images.whole, parameters);
  return failed(result) ? result : check_parts(images);
}

void activate_parts(const Images& images, Parts& parts) {
  parts.clear();
  const ImageTable& table = images.whole[TableId::kParts];
  for (std::uint32_t i = 0; i < table.records; ++i) {
    invariant(parts.push_back(read_part(table, i)), "more parts than were checked");
    activate(images.parts[i], parts[i].mission);
  }
}

}  // namespace

void use_sensor(SensorNumber sensor, Mission& mission, Parts& parts) {
  static_cast<SensorParameters&>(mission.parameters) = mission.sensors[sensor];
  for (Part& part : parts) static_cast<SensorParameters&>(part.mission.parameters) = mission.sensors[sensor];
}

LoadFailure load_image(Bytes bytes, Mission& mission, Parts& parts) {
  Images images;
  const LoadFailure result = check_all(bytes, images);
  if (failed(result)) return result;
  activate_parts(images, parts);
  activate(images.whole, mission);
  return {};
}

LoadFailure load_image(Bytes bytes, Mission& mission) {
  Images images;
  const LoadFailure result = check_all(bytes, images);
  if (!failed(result)) activate(images.whole, mission);
  return result;
}

}  // namespace lasso
