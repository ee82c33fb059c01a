#include "fsw/link/key_change.hpp"

#include <gtest/gtest.h>

#include "ut/support/verifies.hpp"

namespace lasso {
namespace {

// Says what it is asked for.
class Keys final : public Authenticator {
 public:
  std::size_t trailer_bytes() const override { return 4; }
  bool authentic(ConstBytes, ConstBytes) override { return true; }
  bool try_key(std::uint32_t number) override {
    if (number <= in_use) return false;
    trial = number;
    return true;
  }
  bool by_key_on_trial() const override { return by_trial; }
  bool end_key_trial(bool kept) override {
    if (kept && full) return false;
    if (kept) in_use = trial;
    trial = 0;
    return true;
  }
  std::uint32_t in_use = 0, trial = 0;
  bool by_trial = false, full = false;
};

class KeyChangeTest : public ::testing::Test {
 protected:
  KeyChangeTest() { change_.use_authenticator(keys_); }
  Keys keys_;
  KeyChange change_;
};

TEST_F(KeyChangeTest, ANewKeyIsKeptOnceItHasConfirmedItself) {
  VERIFIES("LASSO-LNK-046~2");
  EXPECT_EQ(change_.confirm(1), ServiceRefusal::kNoKeyOnTrial);
  EXPECT_EQ(change_.begin(1), ServiceRefusal::kNone);
  EXPECT_EQ(change_.confirm(1), ServiceRefusal::kNotByNewKey);
  EXPECT_EQ(keys_.in_use, 0U);
  keys_.by_trial = true;
  EXPECT_EQ(change_.confirm(2), ServiceRefusal::kNoKeyOnTrial) << "of another number";
  EXPECT_EQ(change_.confirm(1), ServiceRefusal::kNone);
  EXPECT_EQ(keys_.in_use, 1U);
  for (std::uint32_t i = 0; i < 2 * kKeyTrialFrames; ++i) ASSERT_FALSE(change_.pass_boundary());
  EXPECT_EQ(keys_.in_use, 1U);
}

TEST_F(KeyChangeTest, AKeyThatNobodyConfirmsIsGivenUpInTime) {
  VERIFIES("LASSO-LNK-046~2");
  EXPECT_EQ(change_.begin(7), ServiceRefusal::kNone);
  for (std::uint32_t i = 1; i < kKeyTrialFrames; ++i) ASSERT_FALSE(change_.pass_boundary()) << i;
  EXPECT_EQ(keys_.trial, 7U);
  EXPECT_TRUE(change_.pass_boundary());
  EXPECT_EQ(change_.number(), 7U);
  EXPECT_EQ(keys_.trial, 0U);
  EXPECT_EQ(keys_.in_use, 0U);
  keys_.by_trial = true;
  EXPECT_EQ(change_.confirm(7), ServiceRefusal::kNoKeyOnTrial);
  EXPECT_FALSE(change_.pass_boundary());
  EXPECT_EQ(change_.begin(7), ServiceRefusal::kNone) << "it may be tried again";
}

TEST_F(KeyChangeTest, AKeyThatCannotBeStoredIsNotConfirmedAndStaysOnTrial) {
  VERIFIES("LASSO-LNK-052~1");
  EXPECT_EQ(change_.begin(1), ServiceRefusal::kNone);
  keys_.by_trial = keys_.full = true;
  EXPECT_EQ(change_.confirm(1), ServiceRefusal::kNotKept);
  EXPECT_EQ(keys_.in_use, 0U);
  EXPECT_EQ(keys_.trial, 1U);
  keys_.full = false;
  EXPECT_FALSE(change_.pass_boundary());
  EXPECT_EQ(change_.confirm(1), ServiceRefusal::kNone) << "once it can be stored";
  EXPECT_EQ(keys_.in_use, 1U);
  EXPECT_EQ(change_.begin(2), ServiceRefusal::kNone);
  keys_.full = true;
  EXPECT_EQ(change_.confirm(2), ServiceRefusal::kNotKept);
  for (std::uint32_t i = 1; i < kKeyTrialFrames; ++i) ASSERT_FALSE(change_.pass_boundary()) << i;
  EXPECT_TRUE(change_.pass_boundary()) << "the trial is not longer for it";
  EXPECT_EQ(keys_.trial, 0U);
}

// As after a flipped bit.
TEST_F(KeyChangeTest, ATrialThatOnlyTheAuthenticatorKnowsOfEndsAtTheNextBoundary) {
  VERIFIES("LASSO-LNK-046~2");
  keys_.trial = 5;
  EXPECT_FALSE(change_.pass_boundary());
  EXPECT_EQ(keys_.trial, 0U);
  EXPECT_FALSE(KeyChange().pass_boundary());
}

TEST_F(KeyChangeTest, OneKeyIsOnTrialAtATime) {
  VERIFIES("LASSO-LNK-046~2");
  EXPECT_EQ(change_.begin(1), ServiceRefusal::kNone);
  EXPECT_EQ(change_.begin(2), ServiceRefusal::kKeyOnTrial);
  EXPECT_EQ(keys_.trial, 1U);
  keys_.by_trial = true;
  EXPECT_EQ(change_.confirm(1), ServiceRefusal::kNone);
  EXPECT_EQ(change_.begin(1), ServiceRefusal::kNoSuchKey) << "numbers grow";
}

TEST_F(KeyChangeTest, AStartEndsATrial) {
  VERIFIES("LASSO-LNK-046~2");
  EXPECT_EQ(change_.begin(1), ServiceRefusal::kNone);
  KeyChange after_restart;
  after_restart.use_authenticator(keys_);
  EXPECT_EQ(keys_.trial, 0U);
  EXPECT_EQ(KeyChange().begin(1), ServiceRefusal::kNoSuchKey) << "without an authenticator there is no key";
}

}  // namespace
}  // namespace lasso
