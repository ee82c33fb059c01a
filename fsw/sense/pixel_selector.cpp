#include "fsw/sense/pixel_selector.hpp"

#include "fsw/geometry/portable_math.hpp"
#include "fsw/sense/acquisition.hpp"
#include "fsw/sense/pattern.hpp"

namespace lasso {
namespace {

constexpr std::size_t kMaxPieces = kMaxPixelsPerPoll / kMaxSamplesPerPoll;
constexpr std::uint32_t kPartBits = 15;
static_assert(kCellParts == 1u << kPartBits, "a part of a cell is the low bits of a place");

// A key is the squared distance to the aim point, at most 2 (2^15 - 1)^2 < 2^31, or that and 2^31 for a pixel without a measurement.
constexpr std::uint32_t kUnmeasured = 1u << 31;
constexpr std::uint32_t kEmpty = 0xFFFFFFFF;  // above all keys

// 2^32 over the plastic number and over its square, and of sequences that turn them from scan to scan.
constexpr std::uint32_t kCellStepX = 0xC13FA9A9, kCellStepY = 0x91E10DA6;
constexpr std::uint32_t kScanStepX = 0x9E3779B9, kScanStepY = 0x6A09E667;

// At least 1, at most kMaxRays; rounded down.
std::uint32_t whole(double count) {
  if (count < 1) return 1;
  if (!(count < static_cast<double>(kMaxRays))) return kMaxRays;
  return static_cast<std::uint32_t>(static_cast<std::int32_t>(count));
}

double smaller(double a, double b) { return a < b ? a : b; }

std::uint32_t squared_offset(std::uint32_t place, std::uint32_t aim) {
  const auto offset = static_cast<std::int32_t>(place % kCellParts) - static_cast<std::int32_t>(aim);
  return static_cast<std::uint32_t>(offset * offset);
}

// An order of pixels by their content alone, for those that are as near to the aim point.
bool precedes(const RangeSample& a, const RangeSample& b) {
  const float p[] = {a.direction[0], a.direction[1], a.direction[2], a.range_m, a.sigma_factor, static_cast<float>(a.state)};
  const float q[] = {b.direction[0], b.direction[1], b.direction[2], b.range_m, b.sigma_factor, static_cast<float>(b.state)};
  for (std::size_t i = 0; i < sizeof p / sizeof p[0]; ++i) {
    if (p[i] < q[i] || p[i] > q[i]) return p[i] < q[i];
  }
  return false;
}

// Says no more than its state does.
RangeSample plain(const RangeSample& given) {
  RangeSample pixel = given;
  if (pixel.state == RayState::kHit) return pixel;
  pixel.range_m = 0;
  pixel.sigma_factor = 1;
  return pixel;
}

}  // namespace

CellGrid cell_grid(const ScanPlan& plan, const PixelPitch& pitch) {
  const double points = plan.points;
  const double most_columns = whole(2 * plan.half_x / pitch.x), most_rows = whole(2 * plan.half_y / pitch.y);
  CellGrid grid;
  grid.columns = whole(smaller(square_root(points * plan.half_x / plan.half_y), most_columns));
  grid.rows = whole(smaller(points / grid.columns, most_rows));
  grid.columns = whole(smaller(points / grid.rows, most_columns));
  return grid;
}

CellPoint aim_point(std::uint32_t cell, std::uint32_t scan_id) {
  constexpr std::uint32_t kShift = 32 - kPartBits;
  return {(cell * kCellStepX + scan_id * kScanStepX) >> kShift, (cell * kCellStepY + scan_id * kScanStepY) >> kShift};
}

std::uint16_t PixelSelector::samples_of(const ScanPlan& plan) const {
  return static_cast<std::uint16_t>(cell_grid(plan, sensor_.pitch()).cells());
}

Status PixelSelector::start(const ScanPlan& plan, TimeUs t_start_us) {
  if (state_ != State::kIdle) return Status::kBusy;
  if (validate(plan) != Status::kOk || !plan.aimed.empty()) return Status::kBadValue;
  const Status status = sensor_.start(plan, t_start_us);
  if (status != Status::kOk) return status;
  grid_ = cell_grid(plan, sensor_.pitch());
  left_ = plan.center_x - plan.half_x;
  top_ = plan.center_y - plan.half_y;
  parts_per_x_ = grid_.columns * static_cast<double>(kCellParts) / (2 * plan.half_x);
  parts_per_y_ = grid_.rows * static_cast<double>(kCellParts) / (2 * plan.half_y);
  end_x_ = grid_.columns * static_cast<double>(kCellParts);
  end_y_ = grid_.rows * static_cast<double>(kCellParts);
  scan_id_ = plan.scan_id;
  begun_ = false;
  next_ = 0;
  Cell empty;
  empty.sample.state = RayState::kLost;
  empty.key = kEmpty;
  const Span<Cell> cells(cells_);
  for (std::uint32_t i = 0; i < grid_.cells(); ++i) cells[i] = empty;
  state_ = State::kTaking;
  return status;
}

SensorPoll PixelSelector::poll(TimeUs now_us, Span<RangeSample> out) {
  SensorPoll result;
  if (state_ == State::kIdle) {
    result.status = Status::kNoData;
    return result;
  }
  bool more = state_ == State::kTaking;
  for (std::size_t i = 0; i < kMaxPieces && more; ++i) {
    result.status = take_piece(now_us, more);
    if (result.status == Status::kOk) continue;
    abort();
    return result;
  }
  return state_ == State::kGiving ? give(out) : result;
}

// `more`: there may be pixels that have come already.
Status PixelSelector::take_piece(TimeUs now_us, bool& more) {
  const PixelPoll piece = sensor_.poll(now_us, Span<RangeSample>(piece_));
  if (piece.status != Status::kOk) return piece.status;
  if (piece.count > kMaxSamplesPerPoll) return Status::kBadLength;
  if (piece.count > 0 && begun_ && piece.t_us != t_us_) return Status::kBadOrder;
  if (piece.count > 0) {
    begun_ = true;
    t_us_ = piece.t_us;
  }
  for (std::size_t i = 0; i < piece.count; ++i) take(Span<RangeSample>(piece_)[i]);
  if (piece.complete) state_ = State::kGiving;
  more = piece.count > 0 && !piece.complete;
  return Status::kOk;
}

// Most pixels are not the nearest so far: what they say is not looked at.
void PixelSelector::take(const RangeSample& given) {
  Place place;
  if (!locate(given, place)) return;
  Cell& cell = Span<Cell>(cells_)[place.cell];
  if (place.key > cell.key) return;
  const RangeSample pixel = plain(given);
  BadSample reason{};
  if (!is_known(pixel.state) || !is_sound(pixel, reason)) {
    ++bad_pixels_;
    return;
  }
  if (place.key == cell.key && !precedes(pixel, cell.sample)) return;
  cell = {pixel, place.key};
}

// False outside of the window, and of what is no number.
bool PixelSelector::locate(const RangeSample& pixel, Place& place) const {
  const double z = static_cast<double>(pixel.direction[2]);
  if (!(z > 0)) return false;
  const double per_z = 1 / z;
  const double x = (static_cast<double>(pixel.direction[0]) * per_z - left_) * parts_per_x_;
  const double y = (static_cast<double>(pixel.direction[1]) * per_z - top_) * parts_per_y_;
  if (!(x >= 0 && x < end_x_)) return false;
  if (!(y >= 0 && y < end_y_)) return false;
  const auto parts_x = static_cast<std::uint32_t>(static_cast<std::int32_t>(x));
  const auto parts_y = static_cast<std::uint32_t>(static_cast<std::int32_t>(y));
  place.cell = (parts_y / kCellParts) * grid_.columns + parts_x / kCellParts;
  const CellPoint aim = aim_point(place.cell, scan_id_);
  place.key = squared_offset(parts_x, aim.x) + squared_offset(parts_y, aim.y);
  if (pixel.state == RayState::kInvalid) place.key += kUnmeasured;
  return true;
}
static_assert(kMaxRays * kCellParts <= 1u << 31, "a place in a row of cells fits 32 bits");

SensorPoll PixelSelector::give(Span<RangeSample> out) {
  SensorPoll result;
  while (result.count < out.size() && next_ < grid_.cells()) {
    RangeSample& sample = out[result.count++];
    sample = Span<Cell>(cells_)[next_++].sample;
    sample.t_us = t_us_;
  }
  result.complete = next_ == grid_.cells();
  if (result.complete) state_ = State::kIdle;
  return result;
}

void PixelSelector::abort() {
  sensor_.abort();
  state_ = State::kIdle;
}

SensorCounters PixelSelector::counters() const {
  SensorCounters counters = sensor_.counters();
  counters.samples_refused += bad_pixels_;
  return counters;
}

}  // namespace lasso
