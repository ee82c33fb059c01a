// The flight image of this board: start-up has made memory and registers ready, and comes here after each restart.
#include <new>

#include "bsp/ppc603e/board_bus.hpp"
#include "bsp/ppc603e/console.hpp"
#include "bsp/ppc603e/cpu.hpp"
#include "bsp/ppc603e/fault.hpp"
#include "bsp/ppc603e/flight.hpp"
#include "bsp/ppc603e/loaded.hpp"
#include "bsp/ppc603e/ram_store.hpp"
#include "fsw/exec/report.hpp"
#include "fsw/exec/start_image.hpp"
#include "fsw/mission/image_format.hpp"

extern "C" {
extern void (*board_constructors_begin[])();
extern void (*board_constructors_end[])();
extern const std::uint8_t board_code_begin[], board_code_end[];
extern std::uint8_t board_image_buffer0[], board_image_buffer1[], board_store[], board_store_end[];
[[noreturn]] void board_main();
void board_interrupt(std::uint32_t vector);
}

namespace lasso::ppc603e {
namespace {

constexpr std::uint32_t kStrapsMagic = 0x53545250;
constexpr std::uint32_t kTicksPerSecond = 16600000;
constexpr std::uint32_t kLeastTicksPerSecond = 1000000, kMostTicksPerSecond = 1000000000;  // the decrementer holds 2 s of them

// Serial interrupts between two of the decrementer; more are those of a line that is stuck, and would keep the processor for ever. Three
// full rings each way are below half of it.
constexpr std::uint32_t kMostServices = 8192;

constexpr TimeUs kBoundary0Us = 1'000'000;
constexpr DurationUs kLeadUs = 10'000;  // from the clock's setting to boundary 0

// Of which board this image is (ft/pil/run asks before it is started).
[[gnu::section(".board_id"), gnu::used]] const char board_id[32] = "3dlasso board ppc603e-grackle";

enum Port : std::uint32_t { kCamera = 0, kGround = 1, kRig = 2, kConsole = 3 };

struct Board {
  lcs::Line camera_line;
  GroundLine ground_line;
  Ring rig_in, rig_out;
  SerialPort camera{port_registers(kCamera), camera_line.from_camera, camera_line.to_camera};
  SerialPort ground{port_registers(kGround), ground_line.in, ground_line.out};
  SerialPort rig_port{port_registers(kRig), rig_in, rig_out};
  Rig rig{rig_port, rig_in, rig_out};
};
Straps straps{};
alignas(RamStore) std::uint8_t store_memory[sizeof(RamStore)];
alignas(Board) std::uint8_t board_memory[sizeof(Board)];
alignas(Component) std::uint8_t component_memory[sizeof(Component)];
alignas(lcs::Driver) std::uint8_t driver_memory[sizeof(lcs::Driver)];
alignas(Flight) std::uint8_t flight_memory[sizeof(Flight)];
alignas(Clock) std::uint8_t clock_memory[sizeof(Clock)];
Board* board = nullptr;
Flight* flight = nullptr;
std::uint32_t services = 0;  // since the decrementer's last interrupt

[[noreturn]] void stop(const char* why) {
  allow_interrupts(false);
  say("board: ");
  say(why);
  say(": stopped\n");
  for (;;) set_machine_state(machine_state() | kRest);
}

lcs::Calibration calibration() {
  lcs::Calibration design;
  design.serial = 1;
  return design;
}

// The console first: a refusal is for reading.
void check_board() {
  const bool bus = open_bus();
  if (bus) open_console(port_registers(kConsole));
  const std::uint32_t version = processor_version() >> 16;
  if (version != kProcessor603e && version != kProcessor603eV) stop("the image is for another board: the processor is not a 603e");
  if (!bus) stop("the image is for another board: no Grackle bridge, Heathrow chip and serial card of four ports");
}

bool strapped() { return straps.magic == kStrapsMagic; }

std::uint32_t ticks_per_s() {
  const std::uint32_t ticks = strapped() ? straps.ticks_per_s : kTicksPerSecond;
  if (ticks >= kLeastTicksPerSecond && ticks <= kMostTicksPerSecond) return ticks;
  say_number("board: the straps at 0x04010000 say ", ticks);
  say_number(" ticks of the time base a second, not 1000000 to 1000000000: taken are ", kTicksPerSecond);
  say("\n");
  return kTicksPerSecond;
}

void open_lines(Board& b) {
  if (!b.camera.open() || !b.ground.open() || !b.rig_port.open()) stop("a serial port does not give back what is sent in its loop");
  unmask_serial_interrupt();
}

void tell_start(const FaultRecord& record) {
  say("board: 3dlasso ");
  say(version());
  say(" on ppc603e-grackle");
  say_number(", restarts ", record.restarts);
  say_number(", cause ", record.cause);
  say("\n");
}

std::size_t bytes_between(const std::uint8_t* begin, const std::uint8_t* end) {
  return reinterpret_cast<std::uintptr_t>(end) - reinterpret_cast<std::uintptr_t>(begin);
}

// What the scrub watches beside the images: code and constants. The vectors below them are mapped for nobody.
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
  if (magic != kImageMagic) stop("no mission image in the store, and no mission image at its place (load it at 0x04100000)");
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
  auto* driver = new (driver_memory) lcs::Driver(b.camera_line, lcs::Optics(calibration()));
  auto* component = new (component_memory) Component(*driver);
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
}  // namespace lasso::ppc603e

void board_interrupt(std::uint32_t vector) {
  using namespace lasso::ppc603e;
  if (vector == 0x900) {
    if (flight == nullptr) return;
    if (services > kMostServices) unmask_serial_interrupt();
    services = 0;
    if (!flight->waiting()) return flight->tick();
    board->camera.look();
    board->ground.look();
    board->rig_port.look();
    return flight->wait_on();
  }
  if (board == nullptr) return;
  if (++services > kMostServices) mask_serial_interrupt();
  const std::uint64_t begun = time_base();
  board->camera.service();
  board->ground.service();
  const std::uint64_t taken = time_base() - begun;
  board->rig_port.service();
  if (flight != nullptr) flight->note_lines(taken, services > kMostServices);
}

void board_main() {
  using namespace lasso;
  using namespace lasso::ppc603e;
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
