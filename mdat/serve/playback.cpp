#include "mdat/serve/playback.hpp"

#include <algorithm>

#include "mdat/common/text.hpp"

namespace lasso::mdat::serve {
namespace {

constexpr std::uint64_t kMicrosecond_ns = 1000;

}  // namespace

std::string Playback::take(const PlaybackRequest& request, std::uint64_t now_ns) {
  if (ended_) return "the run is over";
  const auto speed = static_cast<double>(request.speed);
  if (!(speed > 0 && speed <= kMostPace))
    return "playback control: speed " + format("%g", speed) + ", expected above 0 and up to " + format("%g", kMostPace);
  pacing_.set_pace(speed);
  const bool back = request.seek_ns && *request.seek_ns < now_ns;
  if (request.seek_ns && !back) pacing_.hurry_to(static_cast<TimeUs>(std::min(*request.seek_ns, range_.end_ns) / kMicrosecond_ns));
  request.play ? pacing_.resume() : pacing_.pause();
  return back ? "playback control: a run that flies cannot go back; a recording of it can (--record, mdat serve)" : "";
}

PlaybackState Playback::state(std::uint64_t now_ns) const {
  const PlaybackStatus going = pacing_.paused() ? PlaybackStatus::kPaused : PlaybackStatus::kPlaying;
  const double pace = pacing_.pace() > 0 ? pacing_.pace() : kMostPace;
  return {ended_ ? PlaybackStatus::kEnded : going, std::max(now_ns, range_.begin_ns), static_cast<float>(pace)};
}

}  // namespace lasso::mdat::serve
