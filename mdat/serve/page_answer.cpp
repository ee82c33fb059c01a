#include <zlib.h>

#include <algorithm>

#include "mdat/common/errors.hpp"
#include "mdat/serve/page_files.hpp"

namespace lasso::mdat::serve {
namespace {

constexpr int kGzipWindow = 16 + MAX_WBITS;

struct TypeRow {
  std::string_view ending;
  const char* type;
};
constexpr TypeRow kTypes[] = {{".html", "text/html; charset=utf-8"}, {".js", "text/javascript; charset=utf-8"},
                              {".css", "text/css; charset=utf-8"},   {".svg", "image/svg+xml"},
                              {".txt", "text/plain; charset=utf-8"}, {".json", "application/json"},
                              {".wasm", "application/wasm"},         {".png", "image/png"}};

const char* type_of(std::string_view name) {
  for (const TypeRow& row : kTypes) {
    if (name.size() > row.ending.size() && name.substr(name.size() - row.ending.size()) == row.ending) return row.type;
  }
  return "application/octet-stream";
}

std::string gunzipped(std::string_view bytes) {
  z_stream stream{};
  if (inflateInit2(&stream, kGzipWindow) != Z_OK) throw RunError("zlib cannot begin");
  std::string result, part(1 << 16, '\0');
  std::string input(bytes);
  stream.next_in = reinterpret_cast<Bytef*>(input.data());
  stream.avail_in = static_cast<uInt>(input.size());
  int status = Z_OK;
  while (status == Z_OK) {
    stream.next_out = reinterpret_cast<Bytef*>(part.data());
    stream.avail_out = static_cast<uInt>(part.size());
    status = inflate(&stream, Z_NO_FLUSH);
    result.append(part, 0, part.size() - stream.avail_out);
  }
  inflateEnd(&stream);
  if (status != Z_STREAM_END) throw RunError("the page that was compiled in is damaged");
  return result;
}

constexpr char kNoPage[] =
    "<!doctype html><html lang=\"en\"><meta charset=\"utf-8\"><title>mdat serve</title>"
    "<h1>This mdat was built without its page</h1>"
    "<p>The page needs node (18 or newer) and npm. In the sources, <code>make serve</code> installs them, builds the page into mdat, and "
    "starts it.</p><p>Programs are answered all the same: <a href=\"/api/about\">/api/about</a>, <a "
    "href=\"/api/recordings\">/api/recordings</a>.</p></html>\n";

}  // namespace

Response page_answer(std::span<const PageFile> files, const std::string& path, const Request& request) {
  const std::string name = path == "/" ? "index.html" : path.substr(1);
  if (files.empty() && path == "/") return {200, type_of(name), kNoPage, {}};
  const auto found = std::find_if(files.begin(), files.end(), [&](const PageFile& file) { return file.name == name; });
  if (found == files.end()) return error_response(404, "there is no " + path.substr(0, 80), "go to /");
  Response response{200, type_of(name), "", {{"Vary", "Accept-Encoding"}}};
  const bool packed = request.header("accept-encoding").find("gzip") != std::string_view::npos;
  if (packed) response.headers.emplace_back("Content-Encoding", "gzip");
  response.body = packed ? std::string(found->gzipped) : gunzipped(found->gzipped);
  return response;
}

}  // namespace lasso::mdat::serve
