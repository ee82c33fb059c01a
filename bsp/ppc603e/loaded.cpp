#include "bsp/ppc603e/loaded.hpp"

#include "fsw/core/byte_codec.hpp"
#include "fsw/mission/image_format.hpp"

extern "C" {
extern const volatile lasso::ppc603e::Straps board_straps;
extern const std::uint8_t board_mission[];
}

namespace lasso::ppc603e {
namespace {

// As start.S has them: 0xFC000000, 64 MB, read and write, not cached, guarded.
constexpr std::uint32_t kDevices = 0xFC0007FE, kDevicesHow = 0xFC00002A;
// 0x04000000, 32 MB, read only: link.ld's LOADED.
constexpr std::uint32_t kLoaded = 0x040003FE, kLoadedHow = 0x04000001;

std::uint32_t header_word(std::size_t number) { return ByteReader(ConstBytes(board_mission + 4 * number, 4)).u32(); }

}  // namespace

void map_devices() { set_last_data_block(kDevices, kDevicesHow); }

LoadedMemory::LoadedMemory() { set_last_data_block(kLoaded, kLoadedHow); }

Straps LoadedMemory::straps() { return {board_straps.magic, board_straps.ticks_per_s, board_straps.rig}; }

std::uint32_t LoadedMemory::image_magic() { return header_word(0); }

std::uint32_t LoadedMemory::image_bytes() { return header_word(2); }

ConstBytes LoadedMemory::image() {
  const bool there = image_magic() == kImageMagic && image_bytes() <= kMissionBytes;
  return {board_mission, there ? image_bytes() : 0};
}

}  // namespace lasso::ppc603e
