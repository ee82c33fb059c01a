// Mission images in flight: commands that load, check and activate them, the trial of one that has become active, and what is reported of
// them and of memory that must not change. The buffers are kept by ImageKeeper (fsw/mission/image_keeper.hpp). Used by the acquisition
// thread.
#pragma once

#include <cstdint>

#include "fsw/exec/acquisition_task.hpp"
#include "fsw/exec/component_context.hpp"
#include "fsw/exec/image_trial.hpp"
#include "fsw/exec/mode_manager.hpp"
#include "fsw/exec/parameter_service.hpp"
#include "fsw/link/commands.hpp"
#include "fsw/link/memory_report.hpp"
#include "fsw/mission/image_keeper.hpp"

namespace lasso {

// What the packet image counts; it is sent when one of them changes.
struct MemoryCounts {
  std::uint8_t other_state = 0;
  std::uint32_t activations = 0, roll_backs = 0, confirmed = 1;
  std::uint32_t findings = 0, repairs = 0;
};

class ImageService {
 public:
  // What is given outlives it.
  ImageService(ImageKeeper& images, AcquisitionTask& acquisition, const ComponentContext& context, ModeManager& modes,
               ParameterService& parameters)
      : images_(images), acquisition_(acquisition), context_(context), modes_(modes), parameters_(parameters) {}

  // See the functions of the same name of Component.
  ImageRefusal activate(std::uint32_t crc);
  ImageRefusal roll_back();
  // The commands of service 6, and those of images.
  ServiceRefusal serve(const Command& command, TimeUs now_us);

  // A slot's share of the work on the other image, of the scrub, and of the stored log.
  void run_slot();

  // What a scan's estimate says of an image on trial: before the track follows it.
  void note(const Registration& registration) { trial_.note(registration, modes_.mode()); }
  // A scan was lost as that of another calibration than the image's.
  void note_foreign() { trial_.note_foreign(); }
  // A boundary, while no estimate reads the active image: repairs, judges a trial, and changes the image where that was requested.
  void pass_boundary();
  // Sends the structure `image` when it is due.
  void send(TimeUs now_us);

 private:
  enum class Request : std::uint8_t { kNone, kActivate, kRollBack };
  const Mission& mission() const { return images_.view(0).mission; }
  void repair();
  void judge();
  bool may_change(Request request) const;
  void change(bool back);
  void begin_trial(bool back, const MissionParameters& before);
  ServiceRefusal load(const LoadCommand& load);
  ServiceRefusal dump(const MemoryCommand& range, TimeUs now_us);
  ServiceRefusal check(const MemoryCommand& range, TimeUs now_us);
  ConstBytes memory_of(std::uint8_t area) const;
  ServiceRefusal find(const MemoryCommand& range, std::size_t most, ConstBytes& bytes) const;

  ImageKeeper& images_;
  AcquisitionTask& acquisition_;
  const ComponentContext& context_;
  ModeManager& modes_;
  ParameterService& parameters_;
  Request request_ = Request::kNone;
  std::uint32_t requested_crc_ = 0;  // kActivate: of the image that was named
  ImageTrial trial_;
  MemoryCounts counts_;               // of now,
  MemoryCounts reported_;             // and as they were reported last
  std::uint32_t choices_before_ = 0;  // of calibrations, with the image before
};

}  // namespace lasso
