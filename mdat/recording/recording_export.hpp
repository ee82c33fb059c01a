// Recordings in the files of other programs. Poses are T_sensor_target (the target's frame in the sensor's) as in the recording.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "mdat/recording/recording_edit.hpp"
#include "mdat/recording/topic_reader.hpp"

namespace lasso::mdat {

struct ExportOptions {
  std::string topic;  // empty: as each format says
  RecordingSpan span;
  std::string epoch = "2000-01-01T00:00:00";  // of the recording's second 0, in ephemerides
};

// Files of an export, by their names, with their contents; and what was left out, a line each.
struct ExportedFiles {
  std::map<std::string, std::string> files;
  std::vector<std::string> notes;
};

// A table for each topic (of `topic` alone if that is given): a row a message, a column a number or text. Topics whose messages have lists
// of any length, as scans, are left out, and noted.
ExportedFiles export_csv(const std::filesystem::path& file, const ExportOptions& options);

// "NAME.tum" for each topic of poses: "t x y z qx qy qz qw", seconds, metres.
ExportedFiles export_tum(const std::filesystem::path& file, const ExportOptions& options);

// Scans of a run for mdat replay --scans: scans/fNNNNN.csv, and in its form of poses truth.csv (of each scan) and poses.csv (true ones of
// the frame before, to start from).
ExportedFiles export_scans(const std::filesystem::path& file, const ExportOptions& options);

// The points of each PointCloud2 (preset /scan), one file a message, all numeric fields: binary PLY or PCD.
ExportedFiles export_ply(const std::filesystem::path& file, const ExportOptions& options);
ExportedFiles export_pcd(const std::filesystem::path& file, const ExportOptions& options);

// Ephemerides of the target in the sensor's axes (preset /odom): CCSDS OEM 2.0 (positions; velocities of the topic, or else by differences,
// which its comment says) and AEM 1.0 (attitude).
std::string export_oem(const std::filesystem::path& file, const ExportOptions& options);
std::string export_aem(const std::filesystem::path& file, const ExportOptions& options);

// The first frame of the span as glTF 2.0 in one file: surfaces at truth and estimate, returns coloured by residual, missed rays; its y
// axis up, as glTF has it, is against the sensor's y.
std::string export_glb(const std::filesystem::path& file, const ExportOptions& options);

// HDF5: a group a topic, a dataset a column, "t_s" the times. Of clouds of points all are one behind the other, and "first" says where each
// message begins. Topics of other lists are left out.
std::string export_h5(const std::filesystem::path& file, const ExportOptions& options);

// A bag of rosbag2: folder/NAME_0.mcap, which is the recording or its span, and folder/metadata.yaml (version 5), NAME that of the folder.
// Throws InputError: no message, or a file that cannot be written.
void export_bag(const std::filesystem::path& file, const ExportOptions& options, const std::filesystem::path& folder);

// CCSDS packets one behind the other, as the component sent them.
std::string export_packets(const std::filesystem::path& file, const ExportOptions& options);

}  // namespace lasso::mdat
