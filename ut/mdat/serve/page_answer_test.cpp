#include <gtest/gtest.h>
#include <zlib.h>

#include "mdat/serve/page_files.hpp"
#include "ut/support/verifies.hpp"

namespace lasso::mdat::serve {
namespace {

std::string gzip(const std::string& text) {
  z_stream stream{};
  EXPECT_EQ(deflateInit2(&stream, 9, Z_DEFLATED, 16 + MAX_WBITS, 9, Z_DEFAULT_STRATEGY), Z_OK);
  std::string input = text, result(text.size() + 100, '\0');
  stream.next_in = reinterpret_cast<Bytef*>(input.data());
  stream.avail_in = static_cast<uInt>(input.size());
  stream.next_out = reinterpret_cast<Bytef*>(result.data());
  stream.avail_out = static_cast<uInt>(result.size());
  EXPECT_EQ(deflate(&stream, Z_FINISH), Z_STREAM_END);
  result.resize(stream.total_out);
  deflateEnd(&stream);
  return result;
}

TEST(PageAnswer, FilesAreThoseOfTheMapAlone) {
  VERIFIES("LASSO-WEB-005~2 LASSO-WEB-016~1");
  const std::string html = gzip("<p>page"), script = gzip(std::string(200000, 'j'));
  const PageFile files[] = {{"index.html", html}, {"app.js", script}};
  Request request;
  EXPECT_EQ(page_answer(files, "/", request).body, "<p>page");
  EXPECT_EQ(page_answer(files, "/", request).type, "text/html; charset=utf-8");
  EXPECT_EQ(page_answer(files, "/app.js", request).body, std::string(200000, 'j'));
  request.headers["accept-encoding"] = "br, gzip";
  const Response packed = page_answer(files, "/app.js", request);
  EXPECT_EQ(packed.body, script);
  EXPECT_EQ(packed.type, "text/javascript; charset=utf-8");
  EXPECT_EQ(packed.headers.at(1), (std::pair<std::string, std::string>{"Content-Encoding", "gzip"}));
  for (const char* path : {"/etc/passwd", "/app.js/", "//app.js", "/index", "/app.js.map"})
    EXPECT_EQ(page_answer(files, path, request).status, 404U) << path;
}

TEST(PageAnswer, WithoutAPageItSaysHowToGetOne) {
  VERIFIES("LASSO-WEB-016~1");
  const Response response = page_answer({}, "/", Request{});
  EXPECT_EQ(response.status, 200U);
  EXPECT_NE(response.body.find("make serve"), std::string::npos);
  EXPECT_EQ(page_answer({}, "/app.js", Request{}).status, 404U);
}

}  // namespace
}  // namespace lasso::mdat::serve
