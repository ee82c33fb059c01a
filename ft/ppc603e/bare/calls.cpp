// What a statically linked program of the unit tests wants of Linux, on a 603e that has none: memory, a console, a file for its report, an
// end. Every other call is answered as one that does not exist. Its text goes to the card's fourth port, its report to the third.
#include <cstddef>
#include <cstdint>

#include "bsp/bare/console.hpp"
#include "bsp/ppc603e/board_bus.hpp"

namespace lasso::kernel {
namespace {

using bare::open_console;
using bare::say;
using bare::say_hex;
using bare::say_number;
using ppc603e::open_bus;
using ppc603e::serial_registers;

constexpr std::uint32_t kProgram = 0x10000000, kHeap = 0x20000000, kHeapEnd = 0x27000000, kStackEnd = 0x27F00000, kArguments = 0x27F00000;
constexpr std::uint32_t kConsolePort = 3, kReportPort = 2;
constexpr std::int32_t kReport = 3;  // descriptor of the only file that can be opened

// Numbers of Linux's calls on 32-bit PowerPC.
enum Call : std::uint32_t {
  kExit = 1,
  kWrite = 4,
  kClose = 6,
  kGetPid = 20,
  kMakeFolder = 39,
  kBreak = 45,
  kProtect = 125,
  kWriteVector = 146,
  kAction = 173,
  kMask = 174,
  kGetFolder = 182,
  kGetThread = 207,
  kFutex = 221,
  kSetThreadAddress = 232,
  kExitGroup = 234,
  kClock = 246,
  kSignal = 250,
  kOpenAt = 286,
  kStat = 383,
  kClock64 = 403,
  kFutex64 = 422,
};
constexpr std::int32_t kNoSuchCall = -38, kBadFile = -9;

std::uint32_t heap_at = kHeap;

[[noreturn]] void end(const char* how, std::uint32_t value) {
  open_console(serial_registers(kConsolePort));
  say_number(how, value);
  say("\n");
  for (;;) {
  }
}

std::int32_t write(std::uint32_t file, const char* text, std::uint32_t size) {
  if (file > static_cast<std::uint32_t>(kReport)) return kBadFile;
  open_console(serial_registers(file == kReport ? kReportPort : kConsolePort));
  for (std::uint32_t i = 0; i < size; ++i) {
    const char letter[2] = {text[i], '\0'};
    say(letter);
  }
  return static_cast<std::int32_t>(size);
}

struct Piece {
  const char* text;
  std::uint32_t size;
};

std::int32_t write_vector(std::uint32_t file, const Piece* pieces, std::uint32_t count) {
  std::int32_t all = 0;
  for (std::uint32_t i = 0; i < count; ++i) {
    const std::int32_t written = write(file, pieces[i].text, pieces[i].size);
    if (written < 0) return written;
    all += written;
  }
  return all;
}

std::int32_t move_break(std::uint32_t wanted) {
  if (wanted >= kHeap && wanted <= kHeapEnd) heap_at = wanted;
  return static_cast<std::int32_t>(heap_at);
}

std::int32_t tell_folder(char* path, std::uint32_t size) {
  constexpr std::int32_t kRange = -34, kBytes = 2;
  if (size < kBytes) return kRange;
  path[0] = '/';
  path[1] = '\0';
  return kBytes;
}

// Every path is a folder's.
std::int32_t describe_file(std::uint8_t* out) {
  constexpr std::size_t kBytes = 256, kMode = 28;
  for (std::size_t i = 0; i < kBytes; ++i) out[i] = 0;
  out[kMode] = 0x41;  // 040755
  out[kMode + 1] = 0xED;
  return 0;
}

// The tests take no time from it; GoogleTest wants some.
template <class Part>
std::int32_t tell_time(Part* time) {
  time[0] = time[1] = 0;
  return 0;
}

template <class To>
To* at(std::uint32_t address) {
  return reinterpret_cast<To*>(address);  // NOLINT(performance-no-int-to-ptr): what a register of the program says
}

}  // namespace
}  // namespace lasso::kernel

extern "C" {
std::uint64_t prepare_program();  // its stack and its entry: registers 3 and 4
std::int32_t serve_call(std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d, std::uint32_t e, std::uint32_t f,
                        std::uint32_t number);
[[noreturn]] void tell_fault(std::uint32_t vector, std::uint32_t place, std::uint32_t address, std::uint32_t miss);
}

std::int32_t serve_call(std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t, std::uint32_t e, std::uint32_t,
                        std::uint32_t number) {
  using namespace lasso::kernel;
  switch (number) {
    case kExit:
    case kExitGroup:
      end("\nbare: exit ", a);
    case kSignal:
      end("\nbare: signal ", c);
    case kWrite:
      return write(a, at<const char>(b), c);
    case kWriteVector:
      return write_vector(a, at<const Piece>(b), c);
    case kBreak:
      return move_break(a);
    case kClock:
      return tell_time(at<std::uint32_t>(b));
    case kClock64:
      return tell_time(at<std::uint64_t>(b));
    case kGetFolder:
      return tell_folder(at<char>(a), b);
    case kStat:
      return describe_file(at<std::uint8_t>(e));
    case kOpenAt:
      return kReport;
    case kGetPid:
    case kGetThread:
    case kSetThreadAddress:
      return 1;
    case kClose:
    case kFutex:
    case kFutex64:
    case kMakeFolder:
    case kProtect:
    case kAction:
    case kMask:
      return 0;
    default:
      return kNoSuchCall;
  }
}

void tell_fault(std::uint32_t vector, std::uint32_t place, std::uint32_t address, std::uint32_t miss) {
  using namespace lasso::kernel;
  open_console(serial_registers(kConsolePort));
  say_hex("\nbare: vector ", vector);
  say_hex(" at ", place);
  say_hex(", address ", address);
  say_hex(", missed ", miss);
  end("\nbare: fault ", vector);
}

// As Linux leaves the stack: the number of arguments, where they are, the environment, and what is said of the program's headers. Arguments
// and environment are texts one after the other, an empty one behind each of the two lists.
std::uint64_t prepare_program() {
  using namespace lasso::kernel;
  if (!open_bus().whole()) {
    for (;;) {
    }
  }
  constexpr std::uint32_t kMostWords = 64;
  std::uint32_t words[kMostWords] = {};
  std::uint32_t count = 1, list = 0;
  for (const char* text = at<const char>(kArguments); list < 2;) {
    const bool empty = *text == '\0';
    words[count] = empty ? 0 : static_cast<std::uint32_t>(reinterpret_cast<std::uintptr_t>(text));
    if (empty && list++ == 0) words[0] = count - 1;
    if (++count > kMostWords - 16) end("\nbare: too many arguments ", count);
    while (*text++ != '\0') {
    }
  }
  struct Header {
    std::uint8_t identity[16];
    std::uint16_t type, machine;
    std::uint32_t version, entry, programs, sections, flags;
    std::uint16_t bytes, program_bytes, program_count;
  };
  const auto* header = at<const Header>(kProgram);
  const std::uint32_t auxiliary[] = {
      3, kProgram + header->programs, 4, header->program_bytes, 5, header->program_count, 6, 4096, 25, kProgram, 9, header->entry, 0, 0};
  for (const std::uint32_t word : auxiliary) words[count++] = word;
  auto* stack = at<std::uint32_t>(kStackEnd - 4 * kMostWords);
  for (std::uint32_t i = 0; i < kMostWords; ++i) stack[i] = words[i];
  return std::uint64_t{kStackEnd - 4 * kMostWords} << 32 | header->entry;
}
