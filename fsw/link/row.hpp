// One typed row per telemetry item. The packer, the decoder, the interface document and the byte-offset test read the same rows;
// the wire type of a row is the type of its member, so that it cannot be written down differently twice.
#pragma once

#include <cstddef>
#include <cstdint>

#include "fsw/core/byte_codec.hpp"
#include "fsw/core/span.hpp"

namespace lasso {

// Big-endian on the wire; two's complement; IEEE 754.
enum class WireType : std::uint8_t { kU8 = 0, kU16, kU32, kI64, kF32, kF64 };
const char* to_string(WireType type);  // "u8", ...; never null
std::size_t wire_size(WireType type);  // bytes of one element

template <class Packet>
struct TelemetryRow {
  std::uint16_t id;
  const char* name;
  WireType type;
  std::uint16_t count;  // elements
  const char* unit;     // "m", "rad", "1", ...
  const char* choices;  // enumerations: value=name pairs joined by '|'; otherwise ""
  const char* meaning;  // one line
  void (*write)(const Packet&, ByteWriter&);
  void (*read)(ByteReader&, Packet&);
  double (*value)(const Packet&, std::size_t element);  // for printing; exact below 2^53

  std::size_t size() const { return wire_size(type) * count; }
};

// Sum of the rows' sizes before `row`.
template <class Packet>
std::size_t rows_size(Span<const TelemetryRow<Packet>> rows, std::size_t row) {
  std::size_t size = 0;
  for (std::size_t i = 0; i < row; ++i) size += rows[i].size();
  return size;
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
  static double value(const Packet& packet, std::size_t i) { return static_cast<double>(Member::at(packet.*kMember, i)); }
};

}  // namespace wire

template <auto kMember>
constexpr auto make_row(std::uint16_t id, const char* name, const char* unit, const char* choices, const char* meaning) {
  using F = wire::Field<kMember>;
  return TelemetryRow<typename F::Packet>{
      id, name, wire::TypeOf<typename F::Type>::kType, F::Member::kCount, unit, choices, meaning, &F::write, &F::read, &F::value};
}

}  // namespace lasso
