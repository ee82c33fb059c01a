// A sensor that measures all its pixels at once, such as a flash LIDAR or a pair of cameras: more of them than an image of the component
// holds. It hands over a frame in pieces, pixel by pixel in any order; a PixelSelector keeps what the plan asks for. Every call returns at
// once and does bounded work.
#pragma once

#include "fsw/core/span.hpp"
#include "fsw/core/status.hpp"
#include "fsw/core/time.hpp"
#include "fsw/sense/range_image.hpp"
#include "fsw/sense/scan_plan.hpp"
#include "fsw/sense/sensor.hpp"

namespace lasso {

struct PixelPoll {
  Status status = Status::kOk;  // as SensorPoll's
  std::size_t count = 0;        // pixels written, in any order, none twice
  bool complete = false;        // the frame's last pixel has been handed over
  TimeUs t_us = 0;              // of the whole frame: the middle of its exposure. The same in each piece that holds pixels
};

// The largest distance of neighbouring pixels on the tangent plane z = 1, > 0.
struct PixelPitch {
  double x = 0, y = 0;
};

class PixelSensor {
 public:
  virtual PixelPitch pitch() const = 0;
  // Takes a frame at t_start_us or as soon after as the hardware can. It may leave out pixels that lie outside the plan's window. kBusy
  // while a frame is under way, kBadValue when the window is outside the sensor's limits; the sensor is then as it was. Other answers, of
  // poll(), too: as a Sensor's (sensor.hpp).
  virtual Status start(const ScanPlan& plan, TimeUs t_start_us) = 0;
  // Hands over at most out.size() pixels that are there by `now_us`. Each says where it looks (direction) even where it measured nothing:
  // kHit, kMiss (nothing returned), kInvalid (no measurement). Its t_us means nothing.
  virtual PixelPoll poll(TimeUs now_us, Span<RangeSample> out) = 0;
  // Ends a frame and discards its pixels. No effect when idle.
  virtual void abort() = 0;
  virtual SensorCounters counters() const { return {}; }
  virtual void permit_laser(bool permitted) = 0;

 protected:
  ~PixelSensor() = default;  // never deleted through this interface: no operator delete in flight code
};

}  // namespace lasso
