#include "bsp/bare/loaded.hpp"

#include "bsp/bare/board.hpp"
#include "fsw/core/byte_codec.hpp"
#include "fsw/mission/image_format.hpp"

extern "C" {
extern const volatile lasso::bare::Straps board_straps;
extern const std::uint8_t board_mission[];
}

namespace lasso::bare {
namespace {

std::uint32_t place_of(const volatile void* memory) { return static_cast<std::uint32_t>(reinterpret_cast<std::uintptr_t>(memory)); }
std::uint32_t header_word(std::size_t number) { return ByteReader(ConstBytes(board_mission + 4 * number, 4)).u32(); }

}  // namespace

LoadedMemory::LoadedMemory() { map_loaded(); }

LoadedMemory::~LoadedMemory() { map_devices(); }

Straps LoadedMemory::straps() { return {board_straps.magic, board_straps.ticks_per_s, board_straps.rig}; }

std::uint32_t LoadedMemory::straps_at() { return place_of(&board_straps); }

std::uint32_t LoadedMemory::image_at() { return place_of(board_mission); }

std::uint32_t LoadedMemory::image_magic() { return header_word(0); }

std::uint32_t LoadedMemory::image_bytes() { return header_word(2); }

ConstBytes LoadedMemory::image() {
  const bool there = image_magic() == kImageMagic && image_bytes() <= kMissionBytes;
  return {board_mission, there ? image_bytes() : 0};
}

}  // namespace lasso::bare
