#include <limits>

#include "ut/mdat/missiondb/mesh_files.hpp"
#include "ut/support/verifies.hpp"

namespace lasso::mdat {
namespace {

TEST(StlReader, TextOfOtherPrograms) {
  VERIFIES("LASSO-GND-005~2");
  const std::string text = text_stl(box());
  const auto with_normal = [&](const std::string& normal) { return changed(text, "normal 0 0 0", "normal " + normal); };
  const auto named = [&](const std::string& name) { return changed(text, "solid box", "solid" + name); };
  std::string upper = text;
  for (char& c : upper) c = static_cast<char>(std::toupper(c));
  std::string one_line = changed(text, "\n", " ");
  one_line.replace(0, 9, "solid\n");
  const std::string corpus[] = {
      text, upper, one_line, "\xEF\xBB\xBF" + text, "\n  \n" + text, changed(text, "\n", "\r\n"), changed(text, "\n", "\r"),
      changed(text, "  ", "\t"), changed(text, ".000000", ".0e+00"), changed(text, "vertex 1", "vertex +1"), text + "\n\n",
      text + std::string(300, '\0'),
      // names
      named(""), named(" "), named(" a facet normal of a vertex in the outer loop endsolid"), named(" K\xC3\xB6rper"), named(" K\xF6rper"),
      named(" \xE5\x8D\xAB\xE6\x98\x9F"), named(" " + std::string(5000, 'n')), changed(text, "endsolid box", "endsolid"),
      changed(text, "solid box\n", "solid box ; COLOR=1 endfacet\n"),
      // normals, which nobody reads
      with_normal("nan nan nan"), with_normal("-nan(ind) -nan(ind) -nan(ind)"), with_normal("1.#QNAN -1.#IND 1.#INF"),
      with_normal("NaN -NaN inf"), with_normal("nan(0x8000000000000) nan(snan) -inf"), with_normal("0,0 0,0 1,0"),
      with_normal("1e-400 1e400 0"), changed(text, " normal 0 0 0", "")};
  for (const std::string& file : corpus) {
    SCOPED_TRACE(file.substr(0, 60));
    expect_box(imported("a.stl", file));
  }
}

TEST(StlReader, SeveralSolidsInAText) {
  VERIFIES("LASSO-GND-005~2");
  Mesh moved = box();
  for (Vector3d& v : moved.vertices) v.x() += 4;
  const Mesh two = imported("a.stl", text_stl(box()) + "\n" + text_stl(moved));
  EXPECT_EQ(two.vertices.size(), 16u);
  EXPECT_EQ(two.triangles.size(), 24u);
  EXPECT_NEAR(signed_volume(two), 60, 1e-6);
}

TEST(StlReader, BinaryOfOtherPrograms) {
  VERIFIES("LASSO-GND-005~2");
  for (const char* header :
       {"", "solid", "solid body facet normal", "SOLID \r\n", "COLOR=\xFF\x80\x20\xFF,MATERIAL=", "solid ascii\nfacet normal 0 0 0\n"}) {
    std::vector<std::string> left_out;
    expect_box(imported("b.stl", binary_stl(box(), header), &left_out));
    EXPECT_TRUE(left_out.empty());
    expect_box(imported("b.stl", binary_stl(box(), header) + '\n', &left_out));
    ASSERT_EQ(left_out.size(), 1u);
    EXPECT_EQ(left_out[0], "1 byte behind the 12 triangles that its header announces");
    expect_box(imported("b.stl", binary_stl(box(), header) + std::string(92, '\0'), &left_out));
    EXPECT_EQ(left_out.at(0).substr(0, 8), "92 bytes");
  }
  expect_box(imported("b.stl", binary_stl(box(), std::string(80, ' '))));
}

TEST(StlReader, RefusesWithPlaceAndRemedy) {
  VERIFIES("LASSO-GND-014~1");
  const std::string text = text_stl(box());
  EXPECT_EQ(refusal("a.stl", changed(text, "vertex 1.000000", "vertex 1,000000")),
            "line 18: expected a number, found \"1,000000\": numbers have a decimal point, no comma");
  EXPECT_NE(refusal("a.stl", changed(text, "vertex 1.000000", "vertex -nan(ind)")).find("is not finite"), std::string::npos);
  EXPECT_NE(refusal("a.stl", changed(text, "vertex 1.000000", "vertex 1.#QNAN")).find("is not finite"), std::string::npos);
  EXPECT_NE(refusal("a.stl", changed(text, "vertex 1.000000", "vertex 1e999")).find("is not finite"), std::string::npos);
  EXPECT_EQ(refusal("a.stl", std::string("\xFF\xFEs\0o\0l\0i\0d\0", 12)), "is UTF-16 text: save it as UTF-8 or ASCII");
  EXPECT_EQ(refusal("a.stl", "solid\nendsolid\n"), "is empty: it holds no triangle");
  EXPECT_EQ(refusal("a.stl", "solid x\nvertex 0 0 0\nendsolid\n"), "line 2: expected `facet` or `endsolid`, found \"vertex\"");
  const std::string other = "v 1 2 3\n";
  EXPECT_NE(refusal("a.stl", other + other).find("it begins with \"v 1 2 3?v 1 2 3?\""), std::string::npos);
  EXPECT_EQ(refusal("b.stl", binary_stl({})), "is empty: it holds no triangle");
  EXPECT_EQ(refusal("b.stl", binary_stl({}) + std::string(50, '\0')),
            "is empty: it holds no triangle, says its header, but 50 bytes follow: export it again");
  Mesh bad = box();
  bad.vertices[3].y() = std::numeric_limits<double>::infinity();
  EXPECT_NE(refusal("b.stl", binary_stl(bad)).find("not finite"), std::string::npos);
}

TEST(StlReader, MessagesAreOneShortLine) {
  VERIFIES("LASSO-GND-014~1");
  const std::string text = text_stl(box());
  const std::string said = refusal("a.stl", changed(text, "endloop", "\x1B[2J" + std::string(100000, 'x') + "\x01"));
  EXPECT_LT(said.size(), 150u);
  for (const char c : said) EXPECT_GE(c, ' ');
  EXPECT_NE(said.find("line 7: "), std::string::npos) << said;
}

TEST(StlReader, RefusesEveryTruncation) {
  VERIFIES("LASSO-GND-014~1");
  for (const char* header : {"made", "solid"}) {
    const std::string binary = binary_stl(box(), header);
    for (std::size_t size = 0; size < binary.size(); size += 7) EXPECT_NE(refusal("b.stl", binary.substr(0, size)), "") << size;
  }
  const std::string text = text_stl(box());
  for (std::size_t size = 0; size + 12 < text.size(); size += 11) EXPECT_NE(refusal("a.stl", text.substr(0, size)), "") << size;
}

}  // namespace
}  // namespace lasso::mdat
