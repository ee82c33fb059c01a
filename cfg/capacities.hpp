// What the flight component has room for. Checked at compile time, by the mission compiler, or at load; never truncated in flight.
#pragma once

#include <cstddef>
#include <cstdint>

namespace lasso {

constexpr std::size_t kMaxRays = 4096;              // rays of one scan (nominal 1024)
constexpr std::size_t kMaxAimedRays = 384;          // rays of one scan that leave its pattern
constexpr std::size_t kMaxSamplesPerPoll = 128;     // samples a sensor hands over in one call
constexpr std::size_t kMaxPixelsPerPoll = 4096;     // pixels of a dense sensor that are looked at in one call
constexpr std::size_t kMaxImageBytes = 32u << 20;   // flight image: 70,000 curved triangles
constexpr std::uint32_t kMaxElementsPerCell = 500;  // elements in one ray cell's list
constexpr std::uint32_t kMaxCellDistance = 250;     // longest jump through empty cells, in cells
constexpr std::size_t kMaxParts = 6;                // parts of the target with models of their own
constexpr std::size_t kMaxSensors = 4;              // sensors of which one takes a scan
constexpr std::size_t kMaxCalibrations = 4;         // of a sensor, of which one holds
constexpr std::size_t kMaxNamedFrames = 4;          // frames besides the sensor's and the target's that poses are reported in
constexpr std::size_t kMaxHullPoints = 256;         // extreme points of the target, for aiming
constexpr std::uint32_t kMaxElements = 1u << 18;
constexpr std::uint32_t kMaxEdges = 1u << 17;
constexpr std::size_t kMaxSites = 512;                // silhouette measurements of one scan
constexpr std::size_t kMaxContourEdges = 4096;        // model edges on the contour of one view
constexpr std::size_t kMaxAimPlaces = 128;            // places on it among which those worth a look are chosen
constexpr std::size_t kTelemetryQueueBytes = 8192;    // packets between two downlinks
constexpr std::size_t kAnswerBytes = 1024;            // of answers to commands besides: three to each of a frame
constexpr std::uint32_t kMaxCommandsPerFrame = 8;     // commands that are answered in a frame
constexpr std::uint32_t kMaxUrgentPerFrame = 2;       // commands that make safe, besides
constexpr std::uint32_t kMaxStrangersPerFrame = 256;  // packets that are looked at in a frame, and come from nobody who may command
constexpr std::uint32_t kMaxRefusalsPerFrame = 4;     // of those that are answered; as many again whose sequence count alone is wrong
constexpr std::size_t kMaxEventsPerFrame = 32;        // events that wait for the frame's end
constexpr std::size_t kTaskStackBytes = 32u << 10;    // stack that a board gives each task; make prove: they need half of it at most

}  // namespace lasso
