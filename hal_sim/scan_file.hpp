// Scans in files: recordings that this project makes, and third-party data for replay.
//
//   .csv  header `t_s,x_m,y_m,z_m,valid`, one ray a row in time order. valid 1: the point hit; valid 0: a ray that missed, x,y,z its unit
//         direction. Written with t_s rounded to microseconds. Read also without t_s, without valid, and with other columns
//         (csv_table.hpp, scan_columns.hpp).
//   .ply  ascii or binary; the element `vertex` has x, y, z.
//   .pcd  ascii, binary or binary_compressed, seen from its VIEWPOINT.
//   .asc, .xyz, .pts  plain text, x, y and z the first columns or those that a header names.
//   .png  16-bit greyscale: a depth image (depth_image.hpp), where a camera is given; with misses, without times.
//
// Clouds have neither times nor misses: all samples at time 0, misses_known false. Rows without a measurement (coordinates that are
// not finite, or all zero) are no rays. Of more than kMaxRays rays some are taken (raw_scan.hpp).
#pragma once

#include <filesystem>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "fsw/sense/range_image.hpp"
#include "hal_sim/depth_image.hpp"
#include "hal_sim/raw_scan.hpp"

namespace lasso::sim {

// One line: file, line (or point), what stands there, and what to do about it; of a CSV file also which further lines are bad.
class ScanFileError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

// The extensions of scans' files, for texts: ".csv, .ply, ...". The last is of images, which need a camera.
std::string scan_extensions();

// The stem of a scan's file (extension in any case); other names as they are.
std::string scan_stem(const std::string& name);

// Reads one file by its extension (any case). A file is read whole or not at all. Throws ScanFileError: cannot be read, unknown extension,
// wrong header, ragged rows, not a number, valid neither 0 nor 1, a miss whose direction is not of unit length within 1e-3, time going
// back, a column beside which misses may be returns, no row, truncated data.
RawScan read_raw_scan(const std::filesystem::path& file, const DepthCamera& camera = {});

// The same as an image, scan_id 0. Throws as read_raw_scan and to_image.
RangeImage read_scan_file(const std::filesystem::path& file, const ScanFrame& frame = {});

// What a file holds besides its rays.
struct ScanFacts {
  std::size_t hits = 0, misses = 0;  // in the file
  std::size_t unmeasured = 0;        // rows without a measurement
  std::size_t kept_hits = 0, kept_misses = 0;
  bool has_times = false;
  double first_time = 0, last_time = 0;  // in the file's unit
  double unit_s = 0;                     // where its header names another than seconds
  bool seconds_named = false;            // the header names seconds
  bool viewpoint = false;                // the file says where the sensor stood
  double median_range_m = 0;             // of the returns; 0 where there is none
  std::size_t directions = 0;            // returns of length 1, where these are many (has_directions)
  std::vector<ScanWarning> warnings;     // of its reader
};

// Scans of any origin, in order.
class ScanSource {
 public:
  virtual ~ScanSource() = default;
  virtual std::size_t size() const = 0;
  virtual std::filesystem::path place(std::size_t i) const = 0;  // for texts; its stem is the scan's name
  virtual RawScan read(std::size_t i) const = 0;
};

// The scans of a folder in natural order (scan2 before scan10); other files are ignored, images too where no camera is given.
class RecordedScans {
 public:
  // Throws ScanFileError: not a folder, no scan in it, two scans with one stem.
  explicit RecordedScans(const std::filesystem::path& folder, const ScanFrame& frame = {}, const DepthCamera& camera = {});
  // What reading throws is the source's.
  RecordedScans(std::shared_ptr<const ScanSource> source, const ScanFrame& frame) : source_(std::move(source)), frame_(frame) {}

  std::size_t size() const { return source_->size(); }
  std::filesystem::path file(std::size_t i) const { return source_->place(i); }
  std::string stem(std::size_t i) const { return file(i).stem().string(); }
  RangeImage read(std::size_t i) const;   // scan_id = i; throws as read_scan_file
  std::vector<ScanFacts> survey() const;  // reads each file once; throws as read_scan_file, but for its times

  // Of times whose unit no header names. Throws ScanFileError where a time of these facts is then beyond 1e11 s.
  void set_time_unit(double unit_s, const std::vector<ScanFacts>& facts);

 private:
  std::shared_ptr<const ScanSource> source_;
  ScanFrame frame_;
};

// The CSV form. Invalid samples are left out: like them, a ray that is not listed says nothing.
std::string scan_csv(const RangeImage& image);
// Writes it. The file appears whole or not at all. Throws ScanFileError: nothing to write, or the file cannot be written.
void write_scan_csv(const std::filesystem::path& file, const RangeImage& image);

}  // namespace lasso::sim
