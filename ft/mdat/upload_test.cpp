// A mission image that is changed in flight: by the link alone, as an operator would. The component runs in a process of its own, which
// loses its power now and then.
#include <gtest/gtest.h>

#include <chrono>
#include <cstdio>
#include <memory>
#include <thread>

#include "ft/mdat/live_run.hpp"
#include "ut/support/verifies.hpp"

namespace lasso::ft {
namespace {

constexpr const char* kModel = R"(name = "three boxes"
scale = SCALE

[[part]]
name = "body"
kind = "box"
size = [1.0, 0.5, 0.4]

[[part]]
name = "tower"
kind = "box"
size = [0.3, 0.25, 0.6]
place = [{move = [0.2, 0.1, 0.3]}]

[[part]]
name = "arm"
kind = "box"
size = [0.2, 0.7, 0.15]
place = [{move = [-0.3, 0.4, 0.0]}]
)";

// 20 frames a second and a small image: it is loaded in some seconds. All of the mission's rays, as with a quarter of them this target is
// lost with some seeds. A busy machine loses scans: a trial waits for few valid poses, and no track is lost meanwhile.
class UploadTest : public ::testing::Test {
 protected:
  UploadTest() : url_("udp://127.0.0.1:" + free_port()) {
    make_image("first", "1", "1.0");
    make_image("second", "2", "1.0");
  }

  void make_image(const std::string& name, const std::string& version, const std::string& scale) const {
    std::string model = kModel;
    model.replace(model.find("SCALE"), 5, scale);
    work_.write("missions/models/" + name + ".toml", model);
    work_.write_mission({{"version = 1", "version = " + version},
                         {"models/hubble_tenth.toml", "models/" + name + ".toml"},
                         {"[target.parameters]\narray_angle_deg = 0.0\ndoor_angle_deg = 105.0\n", ""},
                         {"cell_size_m = 0.012", "cell_size_m = 0.1"},
                         {"duration_s = 0.18", "duration_s = 0.045"},
                         {"period_s = 0.2", "period_s = 0.05"},
                         {"[start]", "[image]\ntrial_scans = 40\ntrial_valid_min = 3\n\n[tracking]\ncoast_frames = 1000\n\n[start]"}});
    std::filesystem::rename(work_ / "missions/test.toml", work_ / ("missions/" + name + ".toml"));
    const Answer made = work_.mdat("mission compile missions/" + name + ".toml --scenario spin -o " + name + ".3dli");
    ASSERT_EQ(made.exit_code, 0) << made.err;
  }

  std::uint32_t crc_of(const std::string& image) const {
    const std::string bytes = work_.read(image);
    std::uint32_t crc = 0;
    for (const char byte : bytes.substr(bytes.size() - 4)) crc = crc << 8U | static_cast<std::uint8_t>(byte);
    return crc;
  }
  std::string name_of(const std::string& image) const {
    char text[16];
    (void)std::snprintf(text, sizeof text, "%08x", crc_of(image));
    return text;
  }

  // The run says which image it begins with, and where that came from.
  std::unique_ptr<LiveRun> start(const std::string& image, const std::string& from, const std::string& mission = "first") const {
    auto run = std::make_unique<LiveRun>(work_, "run",
                                         std::vector<std::string>{"run", "missions/" + mission + ".toml", "--scenario", "spin",
                                                                  "--no-report", "--frames", "100000", "--link", url_, "--store", "store"});
    EXPECT_TRUE(run->says("image " + name_of(image) + " of " + from)) << run->out() << work_.read("run.err");
    return run;
  }

  Answer send(const std::string& command) const { return work_.mdat("command " + command + " --wait 30 --to " + url_); }
  Answer upload(const std::string& arguments) const {
    return work_.mdat("upload " + arguments + " --wait 30 --trial-wait 60 --to " + url_);
  }

  // One that is killed when some blocks have gone.
  void interrupt_upload() const {
    LiveRun interrupted(work_, "upload", {"upload", "second.3dli", "--to", url_});
    for (int i = 0; i < 3000 && work_.read("upload.err").find("blocks") == std::string::npos; ++i)
      std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }

  // Is this image active? By the packet image.
  bool is_active(const std::string& image) const {
    const std::string out = send("report_structure structure=image --listen 1").out;
    return out.find(std::to_string(crc_of(image))) < out.find("active_buffer");
  }

  WorkFolder work_;
  std::string url_;
};

TEST_F(UploadTest, ALossOfPowerInTheMiddleLeavesTheOldImageAndALaterOneIsLoadedTriedAndTakenBack) {
  VERIFIES("LASSO-IMG-011~1 LASSO-IMG-012~1 LASSO-IMG-015~1 LASSO-LNK-016~2 LASSO-LNK-017~2");
  {
    const auto run = start("first.3dli", "the mission");
    interrupt_upload();
    run->kill();
  }
  const auto run = start("first.3dli", "store", "second");
  interrupt_upload();
  const Answer loaded = upload("second.3dli");
  ASSERT_EQ(loaded.exit_code, 0) << loaded.err;
  EXPECT_NE(loaded.out.find("is ready"), std::string::npos) << loaded.out;
  const std::string activate = "activate_image crc=" + std::to_string(crc_of("second.3dli"));
  EXPECT_NE(send(activate).err.find("not_armed"), std::string::npos);
  EXPECT_TRUE(is_active("first.3dli"));
  const Answer active = upload("second.3dli --activate");
  EXPECT_EQ(active.exit_code, 0) << active.err;
  EXPECT_NE(active.out.find("is active and confirmed"), std::string::npos) << active.out;
  EXPECT_TRUE(is_active("second.3dli"));
  EXPECT_EQ(send("roll_back_image --arm").exit_code, 0);
  EXPECT_TRUE(is_active("first.3dli"));
}

// An image that the check does not refuse, and that no scan agrees with.
TEST_F(UploadTest, ABadImageIsRefusedOrTakenBack) {
  VERIFIES("LASSO-IMG-013~1 LASSO-IMG-014~2");
  const auto run = start("first.3dli", "the mission");
  work_.write("damaged.3dli", work_.read("second.3dli").substr(0, 4096));
  const Answer here = upload("damaged.3dli");
  EXPECT_EQ(here.exit_code, 2) << here.err;
  const Answer there = upload("damaged.3dli --unchecked --activate");
  EXPECT_EQ(there.exit_code, 1) << there.out;
  EXPECT_NE(there.err.find("the component refuses the image: "), std::string::npos) << there.err;
  EXPECT_TRUE(is_active("first.3dli"));
  make_image("other", "3", "0.6");
  const Answer other = upload("other.3dli --activate");
  EXPECT_EQ(other.exit_code, 1) << other.out;
  EXPECT_NE(other.err.find("was taken back"), std::string::npos) << other.err;
  EXPECT_TRUE(is_active("first.3dli"));
}

// mdat upload signs what is not signed, and sends nothing that is signed with another key; the component refuses it, too.
TEST_F(UploadTest, AComponentWithAKeyTakesASignedImageAlone) {
  VERIFIES("LASSO-IMG-022~1 LASSO-LNK-045~1");
  work_.write("key", std::string(64, 'a'));
  work_.write("other", std::string(64, 'b'));
  const LiveRun run(
      work_, "run",
      {"run", "missions/first.toml", "--scenario", "spin", "--no-report", "--frames", "100000", "--link", url_, "--key", "key"});
  ASSERT_EQ(send("ping --key key").exit_code, 0);
  ASSERT_EQ(work_.mdat("mission sign second.3dli -o forged.3dli --key other").exit_code, 0);
  const Answer kept = upload("forged.3dli --key key");
  EXPECT_EQ(kept.exit_code, 2);
  EXPECT_NE(kept.err.find("forged.3dli: is signed with another key"), std::string::npos) << kept.err;
  const Answer forged = upload("forged.3dli --key key --unchecked");
  EXPECT_EQ(forged.exit_code, 1);
  EXPECT_NE(forged.err.find("the component refuses the image: not_authentic"), std::string::npos) << forged.err;
  const Answer active = upload("second.3dli --activate --key key");
  EXPECT_EQ(active.exit_code, 0) << active.err;
  EXPECT_NE(active.out.find("image " + name_of("second.3dli") + " is active and confirmed"), std::string::npos) << active.out;
}

// Whether the component wants the signature, its link does not tell.
TEST_F(UploadTest, WithoutAKeyASignatureIsSentAndLeftBehindWhereTheUserSaysSo) {
  VERIFIES("LASSO-LNK-055~1");
  work_.write("key", std::string(64, 'a'));
  ASSERT_EQ(work_.mdat("mission sign second.3dli -o signed.3dli --key key").exit_code, 0);
  const auto run = start("first.3dli", "the mission");
  const Answer as_it_is = upload("signed.3dli");
  EXPECT_EQ(as_it_is.exit_code, 1);
  EXPECT_NE(as_it_is.err.find("signed.3dli: is signed, and sent with its signature"), std::string::npos) << as_it_is.err;
  EXPECT_NE(as_it_is.err.find("check_image is not carried out: other_image"), std::string::npos) << as_it_is.err;
  const Answer unsigned_one = upload("signed.3dli --unsigned");
  EXPECT_EQ(unsigned_one.exit_code, 0) << unsigned_one.err;
  EXPECT_NE(unsigned_one.out.find("image " + name_of("second.3dli") + " is ready"), std::string::npos) << unsigned_one.out;
  EXPECT_EQ(upload("signed.3dli --unsigned --key key").exit_code, 2);
}

}  // namespace
}  // namespace lasso::ft
