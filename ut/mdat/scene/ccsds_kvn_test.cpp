#include "mdat/scene/ccsds_kvn.hpp"

#include <gtest/gtest.h>

#include "ut/mdat/scene/support.hpp"
#include "ut/support/verifies.hpp"

namespace lasso::mdat::scene {
namespace {

TEST(Kvn, WordsAreCapitalsWithOneUnderscoreForBlanks) {
  VERIFIES("LASSO-SCN-018~1");
  EXPECT_EQ(kvn_word("  Mars  Global_ Surveyor\t"), "MARS_GLOBAL_SURVEYOR");
  EXPECT_EQ(kvn_word("sc_body_1"), "SC_BODY_1");
  EXPECT_EQ(kvn_word("   "), "");
}

TEST(Kvn, KeysAndRowsKeepTheirLines) {
  VERIFIES("LASSO-SCN-018~1");
  Problems problems{Place{}};
  KvnMessage message(
      "\xEF\xBB\xBF"
      "CCSDS_OEM_VERS=2.0\r\nMETA_START\r\n  REF_FRAME =  gcrf \r\nMETA_STOP\r\nDATA_START\r\n"
      "2026-01-01T00:00:00\t1  2\r\nCOMMENT 5 = 5\r\nCOVARIANCE_START\r\n1 2\r\nEPOCH = x\r\nCOVARIANCE_STOP\r\n"
      "2026-01-01T00:00:01 3 4 5\r\nDATA_STOP\r\n",
      "k", "OEM", problems);
  EXPECT_EQ(message.value("CCSDS_OEM_VERS"), "2.0");
  EXPECT_EQ(message.value("EPOCH"), "");
  EXPECT_EQ(message.place("REF_FRAME").line, 3);
  EXPECT_EQ(message.known_frame({"REF_FRAME"}, {"eme2000", "GCRF"}), "GCRF");
  const std::vector<KvnRow> rows = message.rows({2, 3}, "");
  ASSERT_EQ(rows.size(), 2U);
  EXPECT_EQ(rows[1].numbers, (std::vector<double>{3, 4, 5}));
  EXPECT_EQ(rows[1].line, 12);
  EXPECT_EQ(seconds_between(rows[0].epoch, rows[1].epoch), 1);
  EXPECT_TRUE(problems.empty());
}

// Where no row was understood, that is the problem, and not that there is none.
TEST(Kvn, AFileWhoseRowsAreAllWrongIsNotSaidToBeEmpty) {
  VERIFIES("LASSO-SCN-017~1");
  EXPECT_EQ(problems_of([] {
              Problems problems({"k"});
              KvnMessage message("META_STOP\n2026-01-01T00:00:00 1\n", "k", "OEM", problems);
              message.rows({6}, "six");
              message.check(MotionTable{}, "");
            }),
            "k:2:1: has 1 numbers: expected six");
}

}  // namespace
}  // namespace lasso::mdat::scene
