// What the rig of flips does with a board that is none: it begins, and then only babbles.
#include "ft/pil/seu_board.hpp"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <atomic>
#include <thread>

namespace lasso::pil {
namespace {

using std::chrono::milliseconds;
using std::chrono::steady_clock;

constexpr off_t kRamSize = 256 << 20;

// The emulator's end of lines and debug port, in a thread of its own.
class BabblingBoard {
 public:
  explicit BabblingBoard(std::string folder) : folder_(std::move(folder)) {
    EXPECT_EQ(server_.listen("unix:" + folder_ + "/gdb.sock", false), "");
  }
  ~BabblingBoard() {
    ended_ = true;
    if (thread_.joinable()) thread_.join();
  }
  BabblingBoard(const BabblingBoard&) = delete;
  BabblingBoard& operator=(const BabblingBoard&) = delete;

  void start() {
    const int fd = open((folder_ + "/ram.bin").c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0600);
    EXPECT_EQ(ftruncate(fd, kRamSize), 0);
    (void)close(fd);
    thread_ = std::thread([this] { run(); });
  }

 private:
  void run() {
    const std::array<const char*, 3> names{"camera", "ground", "rig"};
    for (std::size_t i = 0; i < names.size(); ++i) EXPECT_EQ(lines_[i].open("unix:" + folder_ + "/" + names[i] + ".sock", 0, false), "");
    while (!ended_ && !server_.accept(debug_port_)) std::this_thread::sleep_for(milliseconds(1));
    say(debug_port_, "+$OK#9a");
    Packet report = words({bare::kRigReport, static_cast<std::uint32_t>(bare::RigKind::kBegun)});
    report.resize(std::size_t{4} * bare::kRigWords);
    (void)lines_[2].write({report.data(), report.size()});
    for (; !ended_; std::this_thread::sleep_for(milliseconds(20))) say(lines_[1], "b");
  }

  static void say(posix::SerialLine& line, const std::string& text) {
    (void)line.write({reinterpret_cast<const std::uint8_t*>(text.data()), text.size()});
  }

  std::string folder_;
  posix::LineServer server_;
  posix::SerialLine debug_port_;
  std::array<posix::SerialLine, 3> lines_;
  std::atomic<bool> ended_{false};
  std::thread thread_;
};

TEST(SeuBoard, OneThatOnlyBabblesIsGivenUp) {
  const std::string folder = testing::TempDir();
  Places places;
  for (const char* name : {"all_data", "acquisition_stack", "log", "code", "vectors", "image", "stored_image", "stored_header"})
    places[name] = {{0, 4}};
  BabblingBoard babbling(folder);
  SeuBoard board(folder, places, [&] { babbling.start(); });
  board.begin();
  const auto begun = steady_clock::now();
  EXPECT_FALSE(board.await(2));
  EXPECT_LT(steady_clock::now() - begun, std::chrono::seconds(10));
  (void)unlink((folder + "/ram.bin").c_str());
}

}  // namespace
}  // namespace lasso::pil
