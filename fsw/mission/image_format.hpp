// The flight image: layout on the wire and in the store. Everything is big-endian; all tables are arrays of 32-bit words, except the
// parameters (IEEE binary64). No pointers: tables refer to each other by index. One image serves every number type: lengths are integers
// with `length_fraction_bits` (value = word * 2^-bits, metres, |value| < 2^(31-bits)), unit vectors Q1.30, curvature Q15.16 (1/m).
//
//   header      16 words, listed below
//   directory   table_count entries of 5 words: id, words per record, records, byte offset from the image's start, CRC-32C of its bytes
//   tables      in the order of the directory, each starting on a multiple of 8 bytes, gaps are zero
//   trailer     CRC-32C of all bytes before it
//
// The frame is the target's: metres, origin and axes of the mesh after the mission's scale.
#pragma once

#include <cstdint>

namespace lasso {

constexpr std::uint32_t kImageMagic = 0x33444C49;  // "3DLI"
constexpr std::uint32_t kImageVersion = 10;
constexpr std::uint32_t kImageHeaderWords = 16;
constexpr std::uint32_t kDirectoryEntryWords = 5;
constexpr int kUnitFractionBits = 30;
constexpr int kCurvatureFractionBits = 16;

// Header words: 0 magic, 1 version, 2 total bytes (with trailer), 3 table count, 4 mission id, 5 mission version,
// 6 parameter count (must equal this build's), 7..15 zero.

enum class TableId : std::uint32_t {
  kParameters = 1,  // binary64 values in the order of parameter_rows(); 2 words a record
  kFieldGeometry,   // 1 record, see FieldGeometryWord
  kElements,        // kElementWords a record
  kCurvatures,      // kCurvatureWords a record; record 0 is all zero and means flat
  kBricks,          // kBrickWords a record, brick index = (iz * nby + iy) * nbx + ix
  kRayCells,        // 512 words a record (one occupied brick): cell = iz&7 << 6 | iy&7 << 3 | ix&7
  kRayLists,        // 1 word a record: element index, and kFinalEntry
  kNearCells,       // 128 words a record (one near brick): 4x4x4 near cells of 2 words
  kFootPoints,      // kFootWords a record, one per brick of the grid
  kEdges,           // kEdgeWords a record
  kHull,            // 3 words a record: a point in Length, at most kMaxHullPoints
  kSearchGrid,      // 1 record, see SearchGridWord
  kDistances,       // 1 word a record: the distances of 4 neighbours along x, first one in the highest byte
  kViews,           // kViewWords a record, kMinViews..kMaxViews
  kSymmetries,      // kSymmetryWords a record, at most kMaxSymmetries
  kParts,           // kPartWords a record, at most kMaxParts; none in a part's own image
  kPartImages,      // 1 word a record: the parts' images one after the other, each a whole flight image
  kSensors,  // kSensorWords a record, at most kMaxSensors - 1: the sensors besides that of the parameters; of no meaning in a part's image
  kCalibrations,  // kCalibrationWords a record, at most kMaxCalibrations a sensor, in the order of the sensors' numbers; likewise
  kNamedFrames,   // kNamedFrameWords a record, at most kMaxNamedFrames; only an image with records of it has this table
};
constexpr std::uint32_t kTableCount = 20;                // all of them, in the order of the ids
constexpr std::uint32_t kLeastTables = kTableCount - 1;  // what every image has

// Words of the one FieldGeometry record.
enum FieldGeometryWord : std::uint32_t {
  kLengthFractionBits = 0,  // 8..30
  kOriginX,
  kOriginY,
  kOriginZ,   // Length: the corner of cell (0, 0, 0)
  kCellSize,  // Length h; a brick is 8 cells, a near cell is 2 cells
  kBricksX,
  kBricksY,
  kBricksZ,      // each 1..1023
  kModelRadius,  // Length: largest distance of a mesh vertex from the target's origin
  kCenterX,
  kCenterY,
  kCenterZ,   // Length: the geometric centre (middle of the bounding box), where scans are aimed
  kNearBand,  // Length: every point within this of the surface lies in a near brick
  kFieldGeometryWords
};

// Element: a convex planar polygon of 3 or 4 sides. Words: 0..2 unit normal n (Unit, outward), 3 plane offset d (Length, n.p = d),
// 4 curvature index (0 flat), 5 flags; then its four sides, each with a unit inward normal m in the plane (Unit) and an offset c (Length),
// inside where m.p >= c: 6..9 m_x of the sides, 10..13 m_y, 14..17 m_z, 18..21 c. A triangle's fourth side has m = 0 and c = -2^31.
constexpr std::uint32_t kElementWords = 22;
constexpr std::uint32_t kElementTwoSided = 1;  // flag: seen from behind too (sheets without thickness)

// Curvature of a smooth surface: n(p) = n + G (p - c), G = [g0 g1 g2] by columns. Words: 0..2 n (Unit, near the element's normal, not
// exactly of unit length), 3..5 c (Length), 6..8 g0, 9..11 g1, 12..14 g2 (Q15.16, 1/m).
constexpr std::uint32_t kCurvatureWords = 15;

// Brick. Word 0, ray word: kEmptyBit | D (every cell of the brick is empty, and the nearest occupied cell is at Chebyshev distance >= D
// cells from each of them, D >= 1 and <= kMaxCellDistance), or the record in kRayCells. Word 1: 1 + record in kNearCells, or 0.
constexpr std::uint32_t kBrickWords = 2;
constexpr std::uint32_t kEmptyBit = 0x80000000u;

// Ray cell word: kEmptyBit | D, D = Chebyshev distance in cells to the nearest occupied cell (1..kMaxCellDistance, never too large);
// or count << 22 | offset into kRayLists (count 1..kMaxElementsPerCell, offset < 2^22).
// A cell's list holds every element that crosses the cell's box widened by half a cell on each side (the sample spacing is one cell).
// Hence, for any ray: samples along it at a spacing of one cell list every element that it hits within half a spacing of the sample.
constexpr std::uint32_t kRayCellsPerBrick = 512;
constexpr std::uint32_t kListOffsetBits = 22;
constexpr std::uint32_t kListOffsetMask = (1u << kListOffsetBits) - 1;

// Entry of a cell's list: an element, largest in the cell first, and kFinalEntry where no ray that meets the element's front within half a
// cell of the sample can have met another element of the list there before, by more than 1/1000 of a cell across either one's plane.
constexpr std::uint32_t kFinalEntry = 0x80000000u;

// Near cell = 2x2x2 ray cells; index in the brick = (iz&7)>>1 << 4 | (iy&7)>>1 << 2 | (ix&7)>>1. Word 0: 1 + the element closest to the
// cell's centre; word 1: 1 + the closest element among those whose normal points against that one's (n.n' < 0), within the near band of
// the centre, or 0. Near bricks are all bricks with a point within kNearBand of the surface.
constexpr std::uint32_t kNearWordsPerBrick = 128;

// Foot point: the surface point closest to the brick's centre (Length x3).
constexpr std::uint32_t kFootWords = 3;

// Edge for silhouettes: every convex mesh edge whose faces are not coplanar (concave ones are never contours, but where a face is
// two-sided) and every boundary edge. Words: 0..2 a, 3..5 b (Length), 6..8 n0 (Unit), 9 d0, 10..12 n1, 13 d1 (Length): the planes of its
// two faces. A boundary edge has n1 = -n0, d1 = -d0. Word 14 flags.
constexpr std::uint32_t kEdgeWords = 15;
constexpr std::uint32_t kEdgeBoundary = 1;

// What the search for a first pose needs (fsw/pose/recognition/pose_search.hpp): distances to the surface on a coarse grid of their own,
// one byte a cell: distance of the cell's centre as a share of the truncation, 255 at and beyond it. Cell index = (iz * ny + iy) * nx + ix,
// nx a multiple of 4. Outside the grid the distance is the truncation.
enum SearchGridWord : std::uint32_t {
  kSearchOriginX = 0,
  kSearchOriginY,
  kSearchOriginZ,   // Length: the corner of cell (0, 0, 0)
  kSearchCellSize,  // Length
  kSearchCellsX,
  kSearchCellsY,
  kSearchCellsZ,      // each 1..kMaxSearchCells
  kSearchTruncation,  // Length
  kSearchSize,        // Length: the model's largest extent, which tolerances are shares of
  kSearchGridWords
};
constexpr std::uint32_t kMaxSearchCells = 128;

// View: words 0..2 the direction from the target to the sensor (Unit), 3..5 the centroid of what is seen from afar (Length), 6..8 the same
// from kNearView sizes before the middle of the model, 9 and 10 how much farther from the sensor than these the median depth of what is
// seen is (Length). Each part is weighted by its area across the line of sight.
constexpr std::uint32_t kViewWords = 11;
constexpr float kNearView = 1.5F;
constexpr std::uint32_t kMinViews = 6;
constexpr std::uint32_t kMaxViews = 1024;

// Near-symmetry: a motion of the model, other than none, that brings it nearly on itself. Words 0..3 quaternion x y z w (Unit), 4..6
// translation (Length): q' = R q + t.
constexpr std::uint32_t kSymmetryWords = 7;
constexpr std::uint32_t kMaxSymmetries = 8;

// Part of the target with a model of its own (fsw/mode/parts.hpp). Binary64 values, two words each, from PartValue k at word 2 k on; then
// two words: where the part's image begins in kPartImages (bytes, a multiple of 8, not before the end of the part before), and its bytes.
enum PartValue : std::uint32_t {
  kPartQx = 0,
  kPartQy,
  kPartQz,
  kPartQw,  // T_target_part: a unit quaternion
  kPartX,
  kPartY,
  kPartZ,         // and the part's origin, m
  kPartRangeMin,  // m, of the part's centre from the sensor: where the part serves
  kPartRangeMax,
  kPartViewX,
  kPartViewY,
  kPartViewZ,       // unit vector in part axes, towards the sensors that see the part
  kPartConeCosine,  // of the largest angle between it and the direction to the sensor
  kPartPriority,    // (0, 1000]: weighs what the part would tell
  kPartValues
};
constexpr std::uint32_t kPartImageOffset = 2 * kPartValues;
constexpr std::uint32_t kPartImageBytes = kPartImageOffset + 1;
constexpr std::uint32_t kPartWords = kPartImageBytes + 1;
constexpr double kMaxPartPriority = 1000;

// A further sensor: binary64 values in the order of sensor_rows(), two words each.
constexpr std::uint32_t kSensorWords = 30;

// The calibration of a laser camera: word 0 the sensor's number, 1 the camera's serial number, then binary64 values, two words each: those
// of kCalibrationReals, and the terms of the residual (fsw/mission/calibration.hpp).
constexpr std::uint32_t kCalibrationWords = 52;

// A pair of named frames (fsw/mission/named_frame.hpp). Binary64 values, two words each: T_target_of, then T_in_sensor, each as quaternion
// x, y, z, w and position in metres.
constexpr std::uint32_t kNamedFrameWords = 28;

}  // namespace lasso
