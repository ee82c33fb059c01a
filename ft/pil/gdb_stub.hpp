// The emulator's debug port: QEMU's stub of gdb's remote protocol, as much of it as flips need. The processor runs between go_on() and
// stop(), or until a breakpoint. Addresses are physical.
#pragma once

#include <cstdint>
#include <string>

#include "bsp/posix/serial_line.hpp"

namespace lasso::pil {

// General registers, floating point registers, then nip, msr, cr, lr, ctr, xer, fpscr: big-endian, as the stub sends them.
constexpr std::uint32_t kGeneral = 32, kFloating = 32, kOthers = 7;
constexpr std::uint32_t kRegisterBytes = 4 * kGeneral + 8 * kFloating + 4 * kOthers;
constexpr const char* kOtherNames[kOthers] = {"nip", "msr", "cr", "lr", "ctr", "xer", "fpscr"};
constexpr std::uint32_t kNipAt = 4 * kGeneral + 8 * kFloating;

class GdbStub {
 public:
  // All throw mdat::RunError where the stub does not answer, or refuses. The processor is stopped after connect().
  void connect(const std::string& socket);
  void stop();
  void go_on();
  bool running() const { return running_; }

  // While it is stopped. Registers in hexadecimal digits, as the protocol has them.
  std::string registers();
  void set_registers(const std::string& hex);
  // Code that is written is translated anew.
  void write(std::uint32_t address, std::uint8_t byte);
  void set_breakpoint(std::uint32_t address, bool set);

  // While it runs: whether a breakpoint has stopped it by now.
  bool hit();
  int descriptor() const { return line_.descriptor(); }

 private:
  void send(const std::string& body);
  std::string receive();
  bool take_packet(std::string& body);
  std::string ask(const std::string& body);
  void expect_ok(const std::string& body);
  void read_some();

  posix::SerialLine line_;
  std::string bytes_;
  bool running_ = false;
};

}  // namespace lasso::pil
