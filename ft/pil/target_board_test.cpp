// What the rig does with a board that is none: it says what a board says at its lines, up to a slot, and then hangs.
#include <gtest/gtest.h>

#include <array>
#include <atomic>
#include <thread>

#include "bsp/posix/serial_line.hpp"
#include "fsw/exec/executive.hpp"
#include "ft/pil/boards.hpp"
#include "ft/pil/line.hpp"
#include "mdat/common/errors.hpp"
#include "mdat/run/simulation.hpp"
#include "ut/support/places.hpp"

namespace lasso::pil {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;

enum class Hang { kSilent, kBabbling };  // no word more; a byte now and then, which is no report

// The emulator's end of the lines, in a thread of its own.
class PlantedBoard {
 public:
  PlantedBoard(std::string folder, std::uint32_t slots, Hang hang) : folder_(std::move(folder)), slots_(slots), hang_(hang) {}
  ~PlantedBoard() {
    ended_ = true;
    if (thread_.joinable()) thread_.join();
  }
  PlantedBoard(const PlantedBoard&) = delete;
  PlantedBoard& operator=(const PlantedBoard&) = delete;

  void start() {
    thread_ = std::thread([this] { run(); });
  }

 private:
  void run() {
    const std::array<const char*, 3> names{"camera", "ground", "rig"};
    for (std::size_t i = 0; i < names.size(); ++i) EXPECT_EQ(lines_[i].open("unix:" + folder_ + "/" + names[i] + ".sock", 0, false), "");
    report(bare::RigKind::kBegun);
    for (std::uint32_t slot = 0; slot < slots_ && !ended_; ++slot) {
      await_answer();
      report(bare::RigKind::kSlot);
    }
    while (!ended_) {
      std::this_thread::sleep_for(milliseconds(20));
      const std::uint8_t byte = 0;
      if (hang_ == Hang::kBabbling) (void)lines_[1].write({&byte, 1});
    }
  }

  void report(bare::RigKind kind) {
    Packet bytes = words({bare::kRigReport, static_cast<std::uint32_t>(kind)});
    bytes.resize(std::size_t{4} * bare::kRigWords);
    (void)lines_[2].write({bytes.data(), bytes.size()});
  }

  void await_answer() {
    std::array<std::uint8_t, 8> answer{};
    for (std::size_t taken = 0; taken < answer.size() && !ended_;) {
      taken += lines_[2].read(Bytes(answer.data() + taken, answer.size() - taken));
      std::this_thread::sleep_for(milliseconds(1));
    }
  }

  std::string folder_;
  std::uint32_t slots_;
  Hang hang_;
  std::atomic<bool> ended_{false};
  std::array<posix::SerialLine, 3> lines_;
  std::thread thread_;
};

class TargetBoard : public testing::Test {
 protected:
  // What the rig says of the board.
  std::string fly(std::uint32_t slots, Hang hang, seconds quiet, seconds whole) {
    const mdat::CompiledMission mission = mdat::compile_mission(test::source_folder() / "cfg/missions/hubble_tenth.toml");
    const auto target = mdat::make_target(mission.mesh);
    mdat::SimulationOptions simulation;
    simulation.scenario = "spin";
    const WorldSetup setup{mdat::camera_case(mission, simulation, *target), {}, false};
    const std::string folder = testing::TempDir();
    PlantedBoard board(folder, slots, hang);
    const Patience patience{quiet, std::chrono::steady_clock::now() + whole};
    try {
      const TargetFlight flight = fly_on_target(
          setup, {folder, 1, 1, patience}, [&] { board.start(); }, [](std::uint32_t) {});
      return std::to_string(flight.slots.size()) + " slots";
    } catch (const mdat::RunError& error) {
      return error.what();
    }
  }
};

TEST_F(TargetBoard, OneThatAnswersFliesToTheEnd) { EXPECT_EQ(fly(kSlotsPerFrame, Hang::kSilent, seconds(30), seconds(60)), "20 slots"); }

TEST_F(TargetBoard, OneThatFallsSilentIsGivenUp) {
  const std::string said = fly(7, Hang::kSilent, seconds(1), seconds(60));
  EXPECT_NE(said.find("nothing has moved on the board's lines for 1 s; awaited was the report of slot 7 in frame 0"), std::string::npos)
      << said;
}

TEST_F(TargetBoard, OneThatOnlyBabblesIsGivenUp) {
  const std::string said = fly(7, Hang::kBabbling, seconds(30), seconds(5));
  EXPECT_NE(
      said.find("the flight has not ended within its time; awaited was the report of slot 7 in frame 0: fewer frames, or a longer limit"),
      std::string::npos)
      << said;
}

}  // namespace
}  // namespace lasso::pil
