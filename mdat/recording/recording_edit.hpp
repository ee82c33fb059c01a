// New recordings of recordings: a span of one, what is whole of one, two in one. Each writes a file that appears whole or not at all.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "mdat/mcap/reader.hpp"

namespace lasso::mdat {

// Of times of messages, ns: first_ns <= t < end_ns.
struct RecordingSpan {
  std::uint64_t first_ns = 0, end_ns = UINT64_MAX;
  bool holds(std::uint64_t t_ns) const { return t_ns >= first_ns && t_ns < end_ns; }
};

// Seconds of the recording's own times. Throws InputError: a time below 0, or an end that is not behind the begin.
RecordingSpan span_of(std::optional<double> from_s, std::optional<double> to_s);

// What became of a file's messages.
struct EditReport {
  std::uint64_t kept = 0, left_out = 0;
  std::vector<mcap::Damage> damage;  // of what was read
  std::int64_t shift_ns = 0;         // that was added to the second file's times
};

// The messages of a span, with all attachments and metadata. What a viewer needs from before (scenes) has the time of the begin. Throws
// InputError: a file that cannot be read or written, a span in which there is no message (and says what there is).
EditReport cut_recording(const std::filesystem::path& file, const RecordingSpan& span, const std::filesystem::path& out);

// All that is whole of a damaged file, as a file without damage. Its metadata says what was lost. Throws as above.
EditReport recover_recording(const std::filesystem::path& file, const std::filesystem::path& out);

struct MergeOptions {
  std::array<std::string, 2> prefixes;  // of topics ("/a/scan"), frames ("a/sensor"; all have one `world`), attachments, metadata
  bool keep_times = false;              // otherwise the second file's first message gets the time of the first one's
  bool different_targets = false;       // allowed
};

// Two files in one. /tf stays one topic. Throws InputError as above; also messages that are not as their definition says, prefixes that are
// the same or no names, and two targets, unless that is allowed.
EditReport merge_recordings(const std::array<std::filesystem::path, 2>& files, const MergeOptions& options,
                            const std::filesystem::path& out);

}  // namespace lasso::mdat
