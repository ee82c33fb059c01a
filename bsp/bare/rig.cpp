#include "bsp/bare/rig.hpp"

#include "bsp/bare/cpu.hpp"
#include "fsw/core/invariant.hpp"

namespace lasso::bare {

std::uint32_t Rig::take_word() {
  std::uint32_t word = 0;
  for (int i = 0; i < 4; ++i) {
    std::uint8_t byte = 0;
    rest_until([&] { return in_.read(Bytes(&byte, 1)) == 1; });  // the rig ends the board when it has no more to say
    word = word << 8 | byte;
  }
  return word;
}

RigAnswer Rig::report(const std::uint32_t (&words)[kRigWords]) {
  std::uint8_t bytes[4 * kRigWords];
  for (std::uint32_t i = 0; i < sizeof bytes; ++i) bytes[i] = static_cast<std::uint8_t>(words[i / 4] >> (24 - 8 * (i % 4)));
  invariant(out_.write(ConstBytes(bytes)) == sizeof bytes, "rig's line full");
  port_.send();
  RigAnswer answer;
  answer.camera_bytes = take_word();
  answer.ground_bytes = take_word();
  return answer;
}

}  // namespace lasso::bare
