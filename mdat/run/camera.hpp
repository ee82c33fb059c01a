// The laser camera, LIDAR or TriDAR of a run: simulated at the other end of a line in simulated time, or reached over a line of this
// machine in real time.
#pragma once

#include <optional>
#include <string>

#include "bsp/posix/line_pump.hpp"
#include "bsp/posix/serial_line.hpp"
#include "hal_lcs/driver.hpp"
#include "hal_sim/lcs_device.hpp"
#include "mdat/run/case.hpp"

namespace lasso::mdat {

// As --sensor names it.
const char* wire_name(lcs::Device device);
// Whether a mission's sensor of this kind is the head that is on a line: a laser camera, a LIDAR, or, as a TriDAR, either;
// a flash LIDAR is none of them.
bool wired(lcs::Device device, SensorKind kind);

// Refuses a line that cannot be opened, as far as can be told without opening it; an empty one is none. Throws InputError.
void check_camera_line(std::optional<lcs::Device> wire, const std::string& line, bool remote);

// The camera, or other head, of a case, which is the mission's sensor of that number.
sim::LcsCamera camera_for(const CaseSetup& setup, const sim::ScannerModel& model, std::uint8_t number);
// The same where there is no line: of the kind that the mission has it be.
sim::LcsCamera head_for(const CaseSetup& setup, const sim::ScannerModel& model, SensorKind kind, std::uint8_t number);

// A head that sees what its scanner model does, at the end of its line. Its driver takes its optics to be what they are, unless the image
// says otherwise.
struct CameraOnLine {
  CameraOnLine(const CaseSetup& setup, const sim::Trajectory& trajectory, const sim::ScannerModel& model, std::uint64_t seed,
               std::uint8_t number)
      : camera(camera_for(setup, model, number)),
        device(*setup.target, trajectory, model, seed, camera, setup.others),
        line(device, sim::optics_of(camera), camera.bits_per_s) {}

  sim::LcsCamera camera;
  sim::LcsDevice device;
  sim::LcsOverLine line;
};

// The driver of a head that is reached over a line of this machine (bsp/posix/serial_line.hpp).
struct LiveCamera {
  // Throws InputError with the line's reason.
  LiveCamera(const CaseSetup& setup, const sim::ScannerModel& model, std::uint8_t number);
  ~LiveCamera();

  lcs::Line rings;
  lcs::Driver driver;
  posix::SerialLine line;
  posix::LinePump pump;
};

// Runs the case's camera alone, in real time, for one client of `server` after the other, until `ending`. Frame 0 of the scenario begins
// with a client's first start of a scan; each client finds the camera as after a boot. Says in `told` who comes and goes.
void serve_camera(const CaseSetup& setup, posix::LineServer& server, const std::atomic<bool>& ending,
                  const std::function<void(const std::string&)>& told);

}  // namespace lasso::mdat
