// What a recording says of itself besides its frames.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "mdat/common/flight_image.hpp"
#include "mdat/mcap/bytes.hpp"
#include "mdat/run/simulation.hpp"

namespace lasso::mdat {

// The record of metadata by which a program knows one of ours.
constexpr char kRecordingMetadata[] = "3dlasso";
// In it, of a part of a recording: its first second, where that is not the run's begin; and until when [ns] its telemetry follows from the
// scans that it holds.
constexpr char kBeginsLate[] = "begins_late_s";
constexpr char kWholeUntil[] = "whole_until_ns";
// Of a run that ended: how many boundaries it passed, which are fewer than its frames need where somebody ended it.
constexpr char kRecordingEnd[] = "3dlasso_end";
constexpr char kBoundaries[] = "boundaries";
// Of a run with an operator's link, in kRecordingMetadata: its form; that its commands had to be signed, with larger numbers than this;
// whether its board had a store. What that held before is attached below kStoreFolder.
constexpr char kLinkForm[] = "link", kDatagrams[] = "datagrams", kByteStream[] = "stream";
constexpr char kSigned[] = "signed", kHasStore[] = "store";  // "yes"
constexpr char kOfApid[] = "apid";                           // of the component, where it is not the preset
constexpr char kStoreFolder[] = "store/";
// In it, of telemetry that came over a link: its address. There are no scans then.
constexpr char kLinkAddress[] = "link_address";
// Of two recordings in one file: prefixes and names of files.
constexpr char kMergedMetadata[] = "merged";
// The mission's files are attached under this name, with their places below the folder that they all share.
constexpr char kMissionFolder[] = "mission/";

constexpr char kImageAttachment[] = "image.3dli";
// What took the place of the mission's calibration, if anything did.
constexpr char kCalibrationAttachment[] = "mission/--calibration";

struct RecordingHead {
  mcap::Text about;                          // mission (its attachment), scenario, seed, frames, sensor, settings, commit
  std::map<std::string, std::string> files;  // name -> content
};

// Of a run of `mission`. Throws InputError where one of its files cannot be read any more.
// `about`: what the caller knows of it besides, such as the commit of the program.
RecordingHead recording_head(const CompiledMission& mission, const SimulationOptions& options, const std::vector<std::string>& settings,
                             mcap::Text about);
// Of telemetry that comes over a link, with the image of the mission in its file; null: not known. Throws as above.
RecordingHead link_recording_head(const CompiledMission* mission, const std::string& address, mcap::Text about);

// The files of a board's store, as they are now, to be attached; zeros at their ends are left out, which it adds again. Empty where there
// is no such folder, or nothing in it. Throws InputError where one cannot be read.
std::map<std::string, std::string> store_files(const std::string& folder);

}  // namespace lasso::mdat
