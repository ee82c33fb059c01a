// Ephemerides in the files of CCSDS: orbits (OEM, 502.0-B) and attitudes (AEM, 504.0-B) in key-value notation, of one segment.
//
// Not read: XML, several segments in one file, spin axes, Euler angles of version 1.0 (its names tell axes, not the order of rotations),
// rates of Euler angles. Covariances are skipped. A spacecraft's motion is a chain of the tables of its OEM and its AEM.
//
// Velocities are the derivatives of the positions in REF_FRAME's own axes, also where this turns (RTN): that is what the table moves by.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "mdat/scene/ccsds_epoch.hpp"
#include "mdat/scene/table_motion.hpp"

namespace lasso::mdat::scene {

struct Ephemeris {
  MotionTable table;          // checked (check_table); times since `first`, in m and rad
  Epoch first;                // of its first row; seconds_between() aligns the tables of several files
  std::string time_system;    // UTC, TAI, TT or GPS: files with different ones cannot be aligned
  std::string object, frame;  // OBJECT_NAME, and the frame that it moves in; in capitals, with underscores for blanks
};

// `frames` are the names of the frames that the mission knows, as CCSDS names them (EME2000, GCRF, RTN); REF_FRAME has to be one of them.
// Positions and velocities, interpolated as INTERPOLATION and INTERPOLATION_DEGREE say (HERMITE, LAGRANGE, LINEAR), by preset as Hermite's
// cubics. Versions 1.0, 2.0 and 3.0. Throws MissionError with every problem of the file.
Ephemeris read_oem(const std::filesystem::path& file, const std::vector<std::string>& frames);
Ephemeris parse_oem(const std::string& text, const std::string& file, const std::vector<std::string>& frames);

// Attitudes, as q_frame_body: the frame is that of REF_FRAME_A and REF_FRAME_B which the mission knows, the body the other one (of two
// known ones A is the frame). Types QUATERNION, QUATERNION/DERIVATIVE, QUATERNION/ANGVEL and, of version 2.0, EULER_ANGLE. ATTITUDE_DIR and
// QUATERNION_TYPE of version 1.0 are obeyed. The table's own interpolation is used, whatever INTERPOLATION recommends. Throws as above.
Ephemeris read_aem(const std::filesystem::path& file, const std::vector<std::string>& frames);
Ephemeris parse_aem(const std::string& text, const std::string& file, const std::vector<std::string>& frames);

}  // namespace lasso::mdat::scene
