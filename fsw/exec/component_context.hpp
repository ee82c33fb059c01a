// What several parts of the component work with: time, images, telemetry, health, interlocks and scans. Component makes it of its own
// members; it owns none of them, and a test can make it of as many as it needs (ut/exec/mode_manager_alone_test.cpp).
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
