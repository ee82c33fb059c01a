#include "fsw/mission/loader.hpp"

#include <cstring>

#include "cfg/capacities.hpp"
#include "fsw/core/byte_codec.hpp"
#include "fsw/geometry/portable_math.hpp"
#include "fsw/mission/image_layout.hpp"
#include "fsw/mission/image_records.hpp"

namespace lasso {
namespace {

using N = FlightNumber;
static_assert(sizeof(Element<N>) == std::size_t{4} * kElementWords, "elements are converted in place");
static_assert(sizeof(Curvature<N>) == std::size_t{4} * kCurvatureWords, "curvatures are converted in place");
static_assert(sizeof(ModelEdge<N>) == std::size_t{4} * kEdgeWords, "edges are converted in place");
static_assert(sizeof(HullPointOf<N>) == std::size_t{4} * 3, "hull points are converted in place");
static_assert(sizeof(ModelView<N>) == std::size_t{4} * kViewWords, "views are converted in place");
static_assert(sizeof(NearSymmetry<N>) == std::size_t{4} * kSymmetryWords, "near-symmetries are converted in place");

constexpr std::uint32_t kPartsTables = 100;  // added to the numbers of the first part's tables, and again for each next one

template <class T>
void store(std::uint8_t* place, T value) {
  static_assert(sizeof(T) == 4, "a converted word keeps its size");
  std::memcpy(place, &value, 4);
}

void convert_word(std::uint8_t* place, char kind, int length_bits) {
  const ImageTable one{place, 1, 1};
  const std::int32_t value = one.signed_word(0, 0);
  switch (kind) {
    case 'L':
    case 'S':
      return store(place, N::length(value, length_bits));
    case 'U':
      return store(place, N::unit(value));
    case 'K':
      return store(place, N::gradient(value, kCurvatureFractionBits));
    default:
      return store(place, one.word(0, 0));
  }
}

// What of a table lies in `piece`, which is `offset` bytes behind the beginning of `base`.
void convert_table(const ImageTable& table, const char* layout, int length_bits, const std::uint8_t* base, std::size_t offset,
                   Bytes piece) {
  const auto begin = static_cast<std::size_t>(table.data - base);
  const std::size_t end = begin + table.bytes();
  const std::size_t last = end < offset + piece.size() ? end : offset + piece.size();
  for (std::size_t at = begin > offset ? begin : offset; at < last; at += 4) {
    convert_word(piece.data() + (at - offset), kind_of(layout, static_cast<std::uint32_t>((at - begin) / 4 % table.words)), length_bits);
  }
}

void convert_image(const FlightImage& image, const std::uint8_t* base, std::size_t offset, Bytes piece) {
  for (std::uint32_t i = 0; i < kTableCount; ++i) {
    if (kLayouts[i] != nullptr) convert_table(image.tables[i], kLayouts[i], image.length_bits, base, offset, piece);
  }
}

template <class T>
const T* records_of(const FlightImage& image, TableId id) {
  return reinterpret_cast<const T*>(image[id].data);  // aligned to 8 bytes, checked; words were written by memcpy
}

void set_grid(const ImageTable& geometry, int bits, Mission& mission) {
  Field<N>& field = mission.field;
  field.cell = N::length(geometry.signed_word(0, kCellSize), bits);
  field.cells_per_m = N::cells_per_m(geometry.signed_word(0, kCellSize), bits);
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
    search.origin_m[i] = FloatNumber::length(grid.signed_word(0, kSearchOriginX + i), bits);
    search.cells[i] = grid.word(0, kSearchCellsX + i);
  }
  search.cells_per_m = 1 / FloatNumber::length(grid.signed_word(0, kSearchCellSize), bits);
  search.truncation_m = FloatNumber::length(grid.signed_word(0, kSearchTruncation), bits);
  search.size_m = FloatNumber::length(grid.signed_word(0, kSearchSize), bits);
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

void set_mission(const FlightImage& image, Mission& mission) {
  const ImageTable& geometry = image[TableId::kFieldGeometry];
  const int bits = image.length_bits;
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

LoadFailure find_part_image(const ImageTable& parts, const ImageTable& images, std::uint32_t record, std::uint32_t free_from,
                            Bytes& bytes) {
  const std::uint32_t offset = parts.word(record, kPartImageOffset);
  const std::uint32_t size = parts.word(record, kPartImageBytes);
  if (size == 0) return failure(Status::kMissing, "a part without a model", TableId::kParts, record);
  if (offset % 8 != 0 || offset < free_from || offset > images.bytes() || size > images.bytes() - offset) {
    return failure(Status::kBadIndex, "image of a part", TableId::kParts, record);
  }
  bytes = Bytes(images.data + offset, size);
  return {};
}

}  // namespace

void use_sensor(SensorNumber sensor, Mission& mission, Parts& parts) {
  static_cast<SensorParameters&>(mission.parameters) = mission.sensors[sensor];
  for (Part& part : parts) static_cast<SensorParameters&>(part.mission.parameters) = mission.sensors[sensor];
}

void ImageLoad::begin(Bytes bytes) {
  *this = ImageLoad{};
  checked_ = false;
  if (reinterpret_cast<std::uintptr_t>(bytes.data()) % 8 != 0)
    return finish(failure(Status::kBadValue, "image buffer is not aligned to 8"));
  check_.begin(bytes);
}

void ImageLoad::finish(const LoadFailure& found) {
  result_ = found;
  checked_ = true;
}

bool ImageLoad::check(std::uint32_t words) {
  if (!checked_ && check_.step(words)) take_checked();
  return checked_;
}

// Of the whole first, then of one part after the other.
void ImageLoad::take_checked() {
  LoadFailure found = check_.result();
  if (checking_ == kWholeImage) {
    whole_ = check_.image();
    part_count_ = whole_[TableId::kParts].records;
  } else {
    parts_[checking_ - 1] = check_.image();
    free_from_ = static_cast<std::uint32_t>(check_.image().bytes.end() - whole_[TableId::kPartImages].data);
    if (!failed(found) && check_.image()[TableId::kParts].records != 0) {
      found = failure(Status::kBadValue, "a part with parts", TableId::kParts);
    }
    if (failed(found)) found.table += kPartsTables * checking_;
  }
  if (!failed(found) && checking_ < part_count_) found = begin_part(checking_);
  if (failed(found) || checking_ == part_count_) return finish(found);
  ++checking_;
}

LoadFailure ImageLoad::begin_part(std::uint32_t record) {
  const ImageTable& table = whole_[TableId::kParts];
  const char* fault = fault_of(read_part(table, record));
  if (fault != nullptr) return failure(Status::kBadValue, fault, TableId::kParts, record);
  Bytes bytes;
  const LoadFailure found = find_part_image(table, whole_[TableId::kPartImages], record, free_from_, bytes);
  if (!failed(found)) check_.begin(bytes);
  return found;
}

bool ImageLoad::convert(std::uint32_t words) {
  const std::size_t left = whole_.bytes.size() - converted_;
  const std::size_t size = left < std::size_t{4} * words ? left : std::size_t{4} * words;
  convert_piece(converted_, whole_.bytes.subspan(converted_, size));
  converted_ += size;
  return converted_ == whole_.bytes.size();
}

void ImageLoad::convert_piece(std::size_t offset, Bytes piece) const {
  convert_image(whole_, whole_.bytes.data(), offset, piece);
  for (std::uint32_t i = 0; i < part_count_; ++i) convert_image(parts_[i], whole_.bytes.data(), offset, piece);
}

void ImageLoad::make(Mission& mission) const { set_mission(whole_, mission); }

void ImageLoad::make(Mission& mission, Parts& parts) const {
  parts.clear();
  for (std::uint32_t i = 0; i < part_count_; ++i) {
    invariant(parts.push_back(read_part(whole_[TableId::kParts], i)), "more parts than were checked");
    set_mission(parts_[i], parts[i].mission);
  }
  make(mission);
}

bool ImageLoad::find_calibration(SensorNumber sensor, std::uint8_t index, TriangulationCalibration& calibration) const {
  const ImageTable& table = whole_[TableId::kCalibrations];
  std::uint32_t first = 0;
  while (first < table.records && table.word(first, 0) != sensor) ++first;
  const std::uint32_t record = first + index;
  if (record >= table.records || table.word(record, 0) != sensor) return false;
  calibration = calibration_of(table, record);
  return true;
}

bool ImageLoad::find_named_frame(std::uint32_t index, NamedFrame& frame) const {
  const ImageTable& table = whole_[TableId::kNamedFrames];
  if (index >= table.records) return false;
  frame = named_frame_of(table, index);
  return is_valid(frame);
}

LoadFailure ImageLoad::run(Bytes bytes) {
  begin(bytes);
  while (!check(kAllWords)) {
  }
  if (!failed(result_)) static_cast<void>(convert(kAllWords));
  return result_;
}

LoadFailure load_image(Bytes bytes, Mission& mission, Parts& parts) {
  ImageLoad load;
  const LoadFailure result = load.run(bytes);
  if (!failed(result)) load.make(mission, parts);
  return result;
}

LoadFailure load_image(Bytes bytes, Mission& mission) {
  ImageLoad load;
  const LoadFailure result = load.run(bytes);
  if (!failed(result)) load.make(mission);
  return result;
}

}  // namespace lasso
