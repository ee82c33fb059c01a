#include <gtest/gtest.h>

#include "ut/hal_sim/scan_files.hpp"
#include "ut/support/verifies.hpp"

namespace lasso::sim {
namespace {

using test::expect_refused;
using test::Folder;

TEST(ScanXyz, ReadsPlainTextHoweverItIsSeparated) {
  VERIFIES("LASSO-SIM-042~1");
  const struct {
    const char* what;
    std::string text;
  } cases[] = {{"blanks", "0.3 -0.4 1.2\n0 0 2.5\n"},
               {"blanks, more columns, blank lines", "\n  0.3   -0.4 1.2 255 255 255\n\n0 0 2.5 0 0 0\n\n\n"},
               {"tabs, CR LF", "0.3\t-0.4\t1.2\r\n0\t0\t2.5\r\n"},
               {"commas", "0.3,-0.4,1.2,17\n0,0,2.5,18\n"},
               {"commas and blanks", "0.3, -0.4, 1.2\n0, 0, 2.5\n"},
               {"semicolons", "0.3;-0.4;+1.2\n0;0;2.5\n"},
               {"semicolons, decimal commas", "0,3; -0,4; 1,2\n0;0;2,5\n"},
               {"blanks, decimal commas", "0,3 -0,4 1,2\n0,0 0,0 2,5\n"},
               {"header", "X Y Z Intensity\n0.3 -0.4 1.2 9\n0 0 2.5 9\n"},
               {"other order", "Intensity,z[m],\"y\",x_m\n9,1.2,-0.4,0.3\n9,2.5,0,0\n"},
               {"marked header", "//X Y Z R G B\n0.3 -0.4 1.2 1 2 3\n0 0 2.5 1 2 3\n"},
               {"marked header of another order", "# made elsewhere\n# z, x, y\n1.2 0.3 -0.4\n# half way\n2.5 0 0\n"},
               {"blanks in a name", "Point ID,X,Y,Z,Intensity\n1,0.3,-0.4,1.2,9\n2,0,0,2.5,9\n"},
               {"blanks in a name, tabs", "Point ID\tX (m)\tY (m)\tZ (m)\n1\t0.3\t-0.4\t1.2\n2\t0\t0\t2.5\n"},
               {"commas in the header alone", "id,z,x,y\n7 1.2 0.3 -0.4\n7 2.5 0 0\n"},
               {"a name for the first columns", "x y z\n0.3 -0.4 1.2 9 9\n0 0 2.5 9 9\n"},
               {"a separator at the end", "id;x;y;z\n1;0,3;-0,4;1,2;\n2;0;0;2,5;\n"},
               {"a remark of axes, 5 columns", "# x right, y down, z forward\n0.3 -0.4 1.2 8 9\n0 0 2.5 8 9\n"},
               {"a remark of axes, 6 columns", "# x right, y down, z forward\n0.3 -0.4 1.2 7 8 9\n0 0 2.5 7 8 9\n"},
               {"a remark of axes, 3 columns", "# z forward, x right, y down\n0.3,-0.4,1.2\n0,0,2.5\n"},
               {"a remark after the names", "# z x y\n# made elsewhere\n1.2 0.3 -0.4\n2.5 0 0\n"},
               {"blanks before commas", "0.3 ,-0.4 ,1.2\n0 ,0 ,2.5\n"},
               {"a count", "2\n0.3 -0.4 1.2 -7\n0 0 2.5 -7\n"},
               {"byte order mark, exponents",
                "\xEF\xBB\xBF"
                "3e-1 -4.0E-1 1.2\n0 0 2.5"}};
  const Folder folder;
  for (const auto& c : cases) {
    const RawScan scan = read_raw_scan(folder.write("a.xyz", c.text));
    ASSERT_EQ(scan.rays.size(), 2u) << c.what;
    EXPECT_EQ(scan.rays[0].place, Vec3(0.3, -0.4, 1.2)) << c.what;
    EXPECT_EQ(scan.rays[1].place, Vec3(0, 0, 2.5)) << c.what;
    EXPECT_FALSE(scan.misses_known) << c.what;
  }
}

TEST(ScanXyz, WholeNumbersBeforeCommasAreNoDecimals) {
  VERIFIES("LASSO-SIM-042~1");
  const Folder folder;
  EXPECT_EQ(read_raw_scan(folder.write("a.xyz", "2 ,2 ,31\n")).rays.at(0).place, Vec3(2, 2, 31));
}

TEST(ScanXyz, RowsWithoutAMeasurementAreCounted) {
  VERIFIES("LASSO-SIM-036~1");
  const Folder folder;
  const RawScan scan = read_raw_scan(folder.write("a.ASC", "nan nan nan\n0 0 0\n0 0 1\nNaN NaN NaN\n"));
  EXPECT_EQ(scan.unmeasured, 3u);
  EXPECT_EQ(scan.rays.size(), 1u);
}

TEST(ScanXyz, EachErrorNamesItsPlaceAndItsRemedy) {
  VERIFIES("LASSO-SIM-021~1");
  expect_refused("a.xyz", "", ":1: there is no point", "at least one");
  expect_refused("a.xyz", "# X Y Z\n", ":1: there is no point", "at least one");
  expect_refused("a.asc", "ncols 100\nnrows 100\n", ":1: the header is \"ncols 100\"", "columns x, y and z");
  expect_refused("a.xyz", "\nid n x y z\n7 1 2 3\n", ":2: the header is \"id n x y z\", with 5 names",
                 "rows of 4 values; name each column");
  expect_refused("a.xyz", "1 2 3\n1 2\n", ":2: the row has 2 values", "x, y and z");
  expect_refused("a.xyz", "1 2 3\n1 b 3\n", ":2: y is \"b\"", "decimal number");
  expect_refused("a.xyz", "1 2 3\n2\n", ":2: the row has 1 values", "x, y and z");
}

}  // namespace
}  // namespace lasso::sim
