// The HTML of the report: one page with its style inside.
#pragma once

#include <string>
#include <vector>

namespace lasso::mdat {

struct HtmlTable {
  std::vector<std::string> head;
  std::vector<std::vector<std::string>> rows;  // first cell: what the row is about; cells are HTML
  bool words = false;                          // its cells are words, which begin at the left
};

std::string to_html(const HtmlTable& table);
std::string figure(const std::string& content, const std::string& caption);
std::string page(const std::string& title, const std::string& body);

}  // namespace lasso::mdat
