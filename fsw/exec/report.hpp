// What a step of the track looks like in telemetry.
#pragma once

#include "fsw/core/time.hpp"
#include "fsw/link/filter_report.hpp"
#include "fsw/link/pose_telemetry.hpp"
#include "fsw/mission/mission.hpp"
#include "fsw/mode/tracker.hpp"
#include "fsw/sense/scan_plan.hpp"

namespace lasso {

// major << 24 | minor << 16 | patch, and the same as text.
std::uint32_t software_version();
std::uint32_t software_build();  // identifier given by the build, 0: development
const char* version();

// Everything except the counters, the changes of the mode and the refusals.
PoseTelemetry make_report(const Mission& mission, const TrackStep& step, const ScanPlan& plan, TimeUs t_publication_us);

// Of the track's filter after the scan; `common` as Registration's.
FilterTelemetry make_filter_report(std::uint32_t scan_id, const FilterState& filter, const CommonErrors& common);

}  // namespace lasso
