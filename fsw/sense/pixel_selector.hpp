// Makes a Sensor of a PixelSensor: of a frame of any number of pixels it keeps at most the plan's points, spread evenly over the plan's
// window, in one pass and fixed memory.
//
// The window is cut into cells, about square, at most as many as the plan has points, none smaller than a pixel. Each cell keeps one
// pixel: the one nearest to the cell's aim point, whether it hit or missed, so that a contour is sampled without bias. A pixel without a
// measurement is kept only where its cell has no other. Aim points are jittered from cell to cell and from scan to scan (R2 sequence,
// Roberts 2018), so that the pixel grid leaves no fixed pattern. What is kept depends on the pixels alone, not on their order or pieces.
#pragma once

#include <cstdint>

#include "cfg/capacities.hpp"
#include "fsw/sense/pixel_sensor.hpp"
#include "fsw/sense/sensor.hpp"

namespace lasso {

// Cells of a plan's window; columns * rows <= plan.points.
struct CellGrid {
  std::uint32_t columns = 1, rows = 1;

  std::uint32_t cells() const { return columns * rows; }
};
CellGrid cell_grid(const ScanPlan& plan, const PixelPitch& pitch);  // of a valid plan

// Where in its cell, in 1/kCellParts of the cell's sides, the aim point of a cell lies in a scan.
constexpr std::uint32_t kCellParts = 32768;
struct CellPoint {
  std::uint32_t x = 0, y = 0;  // [0, kCellParts)
};
CellPoint aim_point(std::uint32_t cell, std::uint32_t scan_id);

class PixelSelector final : public Sensor {
 public:
  // The sensor outlives the selector.
  explicit PixelSelector(PixelSensor& sensor) : sensor_(sensor) {}

  // kBadValue: a plan that validate (pattern.hpp) refuses, or one with aimed rays; otherwise as the sensor's. Loop bound: the cells.
  Status start(const ScanPlan& plan, TimeUs t_start_us) override;
  // Takes at most kMaxPixelsPerPoll pixels. Once the frame is complete, hands over its cells, row by row, at the frame's time; a cell
  // that no pixel has come for is kLost. kBadOrder: pieces of two frames; kBadLength: a piece that is longer than asked for; the scan is
  // then lost, and the sensor's frame aborted.
  SensorPoll poll(TimeUs now_us, Span<RangeSample> out) override;
  void abort() override;
  // The sensor's; pixels that would have been kept and cannot be (BadSample) are refused samples.
  SensorCounters counters() const override;
  void permit_laser(bool permitted) override { sensor_.permit_laser(permitted); }
  bool can_aim() const override { return false; }
  std::uint16_t samples_of(const ScanPlan& plan) const override;

 private:
  enum class State : std::uint8_t { kIdle, kTaking, kGiving };
  struct Cell {
    RangeSample sample;
    std::uint32_t key = 0;
  };
  struct Place {
    std::uint32_t cell = 0, key = 0;
  };

  Status take_piece(TimeUs now_us, bool& more);
  void take(const RangeSample& given);
  bool locate(const RangeSample& pixel, Place& place) const;
  SensorPoll give(Span<RangeSample> out);

  PixelSensor& sensor_;
  State state_ = State::kIdle;
  CellGrid grid_;
  double left_ = 0, top_ = 0, parts_per_x_ = 0, parts_per_y_ = 0;  // of the window on the tangent plane
  double end_x_ = 0, end_y_ = 0;                                   // of the grid, in parts
  std::uint32_t scan_id_ = 0;
  bool begun_ = false;  // the frame's time is known
  TimeUs t_us_ = 0;
  std::uint32_t next_ = 0;  // cell to hand over
  std::uint32_t bad_pixels_ = 0;
  Cell cells_[kMaxRays];
  RangeSample piece_[kMaxSamplesPerPoll];
};

}  // namespace lasso
