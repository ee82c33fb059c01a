// The page as it was compiled in: names and bytes, no file system behind them.
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "mdat/serve/http.hpp"

namespace lasso::mdat::serve {

struct PageFile {
  std::string_view name;     // "index.html", "app.js"
  std::string_view gzipped;  // its bytes, compressed
};

// Made by the build from mdat/web/dist (mdat/serve/embed); empty where there was no page.
std::span<const PageFile> page_files();

// The file of a path ("/": index.html), compressed where the request takes it so. 404: there is none; without any page it says how to get
// one.
Response page_answer(std::span<const PageFile> files, const std::string& path, const Request& request);

}  // namespace lasso::mdat::serve
