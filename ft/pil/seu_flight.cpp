#include "ft/pil/seu_flight.hpp"

#include <algorithm>
#include <chrono>
#include <cstdio>

#include "fsw/exec/executive.hpp"
#include "fsw/link/events.hpp"
#include "fsw/mode/modes.hpp"
#include "mdat/common/errors.hpp"
#include "mdat/run/verdict.hpp"

namespace lasso::pil {
namespace {

// Of the host, for a slot: at least so long, or as many frames of the flight without a flip took. A slot that hangs the board's own
// watchdog ends after 200 million instructions, which are those of some 40 frames.
constexpr int kPatience_s = 20;
constexpr double kPatienceFrames = 100;
constexpr std::uint32_t kSameFrames = 3;               // in a row, memory too: the flip is gone
constexpr std::uint32_t kValidFrames = 3;              // in a row: it tracks again
constexpr std::uint32_t kRecoverFrames = 10;           // after it was reported
constexpr std::uint32_t kDamagedFrames = 20;           // after it was reported of code, which stays damaged
constexpr std::uint32_t kRestartFrames = 10;           // after a restart
constexpr std::chrono::seconds kFlightPatience(1200);  // of the host, for a whole flight
constexpr std::uint32_t kRepeats = 2;                  // of the flight without a flip
constexpr std::uint32_t kFirst = kFirstFrame * kSlotsPerFrame, kLast = kGoldenFrames * kSlotsPerFrame;
constexpr std::uint32_t kBackFrame = 256;  // of vectors.S: the interrupted pointer is at its begin, at the stack's end

struct Heard {
  std::uint32_t poses = 0, invalid = 0, wrong = 0, tracking = 0;
  bool told = false;
};

// The board may send anything.
bool tells(ConstBytes packet) {
  return packet.size() > kPacketHeaderBytes && packet[7] == kServiceEvent && packet[8] >= static_cast<std::uint8_t>(Severity::kLow);
}

Heard hear(const Packet& telemetry, const sim::Trajectory& truth) {
  Heard heard;
  ConstBytes rest(telemetry.data(), telemetry.size());
  for (std::size_t size = packet_size(rest); size > 0 && size <= rest.size(); size = packet_size(rest)) {
    const ConstBytes packet = rest.first(size);
    rest = rest.subspan(size, rest.size() - size);
    PacketHeader header;
    PoseTelemetry pose;
    heard.told = heard.told || tells(packet);
    if (decode_pose(packet, header, pose) != PacketFault::kNone) continue;
    ++heard.poses;
    heard.invalid += pose.valid == 0 ? 1 : 0;
    heard.tracking += pose.valid != 0 && pose.mode == static_cast<std::uint8_t>(TrackingMode::kTracking) ? 1U : 0U;
    const Pose place = truth.at(pose.t_measurement_us).T_sensor_target;
    heard.wrong += mdat::judge_valid(pose, place) == mdat::PoseVerdict::kWrong ? 1U : 0U;
  }
  return heard;
}

bool ends_frame(std::uint32_t boundary) { return boundary % kSlotsPerFrame == 0; }
std::uint32_t frames_since(std::uint32_t boundary, const Flip& flip) { return (boundary - flip.frame * kSlotsPerFrame) / kSlotsPerFrame; }

std::string hex(std::uint32_t number) {
  char text[16];
  (void)std::snprintf(text, sizeof text, "%08x", number);
  return text;
}

void note(Trial& trial, std::uint32_t address, std::uint32_t bit) {
  trial.where = hex(address);
  trial.address = address;
  trial.bit = bit;
}

}  // namespace

SeuFlight::SeuFlight(const WorldSetup& setup, const std::string& folder, const Places& places, std::function<void()> start_emulator)
    : setup_(setup),
      places_(places),
      truth_(mdat::make_trajectory(setup.flight.scenario, setup.flight.range_m, mdat::kEpochUs, mdat::period_us(setup.flight.parameters))),
      board_(folder, places_, std::move(start_emulator)) {}

std::size_t SeuFlight::unsteady_bytes() const { return static_cast<std::size_t>(std::count(unsteady_.begin(), unsteady_.end(), true)); }

void SeuFlight::fly_golden() {
  board_.begin();
  record();
  unsteady_.assign(board_.memory().size(), false);
  for (const char* name : {"estimation_stack", "lines", "clock"}) ignore(places_.at(name).at(0));
  for (std::uint32_t i = 0; i < kRepeats; ++i) find_unsteady();
}

// Between two frames nobody is on the estimation stack; the rings of the lines hold what has been said, ticks of reports among it; clock
// and flight hold ticks.
void SeuFlight::ignore(const Range& range) {
  const std::uint32_t begin = range.address - places_.at("all_data").at(0).address;
  std::fill_n(unsteady_.begin() + begin, range.bytes, true);
}

void SeuFlight::record() {
  World world(setup_);
  moments_.resize(kLast + 1);
  const auto begun = std::chrono::steady_clock::now();
  for (std::uint32_t k = 0; k < kLast; ++k) {
    Moment& moment = moments_[k];
    if (k == kFirst) board_.keep_constants();
    if (k >= kFirst && k < kFirst + kFlipFrames * kSlotsPerFrame) snapshots_[k] = board_.keep();
    if (k >= kFirst && ends_frame(k)) memories_[k].assign(board_.memory().begin(), board_.memory().end());
    world.move_to(k, {moment.said.to_camera.data(), moment.said.to_camera.size()});
    moment.camera = world.from_camera();
    moment.ground = world.from_ground();
    board_.give(moment.camera, moment.ground);
    const std::optional<Said> said = board_.await(kPatience_s);
    if (!said || said->begun) throw mdat::RunError("the board stops without a flip");
    moments_[k + 1].said = *said;
    const Heard heard = hear(said->telemetry, *truth_);
    if (k >= kFirst && (heard.told || heard.invalid + heard.wrong > 0 || (ends_frame(k + 1) && heard.tracking == 0)))
      throw mdat::RunError("the flight without a flip reports a fault, or has poses that are missing, invalid or wrong");
  }
  const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - begun;
  patience_s_ = std::max(kPatience_s, static_cast<int>(kPatienceFrames / kGoldenFrames * taken.count()));
}

// The same flight again, from the first state that is kept.
void SeuFlight::find_unsteady() {
  board_.put_back(snapshots_.at(kFirst));
  board_.processor().go_on();
  for (std::uint32_t k = kFirst; k < kLast; ++k) {
    if (k > kFirst && ends_frame(k)) {
      const Packet& golden = memories_.at(k);
      for (std::size_t i = 0; i < golden.size(); ++i) unsteady_[i] = unsteady_[i] || golden[i] != board_.memory()[i];
    }
    board_.give(moments_[k].camera, moments_[k].ground);
    const std::optional<Said> said = board_.await(patience_s_);
    const Said& golden = moments_[k + 1].said;
    if (!said || said->begun || said->telemetry != golden.telemetry || said->to_camera != golden.to_camera)
      throw mdat::RunError("the board, put back to slot " + std::to_string(kFirst) + ", does something else in slot " + std::to_string(k));
  }
}

// A frame without a flip.
void SeuFlight::check_board() {
  board_.put_back(snapshots_.at(kFirst));
  board_.processor().go_on();
  for (std::uint32_t k = kFirst; k < kFirst + kSlotsPerFrame; ++k) {
    board_.give(moments_[k].camera, moments_[k].ground);
    const std::optional<Said> said = board_.await(patience_s_ / 4);
    if (!said || said->begun || said->telemetry != moments_[k + 1].said.telemetry) throw mdat::RunError("the board cannot be put back");
  }
}

// After a restart, or worse: a new emulator where the old one does not come back.
void SeuFlight::ready_board() {
  if (!doubtful_) return;
  try {
    check_board();
  } catch (const mdat::RunError&) {
    board_.begin();
    check_board();
  }
  doubtful_ = false;
}

Trial SeuFlight::fly(const Flip& flip) {
  ready_board();
  Trial trial;
  Course course;
  course.boundary = flip.boundary();
  course.to_camera = moments_[course.boundary].said.to_camera;
  try {
    board_.put_back(snapshots_.at(course.boundary));
    inject(course, flip, trial);
    board_.processor().go_on();
    fly_on(course, flip, trial);
  } catch (const mdat::RunError& error) {  // the emulator itself has given up
    (void)std::fprintf(stderr, "flip %u: %s\n", flip.trial, error.what());
    trial.outcome = trial.wrong > 0 ? "silent_wrong" : "hang";
    board_.begin();
    doubtful_ = true;
  }
  return trial;
}

void SeuFlight::fly_on(Course& course, const Flip& flip, Trial& trial) {
  const auto end = std::chrono::steady_clock::now() + kFlightPatience;
  while (trial.outcome.empty()) {
    const Step done = std::chrono::steady_clock::now() < end ? step(course, flip, trial) : Step::kSilent;
    if (done == Step::kSilent) trial.outcome = trial.wrong > 0 ? outcome_of(course, trial) : "hang";
    doubtful_ = doubtful_ || done != Step::kDone;
    if (done != Step::kDone || !ends_frame(course.boundary)) continue;
    trial.frames = course.restarts > 0 ? course.frames_before + course.boundary / kSlotsPerFrame : frames_since(course.boundary, flip);
    end_frame(course, trial);
    if (!course.flipped) flip_now(course, flip, trial);
    if (decided(course, trial)) trial.outcome = outcome_of(course, trial);
  }
}

SeuFlight::Step SeuFlight::step(Course& course, const Flip& flip, Trial& trial) {
  answer(course);
  const std::optional<Said> said = board_.await(patience_s_, [&] { reach(course, flip, trial); });
  if (!said) return Step::kSilent;
  if (said->begun) return start_anew(course, *said, trial), Step::kBegun;
  ++course.boundary;
  course.to_camera = said->to_camera;
  course.telemetry.insert(course.telemetry.end(), said->telemetry.begin(), said->telemetry.end());
  if (!course.world && (course.boundary > kLast || course.to_camera != moments_[course.boundary].said.to_camera)) diverge(course);
  return Step::kDone;
}

// The world of a start, as for the first one.
void SeuFlight::start_anew(Course& course, const Said& said, const Trial& trial) {
  ++course.restarts;
  course.frames_before = trial.frames;
  course.boundary = 0;
  course.world = std::make_unique<World>(setup_);
  course.to_camera = said.to_camera;
  course.telemetry = said.telemetry;
}

void SeuFlight::answer(Course& course) {
  if (!course.world && course.boundary >= kLast) diverge(course);
  if (!course.world) return board_.give(moments_[course.boundary].camera, moments_[course.boundary].ground);
  course.world->move_to(course.boundary, {course.to_camera.data(), std::min(course.to_camera.size(), lcs::kLineBytes)});
  const Packet camera = course.world->from_camera(), ground = course.world->from_ground();
  board_.give(camera, ground);
}

// From here on the world does what the board says: up to here it was that of the flight without a flip.
void SeuFlight::diverge(Course& course) {
  course.world = std::make_unique<World>(setup_);
  for (std::uint32_t k = 0; k < course.boundary; ++k) {
    const Packet& sent = moments_[k].said.to_camera;
    course.world->move_to(k, {sent.data(), sent.size()});
    static_cast<void>(course.world->from_camera());
    static_cast<void>(course.world->from_ground());
  }
}

// --- the flip; the processor is stopped

void SeuFlight::inject(Course& course, const Flip& flip, Trial& trial) {
  if (within_slot(flip.region)) return look_out(course, flip);
  const std::uint32_t address = address_in(places_.at(kRegionNames[static_cast<std::size_t>(flip.region)]), flip.place);
  board_.flip(address, flip.bit);
  note(trial, address, flip.bit);
  course.flipped = true;
}

void SeuFlight::look_out(Course& course, const Flip& flip) {
  course.breakpoints = flip.instructions;
  for (const std::uint32_t address : course.breakpoints) board_.processor().set_breakpoint(address, true);
}

// One of the instructions is reached. Each counts once.
void SeuFlight::reach(Course& course, const Flip& flip, Trial& trial) {
  const std::uint32_t at = register_word(board_.processor().registers(), kNipAt);
  const auto found = std::find(course.breakpoints.begin(), course.breakpoints.end(), at);
  if (found != course.breakpoints.end()) {
    board_.processor().set_breakpoint(at, false);
    course.breakpoints.erase(found);
    if (++course.reached == flip.reached) {
      trial.instruction = at;
      flip_live(course, flip, trial);
    }
  }
  board_.processor().go_on();
}

// None, or not as many, were reached in a whole frame.
void SeuFlight::flip_now(Course& course, const Flip& flip, Trial& trial) {
  board_.processor().stop();
  flip_live(course, flip, trial);
  board_.processor().go_on();
}

void SeuFlight::flip_live(Course& course, const Flip& flip, Trial& trial) {
  for (const std::uint32_t address : course.breakpoints) board_.processor().set_breakpoint(address, false);
  course.breakpoints.clear();
  course.flipped = true;
  std::string registers = board_.processor().registers();
  if (flip.region == Region::kStack) return flip_stack(flip, registers, trial);
  trial.where = flip_register(registers, flip.place, flip.bit, trial.bit);
  board_.processor().set_registers(registers);
}

void SeuFlight::flip_stack(const Flip& flip, const std::string& registers, Trial& trial) {
  const Range acquisition = places_.at("acquisition_stack").at(0), estimation = places_.at("estimation_stack").at(0);
  const std::uint8_t* saved = board_.at(acquisition.address + acquisition.bytes - kBackFrame);
  const std::uint32_t interrupted = std::uint32_t{saved[0]} << 24 | std::uint32_t{saved[1]} << 16 | std::uint32_t{saved[2]} << 8 | saved[3];
  const std::uint32_t address = address_in(live_stacks(register_word(registers, 4), acquisition, estimation, interrupted), flip.place);
  board_.flip(address, flip.bit);
  note(trial, address, flip.bit);
}

// --- the end of a frame

void SeuFlight::end_frame(Course& course, Trial& trial) {
  const Heard heard = hear(course.telemetry, *truth_);
  const bool golden = course.boundary <= kLast && course.telemetry == moments_[course.boundary].said.telemetry;
  course.other = course.other || !golden;
  course.same = golden && !course.world && steady_again(course.boundary, trial) ? course.same + 1 : 0;
  course.valid = heard.tracking > 0 && heard.invalid == 0 ? course.valid + 1 : 0;
  trial.wrong += heard.wrong;
  trial.invalid += heard.invalid + (heard.poses == 0 ? 1U : 0U);
  if (heard.wrong > 0 && trial.first_wrong == 0) trial.first_wrong = trial.frames;
  if (heard.told && trial.told_after == 0 && course.restarts == 0) trial.told_after = trial.frames;
  course.telemetry.clear();
}

// Memory is as without the flip, but for what differs in each flight, where the flip may not have been: clock, flight and lines of the
// board.
bool SeuFlight::steady_again(std::uint32_t boundary, const Trial& trial) const {
  const auto found = memories_.find(boundary);
  if (found == memories_.end() || trial.where.empty()) return false;
  const Range lines = places_.at("lines").at(0), clock = places_.at("clock").at(0);
  if (trial.address - lines.address < lines.bytes || trial.address - clock.address < clock.bytes) return false;
  const ConstBytes now = board_.memory();
  for (std::size_t i = 0; i < now.size(); ++i)
    if (now[i] != found->second[i] && !unsteady_[i]) return false;
  return true;
}

bool SeuFlight::decided(const Course& course, const Trial& trial) const {
  if (course.restarts > 0) return course.boundary >= kRestartFrames * kSlotsPerFrame;
  if (trial.told_after > 0) {
    const std::uint32_t least = board_.constants_right() ? kValidFrames : kDamagedFrames;
    return trial.frames >= trial.told_after + (course.valid >= kValidFrames ? least : std::max(least, kRecoverFrames));
  }
  if (course.same >= kSameFrames && board_.constants_right()) return true;
  return trial.frames >= kScrubFrames;
}

std::string SeuFlight::outcome_of(const Course& course, const Trial& trial) {
  const bool told = trial.told_after > 0 || course.restarts > 0;
  if (trial.wrong > 0) return told ? "told_wrong" : "silent_wrong";
  if (course.restarts > 0) return "reset";
  if (told) return course.valid >= kValidFrames ? "recovered" : "stopped";
  if (trial.invalid > 0) return "invalid";
  if (course.other) return "harmless";
  return course.same > 0 && board_.constants_right() ? "masked" : "latent";
}

}  // namespace lasso::pil
