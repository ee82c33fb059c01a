// The interface document, before it is Markdown or HTML.
#pragma once

#include <string>
#include <vector>

#include "fsw/link/packet_row.hpp"

namespace lasso::mdat {

struct DocumentTable {
  std::vector<std::string> head;
  std::vector<std::vector<std::string>> rows;
};

struct DocumentSection {
  int level = 2;
  std::string title;
  std::vector<std::string> paragraphs;  // `code` in backticks, nothing else
  DocumentTable table;                  // none if it has no head
};

std::vector<DocumentSection> interface_document(std::uint16_t apid);  // of the component

// "0 to 1", "at least 0", "any"; of an enumeration, its name.
std::string range_text(const ItemRow& row);

// Of an event's packet: "informative", "low", "medium", "high".
std::string severity_text(const PacketRow& event);

}  // namespace lasso::mdat
