// Where the flight image has what is protected: symbols of this object, which ft/pil/seu.py reads and no image holds.
#include "fsw/exec/component.hpp"
#include "hal_lcs/driver.hpp"

#define PLACE(name, value) __asm__ volatile(".globl " name "\n.set " name ", %c0" ::"i"(value))

namespace lasso {

void layout();
void layout() {
  PLACE("views_at", offsetof(Component, images_) + offsetof(ImageKeeper, slots_) + offsetof(ImageSlot, views_));
  PLACE("views_bytes", sizeof(MissionView));
  PLACE("mode_at", offsetof(Component, modes_) + offsetof(ModeManager, mode_));
  PLACE("mode_bytes", sizeof(ModeManager::mode_));
  PLACE("parameters_at", offsetof(Component, parameters_) + offsetof(ParameterService, area_));
  PLACE("parameters_bytes", sizeof(ParameterArea));
  PLACE("laser_at", offsetof(lcs::Driver, laser_));
  PLACE("laser_bytes", sizeof(lcs::Driver::laser_));
}

}  // namespace lasso
