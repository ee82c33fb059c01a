#include "fsw/mission/parameter_area.hpp"

#include <cstddef>

#include "fsw/core/byte_codec.hpp"
#include "fsw/core/crc.hpp"

namespace lasso {
namespace {

using P = MissionParameters;
constexpr double P::*kFixed[] = {&P::pattern,          &P::points,           &P::duration_s,     &P::cycles_a,       &P::cycles_b,
                                 &P::period_s,         &P::initial_present,  &P::initial_qx,     &P::initial_qy,     &P::initial_qz,
                                 &P::initial_qw,       &P::initial_x_m,      &P::initial_y_m,    &P::initial_z_m,    &P::initial_wx_radps,
                                 &P::initial_wy_radps, &P::initial_wz_radps, &P::initial_vx_mps, &P::initial_vy_mps, &P::initial_vz_mps};

bool is_marked(const std::uint32_t (&marks)[kMaxParameters / 32], std::size_t row) {
  return (Span<const std::uint32_t>(marks)[row / 32] >> row % 32 & 1U) != 0;
}

// Of the keys in their order. Where it is the same, so are the places of the rows, by which a saved set names its values.
std::uint32_t table_sum() {
  std::uint32_t sum = 0;
  for (const ParameterRow& row : parameter_rows()) {
    for (const char* letter = row.key; *letter != 0; ++letter) sum = crc32c({reinterpret_cast<const std::uint8_t*>(letter), 1}, sum);
  }
  return sum;
}

bool is_consistent(const MissionParameters& p) { return !(p.short_range_enter_m > 0) || p.short_range_leave_m > p.short_range_enter_m; }

}  // namespace

bool is_changeable(std::size_t row) {
  if (row < kSensorValues || row >= parameter_rows().size()) return false;
  bool changeable = true;
  for (double P::*const member : kFixed) changeable = changeable && parameter_rows()[row].member != member;
  return changeable;
}

ParameterArea::ParameterArea() {
  invariant(parameter_rows().size() <= kMaxParameters, "more parameters than the area holds");
  revert();
}

ParameterRefusal ParameterArea::set(std::size_t row, double value, const MissionParameters& now) {
  if (row >= parameter_rows().size()) return ParameterRefusal::kNoSuchParameter;
  if (!is_changeable(row)) return ParameterRefusal::kFixed;
  const ParameterRow& limits = parameter_rows()[row];
  const double si = value * limits.to_si;
  MissionParameters wanted = now;
  wanted.*limits.member = si;
  std::size_t bad_row = 0;
  if (validate(wanted, bad_row) != Status::kOk) return ParameterRefusal::kOutOfLimits;
  if (!is_consistent(wanted)) return ParameterRefusal::kInconsistent;
  Copy changed = copies_[0];
  changed.values[row] = si;
  changed.changed[row / 32] |= 1U << row % 32;
  keep(changed);
  return ParameterRefusal::kNone;
}

void ParameterArea::revert() { keep(Copy{}); }

bool ParameterArea::changed(std::size_t row) const { return row < kMaxParameters && is_marked(copies_[0].changed, row); }

std::size_t ParameterArea::changes() const {
  std::size_t count = 0;
  for (std::size_t row = 0; row < kMaxParameters; ++row) count += changed(row) ? 1U : 0U;
  return count;
}

void ParameterArea::apply(MissionParameters& parameters) const {
  for (std::size_t row = 0; row < parameter_rows().size(); ++row) {
    if (changed(row)) parameters.*parameter_rows()[row].member = copies_[0].values[row];
  }
}

void ParameterArea::save(Bytes out) const {
  ByteWriter writer(out);
  writer.u32(table_sum());
  for (const std::uint32_t word : copies_[0].changed) writer.u32(word);
  for (const double value : copies_[0].values) writer.f64(value);
}

ParameterRefusal ParameterArea::restore(ConstBytes saved, const MissionParameters& image) {
  ByteReader reader(saved);
  Copy restored;
  if (reader.u32() != table_sum()) return ParameterRefusal::kOtherTable;
  for (std::uint32_t& word : restored.changed) word = reader.u32();
  for (double& value : restored.values) value = reader.f64();
  MissionParameters wanted = image;
  for (std::size_t row = 0; row < kMaxParameters; ++row) {
    if (!is_marked(restored.changed, row)) continue;
    if (!is_changeable(row)) return ParameterRefusal::kFixed;
    wanted.*parameter_rows()[row].member = restored.values[row];
  }
  std::size_t bad_row = 0;
  if (validate(wanted, bad_row) != Status::kOk) return ParameterRefusal::kOutOfLimits;
  if (!is_consistent(wanted)) return ParameterRefusal::kInconsistent;
  keep(restored);
  return ParameterRefusal::kNone;
}

AreaState ParameterArea::check() {
  const bool first = sum_of(copies_[0]) == copies_[0].sum;
  const bool second = sum_of(copies_[1]) == copies_[1].sum;
  if (first && second) return AreaState::kRight;
  if (first) copies_[1] = copies_[0];
  if (second) copies_[0] = copies_[1];
  if (first || second) return AreaState::kRepaired;
  revert();
  return AreaState::kLost;
}

std::uint32_t ParameterArea::sum_of(const Copy& copy) {
  return crc32c(ConstBytes(reinterpret_cast<const std::uint8_t*>(&copy), offsetof(Copy, sum)));
}

void ParameterArea::keep(const Copy& copy) {
  copies_[0] = copy;
  copies_[0].sum = sum_of(copies_[0]);
  copies_[1] = copies_[0];
}

}  // namespace lasso
