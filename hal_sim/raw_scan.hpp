// A scan as its file says it: of any size, in its own axes and unit of time. And the range image that is made of it.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "fsw/geometry/se3.hpp"
#include "fsw/sense/range_image.hpp"

namespace lasso::sim {

struct RawRay {
  Vec3 place = Vec3::Zero();  // of a return; of a miss the unit direction. The file's axes
  double time = 0;            // in the file's unit
  std::uint32_t row = 0;      // its line in a text, else its number from 1
  bool hit = true;
};

// What may be misread: where, and what it is.
struct ScanWarning {
  std::string place, text;
};

struct RawScan {
  std::string file;
  bool rows_are_lines = false;
  bool has_times = false;
  bool misses_known = false;
  double unit_s = 0;           // of its times, where its header names another than seconds; 0: not said
  bool seconds_named = false;  // the header names seconds, by which other units are written, too
  std::size_t unmeasured = 0;  // rows without a measurement, of which no direction is known: they are no rays
  double first_time = 0;       // of the first row, with or without a measurement
  Pose T_file_sensor;          // where the sensor stands in the file's axes, as the file says
  std::vector<ScanWarning> warnings;
  std::vector<RawRay> rays;

  std::string place(const RawRay& ray) const;  // of its row, for errors
  // Takes a point in: a return, or a row without a measurement, where a coordinate is not finite or all are zero.
  void add_point(const Vec3& point, double time, std::size_t row);
  void add_miss(const Vec3& unit, double time, std::size_t row);
};

// Whether it is a return whose length is 1 to four decimals, in the file's unit; how many are; and whether they are a tenth of the returns,
// and 16 at least.
bool is_direction(const RawRay& ray);
std::size_t count_directions(const RawScan& scan);
bool has_directions(const RawScan& scan);

// From a file's axes and unit to the sensor frame (x right, y down, z boresight; metres, seconds).
struct ScanFrame {
  Mat3 R_sensor_file = Mat3::Identity();  // of one length: a change of axes, or of handedness
  Vec3 sensor_m = Vec3::Zero();           // where the sensor stands, in the file's axes and metres
  double scale = 1;                       // metres in a unit of the file's lengths
  double unit_s = 1;                      // of times
};

// The axes that a text names: what the file's x, y and z point to, as "forward-right-down"; or which of the file's axes the sensor's x, y
// and z are, as "y,-z,x". Throws ScanFileError.
Mat3 axes_of(std::string_view text);

// At most kMaxRays rays: of more, some that are spread over their directions (thinning.hpp). A scan of no ray has one sample that says
// nothing, at the time of its first row. Throws ScanFileError: a point beyond 1000 km, a time beyond 1e11 s.
RangeImage to_image(const RawScan& scan, const ScanFrame& frame);

}  // namespace lasso::sim
