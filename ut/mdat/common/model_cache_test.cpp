#include "mdat/common/model_cache.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <set>
#include <thread>
#include <vector>

#include "mdat/missiondb/model_file.hpp"
#include "mdat/source/sha256.hpp"
#include "ut/mdat/modelc/meshes.hpp"
#include "ut/support/places.hpp"
#include "ut/support/verifies.hpp"

namespace lasso::mdat {
namespace {

namespace fs = std::filesystem;

struct Model {
  ModelTables tables;
  CompileReport report;
};

// Of no mesh: as many words as it says, none like those of another seed.
Model made_up(std::uint32_t seed, std::size_t words = 1000) {
  Model model;
  for (std::size_t i = 0; i < words; ++i) model.tables[TableId::kRayLists].push_back(seed + static_cast<std::uint32_t>(7 * i));
  model.tables[TableId::kHull] = {seed, 2, 3};
  model.report.elements = seed;
  model.report.ray_lists.mean = 0.1 * seed;
  model.report.seconds = 1.5;
  return model;
}

std::string key_for(const std::string& name) { return sha256_of(name); }

std::string read(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
}

void write(const fs::path& file, const std::string& bytes) { std::ofstream(file, std::ios::binary) << bytes; }

class ModelCacheTest : public ::testing::Test {
 protected:
  ModelCacheTest() {
    char name[] = "/tmp/ut-model-cache-XXXXXX";
    top_ = mkdtemp(name);
    at_.folder = top_ / "cache";
  }
  ~ModelCacheTest() override {
    std::error_code ignored;
    fs::remove_all(top_, ignored);
  }

  // The cache's warning, or "".
  std::string keep(const std::string& name, const Model& model) const {
    ModelCache cache(at_);
    cache.keep(key_for(name), model.tables, model.report);
    return cache.warning();
  }
  bool find(const std::string& name, Model& model) const { return ModelCache(at_).find(key_for(name), model.tables, model.report); }
  bool has(const std::string& name) const {
    Model ignored;
    return find(name, ignored);
  }
  fs::path file(const std::string& name) const { return at_.folder / (key_for(name) + ".3dlm"); }
  std::ptrdiff_t files() const { return std::distance(fs::directory_iterator(at_.folder), fs::directory_iterator()); }

  fs::path top_;
  ModelCacheOptions at_;
};

TEST_F(ModelCacheTest, GivesTheBytesAndTheReportOfACompilation) {
  VERIFIES("LASSO-MDT-012~1");
  for (const char* name : {"hubble_tenth.toml", "probe.toml"}) {
    const Mesh mesh = build_model(test::source_folder() / "cfg/models" / name, {});
    ModelOptions options;
    options.cell_size_m = 0.1;
    Model fresh, first, second;
    fresh.tables = compile_model(mesh, options, fresh.report);
    ModelCache filled(at_), found(at_);
    first.tables = filled.compile(mesh, options, first.report);
    second.tables = found.compile(mesh, options, second.report);
    EXPECT_EQ(filled.found(), 0U) << name;
    EXPECT_EQ(found.found(), 1U) << name;
    EXPECT_EQ(second.tables.words, fresh.tables.words) << name;
    EXPECT_EQ(second.report, first.report) << name;
    fresh.report.seconds = second.report.seconds;
    EXPECT_EQ(second.report, fresh.report) << name;
    EXPECT_GT(second.report.elements, 10U) << name;
  }
}

TEST(ModelKey, IsAnotherOneForAnotherMeshOptionOrCompiler) {
  VERIFIES("LASSO-MDT-012~1");
  const Mesh box = shapes::box({0, 0, 0}, {0.5, 0.4, 0.3}), higher = shapes::box({0, 0, 0}, {0.5, 0.4, std::nextafter(0.3, 1)});
  Mesh turned = box;
  std::swap(turned.triangles[0][0], turned.triangles[0][1]);
  std::set<std::string> keys;
  for (const Mesh& mesh : {box, higher, turned}) keys.insert(model_key("a", mesh, {}));
  keys.insert(model_key("b", box, {}));
  for (double ModelOptions::*member : {&ModelOptions::cell_size_m, &ModelOptions::crease_angle_deg, &ModelOptions::weld_tolerance_m,
                                       &ModelOptions::far_margin, &ModelOptions::near_band_m}) {
    ModelOptions options;
    options.*member = 0.05;
    keys.insert(model_key("a", box, options));
  }
  ModelOptions oriented;
  oriented.oriented = true;
  keys.insert(model_key("a", box, oriented));
  EXPECT_EQ(keys.size(), 10U);
  EXPECT_EQ(model_key("a", box, {}), model_key("a", Mesh(box), ModelOptions()));
}

TEST(ModelKey, KnowsTheCompiler) {
  VERIFIES("LASSO-MDT-012~1");
  const std::string compiler = model_compiler();
  for (const char* part : {"mdat ", "sources ", "Eigen 3", "Embree 3"}) EXPECT_NE(compiler.find(part), std::string::npos) << compiler;
  EXPECT_EQ(compiler.find('@'), std::string::npos) << compiler;
  EXPECT_EQ(compiler.find(test::source_folder().string()), std::string::npos) << "the same in any folder: " << compiler;
}

TEST_F(ModelCacheTest, ADamagedTruncatedOrForeignEntryIsNone) {
  VERIFIES("LASSO-MDT-013~1");
  const Model model = made_up(3);
  ASSERT_EQ(keep("one", model), "");
  ASSERT_EQ(keep("other", made_up(4)), "");
  const std::string good = read(file("one"));
  std::string flipped = good;
  flipped[good.size() / 2] = static_cast<char>(flipped[good.size() / 2] ^ 1);
  // Right in its digest and its key, and too short, or with a table of more words than it has.
  const std::string key = key_for("one"), empty = key + std::string(sizeof(CompileReport), '\0'), endless = empty + std::string(8, '\xff');
  const std::string bad[] = {flipped,
                             good.substr(0, good.size() - 1),
                             good.substr(0, 40),
                             "",
                             good + "more",
                             read(file("other")),
                             sha256_of(key) + key,
                             sha256_of(empty) + empty,
                             sha256_of(endless) + endless};
  for (const std::string& entry : bad) {
    write(file("one"), entry);
    Model found;
    EXPECT_FALSE(find("one", found)) << entry.size();
    EXPECT_EQ(keep("one", model), "");
    EXPECT_TRUE(find("one", found)) << entry.size();
    EXPECT_EQ(found.tables.words, model.tables.words);
    EXPECT_EQ(found.report, model.report);
  }
}

TEST_F(ModelCacheTest, ServesSeveralAtOnce) {
  VERIFIES("LASSO-MDT-013~1");
  const Model model = made_up(5, 100000);
  ASSERT_EQ(keep("one", model), "");
  std::atomic<int> wrong = 0;
  const auto work = [&] {
    for (int i = 0; i < 20; ++i) {
      Model found;
      wrong += !keep("one", model).empty();
      wrong += !find("one", found) || found.tables.words != model.tables.words;
    }
  };
  {
    std::vector<std::jthread> threads;
    for (int i = 0; i < 4; ++i) threads.emplace_back(work);
  }
  EXPECT_EQ(wrong, 0);
  EXPECT_EQ(files(), 1) << "nothing is left beside the entry";
}

TEST_F(ModelCacheTest, WhatWasUsedLongestAgoIsRemovedFirst) {
  VERIFIES("LASSO-MDT-014~1");
  ASSERT_EQ(keep("a", made_up(1)), "");
  const std::uint64_t one = fs::file_size(file("a"));
  at_.bytes_max = 5 * one / 2;
  write(at_.folder / "notes.txt", std::string(10 * one, ' '));
  write(at_.folder / "a.3dlm.bak", std::string(10 * one, ' '));
  const fs::path left = at_.folder / "0123.3dlm.AbCdEf";
  write(left, std::string(one, ' '));
  const auto used = [](const fs::path& entry, int hours) {
    fs::last_write_time(entry, fs::file_time_type::clock::now() - std::chrono::hours(hours));
  };
  used(left, 9);
  used(file("a"), 8);
  ASSERT_EQ(keep("b", made_up(2)), "");
  EXPECT_FALSE(fs::exists(left)) << "what a process left behind goes, too";
  used(file("b"), 7);
  ASSERT_TRUE(has("a")) << "used again";
  ASSERT_EQ(keep("c", made_up(3)), "");
  EXPECT_TRUE(has("a"));
  EXPECT_FALSE(has("b"));
  EXPECT_TRUE(has("c"));
  EXPECT_EQ(files(), 4) << "two entries, and files that are none";
}

TEST_F(ModelCacheTest, AFolderThatCannotBeWrittenCostsAWarning) {
  VERIFIES("LASSO-MDT-014~1");
  write(top_ / "file", "no folder");
  at_.folder = top_ / "file";
  EXPECT_FALSE(has("a"));
  const std::string warning = keep("a", made_up(1));
  EXPECT_EQ(warning.find("the compiled model is not kept: " + at_.folder.string() + ": cannot be written: "), 0U) << warning;
  EXPECT_EQ(read(top_ / "file"), "no folder");
}

// The environment is this process's: it is put back.
class UserCache : public ::testing::Test {
 protected:
  UserCache() {
    for (const char* name : {"MDAT_CACHE", "XDG_CACHE_HOME", "HOME"}) {
      const char* value = std::getenv(name);
      before_.emplace_back(name, value == nullptr ? "" : value);
      unsetenv(name);
    }
  }
  ~UserCache() override {
    for (const auto& [name, value] : before_) value.empty() ? unsetenv(name) : setenv(name, value.c_str(), 1);
  }
  std::vector<std::pair<const char*, std::string>> before_;
};

TEST_F(UserCache, LiesWhereTheEnvironmentSays) {
  VERIFIES("LASSO-MDT-014~1");
  EXPECT_EQ(ModelCache::of_user().folder(), "") << "none";
  setenv("HOME", "/home/someone", 1);
  EXPECT_EQ(ModelCache::of_user().folder(), "/home/someone/.cache/3dlasso");
  setenv("XDG_CACHE_HOME", "relative", 1);
  EXPECT_EQ(ModelCache::of_user().folder(), "/home/someone/.cache/3dlasso") << "the XDG specification has it ignored";
  setenv("XDG_CACHE_HOME", "/var/cache/someone", 1);
  EXPECT_EQ(ModelCache::of_user().folder(), "/var/cache/someone/3dlasso");
  setenv("MDAT_CACHE", "here", 1);
  EXPECT_EQ(ModelCache::of_user().folder(), "here");
  EXPECT_EQ(ModelCache::of_user_if(false).folder(), "");
  EXPECT_EQ(ModelCache::none().folder(), "");
}

}  // namespace
}  // namespace lasso::mdat
