#include "ft/pil/seu_board.hpp"

#include <algorithm>
#include <array>
#include <chrono>
#include <fstream>
#include <sstream>
#include <thread>

#include "mdat/common/errors.hpp"

namespace lasso::pil {
namespace {

constexpr int kStartPatience_s = 60;

Range only(const Places& places, const std::string& name) {
  const auto found = places.find(name);
  if (found == places.end() || found->second.size() != 1) throw mdat::RunError("places of the board: one range of " + name + " is needed");
  return found->second.front();
}

bool is_start(const Report& report) { return report[bare::kRigKind] == static_cast<std::uint32_t>(bare::RigKind::kBegun); }

}  // namespace

Places read_places(const std::string& file) {
  std::ifstream stream(file);
  Places places;
  std::string name;
  Range range;
  while (stream >> name >> range.address >> range.bytes) places[name].push_back(range);
  if (places.empty() || !stream.eof()) throw mdat::RunError(file + ": lines of a name, an address and bytes are needed");
  return places;
}

SeuBoard::SeuBoard(std::string folder, const Places& places, std::function<void()> start_emulator)
    : folder_(std::move(folder)),
      start_emulator_(std::move(start_emulator)),
      memory_(only(places, "all_data")),
      stack_(only(places, "acquisition_stack")),
      log_(only(places, "log")),
      constants_{only(places, "code"), only(places, "vectors"), only(places, "image"), only(places, "stored_image"),
                 only(places, "stored_header")} {}

void SeuBoard::begin() {
  for (std::optional<Line>* line : {&camera_, &ground_, &rig_}) line->emplace();
  camera_->listen(folder_, "camera");
  ground_->listen(folder_, "ground");
  rig_->listen(folder_, "rig");
  start_emulator_();
  for (std::optional<Line>* line : {&camera_, &ground_, &rig_}) (*line)->await();
  gdb_.connect(folder_ + "/gdb.sock");
  ram_ = shared_.map(folder_);
  gdb_.go_on();
  const std::optional<Said> said = await(kStartPatience_s);
  if (!said || !said->begun) throw mdat::RunError("the board does not begin");
}

void SeuBoard::keep_constants() {
  kept_constants_.clear();
  for (const Range& range : constants_) kept_constants_.emplace_back(bytes_of(range).begin(), bytes_of(range).end());
}

void SeuBoard::give(const Packet& from_camera, const Packet& from_ground) {
  camera_->give(from_camera);
  ground_->give(from_ground);
  rig_->give(words({camera_->given(), ground_->given()}));
}

std::optional<Said> SeuBoard::await(int patience_s, const std::function<void()>& stopped) {
  using std::chrono::steady_clock;
  const steady_clock::time_point end = steady_clock::now() + std::chrono::seconds(patience_s);
  std::optional<Report> report;
  for (;;) {
    for (std::optional<Line>* line : {&camera_, &ground_, &rig_}) (*line)->move();
    if (gdb_.hit() && stopped) stopped();
    if (!report && rig_->has(4 * bare::kRigWords)) {
      report = report_of(rig_->take(4 * bare::kRigWords));
      if (is_start(*report)) camera_->count_anew(), ground_->count_anew();
    }
    if (report && camera_->has_all((*report)[bare::kRigCameraSent]) && ground_->has_all((*report)[bare::kRigGroundSent])) break;
    std::array<pollfd, 4> states{camera_->awaited(), ground_->awaited(), rig_->awaited(), pollfd{gdb_.descriptor(), POLLIN, 0}};
    const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(end - steady_clock::now()).count();
    if (left <= 0 || poll(states.data(), states.size(), static_cast<int>(left)) <= 0) return {};
  }
  return Said{is_start(*report), camera_->take_until((*report)[bare::kRigCameraSent]),
              ground_->take_until((*report)[bare::kRigGroundSent])};
}

Snapshot SeuBoard::keep() {
  gdb_.stop();
  Snapshot snapshot;
  snapshot.memory.assign(bytes_of(memory_).begin(), bytes_of(memory_).end());
  snapshot.stack.assign(bytes_of(stack_).begin(), bytes_of(stack_).end());
  snapshot.log.assign(bytes_of(log_).begin(), bytes_of(log_).end());
  snapshot.registers = gdb_.registers();
  snapshot.counts = {camera_->taken(), camera_->given(), ground_->taken(), ground_->given()};
  gdb_.go_on();
  return snapshot;
}

// The processor is stopped then.
void SeuBoard::put_back(const Snapshot& snapshot) {
  gdb_.stop();
  for (std::optional<Line>* line : {&camera_, &ground_, &rig_}) (*line)->move();
  std::copy(snapshot.memory.begin(), snapshot.memory.end(), bytes_of(memory_).begin());
  std::copy(snapshot.stack.begin(), snapshot.stack.end(), bytes_of(stack_).begin());
  std::copy(snapshot.log.begin(), snapshot.log.end(), bytes_of(log_).begin());
  restore_constants();
  gdb_.set_registers(snapshot.registers);
  camera_->go_back(snapshot.counts.camera_taken, snapshot.counts.camera_given);
  ground_->go_back(snapshot.counts.ground_taken, snapshot.counts.ground_given);
  rig_->go_back(0, 0);
}

bool SeuBoard::constants_right() const {
  for (std::size_t i = 0; i < constants_.size(); ++i)
    if (!std::equal(kept_constants_[i].begin(), kept_constants_[i].end(), bytes_of(constants_[i]).begin())) return false;
  return true;
}

void SeuBoard::restore_constants() {
  for (std::size_t i = 0; i < constants_.size(); ++i) {
    const Packet& kept = kept_constants_[i];
    const Bytes now = bytes_of(constants_[i]);
    for (std::size_t n = 0; n < kept.size(); ++n)
      if (now[n] != kept[n]) gdb_.write(constants_[i].address + static_cast<std::uint32_t>(n), kept[n]);
  }
}

void SeuBoard::flip(std::uint32_t address, std::uint8_t bit) { gdb_.write(address, static_cast<std::uint8_t>(*at(address) ^ (1U << bit))); }

}  // namespace lasso::pil
