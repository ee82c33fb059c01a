// Decoded streams as text for people and programs, and as a capture for Wireshark.
#pragma once

#include <string>
#include <vector>

#include "mdat/link/decode.hpp"

namespace lasso::mdat {

// What is shown of a stream.
struct Selection {
  std::string packet;              // the kind; empty: all
  std::vector<std::string> items;  // empty: all
};

// Throws InputError: a kind or an item that the dictionary does not have.
void check_selection(const Selection& selection);

// "item value, item value"; values of enumerations by name.
std::string items_text(const DecodedPacket& packet);

// A block for each packet; with items selected, a line for each.
std::string table_text(const DecodedStream& stream, const Selection& selection);
// A line for each packet of one kind: the selected one, or the commonest of those that have a selected item. Elements of an item are
// columns of their own.
std::string csv_text(const DecodedStream& stream, const Selection& selection);
// Values of enumerations by name; other numbers exactly, "nan", "inf" and "-inf" as text.
std::string json_text(const DecodedStream& stream, const Selection& selection);
// libpcap, link type 147 (USER0), a record for each packet at its CUC time: what the dissector of `mdat dictionary --format lua` reads.
std::string pcap_bytes(const DecodedStream& stream);

}  // namespace lasso::mdat
