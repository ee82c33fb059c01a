#include "mdat/common/text.hpp"
#include "mdat/link/dictionary_text.hpp"
#include "mdat/link/page.hpp"

namespace lasso::mdat {
namespace {

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  for (std::size_t at = text.find(from); at != std::string::npos; at = text.find(from, at + to.size())) text.replace(at, from.size(), to);
  return text;
}

std::string markdown_row(const std::vector<std::string>& cells) {
  std::string text = "|";
  for (const std::string& cell : cells) text += " " + replaced(cell, "|", "\\|") + " |";
  return text + "\n";
}

std::string markdown(const DocumentTable& table) {
  if (table.head.empty()) return "";
  std::string text = markdown_row(table.head) + markdown_row(std::vector<std::string>(table.head.size(), "---"));
  for (const std::vector<std::string>& row : table.rows) text += markdown_row(row);
  return text + "\n";
}

// Pairs of `from` become pairs of tags.
std::string tagged(std::string text, const std::string& from, const std::string& tag) {
  bool open = true;
  for (std::size_t at = text.find(from); at != std::string::npos; at = text.find(from, at), open = !open) {
    text.replace(at, from.size(), open ? "<" + tag + ">" : "</" + tag + ">");
  }
  return text;
}

// [text](place) becomes its text: a page that stands alone has nowhere to lead.
std::string unlinked(std::string text) {
  const std::size_t middle = text.find("](");
  if (middle == std::string::npos) return text;
  const std::size_t open = text.rfind('[', middle), close = text.find(')', middle);
  return text.substr(0, open) + text.substr(open + 1, middle - open - 1) + text.substr(close + 1);
}

std::string html_row(const std::vector<std::string>& cells, const std::string& tag) {
  std::string text = "<tr>";
  for (const std::string& cell : cells) text += "<" + tag + ">" + escape(cell) + "</" + tag + ">";
  return text + "</tr>\n";
}

std::string html(const DocumentTable& table) {
  if (table.head.empty()) return "";
  std::string text = "<table>\n" + html_row(table.head, "th");
  for (const std::vector<std::string>& row : table.rows) text += html_row(row, "td");
  return text + "</table>\n";
}

constexpr char kHtmlHead[] =
    "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"><title>3DLASSO: the link</title>\n"
    "<style>body{font:15px/1.45 sans-serif;max-width:75em;margin:2em auto;padding:0 1em;color:#222}"
    "table{border-collapse:collapse;margin:1em 0}td,th{border:1px solid #bbb;padding:.15em .5em;text-align:left;vertical-align:top}"
    "th{background:#eee}code{background:#f3f3f3}</style></head><body>\n";

}  // namespace

std::string dictionary_markdown(std::uint16_t apid) {
  std::string text;
  for (const DocumentSection& section : interface_document(apid)) {
    text += std::string(static_cast<std::size_t>(section.level), '#') + " " + section.title + "\n\n";
    for (const std::string& paragraph : section.paragraphs) text += paragraph + "\n\n";
    text += markdown(section.table);
  }
  return text.substr(0, text.size() - 1);
}

std::string dictionary_html(std::uint16_t apid) {
  std::string text = kHtmlHead;
  for (const DocumentSection& section : interface_document(apid)) {
    const std::string level = std::to_string(section.level);
    text += "<h" + level + ">" + escape(section.title) + "</h" + level + ">\n";
    for (const std::string& paragraph : section.paragraphs) {
      text += "<p>" + tagged(tagged(escape(unlinked(paragraph)), "**", "b"), "`", "code") + "</p>\n";
    }
    text += html(section.table);
  }
  return text + "</body></html>\n";
}

}  // namespace lasso::mdat
