// Bytes that claim to be a flight image. The loader refuses them and changes nothing, or makes a mission on which an estimate or a search
// reads nothing out of bounds and ends. The first byte: bit 0 leaves lengths and checksums as they are (else they are repaired, since no
// mutation gets past them), bit 1 starts the estimate wide, bit 2 searches instead. Mutations of bytes seldom leave an image that loads, so
// most of them are of words in tables, of the whole's or of a part's.
#include "cfg/capacities.hpp"
#include "fsw/core/crc.hpp"
#include "fsw/mission/image_format.hpp"
#include "fsw/mission/mission.hpp"
#include "fsw/pose/estimator/estimator.hpp"
#include "fsw/pose/recognition/pose_search.hpp"
#include "ft/fuzz/exact.hpp"
#include "ft/fuzz/small_image.hpp"
#include "ut/support/generator.hpp"

extern "C" std::size_t LLVMFuzzerMutate(std::uint8_t* data, std::size_t size, std::size_t max_size);

namespace lasso::fuzz {
namespace {

constexpr int kSearchSide = 13;  // rays each way: more would take milliseconds
constexpr std::uint32_t kSlice = 10'000, kMaxSlices = 10'000;
constexpr std::size_t kLengthAt = 8, kTablesAt = 12;
constexpr std::size_t kDirectoryAt = std::size_t{4} * kImageHeaderWords;
constexpr std::size_t kPartBytes = std::size_t{4} * kPartWords;
constexpr std::size_t kEntryBytes = std::size_t{4} * kDirectoryEntryWords;

bool has_directory(ConstBytes image) { return image.size() >= kDirectoryAt + kTableCount * kEntryBytes + 4; }
std::uint32_t tables_of(ConstBytes image) { return get_u32(image.data() + kTablesAt) == kTableCount ? kTableCount : kLeastTables; }
std::uint8_t* entry_of(Bytes image, std::size_t table) { return image.data() + kDirectoryAt + table * kEntryBytes; }

// The bytes of a table; none where its entry says nonsense.
Bytes table_of(Bytes image, std::size_t table) {
  const std::uint8_t* entry = entry_of(image, table);
  const std::uint64_t bytes = std::uint64_t{4} * get_u32(entry + 4) * get_u32(entry + 8);
  const std::size_t offset = get_u32(entry + 12);
  if (offset > image.size() || bytes > image.size() - offset) return {};
  return image.subspan(offset, bytes);
}

// The image of a part; nothing where the tables of the whole say nonsense of it.
Bytes part_of(Bytes image, std::size_t part) {
  const Bytes parts = table_of(image, static_cast<std::size_t>(TableId::kParts) - 1);
  const Bytes images = table_of(image, static_cast<std::size_t>(TableId::kPartImages) - 1);
  if (parts.size() / kPartBytes <= part) return {};
  const std::uint8_t* record = parts.data() + part * kPartBytes;
  const std::size_t offset = get_u32(record + std::size_t{4} * kPartImageOffset);
  const std::size_t bytes = get_u32(record + std::size_t{4} * kPartImageBytes);
  if (offset > images.size() || bytes > images.size() - offset) return {};
  return images.subspan(offset, bytes);
}

void repair_one(Bytes image) {
  if (!has_directory(image)) return;
  put_u32(image.data() + kLengthAt, static_cast<std::uint32_t>(image.size()));
  for (std::size_t i = 0; i < tables_of(image); ++i) put_u32(entry_of(image, i) + 16, crc32c(table_of(image, i)));
  put_u32(image.data() + image.size() - 4, crc32c(image.first(image.size() - 4)));
}

void repair(Bytes image) {
  if (!has_directory(image)) return;
  for (std::size_t part = 0; part < kMaxParts; ++part) repair_one(part_of(image, part));
  repair_one(image);
}

std::uint32_t mutated(std::uint32_t word, test::Generator& random) {
  switch (random.below(6)) {
    case 0:
      return word ^ 1U << random.below(32);
    case 1:
      return word + 1;
    case 2:
      return word - 1;
    case 3:
      return 0U - static_cast<std::uint32_t>(random.below(2));
    case 4:
      return static_cast<std::uint32_t>(random.below(1U << random.below(32)));
    default:
      return static_cast<std::uint32_t>(random.bits());
  }
}

void mutate_words(Bytes image, test::Generator& random) {
  for (std::uint64_t n = 1 + random.below(8); n > 0; --n) {
    const Bytes table = table_of(image, random.below(tables_of(image)));
    if (table.size() < 4) continue;
    std::uint8_t* word = table.data() + 4 * random.below(table.size() / 4);
    put_u32(word, mutated(get_u32(word), random));
  }
}

void estimate(const Mission& mission, bool wide) {
  static const auto scan = small_scan();
  static const auto estimator = std::make_unique<Estimator>();
  const Registration result = estimator->estimate(mission, *scan, {small_start(), Twist{}, wide});
  expect(result.inliers <= result.returns && result.returns <= scan->samples.size(), "no more inliers than returns than samples");
}

void search(const Mission& mission) {
  static const auto scan = small_scan(kSearchSide);
  static const auto workspace = std::make_unique<Workspace>();
  static const auto search = std::make_unique<PoseSearch>();
  search->begin(SearchLimits());
  if (search->add_scan(mission, *scan, *workspace) != Status::kOk) return;
  for (std::uint32_t slices = 0; !search->advance(mission, *workspace, kSlice); ++slices) expect(slices < kMaxSlices, "a search ends");
  expect(search->result().outcome != SearchOutcome::kNone, "a search that ended has an outcome");
}

// As the scans of the last sensor see it, if asked for.
void use(Mission& mission, Parts& parts, std::uint8_t options) {
  if ((options & 8) != 0) use_sensor(static_cast<SensorNumber>(mission.sensors.size() - 1), mission, parts);
  if ((options & 4) != 0) return search(mission);
  estimate(mission, (options & 2) != 0);
  for (const Part& part : parts) estimate(part.mission, (options & 2) != 0);
}

void load(ConstBytes input, std::uint8_t options) {
  ExactCopy image(input);
  if ((options & 1) == 0) repair(image.bytes());
  ExactCopy before(image.bytes());
  Mission mission;
  static Parts parts;
  parts.clear();
  const LoadFailure failure = load_image(image.bytes(), mission, parts);
  if (failure.status == Status::kOk) return use(mission, parts, options);
  expect(image.equals(before.bytes()), "an image that is refused stays as it was");
  expect(mission.image_crc == 0 && mission.field.elements == nullptr, "a mission stays as it was when its image is refused");
  expect(parts.size() == 0, "the parts stay as they were when their image is refused");
}

}  // namespace
}  // namespace lasso::fuzz

extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size, std::size_t max_size, unsigned seed) {
  lasso::test::Generator random(seed);
  const lasso::Bytes image(data + 1, size == 0 ? 0 : size - 1);
  if (!lasso::fuzz::has_directory(image) || random.below(8) == 0) return LLVMFuzzerMutate(data, size, max_size);
  const lasso::Bytes part = lasso::fuzz::part_of(image, random.below(2));
  lasso::fuzz::mutate_words(lasso::fuzz::has_directory(part) && random.below(2) == 0 ? part : image, random);
  return size;
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size > 0) lasso::fuzz::load({data + 1, size - 1}, data[0]);
  return 0;
}
