// Commands as plain values, and the decoder that makes them from packets. Their rows: command_rows.hpp.
#pragma once

#include <cstddef>
#include <cstdint>

#include "fsw/core/span.hpp"
#include "fsw/core/time.hpp"
#include "fsw/link/arming.hpp"
#include "fsw/link/authenticator.hpp"
#include "fsw/link/memory_report.hpp"
#include "fsw/link/telecommand.hpp"

namespace lasso {

constexpr std::uint8_t kServiceFunction = 8;
constexpr std::uint8_t kSubservicePerform = 1;
constexpr std::uint8_t kServiceTest = 17;
constexpr std::uint8_t kSubservicePing = 1;
constexpr std::uint8_t kSubservicePong = 2;

constexpr std::uint8_t kSubserviceEnableStructure = 5;
constexpr std::uint8_t kSubserviceDisableStructure = 6;
constexpr std::uint8_t kSubserviceReportStructure = 27;
constexpr std::uint8_t kSubserviceStructurePeriod = 31;
constexpr std::uint8_t kServiceTime = 9;
constexpr std::uint8_t kSubserviceCorrelate = 128;
constexpr std::uint8_t kServiceParameter = 20;
constexpr std::uint8_t kSubserviceReportParameter = 1;
constexpr std::uint8_t kSubserviceParameterValue = 2;
constexpr std::uint8_t kSubserviceSetParameter = 3;
constexpr std::uint8_t kSubserviceRevertParameters = 128;
constexpr std::uint8_t kSubserviceSaveParameters = 129;
constexpr std::uint8_t kSubserviceRestoreParameters = 130;

enum class CommandKind : std::uint8_t {
  kPing,
  kMode,
  kHold,
  kStart,
  kEnableEvent,
  kDisableEvent,
  kReportDisabled,
  kArm,
  kEnableLaser,
  kInhibitLaser,
  kEnableStructure,
  kDisableStructure,
  kReportStructure,
  kStructurePeriod,
  kCorrelateTime,
  kReportParameter,
  kSetParameter,
  kRevertParameters,
  kBeginImage,
  kCheckImage,
  kActivateImage,
  kRollBackImage,
  kLoadMemory,
  kDumpMemory,
  kCheckMemory,
  kReset,
  kSaveParameters,
  kRestoreParameters,
  kReportStored,
  kSelectCalibration,
  kChangeKey,
  kConfirmKey,
};

// Why a command that is right by itself cannot be carried out. Modes and starts have reasons of their own.
enum class ServiceRefusal : std::uint8_t {
  kNone = 0,
  kNoSuchEvent = 1,
  kNotArmed = 2,
  kNotHazardous = 3,
  kNoSuchStructure = 4,
  kNoSuchParameter = 5,
  kFixedParameter = 6,
  kOutOfLimits = 7,
  kInconsistent = 8,
  kNoImageBuffer = 9,
  kTooLong = 10,
  kNotOpen = 11,
  kOutside = 12,
  kNotWhole = 13,
  kIncomplete = 14,
  kImageBusy = 15,
  kImageNotReady = 16,
  kOtherImage = 17,
  kDoesNotFit = 18,
  kNotAllowed = 19,
  kModeSafe = 20,
  kNoStore = 21,
  kStoreFailed = 22,
  kNothingStored = 23,
  kOtherTable = 24,
  kNoCalibration = 25,
  kNoSuchKey = 26,
  kKeyOnTrial = 27,
  kNoKeyOnTrial = 28,
  kNotByNewKey = 29,
  kNotKept = 30,
};

struct ModeCommand {
  std::uint8_t mode = 0;  // TrackingMode
};
struct HoldCommand {
  std::uint8_t held = 0;
};
struct StartCommand {
  std::uint8_t source = 0;  // InitialPoseSource
  TimeUs t_us = 0;          // at which the rest is stated
  double q_sensor_target[4] = {0, 0, 0, 1};
  double p_sensor_target_m[3] = {};
  double omega_radps[3] = {};  // sensor axes
  double v_mps[3] = {};
  float covariance[21] = {};  // upper triangle, row by row: rotation [rad], translation [m]; sensor axes
};
struct EventCommand {
  std::uint16_t event = 0;  // EventId
};
struct StructureCommand {
  std::uint16_t structure = 0;
  std::uint16_t period_frames = 0;  // kStructurePeriod
};
struct StoredCommand {
  std::uint32_t last = 0;  // sequence number; 0: the last one that was kept
  std::uint8_t count = 0;  // of those that end with it
};
struct ParameterCommand {
  std::uint16_t parameter = 0;  // ParameterRow::id
  double value = 0;             // kSetParameter: in the row's unit
};
struct CalibrationCommand {
  std::uint8_t sensor = 0;
  std::uint8_t calibration = 0;  // of those that the image has for it, from 0
};
struct KeyCommand {
  std::uint32_t number = 0;
};
struct TimeCommand {  // the same moment
  TimeUs component_us = 0;
  TimeUs spacecraft_us = 0;
};

struct Command {
  CommandHeader header;
  CommandKind kind = CommandKind::kPing;
  CommandName name;
  Hazard hazard = Hazard::kNone;
  ModeCommand mode;  // the one of `kind` holds
  HoldCommand hold;
  StartCommand start;
  EventCommand event;
  CommandName armed;  // kArm
  StructureCommand structure;
  TimeCommand time;
  ParameterCommand parameter;
  ImageCommand image;
  LoadCommand load;
  MemoryCommand memory;
  StoredCommand stored;
  CalibrationCommand calibration;
  KeyCommand key;
};

constexpr std::uint8_t kMaxStoredReports = 8;
constexpr std::size_t kMaxCommandBytes = 256 + kMaxAuthenticationBytes;

// For the component `apid`. Checks packet, trailer (where there is an authenticator) and arguments, in this order. `command` is untouched
// when it is refused.
PacketFault decode_command(ConstBytes packet, Command& command, Authenticator* authenticator = nullptr, std::uint16_t apid = kApid);
// As above; `authentic`: the authenticator was asked, and said yes, whatever is wrong with the arguments.
PacketFault decode_command(ConstBytes packet, Command& command, Authenticator* authenticator, std::uint16_t apid, bool& authentic);

constexpr std::uint8_t kSafeMode = 9;  // of set_mode; as TrackingMode says
// Does the packet ask the component `apid` for what makes safe, inhibit_laser or set_mode safe? What it is signed with is not looked at.
bool is_urgent(ConstBytes packet, std::uint16_t apid = kApid);

// Is there a command of this name that has to be armed? Loop bound: the commands.
bool is_hazardous(const CommandName& name);

}  // namespace lasso
