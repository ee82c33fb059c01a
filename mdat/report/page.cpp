#include "mdat/report/page.hpp"

#include "mdat/common/text.hpp"

namespace lasso::mdat {
namespace {

// Figures are drawn on white: in the dark they are inverted, hues kept; pictures of scans stay as they are.
constexpr const char* kStyle = R"(
:root { color-scheme: light dark; --page: #f3f5f8; --card: #fff; --text: #1f2733; --soft: #46505f; --faint: #5c6675; --line: #e0e4ea; --link: #2563b8; }
body { margin: 0; background: var(--page); color: var(--text); font: 16px/1.5 "Inter", "Segoe UI", "Helvetica Neue", Arial, sans-serif; }
main { max-width: 1160px; margin: 0 auto; padding: 40px 24px 64px; }
h1 { font-size: 32px; margin: 0 0 4px; letter-spacing: -0.02em; }
h2 { font-size: 22px; margin: 0 0 16px; letter-spacing: -0.01em; }
section > h2:not(:first-child) { margin-top: 36px; }
h3 { font-size: 17px; margin: 32px 0 12px; }
section > h3:first-child { margin-top: 0; }
a { color: var(--link); }
.lead { margin: 0 0 8px; color: var(--soft); font-size: 17px; }
.note { margin: 0 0 28px; color: var(--faint); font-size: 14px; max-width: 900px; }
section { background: var(--card); border: 1px solid var(--line); border-radius: 10px; padding: 24px 28px; margin: 0 0 28px; }
dl { display: grid; grid-template-columns: max-content 1fr; gap: 4px 20px; margin: 0 0 14px; font-size: 14px; }
dt { color: var(--faint); }
dd { margin: 0; overflow-wrap: anywhere; }
.wide { overflow-x: auto; margin: 0 0 18px; }
table { border-collapse: collapse; font-size: 13.5px; font-variant-numeric: tabular-nums; width: 100%; }
th, td { padding: 6px 8px; text-align: right; white-space: nowrap; border-bottom: 1px solid var(--line); }
th { color: var(--faint); font-weight: 600; white-space: normal; vertical-align: bottom; border-bottom-width: 2px; }
th:first-child, td:first-child { text-align: left; }
td:first-child { font-weight: 600; }
.words th, .words td { text-align: left; }
small { color: var(--faint); }
figure { margin: 26px 0 0; }
figure svg { width: 100%; height: auto; display: block; }
figure img { max-width: 100%; height: auto; display: block; margin: 0 auto; }
figcaption { color: var(--faint); font-size: 13.5px; margin-top: 6px; max-width: 900px; }
.missing { margin: 0; padding: 10px 14px; background: var(--page); border-left: 3px solid #d4571e; font-size: 14px; }
details { margin: 0 0 18px; }
section > details:last-child { margin: 0; }
section > details:last-child .note { margin: 0; }
summary { cursor: pointer; color: var(--link); font-size: 14px; margin-bottom: 8px; }
svg text { font-family: "Inter", "Segoe UI", "Helvetica Neue", Arial, sans-serif; }
.runs { display: grid; grid-template-columns: repeat(auto-fill, minmax(320px, 1fr)); gap: 20px; }
.runs section { padding: 16px 18px; margin: 0; overflow: hidden; }
.runs h2 { font-size: 18px; margin: 0 0 2px; overflow-wrap: anywhere; }
.runs p { margin: 0 0 6px; font-size: 14px; color: var(--faint); }
.seen { display: grid; grid-template-columns: repeat(auto-fit, minmax(300px, 1fr)); gap: 14px; }
.seen figure { margin: 10px 0 0; }
.runs figure { margin: 10px 0 0; }
.runs img, .runs svg { height: 190px; width: 100%; object-fit: contain; background: #fff; }
.good { color: #1c7c3c; font-weight: 600; }
.partly { color: #9a5b00; font-weight: 600; }
.bad { color: #c01028; font-weight: 600; }
@media (max-width: 760px) {
  main { padding: 24px 10px; }
  section { padding: 16px 14px; }
  dl { grid-template-columns: 1fr; }
  dt:not(:first-child) { margin-top: 6px; }
  figure { overflow-x: auto; }
  figure svg, figure img { width: 720px; max-width: none; }
  .runs figure, .seen figure { overflow: visible; }
  .runs figure svg, .runs figure img, .seen figure img { width: 100%; }
}
@media (prefers-color-scheme: dark) {
  :root { --page: #0f1319; --card: #181d25; --text: #e3e8ef; --soft: #b8c1ce; --faint: #9aa5b4; --line: #2c333e; --link: #7fb0f5; }
  figure svg { filter: invert(0.9) hue-rotate(180deg); }
  figure img { background: #fff; border-radius: 6px; }
  .good { color: #5fc682; }
  .partly { color: #e3a94b; }
  .bad { color: #ff7385; }
}
)";

std::string row(const std::vector<std::string>& cells, const std::string& tag) {
  std::string html = "<tr>";
  for (const std::string& cell : cells) html += "<" + tag + ">" + cell + "</" + tag + ">";
  return html + "</tr>\n";
}

}  // namespace

std::string to_html(const HtmlTable& table) {
  std::string html = format("<div class='wide'><table%s>\n", table.words ? " class='words'" : "") + row(table.head, "th");
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
