// A packet of the dictionary: how it is told from others, and what is in it. For the ground: see row.hpp.
#pragma once

#include <cstdint>

#include "fsw/link/arming.hpp"
#include "fsw/link/row.hpp"
#include "fsw/link/space_packet.hpp"

namespace lasso {

struct PacketRow {
  const char* name;
  PacketType type;
  std::uint8_t service, subservice;
  bool numbered;         // the number is in the packet,
  std::uint16_t number;  // 16 bits behind the headers: the structure, the function, the event
  Span<const ItemRow> items;
  const char* meaning;
  const char* cause = "";  // of an event
  const char* action = "";
  Hazard hazard = Hazard::kNone;  // of a command
};

// Rows one behind the other.
template <std::size_t kRows>
struct PacketTable {
  PacketRow rows[kRows] = {};

  constexpr std::size_t size() const { return kRows; }
  constexpr const PacketRow* begin() const { return rows; }
  constexpr const PacketRow* end() const { return rows + kRows; }
  constexpr const PacketRow& operator[](std::size_t i) const { return rows[i]; }
};
template <std::size_t kA, std::size_t kB, std::size_t kC>
constexpr PacketTable<kA + kB + kC> joined(const PacketRow (&a)[kA], const PacketRow (&b)[kB], const PacketTable<kC>& c) {
  PacketTable<kA + kB + kC> table;
  std::size_t at = 0;
  for (const PacketRow& row : a) table.rows[at++] = row;
  for (const PacketRow& row : b) table.rows[at++] = row;
  for (const PacketRow& row : c) table.rows[at++] = row;
  return table;
}

}  // namespace lasso
