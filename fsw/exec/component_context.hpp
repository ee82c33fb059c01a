// What several parts of the component work with: time, images, telemetry, health, interlocks and scans.
#pragma once

#include "fsw/exec/executive.hpp"
#include "fsw/exec/health_monitor.hpp"
#include "fsw/exec/interlocks.hpp"
#include "fsw/exec/scan_scheduler.hpp"
#include "fsw/exec/telemetry.hpp"
#include "fsw/mission/image_keeper.hpp"

namespace lasso {

struct ComponentContext {
  const Executive& executive;
  const ImageKeeper& images;
  Telemetry& telemetry;
  HealthMonitor& health;
  Interlocks& interlocks;
  ScanScheduler& scans;
};

}  // namespace lasso
