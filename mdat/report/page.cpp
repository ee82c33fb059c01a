#include "mdat/report/page.hpp"

#include "mdat/common/text.hpp"

namespace lasso::mdat {
namespace {

constexpr const char* kStyle = R"(
:root { color-scheme: light; }
body { margin: 0; background: #f3f5f8; color: #1f2733; font: 16px/1.5 "Inter", "Segoe UI", "Helvetica Neue", Arial, sans-serif; }
main { max-width: 1160px; margin: 0 auto; padding: 40px 24px 64px; }
h1 { font-size: 32px; margin: 0 0 4px; letter-spacing: -0.02em; }
h2 { font-size: 22px; margin: 0 0 16px; letter-spacing: -0.01em; }
.lead { margin: 0 0 8px; color: #46505f; font-size: 17px; }
.note { margin: 0 0 28px; color: #5c6675; font-size: 14px; max-width: 900px; }
section { background: #fff; border: 1px solid #e0e4ea; border-radius: 10px; padding: 24px 28px; margin: 0 0 28px; }
.wide { overflow-x: auto; margin: 0 0 18px; }
table { border-collapse: collapse; font-size: 13.5px; font-variant-numeric: tabular-nums; width: 100%; }
th, td { padding: 6px 8px; text-align: right; white-space: nowrap; border-bottom: 1px solid #e9ecf1; }
th { color: #5c6675; font-weight: 600; white-space: normal; vertical-align: bottom; border-bottom: 2px solid #cfd6df; }
th:first-child, td:first-child { text-align: left; }
td:first-child { font-weight: 600; }
small { color: #8a94a3; }
figure { margin: 26px 0 0; }
figure svg { width: 100%; height: auto; display: block; }
figure img { max-width: 100%; height: auto; display: block; margin: 0 auto; }
figcaption { color: #5c6675; font-size: 13.5px; margin-top: 6px; max-width: 900px; }
.missing { margin: 0; padding: 10px 14px; background: #f3f5f8; border-left: 3px solid #d4571e; font-size: 14px; }
details { margin: 0 0 18px; }
summary { cursor: pointer; color: #2563b8; font-size: 14px; margin-bottom: 8px; }
svg text { font-family: "Inter", "Segoe UI", "Helvetica Neue", Arial, sans-serif; }
)";

std::string row(const std::vector<std::string>& cells, const std::string& tag) {
  std::string html = "<tr>";
  for (const std::string& cell : cells) html += "<" + tag + ">" + cell + "</" + tag + ">";
  return html + "</tr>\n";
}

}  // namespace

std::string to_html(const HtmlTable& table) {
  std::string html = "<div class='wide'><table>\n" + row(table.head, "th");
  for (const std::vector<std::string>& cells : table.rows) html += row(cells, "td");
  return html + "</table></div>\n";
}

std::string figure(const std::string& content, const std::string& caption) {
  return "<figure>\n" + content + "\n<figcaption>" + caption + "</figcaption>\n</figure>\n";
}

std::string page(const std::string& title, const std::string& body) {
  return "<!DOCTYPE html>\n<html lang='en'>\n<head>\n<meta charset='utf-8'>\n<meta name='viewport' content='width=device-width'>\n<title>" +
         escape(title) + "</title>\n<style>" + kStyle + "</style>\n</head>\n<body>\n<main>\n" + body + "</main>\n</body>\n</html>\n";
}

}  // namespace lasso::mdat
