// Scans in other people's recordings: sensor_msgs/PointCloud2 in MCAP files, and in bags of ROS 2 that are SQLite databases (.db3).
//
// Of a point's fields are used: x, y, z; its time, by a field t, time, timestamp, time_offset, offset_time or time_stamp (integers are
// nanoseconds, offset_us microseconds; reals seconds, or by their size micro- or nanoseconds; small ones count from the header's stamp);
// state and ux, uy, uz, which recordings of mdat have, for rays that missed. Intensities and rings say nothing that registration needs.
// Without a time each point has the header's stamp. A bag may hold more than fits into memory: one scan is read at a time.
#pragma once

#include <filesystem>
#include <memory>
#include <string>

#include "hal_sim/scan_file.hpp"
#include "mdat/recording/foreign_cloud.hpp"

namespace lasso::mdat {

// Is it an MCAP file, a .db3 database, or the folder of a bag (with its metadata.yaml)?
bool is_bag(const std::filesystem::path& path);

// The scans of `topic`, or if that is empty of the only topic of clouds. Throws InputError, and so does reading: a file that is none, that
// is compressed as a whole, or of another version; no such topic (it lists those that are there); a message that is not as its schema says.
std::shared_ptr<const sim::ScanSource> open_bag(const std::filesystem::path& path, const std::string& topic);

// A cloud as a scan, rays in order of their times; `place` is for errors.
sim::RawScan scan_of(const ForeignCloud& cloud, const std::string& place);

}  // namespace lasso::mdat
