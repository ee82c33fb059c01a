// Keys as an operator and a mission's owner have them: images are signed, and keys of commands replaced over the link.
#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include "ft/mdat/live_run.hpp"
#include "ut/support/verifies.hpp"

namespace lasso::ft {
namespace {

const std::string kKeyedRun = "run missions/test.toml --scenario spin --no-report --force --frames 100000 ";

class KeysTest : public ::testing::Test {
 protected:
  KeysTest() {
    work_.write("master", std::string(64, 'a') + "\n");
    work_.write("other", std::string(64, 'b') + "\n");
  }
  Answer command(const std::string& what, const std::string& key) const {
    return work_.mdat("command " + what + " --wait 60 --key " + key + " --to " + url_);
  }

  WorkFolder work_;
  const std::string url_ = "udp://127.0.0.1:" + free_port();
};

TEST_F(KeysTest, AnImageIsSignedAndItsSignatureLookedAt) {
  VERIFIES("LASSO-LNK-045~1");
  ASSERT_EQ(work_.mdat("mission compile missions/test.toml -o plain.3dli").exit_code, 0);
  ASSERT_EQ(work_.mdat("mission compile missions/test.toml -o image.3dli --key master").exit_code, 0);
  const std::string plain = work_.read("plain.3dli"), image = work_.read("image.3dli");
  EXPECT_EQ(image.substr(0, plain.size()), plain);
  EXPECT_EQ(image.size(), plain.size() + 32);
  const Answer is_signed = work_.mdat("mission sign plain.3dli -o signed.3dli --key master");
  EXPECT_EQ(is_signed.exit_code, 0) << is_signed.err;
  EXPECT_EQ(work_.read("signed.3dli"), image);
  EXPECT_EQ(work_.mdat("mission sign signed.3dli --key master").exit_code, 0) << "anew, in its place";
  EXPECT_EQ(work_.read("signed.3dli"), image);
  EXPECT_NE(work_.mdat("mission check image.3dli --key master").out.find("signed with master"), std::string::npos);
  EXPECT_NE(work_.mdat("mission check image.3dli").out.find("signed; --key FILE says whether with that key"), std::string::npos);
  const Answer by_other = work_.mdat("mission check image.3dli --key other"),
               unsigned_one = work_.mdat("mission check plain.3dli --key master");
  EXPECT_EQ(by_other.exit_code, 2);
  EXPECT_NE(by_other.err.find("image.3dli: its signature is not that of other"), std::string::npos) << by_other.err;
  EXPECT_EQ(unsigned_one.exit_code, 2);
  EXPECT_NE(unsigned_one.err.find("plain.3dli: is not signed with master"), std::string::npos) << unsigned_one.err;
  ASSERT_EQ(work_.mdat("key master --number 1 --out key1").exit_code, 0);
  const Answer derived = work_.mdat("mission sign plain.3dli --key key1");
  EXPECT_EQ(derived.exit_code, 2);
  EXPECT_NE(derived.err.find("key1: is key 1, which signs commands alone: give the master key"), std::string::npos) << derived.err;
  EXPECT_EQ(work_.read("plain.3dli"), plain);
}

TEST_F(KeysTest, AKeyIsReplacedOverTheLinkAndHoldsInTheNextRun) {
  VERIFIES("LASSO-LNK-046~2 LASSO-LNK-047~2");
  ASSERT_EQ(work_.mdat("key master --number 1 --out key1").exit_code, 0);
  EXPECT_EQ(work_.mdat("key master --number 2 --out key1").exit_code, 2) << "a key that is there is kept";
  EXPECT_EQ(work_.mdat("key key1 --number 2 --out key2").exit_code, 2) << "no key comes from a derived one";
  const std::string run = kKeyedRun + "--out run --key master --store store --link " + url_;
  {
    Program first(work_, run);
    const Answer changed = command("change_key number=1 --arm", "master");
    EXPECT_EQ(changed.exit_code, 0) << changed.err;
    const Answer by_old = command("confirm_key number=1", "master");
    EXPECT_EQ(by_old.exit_code, 1);
    EXPECT_NE(by_old.err.find("not_by_new_key"), std::string::npos) << by_old.err;
    const Answer confirmed = command("confirm_key number=1", "key1");
    EXPECT_EQ(confirmed.exit_code, 0) << confirmed.err;
    EXPECT_NE(command("ping", "master").err.find("not_authentic"), std::string::npos);
    EXPECT_EQ(first.interrupt().exit_code, 0);
  }
  EXPECT_EQ(work_.read("store/authentication").substr(0, 13), "key 1\nnumber ");
  Program second(work_, run);
  EXPECT_EQ(command("ping", "key1").exit_code, 0);
  EXPECT_NE(command("ping", "master").err.find("not_authentic"), std::string::npos);
  EXPECT_EQ(second.interrupt().exit_code, 0);
}

TEST_F(KeysTest, AKeyThatCannotBeStoredIsNotConfirmed) {
  VERIFIES("LASSO-LNK-052~1");
  ASSERT_EQ(work_.mdat("key master --number 1 --out key1").exit_code, 0);
  Program run(work_, kKeyedRun + "--out run --key master --store store --link " + url_);
  EXPECT_EQ(command("change_key number=1 --arm", "master").exit_code, 0);
  std::filesystem::create_directories(work_ / "store/authentication.partial/full");
  const Answer confirmed = command("confirm_key number=1", "key1");
  EXPECT_EQ(confirmed.exit_code, 1);
  EXPECT_NE(confirmed.err.find("not_kept (the board cannot store that this key is in use"), std::string::npos) << confirmed.err;
  EXPECT_EQ(command("ping", "master").exit_code, 0) << "both count";
  std::filesystem::remove_all(work_ / "store/authentication.partial");
  EXPECT_EQ(command("confirm_key number=1", "key1").exit_code, 0);
  EXPECT_EQ(run.interrupt().exit_code, 0);
  EXPECT_EQ(work_.read("store/authentication").substr(0, 13), "key 1\nnumber ");
}

TEST_F(KeysTest, AKeyFarBeyondTheOneInUseIsRefusedBeforeItIsSent) {
  VERIFIES("LASSO-LNK-053~1");
  const std::string change = "command change_key --arm --out packet --key ";
  const Answer far = work_.mdat(change + "master number=65537");
  EXPECT_EQ(far.exit_code, 2);
  EXPECT_NE(far.err.find("number=65537: behind key 0, which signs the command, come 1 to 65536"), std::string::npos) << far.err;
  EXPECT_EQ(work_.mdat(change + "master number=65536").exit_code, 0);
  ASSERT_EQ(work_.mdat("key master --number 4294967294 --out late").exit_code, 0);
  ASSERT_EQ(work_.mdat("key master --number 4294967295 --out last").exit_code, 0);
  EXPECT_EQ(work_.mdat(change + "late number=4294967295").exit_code, 0);
  const Answer last = work_.mdat(change + "last number=4294967295");
  EXPECT_EQ(last.exit_code, 2);
  EXPECT_NE(last.err.find("behind key 4294967295 there is none: start with a new master key"), std::string::npos) << last.err;
}

TEST_F(KeysTest, AComponentOfAnotherApplicationProcessIsFlownCommandedAndRead) {
  VERIFIES("LASSO-LNK-044~1");
  Program run(work_, kKeyedRun + "--out run --apid 99 --key master --link " + url_);
  const Answer ping = command("ping --apid 99", "master");
  EXPECT_EQ(ping.exit_code, 0) << ping.err;
  EXPECT_EQ(run.interrupt().exit_code, 0);
  EXPECT_NE(work_.mdat("decode run/telemetry.ccsds --apid 99").out.find("pong"), std::string::npos);
  EXPECT_NE(work_.mdat("decode run/telemetry.ccsds --headers --apid 99").out.find("  99 telemetry"), std::string::npos);
  const Answer none = work_.mdat("decode run/telemetry.ccsds --headers --apid 98");
  EXPECT_EQ(none.exit_code, 2);
  EXPECT_NE(none.err.find("no packet of APID 98; without --apid, --headers lists all that are there"), std::string::npos) << none.err;
}

TEST_F(KeysTest, NobodyThereIsOneCode) {
  VERIFIES("LASSO-GND-021~2");
  for (const std::string scheme : {"udp", "tcp"}) {
    const Answer answer = work_.mdat("command ping --wait 0.2 --to " + scheme + "://127.0.0.1:" + free_port());
    EXPECT_EQ(answer.exit_code, 1) << scheme << answer.err;
  }
  EXPECT_EQ(work_.mdat("command ping --wait 0.2 --to tcp://nowhere:1").exit_code, 2);
}

}  // namespace
}  // namespace lasso::ft
