// The flight component as an app of cFS. The app's own task runs the slots, a child task of lower priority the estimates (docs/porting.md).
#include <atomic>
#include <cstring>

#include "cfs/bus.hpp"
#include "cfs/bus_sensor.hpp"

namespace lasso::cfs {
namespace {

constexpr uint16 kPipeDepth = 32;            // the messages of two scans; Linux gives less (README.md)
constexpr int kMessagesPerSlot = 32;         // that are taken before a slot, at most
constexpr uint16 kEstimationPriority = 120;  // below every app's that has a deadline
constexpr std::size_t kImageWords = kMaxImageBytes / 8;

enum Event : uint16 { kStarted = 1, kNotStarted, kNoImage, kNoop, kRefused, kTableRefused };

alignas(required_alignment()) std::uint8_t memory[required_memory()];
std::uint64_t image[kImageWords];

// What has to outlive the app's restart, in cFE's critical data store: why it starts.
struct Note {
  std::uint32_t cause = 0;
};

class App final : public ScannerPort {
 public:
  bool begin();
  void run_slots();
  void estimate();
  void note(ResetCause cause);
  void send(const LASSO_Scan_Payload_t& order) override;

 private:
  bool fail(const char* what, CFE_Status_t status);
  bool make_pipe();
  bool read_table();
  ResetCause cause_of_start();
  bool read_image(std::size_t& bytes);
  bool begin_component();
  bool begin_estimation();
  void take_messages();
  void take(const CFE_SB_Buffer_t& buffer);
  void take_command(const CFE_SB_Buffer_t& buffer);
  bool carry_out(CFE_MSG_FcnCode_t code, const CFE_SB_Buffer_t& buffer);
  void take_telecommand(const CFE_SB_Buffer_t& buffer);
  void report();
  void publish();
  void publish(ConstBytes packet);

  CFE_SB_PipeId_t pipe_ = CFE_SB_INVALID_PIPE;
  CFE_TBL_Handle_t table_ = CFE_TBL_BAD_TABLE_HANDLE;
  CFE_ES_CDSHandle_t store_ = CFE_ES_CDS_BAD_HANDLE;
  osal_id_t wanted_ = OS_OBJECT_ID_UNDEFINED;
  LASSO_Config_t config_{};
  BusSensor sensor_{*this};
  Component* component_ = nullptr;
  LASSO_Scan_t order_{};
  LASSO_Pose_t pose_{};
  LASSO_Housekeeping_t housekeeping_{};
};

App app;

// An image's path ends within the table, and the application process is one that a component may have.
int32 check_table(void* data) {
  const auto& config = *static_cast<const LASSO_Config_t*>(data);
  const bool ends = std::memchr(config.image, 0, sizeof config.image) != nullptr;
  if (ends && config.image[0] == '/' && is_valid({config.apid})) return CFE_SUCCESS;
  CFE_EVS_SendEvent(kTableRefused, CFE_EVS_EventType_ERROR, "table LASSO.Config: image has to be a path from /, apid (%u) 1 to 2046",
                    config.apid);
  return CFE_STATUS_VALIDATION_FAILURE;
}

bool App::fail(const char* what, CFE_Status_t status) {
  CFE_EVS_SendEvent(kNotStarted, CFE_EVS_EventType_ERROR, "%s: 0x%08X", what, static_cast<unsigned>(status));
  return false;
}

bool App::begin() {
  static_cast<void>(CFE_EVS_Register(nullptr, 0, CFE_EVS_EventFilter_BINARY));
  prepare(order_, LASSO_SCAN_MID);
  prepare(pose_, LASSO_POSE_MID);
  prepare(housekeeping_, LASSO_HK_MID);
  return read_table() && make_pipe() && begin_component() && begin_estimation();
}

bool App::read_table() {
  CFE_Status_t status = CFE_TBL_Register(&table_, "Config", sizeof(LASSO_Config_t), CFE_TBL_OPT_DEFAULT, check_table);
  if (status == CFE_SUCCESS) status = CFE_TBL_Load(table_, CFE_TBL_SRC_FILE, "/cf/lasso_config.tbl");
  if (status != CFE_SUCCESS && status != CFE_TBL_INFO_RECOVERED_TBL) return fail("table LASSO.Config of /cf/lasso_config.tbl", status);
  void* table = nullptr;
  status = CFE_TBL_GetAddress(&table, table_);
  if (status != CFE_SUCCESS && status != CFE_TBL_INFO_UPDATED) return fail("table LASSO.Config", status);
  config_ = *static_cast<const LASSO_Config_t*>(table);
  static_cast<void>(CFE_TBL_ReleaseAddress(table_));
  return true;
}

bool App::make_pipe() {
  CFE_Status_t status = CFE_SB_CreatePipe(&pipe_, kPipeDepth, "LASSO");
  const CFE_SB_MsgId_Atom_t ids[] = {LASSO_CMD_MID, LASSO_SEND_HK_MID, LASSO_SAMPLES_MID,
                                     static_cast<CFE_SB_MsgId_Atom_t>(LASSO_TELECOMMAND_MID(config_.apid))};
  for (const CFE_SB_MsgId_Atom_t id : ids) {
    if (status == CFE_SUCCESS) status = CFE_SB_SubscribeEx(CFE_SB_ValueToMsgId(id), pipe_, CFE_SB_Qos_t{}, kPipeDepth);
  }
  return status == CFE_SUCCESS || fail("pipe LASSO", status);
}

// Why the app starts: as it has noted before its end, else as the platform says.
ResetCause App::cause_of_start() {
  Note noted;
  const CFE_Status_t status = CFE_ES_RegisterCDS(&store_, sizeof noted, "Note");
  if (status == CFE_ES_CDS_ALREADY_EXISTS) static_cast<void>(CFE_ES_RestoreFromCDS(&noted, store_));
  note(ResetCause::kPowerOn);
  if (noted.cause == static_cast<std::uint32_t>(ResetCause::kCommanded)) return ResetCause::kCommanded;
  if (noted.cause == static_cast<std::uint32_t>(ResetCause::kInvariant)) return ResetCause::kInvariant;
  uint32 subtype = 0;
  if (CFE_ES_GetResetType(&subtype) != CFE_PSP_RST_TYPE_PROCESSOR) return ResetCause::kPowerOn;
  if (subtype == CFE_PSP_RST_SUBTYPE_HW_WATCHDOG) return ResetCause::kWatchdog;
  return subtype == CFE_PSP_RST_SUBTYPE_EXCEPTION ? ResetCause::kException : ResetCause::kCommanded;
}

void App::note(ResetCause cause) {
  const Note noted{static_cast<std::uint32_t>(cause)};
  static_cast<void>(CFE_ES_CopyToCDS(store_, &noted));
}

bool App::read_image(std::size_t& bytes) {
  osal_id_t file = OS_OBJECT_ID_UNDEFINED;
  int32 status = OS_OpenCreate(&file, config_.image, OS_FILE_FLAG_NONE, OS_READ_ONLY);
  if (status == OS_SUCCESS) {
    status = OS_read(file, image, sizeof image);
    static_cast<void>(OS_close(file));
  }
  bytes = status > 0 ? static_cast<std::size_t>(status) : 0;
  if (bytes > 0) return true;
  CFE_EVS_SendEvent(kNoImage, CFE_EVS_EventType_ERROR, "%s: not read (%d): put the flight image there, or another path into LASSO.Config",
                    config_.image, static_cast<int>(status));
  return false;
}

bool App::begin_component() {
  std::size_t bytes = 0;
  if (!read_image(bytes)) return false;
  component_ = create(memory, sizeof memory, sensor_, {config_.apid});
  const LoadFailure failure = load_image(*component_, {reinterpret_cast<std::uint8_t*>(image), bytes});
  if (failure.status != Status::kOk) {
    CFE_EVS_SendEvent(kNoImage, CFE_EVS_EventType_ERROR, "%s: %s: %s", config_.image, to_string(failure.status), failure.what);
    return false;
  }
  set_reset_cause(*component_, cause_of_start());
  static_cast<void>(lasso::begin(*component_, now_us()));  // refuses only what has no image or has begun
  CFE_EVS_SendEvent(kStarted, CFE_EVS_EventType_INFORMATION, "3DLASSO %s, image %s, APID 0x%03X", version(), config_.image, config_.apid);
  return true;
}

void estimation_task() {
  for (;;) app.estimate();
}

bool App::begin_estimation() {
  CFE_ES_TaskId_t task = CFE_ES_TASKID_UNDEFINED;
  const int32 made = OS_BinSemCreate(&wanted_, "LASSO_ESTIMATE", 0, 0);
  if (made != OS_SUCCESS) return fail("semaphore LASSO_ESTIMATE", made);
  const CFE_Status_t status =
      CFE_ES_CreateChildTask(&task, "LASSO_EST", estimation_task, CFE_ES_TASK_STACK_ALLOCATE, 2 * kTaskStackBytes, kEstimationPriority, 0);
  return status == CFE_SUCCESS || fail("task LASSO_EST", status);
}

void App::estimate() {
  if (OS_BinSemTake(wanted_) == OS_SUCCESS) component_->run_estimation();
}

// Messages, then the slots whose time has come, and what the component says of them.
void App::run_slots() {
  take_messages();
  while (component_->slot_is_due(now_us())) {
    component_->run_slot(now_us());
    if (component_->estimation_pending()) static_cast<void>(OS_BinSemGive(wanted_));
    publish();
  }
  if (!reset_due(*component_)) return;
  CFE_ES_AppId_t self = CFE_ES_APPID_UNDEFINED;
  static_cast<void>(CFE_ES_GetAppID(&self));
  note(ResetCause::kCommanded);
  static_cast<void>(CFE_ES_RestartApp(self));
}

// Waits for messages until the next slot.
void App::take_messages() {
  CFE_SB_Buffer_t* buffer = nullptr;
  for (int i = 0; i < kMessagesPerSlot; ++i) {
    const TimeUs rest_us = next_slot_us(*component_) - now_us();
    const int32 patience = rest_us > 0 ? static_cast<int32>(rest_us / 1000 + 1) : CFE_SB_POLL;
    if (CFE_SB_ReceiveBuffer(&buffer, pipe_, patience) != CFE_SUCCESS) return;
    take(*buffer);
  }
}

void App::take(const CFE_SB_Buffer_t& buffer) {
  CFE_SB_MsgId_t id = CFE_SB_INVALID_MSG_ID;
  static_cast<void>(CFE_MSG_GetMsgId(&buffer.Msg, &id));
  switch (CFE_SB_MsgIdToValue(id)) {
    case LASSO_SAMPLES_MID: {
      const LASSO_Samples_t* samples = as<LASSO_Samples_t>(buffer);
      const bool taken = samples != nullptr && sensor_.take(samples->payload);
      ++(taken ? housekeeping_.payload.sample_messages : housekeeping_.payload.refused_messages);
      return;
    }
    case LASSO_CMD_MID:
      return take_command(buffer);
    case LASSO_SEND_HK_MID:
      return report();
    default:
      return take_telecommand(buffer);
  }
}

void App::take_command(const CFE_SB_Buffer_t& buffer) {
  CFE_MSG_FcnCode_t code = 0;
  static_cast<void>(CFE_MSG_GetFcnCode(&buffer.Msg, &code));
  if (carry_out(code, buffer)) {
    ++housekeeping_.payload.commands;
    return;
  }
  ++housekeeping_.payload.errors;
  CFE_EVS_SendEvent(kRefused, CFE_EVS_EventType_ERROR, "command with function code %u refused: unknown, of another length, or no pose",
                    code);
}

bool App::carry_out(CFE_MSG_FcnCode_t code, const CFE_SB_Buffer_t& buffer) {
  if (code == LASSO_START_TRACKING_CC) {
    const LASSO_Start_t* start = as<LASSO_Start_t>(buffer);
    if (start == nullptr) return false;
    const LASSO_Start_Payload_t& p = start->payload;
    const double* q = p.q_sensor_target;
    const Pose pose{Quat(q[3], q[0], q[1], q[2]), to_vec3(p.p_sensor_target_m)};
    return start_tracking(*component_, pose, {to_vec3(p.omega_radps), to_vec3(p.v_mps)}, p.t_us) == Status::kOk;
  }
  if (as<CFE_MSG_CommandHeader_t>(buffer) == nullptr) return false;
  if (code == LASSO_STOP_TRACKING_CC) return stop_tracking(*component_) == Status::kOk;
  if (code == LASSO_RESET_COUNTERS_CC) housekeeping_.payload = {};
  if (code == LASSO_NOOP_CC) CFE_EVS_SendEvent(kNoop, CFE_EVS_EventType_INFORMATION, "3DLASSO %s is there", version());
  return code == LASSO_RESET_COUNTERS_CC || code == LASSO_NOOP_CC;
}

// One of the component's own, as the ground has made it. What the frame has no room for is lost, as on any link: the ground asks again.
void App::take_telecommand(const CFE_SB_Buffer_t& buffer) {
  CFE_MSG_Size_t size = 0;
  static_cast<void>(CFE_MSG_GetSize(&buffer.Msg, &size));
  if (receive_packet(*component_, {reinterpret_cast<const std::uint8_t*>(&buffer), size}, now_us())) {
    ++housekeeping_.payload.telecommands;
  } else {
    ++housekeeping_.payload.errors;
  }
}

void App::report() {
  static_cast<void>(CFE_TBL_Manage(table_));
  cfs::send(housekeeping_);
}

void App::send(const LASSO_Scan_Payload_t& order) {
  order_.payload = order;
  cfs::send(order_);
}

void App::publish() {
  std::uint8_t packets[kMaxPosePacketBytes];
  for (ConstBytes rest(packets, take_telemetry(*component_, packets)); !rest.empty();
       rest = {packets, take_telemetry(*component_, packets)}) {
    while (!rest.empty()) {
      const std::size_t size = packet_size(rest);
      publish(rest.first(size));
      rest = rest.subspan(size, rest.size() - size);
    }
  }
}

// The packet as it is, and a pose for other apps besides.
void App::publish(ConstBytes packet) {
  union {
    CFE_SB_Buffer_t buffer;
    std::uint8_t bytes[kMaxPosePacketBytes];
  } message;
  std::memcpy(message.bytes, packet.data(), packet.size());
  static_cast<void>(CFE_SB_TransmitMsg(&message.buffer.Msg, false));
  ++housekeeping_.payload.packets;
  PacketHeader header;
  PoseTelemetry pose;
  if (decode_pose(packet, header, pose, config_.apid) != PacketFault::kNone) return;
  pose_.payload = to_message(pose);
  cfs::send(pose_);
  ++housekeeping_.payload.poses;
  housekeeping_.payload.valid_poses += pose.valid;
}

}  // namespace
}  // namespace lasso::cfs

// A bug in the component: the processor is restarted, and the component begins in mode safe.
[[noreturn]] void lasso::on_invariant_failure(const lasso::InvariantFailure& failure) {
  CFE_ES_WriteToSysLog("LASSO: component 0x%03X: invariant failed: %s\n", failure.apid, failure.what);
  lasso::cfs::app.note(lasso::ResetCause::kInvariant);
  CFE_ES_ResetCFE(CFE_PSP_RST_TYPE_PROCESSOR);
  for (;;) OS_TaskDelay(1000);
}

extern "C" [[gnu::visibility("default")]] void LASSO_Main() {
  uint32 status = lasso::cfs::app.begin() ? CFE_ES_RunStatus_APP_RUN : CFE_ES_RunStatus_APP_ERROR;
  while (CFE_ES_RunLoop(&status)) lasso::cfs::app.run_slots();
  CFE_ES_ExitApp(status);
}
