#include "bsp/posix/serial_line.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <chrono>
#include <cstdlib>
#include <functional>
#include <string>
#include <thread>
#include <vector>

#include "ut/support/verifies.hpp"

namespace lasso::posix {
namespace {

constexpr unsigned kRate = 4000000;

std::string folder() {
  char name[] = "/tmp/ut-posix-XXXXXX";
  return mkdtemp(name);
}

bool wait_for(const std::function<bool()>& done) {
  for (int i = 0; i < 5000; ++i) {
    if (done()) return true;
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  return false;
}

bool send_all(SerialLine& line, const std::string& text) {
  std::size_t sent = 0;
  return wait_for([&] {
    sent += line.write(ConstBytes(reinterpret_cast<const std::uint8_t*>(text.data()) + sent, text.size() - sent));
    return sent == text.size() || !line.is_open();
  });
}

std::string receive(SerialLine& line, std::size_t size) {
  std::string got;
  static_cast<void>(wait_for([&] {
    std::uint8_t bytes[64];
    const std::size_t count = line.read(Bytes(bytes));
    got.append(reinterpret_cast<const char*>(bytes), count);
    return got.size() >= size || !line.is_open();
  }));
  return got;
}

// All values of a byte, those of a terminal's control characters, too.
std::string all_bytes() {
  std::string bytes;
  for (int i = 0; i < 256; ++i) bytes.push_back(static_cast<char>(i));
  return bytes;
}

class LineKinds : public ::testing::TestWithParam<const char*> {
 protected:
  LineKinds() : folder_(folder()) {}
  ~LineKinds() override { static_cast<void>(rmdir(folder_.c_str())); }
  std::string address() const {
    const std::string kind = GetParam();
    return kind == "unix" ? "unix:" + folder_ + "/line" : kind == "tcp" ? "tcp://127.0.0.1:0" : "pty";
  }
  std::string folder_;
};

TEST_P(LineKinds, CarryEveryByteBothWaysAndAreTakenByOne) {
  VERIFIES("LASSO-LCS-017~1 LASSO-SIM-031~1");
  LineServer server;
  ASSERT_EQ(server.listen(address(), false), "");
  SerialLine client, camera;
  EXPECT_FALSE(server.accept(camera)) << "nobody has come";
  ASSERT_EQ(client.open(server.address(), kRate, false), "");
  ASSERT_TRUE(send_all(client, all_bytes()));
  ASSERT_TRUE(wait_for([&] { return server.accept(camera); }));
  EXPECT_EQ(receive(camera, 256), all_bytes());
  ASSERT_TRUE(send_all(camera, all_bytes()));
  EXPECT_EQ(receive(client, 256), all_bytes());
  std::uint8_t byte = 0;
  EXPECT_EQ(client.read(Bytes(&byte, 1)), 0U) << "there is no more";
  EXPECT_TRUE(client.is_open());

  SerialLine second;
  const std::string refusal = second.open(server.address(), kRate, false);
  EXPECT_EQ(refusal.rfind(server.address(), 0), 0U) << refusal;
  EXPECT_NE(refusal.find("another program"), std::string::npos) << refusal;
  EXPECT_FALSE(second.is_open());

  client.close();
  EXPECT_TRUE(wait_for([&] { return camera.read(Bytes(&byte, 1)) == 0 && !camera.is_open(); })) << "the client has gone";
  SerialLine next;
  EXPECT_TRUE(wait_for([&] { return server.accept(camera), next.open(server.address(), kRate, false).empty(); }));
}
INSTANTIATE_TEST_SUITE_P(All, LineKinds, ::testing::Values("tcp", "unix", "pty"), [](const auto& kind) { return std::string(kind.param); });

TEST(SerialLine, SaysWhyItIsNotOpen) {
  VERIFIES("LASSO-LCS-017~1");
  const std::string place = folder();
  const std::pair<std::string, const char*> cases[] = {
      {place + "/none", "not there"},
      {"unix:" + place + "/none", "not there"},
      {"/dev/null", "not a serial line"},
      {"tcp://127.0.0.1", "no address"},
      {"tcp://127.0.0.1:99999", "no address"},
      {"tcp://127.0.0.1:", "no address"},
      {"tcp://here:80", "no address"},
      {"tcp://192.0.2.1:80", "--remote"},
      {"unix:", "no address"},
      {"unix:" + std::string(200, 'x'), "no address"},
  };
  for (const auto& [address, why] : cases) {
    SerialLine line;
    const std::string refusal = line.open(address, kRate, false);
    EXPECT_NE(refusal.find(why), std::string::npos) << refusal;
    EXPECT_EQ(refusal.rfind(address, 0), 0U) << refusal;
    EXPECT_FALSE(line.is_open());
  }
  static_cast<void>(rmdir(place.c_str()));
}

TEST(SerialLine, NobodyListensWhereSomebodyDid) {
  VERIFIES("LASSO-LCS-017~1");
  std::string address;
  {
    LineServer server;
    ASSERT_EQ(server.listen("tcp://localhost:0", false), "");
    address = server.address();
  }
  SerialLine line;
  EXPECT_NE(line.open(address, kRate, false).find("nobody listens"), std::string::npos);
}

TEST(LineServer, RefusesWhatIsTakenOrNoAddress) {
  VERIFIES("LASSO-LCS-017~1");
  LineServer first, second;
  ASSERT_EQ(first.listen("tcp://127.0.0.1:0", false), "");
  EXPECT_NE(second.listen(first.address(), false).find("taken"), std::string::npos);
  EXPECT_NE(second.listen("serial", false).find("expected pty"), std::string::npos);
  EXPECT_NE(second.listen("tcp://0.0.0.0:0", false).find("--remote"), std::string::npos);
  EXPECT_EQ(second.listen("tcp://0.0.0.0:0", true), "");
  const std::string place = folder();
  ASSERT_EQ(first.listen("unix:" + place + "/line", false), "");
  EXPECT_NE(second.listen("unix:" + place + "/line", false).find("taken"), std::string::npos);
  first.close();
  EXPECT_EQ(second.listen("unix:" + place + "/line", false), "") << "the path is free again";
  second.close();
  EXPECT_EQ(rmdir(place.c_str()), 0) << "nothing is left behind";
}

// What can be said without opening a line, and with the words of opening it; whether somebody listens cannot.
TEST(SerialLine, IsCheckedWithoutBeingOpened) {
  VERIFIES("LASSO-LCS-017~1");
  const std::string top = folder();
  LineServer server;
  ASSERT_EQ(server.listen("unix:" + top + "/line", false), "");
  for (const std::string& address : {top + "/none", "unix:" + top + "/none", std::string("unix:"), std::string("tcp://192.0.2.1:9"),
                                     std::string("tcp://127.0.0.1:many")}) {
    SerialLine line;
    EXPECT_EQ(SerialLine::check(address, false), line.open(address, kRate, false)) << address;
    EXPECT_NE(SerialLine::check(address, false), "") << address;
  }
  for (const std::string& address : {server.address(), std::string("/dev/null"), std::string("tcp://127.0.0.1:9")})
    EXPECT_EQ(SerialLine::check(address, false), "") << address;
  EXPECT_EQ(SerialLine::check("tcp://192.0.2.1:9", true), "");
  SerialLine camera;
  EXPECT_FALSE(server.accept(camera)) << "nobody has come";
  server.close();
  static_cast<void>(rmdir(top.c_str()));
}

}  // namespace
}  // namespace lasso::posix
