#include <algorithm>
#include <array>

#include "fsw/geometry/portable_math.hpp"
#include "mdat/scene/ccsds.hpp"
#include "mdat/scene/ccsds_kvn.hpp"
#include "mdat/scene/file_text.hpp"

namespace lasso::mdat::scene {
namespace {

// What the data lines of an AEM hold.
struct AemType {
  const char* name;
  std::size_t count;
  const char* columns;
};
constexpr std::array<AemType, 4> kTypes{{
    {"QUATERNION", 4, "the quaternion's 4 components"},
    {"QUATERNION/DERIVATIVE", 8, "the quaternion's 4 components, and their derivatives in 1/s"},
    {"QUATERNION/ANGVEL", 7, "the quaternion's 4 components, and ANGVEL_X, _Y, _Z in deg/s"},
    {"EULER_ANGLE", 3, "ANGLE_1 ANGLE_2 ANGLE_3 in deg"},
}};

// One file's way of stating attitudes: of frame B in A, whatever it is written as.
class AemReader {
 public:
  AemReader(const std::string& text, const std::string& file, const std::vector<std::string>& frames)
      : problems_({file}), message_(text, file, "AEM", problems_), ephemeris_(message_.header({"1.0", "2.0"})) {
    ephemeris_.frame = message_.known_frame({"REF_FRAME_A", "REF_FRAME_B"}, frames);
    frame_is_a_ = ephemeris_.frame == message_.value("REF_FRAME_A");
    first_version_ = message_.value("CCSDS_AEM_VERS") == "1.0";
    read_type();
    read_direction();
  }

  Ephemeris read() {
    if (type_ != nullptr) {
      for (const KvnRow& row : message_.rows({type_->count}, type_->columns)) take(row);
    }
    message_.check(ephemeris_.table, "");
    return std::move(ephemeris_);
  }

 private:
  void read_type() {
    std::vector<std::string> names;
    for (const AemType& type : kTypes) names.emplace_back(type.name);
    if (first_version_) names.pop_back();
    const std::string name = message_.choice("ATTITUDE_TYPE", names, true);
    const auto found = std::find_if(kTypes.begin(), kTypes.end(), [&](const AemType& type) { return type.name == name; });
    type_ = found == kTypes.end() ? nullptr : &*found;
    if (name == "EULER_ANGLE") read_sequence();
    if (name == "QUATERNION/ANGVEL") {
      const std::string in = message_.choice("ANGVEL_FRAME", {message_.value("REF_FRAME_A"), message_.value("REF_FRAME_B")}, true);
      rates_in_a_ = in == message_.value("REF_FRAME_A");
    }
  }

  // Which way, and in which order; version 2.0 has but one way and one order, and where it states them they have to be these.
  void read_direction() {
    const std::string direction = message_.choice("ATTITUDE_DIR", {"A2B", "B2A"}, first_version_);
    b_to_a_ = direction == "B2A";
    if (b_to_a_ && !first_version_)
      message_.complain("ATTITUDE_DIR", "is not of version 2.0, which goes from A to B: state version 1.0, or A2B");
    const bool quaternion = type_ != nullptr && type_->count > 3;
    const std::string order = message_.choice("QUATERNION_TYPE", {"FIRST", "LAST"}, first_version_ && quaternion);
    scalar_first_ = order == "FIRST";
    if (scalar_first_ && !first_version_) {
      message_.complain("QUATERNION_TYPE", "is not of version 2.0, whose scalar is the last: state version 1.0, or LAST");
    }
  }

  void read_sequence() {
    for (const char c : message_.value("EULER_ROT_SEQ")) {
      if (c >= 'X' && c <= 'Z') axes_.push_back(c - 'X');
      if (c >= '1' && c <= '3') axes_.push_back(c - '1');
    }
    const bool good = axes_.size() == 3 && axes_[0] != axes_[1] && axes_[1] != axes_[2];
    if (good) return;
    message_.complain("EULER_ROT_SEQ", "expected three axes, the first rotation's first, such as ZXZ or XYZ");
    type_ = nullptr;
  }

  Quat quaternion(const double* numbers) const {
    if (scalar_first_) return {numbers[0], numbers[1], numbers[2], numbers[3]};
    return {numbers[3], numbers[0], numbers[1], numbers[2]};
  }

  // The quaternion "from A to B" turns A's axes into B's (504.0-B-2, annex F), and so takes coordinates in B to those in A.
  Quat attitude(const KvnRow& row) const {
    if (type_->count > 3) return quaternion(row.numbers.data());
    Quat q = Quat::Identity();
    for (std::size_t i = 0; i < 3; ++i) q = q * exp_so3(row.numbers[i] * kRadPerDeg * Vec3::Unit(axes_[i]));
    return q;
  }

  // Of B relative to A, in A's axes; q_a_b of any length near 1.
  Vec3 angular_velocity(const KvnRow& row, const Quat& q_a_b) const {
    if (type_->count == 8) {
      const Quat rate = quaternion(row.numbers.data() + 4);
      return 2 * ((b_to_a_ ? rate.conjugate() : rate) * q_a_b.inverse()).vec();
    }
    const Vec3 omega_radps = kRadPerDeg * Vec3(row.numbers.data() + 4);
    return rates_in_a_ ? omega_radps : rotate(normalized(q_a_b), omega_radps);
  }

  void take(const KvnRow& row) {
    MotionTable& table = ephemeris_.table;
    if (table.times_s.empty()) ephemeris_.first = row.epoch;
    table.times_s.push_back(seconds_between(ephemeris_.first, row.epoch));
    table.lines.push_back(row.line);
    const Quat q_a_b = b_to_a_ ? attitude(row).conjugate() : attitude(row);
    table.attitudes.push_back(frame_is_a_ ? q_a_b : q_a_b.conjugate());
    if (type_->count < 7) return;
    const Vec3 omega_a = angular_velocity(row, q_a_b);
    table.omegas_radps.push_back(frame_is_a_ ? omega_a : Vec3(-rotate(normalized(q_a_b.conjugate()), omega_a)));
  }

  Problems problems_;
  KvnMessage message_;
  Ephemeris ephemeris_;
  const AemType* type_ = nullptr;
  bool first_version_ = false, frame_is_a_ = true, b_to_a_ = false, scalar_first_ = false, rates_in_a_ = false;
  std::vector<int> axes_;  // of the Euler angles
};

}  // namespace

Ephemeris parse_aem(const std::string& text, const std::string& file, const std::vector<std::string>& frames) {
  return AemReader(text, file, frames).read();
}

Ephemeris read_aem(const std::filesystem::path& file, const std::vector<std::string>& frames) {
  return parse_aem(text_of_file(file), file.string(), frames);
}

}  // namespace lasso::mdat::scene
