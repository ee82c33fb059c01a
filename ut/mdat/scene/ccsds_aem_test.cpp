#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>

#include "mdat/scene/ccsds.hpp"
#include "ut/mdat/scene/support.hpp"
#include "ut/support/verifies.hpp"

namespace lasso::mdat::scene {
namespace {

constexpr double kDeg = M_PI / 180;

std::string aem_header(const std::string& version, const std::string& more, const std::string& a = "EME2000",
                       const std::string& b = "SC_BODY_1") {
  return "CCSDS_AEM_VERS = " + version + "\nCREATION_DATE = 2026-11-27T00:00:00\nORIGINATOR = LASSO\nMETA_START\nOBJECT_NAME = TARGET\n" +
         "REF_FRAME_A = " + a + "\nREF_FRAME_B = " + b + "\nTIME_SYSTEM = TAI\n" + more + "META_STOP\nDATA_START\n";
}

std::string row_of(double t_s, const std::vector<double>& numbers) {
  char text[32];
  std::snprintf(text, sizeof text, "2026-11-27T00:00:%06.3f", t_s);
  std::string row = text;
  for (const double number : numbers) {
    std::snprintf(text, sizeof text, " %.15g", number);
    row += text;
  }
  return row + "\n";
}

Ephemeris read_text(const std::string& text) { return parse_aem(text, "t.aem", {"EME2000", "RTN"}); }

std::string aem_refusal(const std::string& text) {
  return problems_of([&] { read_text(text); });
}

// The example of 504.0-B-2, annex F2.2: B comes of A by +90 deg about z, so that B's x axis is (0, 1, 0) in A.
TEST(Aem, TheStandardsExampleOfAQuaternion) {
  VERIFIES("LASSO-SCN-019~1");
  const Ephemeris aem =
      read_text(aem_header("2.0", "ATTITUDE_TYPE = QUATERNION\n") + row_of(0, {0, 0, std::sqrt(0.5), std::sqrt(0.5)}) + "DATA_STOP\n");
  EXPECT_EQ(aem.frame, "EME2000");
  EXPECT_EQ(aem.time_system, "TAI");
  EXPECT_NEAR((aem.table.attitudes[0] * Vec3::UnitX() - Vec3::UnitY()).norm(), 0, 1e-14);
}

// Annex F3.2: coordinates in A become those in B by the product of three matrices, the first rotation's on the right.
TEST(Aem, TheStandardsExampleOfEulerAngles) {
  VERIFIES("LASSO-SCN-019~1");
  const double a = 0.4, b = -0.7, c = 1.9;
  Mat3 third, second, first;
  third << std::cos(c), std::sin(c), 0, -std::sin(c), std::cos(c), 0, 0, 0, 1;
  second << std::cos(b), 0, -std::sin(b), 0, 1, 0, std::sin(b), 0, std::cos(b);
  first << 1, 0, 0, 0, std::cos(a), std::sin(a), 0, -std::sin(a), std::cos(a);
  const std::string rows = row_of(0, {a / kDeg, b / kDeg, c / kDeg});
  const Quat q_a_b = read_text(aem_header("2.0", "ATTITUDE_TYPE = EULER_ANGLE\nEULER_ROT_SEQ = XYZ\n") + rows).table.attitudes[0];
  EXPECT_NEAR((q_a_b.conjugate().toRotationMatrix() - third * second * first).norm(), 0, 1e-13);
  const Quat zxz = read_text(aem_header("2.0", "ATTITUDE_TYPE = EULER_ANGLE\nEULER_ROT_SEQ = ZXZ\n") + rows).table.attitudes[0];
  const Quat expected = Eigen::AngleAxisd(a, Vec3::UnitZ()) * Eigen::AngleAxisd(b, Vec3::UnitX()) * Eigen::AngleAxisd(c, Vec3::UnitZ());
  EXPECT_NEAR((zxz.toRotationMatrix() - expected.toRotationMatrix()).norm(), 0, 1e-13);
}

// One motion, written in every way that there is: each of them moves the body as it was.
class Variants : public ::testing::Test {
 protected:
  Variants() : truth_({Pose{exp_so3(Vec3(0.5, -1.1, 0.8)), Vec3::Zero()}, {Vec3(0.2, -0.1, 0.3), Vec3::Zero()}}) {}

  // q of the rotation as it is written, its derivative, and the angular velocity of B relative to A in A and in B.
  struct Written {
    Quat q, rate;
    Vec3 omega_a, omega_b;
  };
  // The body in its frame; `body_first`: A is the body. `b_to_a`: the quaternion is that from B to A.
  Written written(double t_s, bool body_first, bool b_to_a) const {
    const MotionState body = truth_.at(std::llround(1e6 * t_s));
    const MotionState b_in_a = body_first ? inverse(body) : body;
    Written result{b_in_a.T_a_b.q, {}, b_in_a.rates.omega_radps, rotate(b_in_a.T_a_b.q.conjugate(), b_in_a.rates.omega_radps)};
    const Quat product = Quat(0, result.omega_a.x(), result.omega_a.y(), result.omega_a.z()) * result.q;
    result.rate.coeffs() = 0.5 * product.coeffs();
    if (b_to_a) result.q = result.q.conjugate(), result.rate = result.rate.conjugate();
    return result;
  }
  static std::vector<double> numbers(const Quat& q, bool scalar_first) {
    if (scalar_first) return {q.w(), q.x(), q.y(), q.z()};
    return {q.x(), q.y(), q.z(), q.w()};
  }
  template <class Numbers>
  void expect_same(const std::string& head, double step_s, const Numbers& numbers_at) {
    std::string text = head;
    for (int i = 0; i < 9; ++i) text += row_of(step_s * i, numbers_at(step_s * i));
    const TableMotion motion(read_text(text + "DATA_STOP\n").table);
    for (const double t_s : {0.3, 1.7, 3.9}) {
      const MotionState found = motion.at(std::llround(1e6 * t_s)), expected = truth_.at(std::llround(1e6 * t_s));
      EXPECT_NEAR(log_so3(found.T_a_b.q * expected.T_a_b.q.conjugate()).norm(), 0, 1e-10) << head;
      EXPECT_NEAR((found.rates.omega_radps - expected.rates.omega_radps).norm(), 0, 1e-10) << head;
    }
  }
  ConstantRates truth_;
};

std::string names(bool body_first, const std::string& version, const std::string& more) {
  return body_first ? aem_header(version, more, "SC_BODY_1", "EME2000") : aem_header(version, more);
}

TEST_F(Variants, OfVersion1WithItsDirectionAndItsOrder) {
  VERIFIES("LASSO-SCN-019~1");
  for (const bool body_first : {false, true}) {
    for (const bool b_to_a : {false, true}) {
      for (const bool scalar_first : {false, true}) {
        const std::string more = std::string("ATTITUDE_DIR = ") + (b_to_a ? "B2A" : "A2B") +
                                 "\nQUATERNION_TYPE = " + (scalar_first ? "FIRST" : "LAST") + "\nATTITUDE_TYPE = QUATERNION";
        expect_same(names(body_first, "1.0", more + "\n"), 0.5,
                    [&](double t_s) { return numbers(written(t_s, body_first, b_to_a).q, scalar_first); });
        expect_same(names(body_first, "1.0", more + "/DERIVATIVE\n"), 0.5, [&](double t_s) {
          const Written at = written(t_s, body_first, b_to_a);
          std::vector<double> row = numbers(at.q, scalar_first);
          const std::vector<double> rate = numbers(at.rate, scalar_first);
          row.insert(row.end(), rate.begin(), rate.end());
          return row;
        });
      }
    }
  }
}

TEST_F(Variants, OfVersion2WithAngularVelocitiesInEitherFrame) {
  VERIFIES("LASSO-SCN-019~1");
  for (const bool body_first : {false, true}) {
    expect_same(names(body_first, "2.0", "ATTITUDE_TYPE = quaternion\n"), 0.5,
                [&](double t_s) { return numbers(written(t_s, body_first, false).q, false); });
    for (const bool in_a : {false, true}) {
      const std::string in = in_a == body_first ? "SC_BODY_1" : "EME2000";
      expect_same(names(body_first, "2.0", "ATTITUDE_TYPE = QUATERNION/ANGVEL\nANGVEL_FRAME = " + in + "\n"), 0.5, [&](double t_s) {
        const Written at = written(t_s, body_first, false);
        std::vector<double> row = numbers(at.q, false);
        for (int i = 0; i < 3; ++i) row.push_back((in_a ? at.omega_a : at.omega_b)[i] / kDeg);
        return row;
      });
    }
  }
}

TEST(Aem, SaysEveryProblemAtOnce) {
  VERIFIES("LASSO-SCN-017~1");
  EXPECT_EQ(aem_refusal(aem_header("1.0", "ATTITUDE_TYPE = EULER_ANGLE\nATTITUDE_DIR = A TO B\n", "J2000", "BODY") + row_of(0, {1, 2, 3})),
            "t.aem:6:1: REF_FRAME_A: J2000: is no frame that the mission knows: these are EME2000, RTN\n"
            "t.aem:7:1: REF_FRAME_B: BODY: is no frame that the mission knows: these are EME2000, RTN\n"
            "t.aem:9:1: ATTITUDE_TYPE: EULER_ANGLE: expected one of QUATERNION, QUATERNION/DERIVATIVE, QUATERNION/ANGVEL\n"
            "t.aem:10:1: ATTITUDE_DIR: A_TO_B: expected one of A2B, B2A");
  EXPECT_EQ(aem_refusal(aem_header("1.0", "ATTITUDE_TYPE = QUATERNION\n") + row_of(1, {0, 0, 0, 0.9}) + row_of(0, {0, 0, 0, 1}) +
                        row_of(2, {0, 0, 1})),
            "t.aem: ATTITUDE_DIR: is missing: expected one of A2B, B2A\n"
            "t.aem: QUATERNION_TYPE: is missing: expected one of FIRST, LAST\n"
            "t.aem:12:1: quaternion: length 0.9: expected a quaternion of unit length, the scalar last\n"
            "t.aem:13:1: time: -1 s: is not after 0 s of the row before: sort the rows by time, each time once\n"
            "t.aem:14:1: has 3 numbers: expected the quaternion's 4 components");
}

TEST(Aem, RefusesWhatContradictsItself) {
  VERIFIES("LASSO-SCN-017~1");
  const std::string row = row_of(0, {0, 0, 0, 1});
  EXPECT_EQ(aem_refusal(aem_header("2.0", "ATTITUDE_TYPE = QUATERNION\nATTITUDE_DIR = A2B\nQUATERNION_TYPE = LAST\n") + row), "");
  EXPECT_EQ(aem_refusal(aem_header("2.0", "ATTITUDE_TYPE = QUATERNION\nATTITUDE_DIR = B2A\nQUATERNION_TYPE = FIRST\n") + row),
            "t.aem:10:1: ATTITUDE_DIR: B2A: is not of version 2.0, which goes from A to B: state version 1.0, or A2B\n"
            "t.aem:11:1: QUATERNION_TYPE: FIRST: is not of version 2.0, whose scalar is the last: state version 1.0, or LAST");
  EXPECT_EQ(aem_refusal(aem_header("2.0", "ATTITUDE_TYPE = QUATERNION/ANGVEL\nANGVEL_FRAME = LVLH\n") + row_of(0, {0, 0, 0, 1, 0, 0, 0})),
            "t.aem:10:1: ANGVEL_FRAME: LVLH: expected one of EME2000, SC_BODY_1");
  for (const char* sequence : {"XXZ", "XY", "XYZX", ""}) {
    EXPECT_EQ(aem_refusal(aem_header("2.0", std::string("ATTITUDE_TYPE = EULER_ANGLE\nEULER_ROT_SEQ = ") + sequence + "\n") +
                          row_of(0, {1, 2, 3})),
              std::string("t.aem:10:1: EULER_ROT_SEQ: ") + sequence + (*sequence == '\0' ? "" : ": ") +
                  "expected three axes, the first rotation's first, such as ZXZ or XYZ");
  }
  EXPECT_EQ(aem_refusal(aem_header("2.0", "ATTITUDE_TYPE = SPIN\n") + row),
            "t.aem:9:1: ATTITUDE_TYPE: SPIN: expected one of QUATERNION, QUATERNION/DERIVATIVE, QUATERNION/ANGVEL, EULER_ANGLE");
  EXPECT_TRUE(problems_of([] { read_aem("/nowhere.aem", {"EME2000"}); }).starts_with("/nowhere.aem: "));
}

TEST(Aem, NoDamageEndsTheProgram) {
  VERIFIES("LASSO-SCN-017~1");
  std::string good = aem_header("1.0", "ATTITUDE_DIR = A2B\nQUATERNION_TYPE = LAST\nATTITUDE_TYPE = QUATERNION/DERIVATIVE\n");
  for (int i = 0; i < 9; ++i) good += row_of(i, {0, 0.6, 0, 0.8, 0.1, 0, 0, 0});
  test::Generator random(102);
  int read_count = 0, refused = 0;
  for (int trial = 0; trial < 2000; ++trial) {
    std::string text = good;
    for (std::uint64_t i = random.below(4); i > 0; --i) text[random.below(text.size())] = static_cast<char>(random.below(256));
    if (random.below(4) == 0) text.resize(random.below(text.size()));
    (aem_refusal(text).empty() ? read_count : refused) += 1;
  }
  EXPECT_GT(read_count, 100);
  EXPECT_GT(refused, 100);
}

}  // namespace
}  // namespace lasso::mdat::scene
