// The flight image of a bare board: start-up has made memory and registers ready, and comes here after each restart.
#include <new>

#include "bsp/bare/board.hpp"
#include "bsp/bare/console.hpp"
#include "bsp/bare/cpu.hpp"
#include "bsp/bare/fault.hpp"
#include "bsp/bare/flight.hpp"
#include "bsp/bare/head.hpp"
#include "bsp/bare/loaded.hpp"
#include "bsp/bare/ram_store.hpp"
#include "fsw/exec/report.hpp"
#include "fsw/exec/start_image.hpp"
#include "fsw/mission/image_format.hpp"

extern "C" {
extern void (*board_constructors_begin[])();
extern void (*board_constructors_end[])();
extern const std::uint8_t board_code_begin[], board_code_end[];
extern std::uint8_t board_image_buffer0[], board_image_buffer1[], board_store[], board_store_end[];
}

namespace lasso::bare {
namespace {

constexpr std::uint32_t kStrapsMagic = 0x53545250;
constexpr std::uint32_t kLeastTicksPerSecond = 1000000, kMostTicksPerSecond = 1000000000;  // a wake-up call has 2 s of them

// Interrupts of the lines between two wake-up calls; more are those of a line that is stuck, and would keep the processor for ever. Three
// full rings each way, with an interrupt each eight bytes, are below two thirds of it.
constexpr std::uint32_t kMostServices = 8192;

constexpr TimeUs kBoundary0Us = 1'000'000;
constexpr DurationUs kLeadUs = 10'000;  // from the clock's setting to boundary 0

struct Board {
  lcs::Line camera_line;
  GroundLine ground_line;
  Ring rig_in, rig_out;
  SerialPort camera{port_registers(camera_port), camera_line.from_camera, camera_line.to_camera};
  SerialPort ground{port_registers(ground_port), ground_line.in, ground_line.out};
  SerialPort rig_port{port_registers(kRigPort), rig_in, rig_out};
  Rig rig{rig_port, rig_in, rig_out};
};
Straps straps{};
alignas(RamStore) std::uint8_t store_memory[sizeof(RamStore)];
alignas(Board) std::uint8_t board_memory[sizeof(Board)];
alignas(Component) std::uint8_t component_memory[sizeof(Component)];
DriverMemory driver_memory;
alignas(Flight) std::uint8_t flight_memory[sizeof(Flight)];
alignas(Clock) std::uint8_t clock_memory[sizeof(Clock)];
Board* board = nullptr;
Flight* flight = nullptr;
std::uint32_t services = 0;  // since the last wake-up call

bool strapped() { return straps.magic == kStrapsMagic; }

std::uint32_t ticks_per_s() {
  const std::uint32_t ticks = strapped() ? straps.ticks_per_s : nominal_ticks_per_s;
  if (ticks >= kLeastTicksPerSecond && ticks <= kMostTicksPerSecond) return ticks;
  say_hex("board: the straps at 0x", LoadedMemory::straps_at());
  say_number(" say ", ticks);
  say_number(" ticks of the time base a second, not 1000000 to 1000000000: taken are ", nominal_ticks_per_s);
  say("\n");
  return nominal_ticks_per_s;
}

void open_lines(Board& b) {
  if (!b.camera.open() || !b.ground.open() || !b.rig_port.open()) stop("a serial port fails its test");
  unmask_line_interrupts();
}

void tell_start(const FaultRecord& record) {
  say("board: 3dlasso ");
  say(version());
  say(" on ");
  say(board_id + kBoardNameAt);
  say_number(", restarts ", record.restarts);
  say_number(", cause ", record.cause);
  say("\n");
}

std::size_t bytes_between(const std::uint8_t* begin, const std::uint8_t* end) {
  return reinterpret_cast<std::uintptr_t>(end) - reinterpret_cast<std::uintptr_t>(begin);
}

// What the scrub watches beside the images: code and constants.
BoardMemory board_memory_of(RamStore& store) {
  BoardMemory memory;
  memory.image_buffers[0] = Bytes(board_image_buffer0, kMissionBytes);
  memory.image_buffers[1] = Bytes(board_image_buffer1, kMissionBytes);
  memory.store = &store;
  memory.code = ConstBytes(board_code_begin, bytes_between(board_code_begin, board_code_end));
  return memory;
}

// Why there is no mission: the store has no image that is right, and what was loaded is none.
[[noreturn]] void refuse_mission(const LoadFailure& failure, std::uint32_t magic, std::uint32_t bytes) {
  if (magic != kImageMagic) {
    say_hex("board: a mission image is to be loaded at 0x", LoadedMemory::image_at());
    say("\n");
    stop("no mission image in the store, and no mission image at its place");
  }
  if (bytes > kMissionBytes) {
    say_number("board: the mission image needs ", bytes);
    say_number(" bytes, and its buffer has ", kMissionBytes);
    say("; coarser cells make it smaller (target.cell_size_m)\n");
    stop("the mission image is too large");
  }
  say("board: the mission image is refused: ");
  say(to_string(failure.status));
  say(", ");
  say(failure.what);
  say("\n");
  stop("no mission");
}

Component& make_component(Board& b, ResetCause cause) {
  auto* component = new (component_memory) Component(make_sensor(driver_memory, b.camera_line));
  component->set_reset_cause(cause);
  auto* store = new (store_memory) RamStore(Bytes(board_store, bytes_between(board_store, board_store_end)), kMissionBytes, write_back);
  ImageStart started;
  std::uint32_t magic = 0, bytes = 0;
  {
    const LoadedMemory loaded;
    magic = LoadedMemory::image_magic();
    bytes = LoadedMemory::image_bytes();
    started = start_image(*component, board_memory_of(*store), LoadedMemory::image());
  }
  if (failed(started.failure)) refuse_mission(started.failure, magic, bytes);
  say(started.from_store ? "board: the image of the store\n" : "board: the image as loaded\n");
  return *component;
}

}  // namespace

void stop(const char* why) {
  forbid_interrupts();
  say("board: ");
  say(why);
  say(": stopped\n");
  rest_for_ever();
}

void serve_wake_up() {
  if (flight == nullptr) return;
  if (flight->probed(time_base())) return flight->wait_on();
  if (services > kMostServices) unmask_line_interrupts();
  services = 0;
  if (!flight->waiting()) return flight->tick();
  board->camera.look();
  board->ground.look();
  board->rig_port.look();
  return flight->wait_on();
}

void serve_lines() {
  if (board == nullptr) return;
  if (++services > kMostServices) mask_line_interrupts();
  const std::uint64_t begun = time_base();
  board->camera.service();
  board->ground.service();
  const std::uint64_t taken = time_base() - begun;
  board->rig_port.service();
  if (flight != nullptr) flight->note_lines(begun, taken, services > kMostServices);
}

}  // namespace lasso::bare

void board_main() {
  using namespace lasso;
  using namespace lasso::bare;
  for (auto make = board_constructors_begin; make != board_constructors_end; ++make) (*make)();
  const FaultRecord& record = open_record();
  check_board();
  tell_start(record);
  {
    const LoadedMemory loaded;
    straps = LoadedMemory::straps();
  }
  board = new (board_memory) Board;
  open_lines(*board);
  Component& component = make_component(*board, static_cast<ResetCause>(record.cause));
  auto* clock = new (clock_memory) Clock(ticks_per_s());
  clock->set(kBoundary0Us - kLeadUs);
  if (component.begin(kBoundary0Us) != Status::kOk) stop("the component does not begin");
  flight = new (flight_memory)
      Flight(component, *clock, {board->camera, board->ground, board->ground_line}, strapped() && straps.rig == 1 ? &board->rig : nullptr);
  flight->run();
  stop("the rig has ended the run");
}
