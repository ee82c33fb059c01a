#include "mdat/modelc/image_writer.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <cstring>

#include "cfg/capacities.hpp"
#include "fsw/core/crc.hpp"
#include "fsw/mission/mission.hpp"
#include "ut/mdat/modelc/meshes.hpp"
#include "ut/mdat/modelc/tables.hpp"
#include "ut/support/verifies.hpp"

namespace lasso::mdat {
namespace {

ModelTables compile(const Mesh& mesh) {
  ModelOptions options;
  options.cell_size_m = 0.02;
  CompileReport report;
  return compile_model(mesh, options, report);
}

std::uint32_t word_at(const std::vector<std::uint8_t>& bytes, std::size_t offset) {
  std::uint32_t word = 0;
  for (std::size_t i = 0; i < 4; ++i) word = word << 8 | bytes[offset + i];
  return word;
}

void expect_every_table(const ModelTables& tables, std::uint32_t count) {
  const auto bytes = write_image(7, 3, preset_parameters(), tables);
  EXPECT_EQ(word_at(bytes, 0), kImageMagic);
  EXPECT_EQ(word_at(bytes, 8), bytes.size());
  EXPECT_EQ(word_at(bytes, 16), 7u);
  EXPECT_EQ(word_at(bytes, 20), 3u);
  EXPECT_EQ(word_at(bytes, 24), parameter_rows().size());
  EXPECT_EQ(word_at(bytes, 12), count);
  std::size_t end = 4 * (kImageHeaderWords + count * kDirectoryEntryWords);
  for (std::uint32_t id = 1; id <= count; ++id) {
    const std::size_t entry = 4 * (kImageHeaderWords + kDirectoryEntryWords * (id - 1));
    EXPECT_EQ(word_at(bytes, entry), id);
    const std::size_t words = std::size_t{word_at(bytes, entry + 4)} * word_at(bytes, entry + 8);
    const std::size_t offset = word_at(bytes, entry + 12);
    EXPECT_EQ(offset % 8, 0u);
    ASSERT_GE(offset, end);
    for (std::size_t i = end; i < offset; ++i) EXPECT_EQ(bytes[i], 0);
    EXPECT_EQ(word_at(bytes, entry + 16), crc32c({bytes.data() + offset, 4 * words}));
    if (id > 1) {
      ASSERT_EQ(words, tables.words[id].size());
      for (std::size_t i = 0; i < words; ++i) ASSERT_EQ(word_at(bytes, offset + 4 * i), tables.words[id][i]);
    }
    end = offset + 4 * words;
  }
  EXPECT_EQ(bytes.size(), end + 4);
  EXPECT_EQ(word_at(bytes, end), crc32c({bytes.data(), end}));
  EXPECT_EQ(write_image(7, 3, preset_parameters(), tables), bytes);
}

TEST(ImageWriter, DirectoryFindsEveryTableAndChecksumsHold) {
  VERIFIES("LASSO-MDL-016~1 LASSO-LNK-050~1");
  ModelTables tables = compile(shapes::sphere(0.3, 10, 12));
  expect_every_table(tables, 19);  // as before there were named frames
  tables[TableId::kNamedFrames].assign(kNamedFrameWords, 7);
  expect_every_table(tables, 20);
}

TEST(ImageWriter, ParametersAreBinary64InTheOrderOfTheirRows) {
  VERIFIES("LASSO-MDL-016~1");
  MissionParameters parameters = preset_parameters();
  parameters.sigma0_m = 0.000123;
  parameters.initial_vz_mps = -0.25;
  const auto bytes = write_image(1, 1, parameters, compile(shapes::box({0, 0, 0}, {0.3, 0.2, 0.1})));
  std::size_t offset = word_at(bytes, 4 * kImageHeaderWords + 12);
  for (const ParameterRow& row : parameter_rows()) {
    const std::uint64_t bits = std::uint64_t{word_at(bytes, offset)} << 32 | word_at(bytes, offset + 4);
    EXPECT_EQ(std::bit_cast<double>(bits), parameters.*row.member) << row.key;
    offset += 8;
  }
}

TEST(ImageWriter, TheFlightLoaderAcceptsEveryShape) {
  VERIFIES("LASSO-MDL-016~1");
  auto meshes = shapes::property_meshes();
  Mesh triangle;
  triangle.vertices = {{0, 0, 0}, {0.3, 0, 0}, {0, 0.4, 0.1}};
  triangle.triangles = {{0, 1, 2}};
  meshes.emplace_back("one triangle", triangle);
  for (const auto& [name, mesh] : meshes) {
    const ModelTables tables = compile(mesh);
    const auto bytes = write_image(9, 2, preset_parameters(), tables);
    std::vector<std::uint64_t> memory(bytes.size() / 8 + 1);
    std::memcpy(memory.data(), bytes.data(), bytes.size());
    Mission mission;
    const LoadFailure failure = load_image({reinterpret_cast<std::uint8_t*>(memory.data()), bytes.size()}, mission);
    EXPECT_EQ(failure.status, Status::kOk) << name << ": " << failure.what << " in table " << failure.table << ", record "
                                           << failure.record;
    EXPECT_EQ(mission.id, 9u);
    EXPECT_EQ(mission.field.element_count, tables[TableId::kElements].size() / kElementWords);
  }
}

// The flight component's own look-up, in its own number type, finds what brute force in double precision finds.
TEST(ImageWriter, TheFlightLookUpHitsWhatBruteForceHits) {
  VERIFIES("LASSO-MDL-002~1");
  for (const auto& [name, mesh] : shapes::property_meshes()) {
    SCOPED_TRACE(name);
    const ModelTables tables = compile(mesh);
    const DecodedTables decoded(tables);
    const auto bytes = write_image(1, 1, preset_parameters(), tables);
    std::vector<std::uint64_t> memory(bytes.size() / 8 + 1);
    std::memcpy(memory.data(), bytes.data(), bytes.size());
    Mission mission;
    ASSERT_EQ(load_image({reinterpret_cast<std::uint8_t*>(memory.data()), bytes.size()}, mission).status, Status::kOk);
    Random random(61);
    int hits = 0, differ = 0;
    for (int k = 0; k < 4000; ++k) {
      const Eigen::Vector3d u = shapes::random_unit(random);
      const Eigen::Vector3d from = Eigen::Vector3d(0.11, -0.07, 0.05) + 0.35 * shapes::random_vector(random) - 1.5 * u;
      double truth = std::numeric_limits<double>::infinity();
      for (std::size_t i = 0; i < decoded.elements().size(); ++i) {
        const bool seen = decoded.elements()[i].n.dot(u) < 0 || decoded.elements()[i].flags == kElementTwoSided;
        if (seen) truth = std::min(truth, decoded.crossing(i, from, u));
      }
      FieldRay<FlightNumber> ray{};
      for (int i = 0; i < 3; ++i) {
        ray.m[i] = FlightNumber::to_length(from[i]);
        ray.u[i] = FlightNumber::to<FlightNumber::Unit>(u[i]);
      }
      set_cells(mission.field, ray);
      const auto hit = walk_field(mission.field, ray, FlightNumber::to_length(0.3), FlightNumber::to_length(3));
      hits += std::isfinite(truth);
      const bool same = hit.found == std::isfinite(truth) && (!hit.found || std::abs(static_cast<double>(hit.t) - truth) < 1e-4);
      differ += !same;
    }
    EXPECT_GT(hits, 500);
    EXPECT_LE(differ, 2);  // rays that graze an outline or a plane to within single precision
  }
}

TEST(ImageWriter, RefusesWhatTheFlightComponentHasNoRoomFor) {
  VERIFIES("LASSO-MDL-008~1");
  ModelTables tables = compile(shapes::box({0, 0, 0}, {0.3, 0.2, 0.1}));
  tables[TableId::kFootPoints].resize(kMaxImageBytes / 4, 0);
  EXPECT_THROW(write_image(1, 1, preset_parameters(), tables), CompileError);
}

}  // namespace
}  // namespace lasso::mdat
