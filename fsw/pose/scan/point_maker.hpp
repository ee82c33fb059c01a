// Turns the samples of a scan into rays and points, in the path's numbers: what prepare_rays does for each of them.
#pragma once

#include "fsw/mission/mission.hpp"
#include "fsw/pose/scan/workspace.hpp"

namespace lasso {

// What holds for all samples of a scan.
template <class N>
struct PointSettings {
  // Noise of a return at its range: sigma_r^2 = sigma0^2 + (k z^2)^2 along the ray, z sigma_angle across it; the former times the sample's
  // own factor.
  typename N::Sigma sigma0;                // m
  typename N::Sigma surface;               // m
  typename N::SigmaRate k;                 // 1/m
  typename N::SigmaRate angle;             // rad
  typename N::Kernel width;                // of the kernel, in sigmas
  typename N::Length range_min;            // m; a return from where the sensor does not measure says nothing
  typename N::Length range_max;            // m
  TimeUs reference_us;                     // the scan's
  bool moving;                             // and to be deskewed: the target's motion at the reference time, sensor frame
  typename N::Tangent minus_half_rate[3];  // rad/s
  typename N::Length origin[3];            // m
  typename N::Length velocity[3];          // m/s
};

// Fills workspace.rays, workspace.points and workspace.sigma_factor. `partial`: as StartPoint's. Bound: the samples.
void make_points(const PointSettings<FlightNumber>& settings, const RangeImage& scan, bool partial, Workspace& workspace);

}  // namespace lasso
