#include "bsp/posix/line_pump.hpp"

#include <poll.h>

#include <algorithm>

#include "bsp/posix/urgency.hpp"

namespace lasso::posix {
namespace {

constexpr int kWaitMs = 1;

}  // namespace

LinePump::LinePump(SerialLine& line, lcs::Line& rings) : line_(line), rings_(rings), thread_(&LinePump::work, this) {}

LinePump::~LinePump() {
  ending_ = true;
  thread_.join();
}

// A line whose ring is full is not waited for: it would answer at once, again and again.
void LinePump::wait() {
  pollfd state{line_.descriptor(), rings_.from_camera.room() > 0 ? static_cast<short>(POLLIN) : short{0}, 0};
  (void)poll(&state, 1, kWaitMs);
}

void LinePump::work() {
  const Urgency urgency(UrgencyLevel::kLine);
  while (!ending_ && line_.is_open()) {
    wait();
    receive();
    send();
  }
  send();  // an inhibit that was given last
  broken_ = !line_.is_open();
}

void LinePump::receive() {
  std::uint8_t bytes[1024];
  const std::size_t room = rings_.from_camera.room();  // asked once: it grows while the driver reads
  const std::size_t count = line_.read(Bytes(bytes, std::min(room, sizeof bytes)));
  (void)rings_.from_camera.write(ConstBytes(bytes, count));  // there is room: nobody else writes
}

void LinePump::send() {
  do {
    if (unsent_at_ == unsent_size_) {
      unsent_at_ = 0;
      unsent_size_ = rings_.to_camera.read(Bytes(unsent_));
    }
    const std::size_t taken = line_.write(ConstBytes(unsent_ + unsent_at_, unsent_size_ - unsent_at_));
    if (taken == 0) return;
    unsent_at_ += taken;
  } while (true);
}

}  // namespace lasso::posix
