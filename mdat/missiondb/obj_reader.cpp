#include <charconv>

#include "mdat/missiondb/file_mesh.hpp"
#include "mdat/missiondb/mesh_import.hpp"
#include "mdat/missiondb/mesh_text.hpp"

namespace lasso::mdat {
namespace {

// A face whose vertices may stand behind it: indices are checked when all are there.
struct ObjFace {
  std::size_t line = 0;
  std::vector<long long> corners;  // from 0
};

// A backslash at the end of a line of numbers joins the next line to it. In comments and names it may end a path of Windows.
bool is_continued(std::string_view line) {
  const std::size_t last = line.find_last_not_of(" \t");
  return last != std::string_view::npos && line[last] == '\\';
}

class ObjReader {
 public:
  explicit ObjReader(std::string_view text) : lines_(text) {}

  FileMesh read() {
    for (std::string_view word = lines_.next(); !word.empty(); word = lines_.next()) read_statement(word);
    for (const ObjFace& face : faces_) add_face(face);
    if (edges_ > 0) mesh_.left_out.push_back(count_text(edges_, "line element"));
    if (points_ > 0) mesh_.left_out.push_back(count_text(points_, "point element"));
    if (curves_ > 0) mesh_.left_out.push_back(count_text(curves_, "free-form curve or surface"));
    if (scripts_ > 0) mesh_.left_out.push_back(count_text(scripts_, "call or csh statement"));
    if (faces_.empty()) {
      throw MeshError("is empty: it holds no face" +
                      (mesh_.left_out.empty() ? "" : ", but " + mesh_.left_out.front() + ": export triangles"));
    }
    return std::move(mesh_);
  }

 private:
  void read_statement(std::string_view keyword) {
    const std::size_t line = lines_.line();
    const std::string_view rest = lines_.rest_of_line();
    edges_ += std::size_t{keyword == "l"};
    points_ += std::size_t{keyword == "p"};
    curves_ += std::size_t{keyword == "curv" || keyword == "curv2" || keyword == "surf"};
    scripts_ += std::size_t{keyword == "call" || keyword == "csh"};
    if (keyword == "v") read_vertex(line, rest);
    if (keyword == "f" || keyword == "fo") read_face(line, rest);
    if (keyword == "l" || keyword == "p") static_cast<void>(whole_statement(rest));
  }
  // With the lines that continue it, without a comment.
  std::string whole_statement(std::string_view line) {
    std::string whole;
    for (; is_continued(line); line = lines_.rest_of_line()) whole += std::string(line.substr(0, line.rfind('\\'))) + ' ';
    whole += line;
    return whole.substr(0, whole.find('#'));
  }
  void read_vertex(std::size_t line, std::string_view rest) {
    const std::string statement = whole_statement(rest);
    Words words(statement, line);
    const double x = words.number();
    const double y = words.number();
    mesh_.vertices.emplace_back(x, y, words.number());
  }
  void read_face(std::size_t line, std::string_view rest) {
    const std::string statement = whole_statement(rest);
    Words words(statement, line);
    ObjFace face{line, {}};
    for (std::string_view word = words.next(); !word.empty(); word = words.next()) face.corners.push_back(corner_of(word, words));
    if (face.corners.size() < 3) words.refuse("a face has fewer than 3 corners: the file is truncated or corrupt");
    faces_.push_back(std::move(face));
  }
  // Vertex, vertex/texture, vertex//normal or vertex/texture/normal; negative: counted back from the last vertex before the face.
  long long corner_of(std::string_view word, const Words& words) const {
    long long index = 0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), index);
    const bool ended = end == word.data() + word.size() || *end == '/';
    if (error != std::errc{} || !ended || index == 0) words.refuse("expected a vertex's number (from 1), found " + excerpt(word));
    const long long before = static_cast<long long>(mesh_.vertices.size());
    if (index < -before)
      words.refuse("a face refers to vertex " + std::to_string(index) + ", but there are " + std::to_string(before) + " before it");
    return index > 0 ? index - 1 : index + before;
  }
  void add_face(const ObjFace& face) {
    std::vector<std::uint32_t> corners;
    for (const long long corner : face.corners) {
      if (corner >= static_cast<long long>(mesh_.vertices.size())) {
        throw MeshError("line " + std::to_string(face.line) + ": a face refers to vertex " + std::to_string(corner + 1) +
                        ", but there are " + std::to_string(mesh_.vertices.size()) + ": the file is truncated or corrupt");
      }
      corners.push_back(static_cast<std::uint32_t>(corner));
    }
    add_polygon(mesh_, corners);
  }

  Words lines_;
  FileMesh mesh_;
  std::vector<ObjFace> faces_;
  std::size_t edges_ = 0, points_ = 0, curves_ = 0, scripts_ = 0;
};

}  // namespace

FileMesh read_obj(std::string_view bytes) { return ObjReader(plain_text(bytes)).read(); }

}  // namespace lasso::mdat
