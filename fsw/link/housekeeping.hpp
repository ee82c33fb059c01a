// When structures of telemetry (service 3) are sent: each can be disabled, has a period, and can be asked for once. Used by one thread.
#pragma once

#include <cstddef>
#include <cstdint>

namespace lasso {

constexpr std::uint16_t kPoseStructureId = 1;
constexpr std::uint16_t kLinkStructureId = 2;
constexpr std::uint16_t kSensorStructureId = 3;
constexpr std::uint16_t kHealthStructureId = 4;
constexpr std::uint16_t kImageStructureId = 5;
constexpr std::uint16_t kFilterStructureId = 6;     // the only one that is disabled at first
constexpr std::uint16_t kNamedPoseStructureId = 7;  // of missions that name frames

// Frames from one report to the next, by structure; 0: when there is news.
inline constexpr std::uint16_t kPresetPeriods[] = {0, 1, 0, 0, 0, 0, 1, 0};
constexpr std::size_t kStructures = sizeof(kPresetPeriods) / sizeof(kPresetPeriods[0]);  // with number 0, which none has

class Housekeeping {
 public:
  Housekeeping();

  // False: there is no such structure.
  bool set_enabled(std::uint16_t structure, bool enabled);
  bool set_period(std::uint16_t structure, std::uint16_t frames);
  bool ask(std::uint16_t structure);

  // Shall the structure be sent in this frame, where `news` says that there is something new to report? Who asks sends it.
  bool due(std::uint16_t structure, bool news);
  // It was asked for, and has not been due since.
  bool asked(std::uint16_t structure) const;
  // A frame ends. Loop bound: kStructures.
  void pass_boundary();

 private:
  struct State {
    bool enabled = true;
    bool asked = false;
    std::uint16_t period = 0;  // frames
    std::uint16_t age = 0;     // frames since the last report; counts up to the longest period
  };
  State states_[kStructures];
};

}  // namespace lasso
