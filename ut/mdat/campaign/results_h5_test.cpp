#include "mdat/campaign/results_h5.hpp"

#include <gtest/gtest.h>
#include <hdf5.h>

#include <cmath>

#include "ut/mdat/campaign/tables.hpp"
#include "ut/support/verifies.hpp"

namespace lasso::mdat {
namespace {

// A file's bytes, opened by the library that other programs read it with.
class H5File {
 public:
  explicit H5File(std::string bytes) : bytes_(std::move(bytes)) {
    const hid_t access = H5Pcreate(H5P_FILE_ACCESS);
    H5Pset_fapl_core(access, 1 << 16, false);
    H5Pset_file_image(access, bytes_.data(), bytes_.size());
    id_ = H5Fopen("test.h5", H5F_ACC_RDONLY, access);
    H5Pclose(access);
  }
  ~H5File() { H5Fclose(id_); }
  H5File(const H5File&) = delete;
  H5File& operator=(const H5File&) = delete;
  hid_t id() const { return id_; }

  std::vector<double> column(const char* name) const {
    const hid_t data = H5Dopen2(id_, name, H5P_DEFAULT), space = H5Dget_space(data);
    std::vector<double> values(static_cast<std::size_t>(H5Sget_simple_extent_npoints(space)));
    H5Dread(data, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data());
    H5Sclose(space);
    H5Dclose(data);
    return values;
  }

  std::string attribute(const char* of, const char* name) const {
    const hid_t attribute = H5Aopen_by_name(id_, of, name, H5P_DEFAULT, H5P_DEFAULT);
    if (attribute < 0) return "";
    const hid_t type = H5Aget_type(attribute);
    std::string text(H5Tget_size(type), '\0');
    H5Aread(attribute, type, text.data());
    H5Tclose(type);
    H5Aclose(attribute);
    return text;
  }

 private:
  std::string bytes_;
  hid_t id_ = -1;
};

TEST(ResultsH5, ReadsBackAsTheTable) {
  VERIFIES("LASSO-GND-058~1");
  const test::MixedCampaign mixed;
  const H5File file(results_h5(mixed.table, "rough", "abc123"));
  ASSERT_GE(file.id(), 0);
  EXPECT_EQ(file.attribute("/", "campaign"), "rough");
  EXPECT_EQ(file.attribute("/", "plan"), "abc123");
  EXPECT_EQ(file.column("case").at(39), 39);
  const std::vector<double> rms = file.column("figures/rms_mm"), spin = file.column("drawn/truth.spin_degps.x");
  ASSERT_EQ(rms.size(), 40U);
  for (std::size_t i = 0; i < 40; ++i) {
    EXPECT_EQ(spin[i], mixed.table.rows[i].drawn[1]);
    if (i == 3 || i == 5)
      EXPECT_TRUE(std::isnan(rms[i]));
    else
      EXPECT_EQ(rms[i], mixed.table.rows[i].figures[1]);
  }
  EXPECT_EQ(file.attribute("figures/rms_mm", "unit"), "mm");
  EXPECT_EQ(file.attribute("drawn/truth.spin_degps.x", "unit"), "deg/s");
  EXPECT_EQ(file.attribute("figures/wrong", "unit"), "");
}

TEST(ResultsH5, StatusIsText) {
  VERIFIES("LASSO-GND-058~1");
  const test::MixedCampaign mixed;
  const H5File file(results_h5(mixed.table, "rough", "abc123"));
  const hid_t data = H5Dopen2(file.id(), "status", H5P_DEFAULT), type = H5Dget_type(data);
  const std::size_t size = H5Tget_size(type);
  std::string text(40 * size, '\0');
  H5Dread(data, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, text.data());
  EXPECT_STREQ(text.substr(0, size).c_str(), "ok");
  EXPECT_EQ(text.substr(3 * size, size), "failed:worker ended, by \"signal\" 11");  // the longest one
  H5Tclose(type);
  H5Dclose(data);
}

// Times of objects, which differ from run to run, are 0 where none is kept.
herr_t expect_no_times(hid_t, const char* name, const H5O_info_t* info, void* count) {
  EXPECT_EQ(info->ctime, 0) << name;
  EXPECT_EQ(info->mtime, 0) << name;
  ++*static_cast<int*>(count);
  return 0;
}

TEST(ResultsH5, KeepsNoTimesAndTheOrderOfColumns) {
  VERIFIES("LASSO-GND-058~1");
  const test::MixedCampaign mixed;
  const std::string bytes = results_h5(mixed.table, "rough", "abc123");
  const H5File file(bytes);
  int objects = 0;
  H5Ovisit2(file.id(), H5_INDEX_NAME, H5_ITER_NATIVE, expect_no_times, &objects, H5O_INFO_TIME);
  EXPECT_EQ(objects, 1 + 2 + 2 + 4);
  EXPECT_EQ(bytes, results_h5(mixed.table, "rough", "abc123"));
  char name[64];
  H5Lget_name_by_idx(file.id(), "figures", H5_INDEX_CRT_ORDER, H5_ITER_INC, 0, name, sizeof name, H5P_DEFAULT);
  EXPECT_STREQ(name, "wrong");  // rms_mm comes first by name
}

TEST(ResultsH5, HoldsATableWithoutCases) {
  VERIFIES("LASSO-GND-058~1");
  const H5File file(results_h5(test::table_of({}), "", ""));
  EXPECT_TRUE(file.column("figures/rms_mm").empty());
}

TEST(ResultsH5, UnitsAreWhatNamesEndWith) {
  VERIFIES("LASSO-GND-058~1");
  EXPECT_EQ(unit_of("truth.offset_m.x"), "m");
  EXPECT_EQ(unit_of("found_s"), "s");
  EXPECT_EQ(unit_of("settled_mmps"), "mm/s");
  EXPECT_EQ(unit_of("truth.dropout_probability"), "");
  EXPECT_EQ(unit_of("frames"), "");
}

}  // namespace
}  // namespace lasso::mdat
