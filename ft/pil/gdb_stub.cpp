#include "ft/pil/gdb_stub.hpp"

#include <poll.h>

#include <array>
#include <chrono>
#include <cstdio>
#include <numeric>
#include <thread>

#include "mdat/common/errors.hpp"

namespace lasso::pil {
namespace {

constexpr int kPatience_ms = 20000;

std::string hex_of(std::uint32_t number) {
  std::array<char, 16> text{};
  (void)std::snprintf(text.data(), text.size(), "%x", number);
  return text.data();
}

}  // namespace

void GdbStub::connect(const std::string& socket) {
  *this = GdbStub();
  std::string wrong = "not tried";
  for (int tries = 0; tries < kPatience_ms / 10 && !wrong.empty(); ++tries) {
    wrong = line_.open("unix:" + socket, 0, false);
    if (!wrong.empty()) std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  if (!wrong.empty()) throw mdat::RunError(wrong);
  expect_ok("Qqemu.PhyMemMode:1");
}

void GdbStub::stop() {
  if (!running_) return;
  const char interrupt = 3;
  static_cast<void>(line_.write({reinterpret_cast<const std::uint8_t*>(&interrupt), 1}));
  static_cast<void>(receive());
  running_ = false;
}

void GdbStub::go_on() {
  send("c");
  running_ = true;
}

std::string GdbStub::registers() {
  const std::string answer = ask("g");
  if (answer.size() != 2 * kRegisterBytes)
    throw mdat::RunError("the emulator's debug port sends other registers than a 603e's: is it QEMU 7.2?");
  return answer;
}

void GdbStub::set_registers(const std::string& hex) { expect_ok("G" + hex); }

void GdbStub::write(std::uint32_t address, std::uint8_t byte) {
  std::array<char, 3> text{};
  (void)std::snprintf(text.data(), text.size(), "%02x", byte);
  expect_ok("M" + hex_of(address) + ",1:" + text.data());
}

void GdbStub::set_breakpoint(std::uint32_t address, bool set) { expect_ok((set ? "Z0," : "z0,") + hex_of(address) + ",4"); }

bool GdbStub::hit() {
  read_some();
  std::string body;
  if (!running_ || !take_packet(body)) return false;
  running_ = false;
  return true;
}

void GdbStub::send(const std::string& body) {
  const unsigned sum =
      std::accumulate(body.begin(), body.end(), 0U, [](unsigned all, char c) { return all + static_cast<std::uint8_t>(c); });
  std::array<char, 4> end{};
  (void)std::snprintf(end.data(), end.size(), "#%02x", sum & 0xFFU);
  const std::string packet = "$" + body + end.data();
  const auto* at = reinterpret_cast<const std::uint8_t*>(packet.data());
  for (std::size_t sent = 0; sent < packet.size() && line_.is_open();) sent += line_.write({at + sent, packet.size() - sent});
}

void GdbStub::read_some() {
  std::array<std::uint8_t, 4096> buffer{};
  const std::size_t count = line_.read(Bytes(buffer.data(), buffer.size()));
  bytes_.append(reinterpret_cast<const char*>(buffer.data()), count);
  if (!line_.is_open()) throw mdat::RunError("the emulator's debug port has been closed: the emulator has gone");
}

// One that is whole, and acknowledged; what lies between packets are acknowledgements of ours.
bool GdbStub::take_packet(std::string& body) {
  const std::size_t begin = bytes_.find('$'), end = bytes_.find('#');
  if (begin == std::string::npos || end == std::string::npos || bytes_.size() < end + 3) return false;
  body = bytes_.substr(begin + 1, end - begin - 1);
  bytes_.erase(0, end + 3);
  static_cast<void>(line_.write({reinterpret_cast<const std::uint8_t*>("+"), 1}));
  return true;
}

std::string GdbStub::receive() {
  const auto end = std::chrono::steady_clock::now() + std::chrono::milliseconds(kPatience_ms);
  std::string body;
  while (!take_packet(body)) {
    pollfd state{line_.descriptor(), POLLIN, 0};
    const bool late = std::chrono::steady_clock::now() > end;
    if (late || poll(&state, 1, kPatience_ms) <= 0) throw mdat::RunError("the emulator's debug port does not answer");
    read_some();
  }
  return body;
}

// A word that the processor has stopped, as after connecting, may come first.
std::string GdbStub::ask(const std::string& body) {
  send(body);
  std::string answer = receive();
  while (answer.starts_with("T")) answer = receive();
  return answer;
}

void GdbStub::expect_ok(const std::string& body) {
  const std::string answer = ask(body);
  if (answer != "OK") throw mdat::RunError("the emulator's debug port refuses " + body.substr(0, 20) + ": " + answer);
}

}  // namespace lasso::pil
