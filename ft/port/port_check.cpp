// port_check [--untimed] [DIGEST]: does a port give what the component needs? A line for each verdict (docs/porting.md). DIGEST is what the
// host's program says. Exit codes: 0 nothing failed, 1 something did, 2 usage.
#include <algorithm>
#include <atomic>
#include <cstdarg>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <memory>

#include "fsw/exec/self_test.hpp"
#include "ft/port/board.hpp"
#include "ft/port/flight.hpp"

namespace lasso::port {
namespace {

constexpr int kFrames = 25;
constexpr int kPosesAtLeast = 20;  // of them: the same telemetry of a lost track would say little
constexpr int kReadings = 100000, kWakeUps = 100;
constexpr DurationUs kPeriodUs = 200000, kSlotUs = kPeriodUs / 20;
constexpr DurationUs kCoarsestUs = kSlotUs / 10;
constexpr std::size_t kMostBytes = 2U << 20;  // as docs/embedding says

int failures = 0;

// A line: what was tried, and what came out.
[[gnu::format(printf, 3, 4)]] void say(bool right, const char* what, const char* format, ...) {
  std::printf("%-7s %-10s ", right ? "ok" : "FAILED", what);
  std::va_list arguments;
  va_start(arguments, format);
  std::vprintf(format, arguments);
  va_end(arguments);
  std::printf("\n");
  std::fflush(stdout);
  failures += right ? 0 : 1;
}

void check_arithmetic() {
  const std::uint32_t failed = failed_self_tests();
  if (failed == 0) return say(true, "arithmetic", "rounds to nearest, keeps subnormals; sines, checksums and codec have their known bits");
  say(false, "arithmetic", "self-tests 0x%02lX failed: look up their bits in fsw/exec/self_test.hpp, then the compiler's flags",
      0UL + failed);
}

void check_memory() {
  say(required_memory() <= kMostBytes, "memory", "a component takes %zu bytes, aligned to %zu (at most %zu)", required_memory(),
      required_alignment(), kMostBytes);
  const bool lock_free = std::atomic<std::uint32_t>::is_always_lock_free;
  say(lock_free, "atomic", "a word of 32 bits is handed over %s",
      lock_free ? "without a lock" : "by a lock: the tasks may wait for each other");
}

void check_bits(const Flight& flight, const char* digest) {
  say(flight.valid_poses() >= kPosesAtLeast, "poses", "%d of %d frames have a valid one (at least %d)", flight.valid_poses(), kFrames,
      kPosesAtLeast);
  const auto told = 0UL + flight.digest();
  if (digest == nullptr) return say(true, "bits", "telemetry has the digest %08lX: run `port_check %08lX` on the board", told, told);
  char mine[9];
  std::snprintf(mine, sizeof mine, "%08lX", told);
  const bool same = std::strcmp(mine, digest) == 0;
  say(same, "bits", "telemetry has the digest %s, %s", mine,
      same ? "as asked for" : "another than asked for: same version? -ffp-contract=off? (docs/golden.md)");
}

void check_clock() {
  TimeUs last_us = now_us();
  DurationUs smallest_us = kPeriodUs, back_us = 0;
  for (int i = 0; i < kReadings; ++i) {
    const DurationUs step_us = now_us() - last_us;
    last_us += step_us;
    back_us = std::min(back_us, step_us);
    if (step_us > 0) smallest_us = std::min(smallest_us, step_us);
  }
  say(back_us == 0, "clock", "of %d readings none is before another (%lld us)", kReadings, 0LL + back_us);
  say(smallest_us <= kCoarsestUs, "resolution", "the smallest step is %lld us (at most %lld)", 0LL + smallest_us, 0LL + kCoarsestUs);
}

void check_wake_up() {
  DurationUs worst_us = 0, early_us = 0;
  TimeUs next_us = now_us();
  for (int i = 0; i < kWakeUps; ++i) {
    next_us += kSlotUs;
    sleep_until(next_us);
    const DurationUs late_us = now_us() - next_us;
    worst_us = std::max(worst_us, late_us);
    early_us = std::min(early_us, late_us);
  }
  say(early_us == 0, "early", "no wake-up call of %d comes before its time (%lld us)", kWakeUps, 0LL + early_us);
  say(worst_us < kSlotUs, "late", "the latest comes %lld us after it (less than a slot, %lld)", 0LL + worst_us, 0LL + kSlotUs);
}

void check_times(const Longest& longest) {
  say(longest.slot_us < kSlotUs, "slots", "the longest takes %lld us (less than %lld)", 0LL + longest.slot_us, 0LL + kSlotUs);
  say(longest.estimate_us < kPeriodUs, "estimate", "the longest takes %lld us (less than a frame, %lld)", 0LL + longest.estimate_us,
      0LL + kPeriodUs);
}

#if defined(__has_feature)
#define LASSO_HAS_FEATURE(feature) __has_feature(feature)
#else
#define LASSO_HAS_FEATURE(feature) 0
#endif
#if defined(__GNUC__) && !defined(__SANITIZE_ADDRESS__) && !LASSO_HAS_FEATURE(address_sanitizer)
constexpr std::size_t kPaintedBytes = 2 * kTaskStackBytes;
constexpr std::uint8_t kPaint = 0xA5;

// The stack below the caller's: painted, and how much of the paint is gone, counted from its far end.
[[gnu::noinline]] std::size_t below(bool paint) {
  std::uint8_t area[kPaintedBytes];
  std::uint8_t* bytes = area;
  asm volatile("" : "+r"(bytes) : : "memory");  // the compiler may not know what is there
  std::size_t kept = 0;
  if (paint) std::memset(bytes, kPaint, kPaintedBytes);
  while (kept < kPaintedBytes && bytes[kept] == kPaint) ++kept;
  return kPaintedBytes - kept;
}

[[gnu::noinline]] void fly_on_paint(Flight& flight) {
  static_cast<void>(below(true));
  flight.fly(kFrames);
  const std::size_t used = below(false);
  say(used <= kTaskStackBytes, "stack", "slots and estimates used %zu bytes (at most %zu; where the stack grows down)", used,
      kTaskStackBytes);
}
#else
void fly_on_paint(Flight& flight) {
  flight.fly(kFrames);
  std::printf("        stack      not measured: by this compiler, or under its sanitizer\n");
}
#endif

int check(bool timed, const char* digest) {
  std::printf("3DLASSO %s on %s\n", version(), name());
  check_arithmetic();
  check_memory();
  const auto flight = std::make_unique<Flight>();
  say(flight->began(), "image", "of a box is taken, and the component begins");
  if (flight->began()) {
    fly_on_paint(*flight);
    check_bits(*flight, digest);
  }
  if (timed) {
    check_clock();
    check_wake_up();
    check_times(flight->longest());
  }
  std::printf(failures == 0 ? "nothing failed\n" : "%d failed\n", failures);
  return failures == 0 ? 0 : 1;
}

}  // namespace
}  // namespace lasso::port

int main(int argc, char** argv) {
  const bool untimed = argc > 1 && std::strcmp(argv[1], "--untimed") == 0;
  const int first = untimed ? 2 : 1;
  if (argc > first + 1 || (argc == first + 1 && std::strlen(argv[first]) != 8)) {
    std::fprintf(stderr, "usage: port_check [--untimed] [DIGEST]: eight hexadecimal digits that the host's port_check says\n");
    return 2;
  }
  return lasso::port::check(!untimed, argc > first ? argv[first] : nullptr);
}
