// Scans in files: recordings that this project makes, and third-party data for replay. Sensor frame, metres, seconds.
//
//   .csv  header `t_s,x_m,y_m,z_m,valid`, one ray a row in time order. valid 1: the point hit; valid 0: a ray that missed, x,y,z its unit
//         direction. t_s is rounded to microseconds.
//   .ply  ascii, binary_little_endian or binary_big_endian; the first element is `vertex` with float or double x, y, z.
//   .pcd  ascii or binary, with the identity as viewpoint.
// PLY and PCD have neither times nor misses: all samples at time 0, misses_known false.
#pragma once

#include <filesystem>
#include <stdexcept>
#include <string>
#include <vector>

#include "fsw/sense/range_image.hpp"

namespace lasso::sim {

// One line: file, line (or point), what stands there, and what to do about it; of a CSV file also which further lines are bad.
class ScanFileError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

// Reads one file by its extension (any case), scan_id 0. A file is read whole or not at all. Throws ScanFileError: cannot be read, unknown
// extension, wrong header, ragged rows, not a number, NaN or infinity, valid neither 0 nor 1, a miss whose direction is not of unit length
// within 1e-3, a point at the sensor's origin or beyond 1000 km, time going back, no row, more than kMaxRays rows, truncated data.
RangeImage read_scan_file(const std::filesystem::path& file);

// The scans of a folder: its .csv, .ply and .pcd files in name order; other files are ignored.
class RecordedScans {
 public:
  // Throws ScanFileError: not a folder, no scan in it, two scans with one stem.
  explicit RecordedScans(const std::filesystem::path& folder);

  std::size_t size() const { return files_.size(); }
  const std::filesystem::path& file(std::size_t i) const { return files_.at(i); }
  std::string stem(std::size_t i) const { return files_.at(i).stem().string(); }
  RangeImage read(std::size_t i) const;  // scan_id = i; throws as read_scan_file
  void check() const;                    // reads each file once; throws as read_scan_file

 private:
  std::vector<std::filesystem::path> files_;
};

// Writes the CSV form. Invalid samples are left out: like them, a ray that is not listed says nothing. The file appears whole or not at
// all. Throws ScanFileError: nothing to write, or the file cannot be written.
void write_scan_csv(const std::filesystem::path& file, const RangeImage& image);

}  // namespace lasso::sim
