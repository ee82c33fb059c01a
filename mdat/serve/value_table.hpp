// Values over time: a table of columns on one time line, and what each column is.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "fsw/core/span.hpp"
#include "fsw/link/dictionary.hpp"

namespace lasso::mdat::serve {

struct ValueTable {
  std::vector<double> time_s;               // ascending
  std::vector<std::vector<float>> columns;  // each as long as time_s; NaN: absent
};

struct Value {
  std::string id, label, unit, topic, group;
  std::size_t table = 0, column = 0;
  const Enumeration* choices = nullptr;  // where its numbers are names
};

// The columns of a packet of the dictionary: one for each element of each item.
class PacketColumns {
 public:
  // `table`: its number among the recording's tables.
  PacketColumns(const PacketRow& packet, std::size_t table);

  const PacketRow& packet() const { return packet_; }
  const std::vector<Value>& values() const { return values_; }
  // One row; `bytes` is a packet of this kind, whole.
  void add(double time_s, ConstBytes bytes, ValueTable& table) const;

 private:
  struct Place {
    std::size_t offset;
    WireType type;
  };
  void add_item(const ItemRow& item, std::size_t offset, std::size_t table);
  const PacketRow& packet_;
  std::vector<Place> places_;
  std::vector<Value> values_;
};

// The row of a packet of telemetry, by its headers and size; null: none has them.
const PacketRow* telemetry_row(ConstBytes packet);

}  // namespace lasso::mdat::serve
