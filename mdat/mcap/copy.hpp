// What one reader tells, into a writer: channels and schemas get the writer's own numbers.
#pragma once

#include <cstdint>
#include <map>
#include <string>

#include "mdat/mcap/reader.hpp"
#include "mdat/mcap/writer.hpp"

namespace lasso::mdat::mcap {

class Copy {
 public:
  // Both outlive it.
  Copy(const Reader& reader, Writer& writer) : reader_(reader), writer_(writer) {}

  // With another topic, time or data where the caller has changed them.
  void message(const Channel& channel, const Message& message);

 private:
  std::uint16_t schema_of(const Channel& channel);
  const Reader& reader_;
  Writer& writer_;
  std::map<std::uint16_t, std::uint16_t> channels_, schemas_;  // the reader's -> the writer's
};

}  // namespace lasso::mdat::mcap
