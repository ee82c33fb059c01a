// One typed row per item of a packet, telemetry or command. Packer, decoder and everything that the ground makes of the dictionary
// (dictionary.hpp) read the same rows; the wire type of a row is the type of its member, so that it cannot be written down differently
// twice.
//
// Flight code does not keep the rows: codec_of() takes from them, at compile time, what packing needs. Their texts serve the ground and are
// linked by the ground alone.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>

#include "fsw/core/byte_codec.hpp"
#include "fsw/core/span.hpp"

namespace lasso {

// Big-endian on the wire; two's complement; IEEE 754.
enum class WireType : std::uint8_t { kU8 = 0, kU16, kU32, kI64, kF32, kF64 };
const char* to_string(WireType type);             // "u8", ...; never null
constexpr std::size_t wire_size(WireType type) {  // bytes of one element
  constexpr std::size_t kSizes[] = {1, 2, 4, 8, 4, 8};
  return kSizes[static_cast<std::size_t>(type)];
}

constexpr bool is_real(WireType type) { return type == WireType::kF32 || type == WireType::kF64; }

// One value of an enumeration.
struct Choice {
  const char* name = "";
  const char* meaning = "";  // for a reason: its cause
  const char* action = "";   // what an operator can do about it, if anything
};
struct Enumeration {
  const char* name = "";
  Span<const Choice> choices;  // value: position
};

// Inclusive, in the item's unit.
struct Range {
  double minimum, maximum;
};
constexpr double kUnbounded = std::numeric_limits<double>::infinity();
constexpr Range kAny{-kUnbounded, kUnbounded};
constexpr Range kAtLeastZero{0, kUnbounded};
constexpr Range kShare{0, 1};
constexpr Range kUnitVector{-1, 1};

struct ItemRow {
  std::uint16_t id;  // unique in its packet
  const char* name;
  WireType type;
  std::uint16_t count;             // elements
  const char* unit;                // "m", "rad", "1", ...
  Range range;                     // of what is valid; decoders let other values pass, and mark them
  const Enumeration* enumeration;  // of what its values are; null: they are numbers
  const char* meaning;             // one line

  constexpr std::size_t size() const { return wire_size(type) * count; }
};

// Rows of items that no struct has: a number, one of an enumeration.
constexpr ItemRow number_item(std::uint16_t id, const char* name, WireType type, const char* unit, const char* meaning) {
  return {id, name, type, 1, unit, kAny, nullptr, meaning};
}
constexpr ItemRow choice_item(std::uint16_t id, const char* name, const Enumeration& enumeration, const char* meaning) {
  const Range range{0, static_cast<double>(enumeration.choices.size()) - 1};
  return {id, name, WireType::kU8, 1, "1", range, &enumeration, meaning};
}

template <class Packet>
struct TypedRow : ItemRow {
  void (*write)(const Packet&, ByteWriter&);
  void (*read)(ByteReader&, Packet&);
  bool (*within)(const Packet&, const Range&);  // every element
};

// What flight code keeps of a packet's rows.
template <class Packet, std::size_t kRows>
struct Codec {
  struct Row {
    void (*write)(const Packet&, ByteWriter&);
    void (*read)(ByteReader&, Packet&);
  };
  Row rows[kRows] = {};
  std::size_t bytes = 0;

  void write(const Packet& packet, ByteWriter& out) const {
    for (const Row& row : rows) row.write(packet, out);
  }
  void read(ByteReader& in, Packet& packet) const {
    for (const Row& row : rows) row.read(in, packet);
  }
};
template <class Packet, std::size_t kRows>
constexpr Codec<Packet, kRows> codec_of(const TypedRow<Packet> (&rows)[kRows]) {
  Codec<Packet, kRows> codec;
  for (std::size_t i = 0; i < kRows; ++i) {
    codec.rows[i].write = rows[i].write;
    codec.rows[i].read = rows[i].read;
    codec.bytes += rows[i].size();
  }
  return codec;
}

// What it keeps of a command's rows besides: what arguments are valid.
template <class Packet, std::size_t kRows>
struct Limits {
  struct Row {
    bool (*within)(const Packet&, const Range&);
    Range range;
  };
  Row rows[kRows] = {};

  bool hold(const Packet& packet) const {
    bool all = true;
    for (const Row& row : rows) all = row.within(packet, row.range) && all;
    return all;
  }
};
template <class Packet, std::size_t kRows>
constexpr Limits<Packet, kRows> limits_of(const TypedRow<Packet> (&rows)[kRows]) {
  Limits<Packet, kRows> limits;
  for (std::size_t i = 0; i < kRows; ++i) limits.rows[i] = {rows[i].within, rows[i].range};
  return limits;
}

// What the ground keeps of them: rows of any packet, as one type.
template <std::size_t kRows>
struct Items {
  ItemRow rows[kRows] = {};
};
template <class Packet, std::size_t kRows>
constexpr Items<kRows> items_of(const TypedRow<Packet> (&rows)[kRows]) {
  Items<kRows> items;
  for (std::size_t i = 0; i < kRows; ++i) items.rows[i] = static_cast<const ItemRow&>(rows[i]);
  return items;
}

namespace wire {

inline void put(ByteWriter& out, std::uint8_t v) { out.u8(v); }
inline void put(ByteWriter& out, std::uint16_t v) { out.u16(v); }
inline void put(ByteWriter& out, std::uint32_t v) { out.u32(v); }
inline void put(ByteWriter& out, std::int64_t v) { out.i64(v); }
inline void put(ByteWriter& out, float v) { out.f32(v); }
inline void put(ByteWriter& out, double v) { out.f64(v); }
inline void get(ByteReader& in, std::uint8_t& v) { v = in.u8(); }
inline void get(ByteReader& in, std::uint16_t& v) { v = in.u16(); }
inline void get(ByteReader& in, std::uint32_t& v) { v = in.u32(); }
inline void get(ByteReader& in, std::int64_t& v) { v = in.i64(); }
inline void get(ByteReader& in, float& v) { v = in.f32(); }
inline void get(ByteReader& in, double& v) { v = in.f64(); }

template <class T>
struct TypeOf;
template <>
struct TypeOf<std::uint8_t> {
  static constexpr WireType kType = WireType::kU8;
};
template <>
struct TypeOf<std::uint16_t> {
  static constexpr WireType kType = WireType::kU16;
};
template <>
struct TypeOf<std::uint32_t> {
  static constexpr WireType kType = WireType::kU32;
};
template <>
struct TypeOf<std::int64_t> {
  static constexpr WireType kType = WireType::kI64;
};
template <>
struct TypeOf<float> {
  static constexpr WireType kType = WireType::kF32;
};
template <>
struct TypeOf<double> {
  static constexpr WireType kType = WireType::kF64;
};

// A scalar member and an array member are both seen as `kCount` elements.
template <class T>
struct Elements {
  using Type = T;
  static constexpr std::uint16_t kCount = 1;
  static T& at(T& member, std::size_t) { return member; }
  static const T& at(const T& member, std::size_t) { return member; }  // NOLINT(bugprone-return-const-ref-from-parameter): of a packet
};
template <class T, std::size_t N>
struct Elements<T[N]> {
  using Type = T;
  static constexpr std::uint16_t kCount = static_cast<std::uint16_t>(N);
  static T& at(T (&member)[N], std::size_t i) { return member[i]; }
  static const T& at(const T (&member)[N], std::size_t i) { return member[i]; }
};

template <class P, class M>
struct MemberTypes {
  using Packet = P;
  using Member = Elements<M>;
};
template <class P, class M>
MemberTypes<P, M> types_of(M P::*);

template <auto kMember>
struct Field {
  using Types = decltype(types_of(kMember));
  using Packet = typename Types::Packet;
  using Member = typename Types::Member;
  using Type = typename Member::Type;

  static void write(const Packet& packet, ByteWriter& out) {
    for (std::size_t i = 0; i < Member::kCount; ++i) put(out, Member::at(packet.*kMember, i));
  }
  static void read(ByteReader& in, Packet& packet) {
    for (std::size_t i = 0; i < Member::kCount; ++i) get(in, Member::at(packet.*kMember, i));
  }
  static bool within(const Packet& packet, const Range& range) {
    bool all = true;
    for (std::size_t i = 0; i < Member::kCount; ++i) {
      const auto value = static_cast<double>(Member::at(packet.*kMember, i));
      if (!(value >= range.minimum && value <= range.maximum)) all = false;  // also what is not a number
    }
    return all;
  }
};

}  // namespace wire

template <auto kMember>
constexpr auto make_row(std::uint16_t id, const char* name, const char* unit, Range range, const char* meaning) {
  using F = wire::Field<kMember>;
  constexpr WireType kType = wire::TypeOf<typename F::Type>::kType;
  return TypedRow<typename F::Packet>{{id, name, kType, F::Member::kCount, unit, range, nullptr, meaning}, &F::write, &F::read, &F::within};
}

template <auto kMember>
constexpr auto make_row(std::uint16_t id, const char* name, const Enumeration& enumeration, const char* meaning) {
  const Range range{0, static_cast<double>(enumeration.choices.size()) - 1};
  auto row = make_row<kMember>(id, name, "1", range, meaning);
  row.enumeration = &enumeration;
  return row;
}

}  // namespace lasso
