// The devices of this board, and how their registers are reached.
#pragma once

#include <cstdint>

namespace lasso::cortexa9 {

// Of the card.
constexpr std::uint32_t kSystemId = 0x10000000, kFirstPort = 0x10009000, kPortStep = 0x1000;
// Of the processor: interface and distributor of its interrupt controller, its global timer.
constexpr std::uint32_t kInterface = 0x1E000100, kDistributor = 0x1E001000, kTimer = 0x1E000200;
constexpr std::uint32_t kTimerInterrupt = 27, kFirstPortInterrupt = 37;
constexpr std::uint32_t kInterfaceControl = kInterface + 0;  // ICCICR
constexpr std::uint32_t kWithdraw = kDistributor + 0x280;    // ICDICPR: what has come and was not served

// Words; the memory is a device's, which keeps their order.
inline void write_device(std::uint32_t address, std::uint32_t value) {
  // NOLINTNEXTLINE(performance-no-int-to-ptr,clang-analyzer-core.FixedAddressDereference): registers lie at fixed addresses
  *reinterpret_cast<volatile std::uint32_t*>(address) = value;
}
inline std::uint32_t read_device(std::uint32_t address) {
  // NOLINTNEXTLINE(performance-no-int-to-ptr,clang-analyzer-core.FixedAddressDereference): as above
  return *reinterpret_cast<volatile std::uint32_t*>(address);
}

// The time base goes from now on, or as before; the wake-up call is not asked for.
void start_timer();
// Of the wake-up call, which has come.
void clear_timer_interrupt();

}  // namespace lasso::cortexa9
