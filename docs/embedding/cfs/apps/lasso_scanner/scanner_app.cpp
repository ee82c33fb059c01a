// A scanner as an app of cFS: takes the orders of the component's app, and sends samples of the examples' box (box.hpp). The driver of
// yours goes here.
#include "box.hpp"
#include "cfs/bus.hpp"
#include "cfs/bus_sensor.hpp"
#include "fsw/sense/pattern.hpp"

namespace lasso::cfs {
namespace {

constexpr int32 kWakeUpMs = 5;
constexpr uint16 kPipeDepth = 8;
enum Event : uint16 { kStarted = 1, kNoPipe = 2 };

class ScannerApp {
 public:
  bool begin() {
    static_cast<void>(CFE_EVS_Register(nullptr, 0, CFE_EVS_EventFilter_BINARY));
    prepare(samples_, LASSO_SAMPLES_MID);
    char name[] = "LASSO_SCAN";
    CFE_Status_t status = CFE_SB_CreatePipe(&pipe_, kPipeDepth, name);
    if (status == CFE_SUCCESS) status = CFE_SB_Subscribe(CFE_SB_ValueToMsgId(LASSO_SCAN_MID), pipe_);
    if (status != CFE_SUCCESS) {
      CFE_EVS_SendEvent(kNoPipe, CFE_EVS_EventType_ERROR, "no pipe for orders, 0x%08X: raise the limits of cFE's bus",
                        static_cast<unsigned>(status));
      return false;
    }
    CFE_EVS_SendEvent(kStarted, CFE_EVS_EventType_INFORMATION, "scanner of a box: waits for orders on 0x%04X", LASSO_SCAN_MID);
    return true;
  }

  void wake_up() {
    CFE_SB_Buffer_t* buffer = nullptr;
    if (CFE_SB_ReceiveBuffer(&buffer, pipe_, kWakeUpMs) == CFE_SUCCESS) {
      const LASSO_Scan_t* order = as<LASSO_Scan_t>(*buffer);
      if (order != nullptr) obey(order->payload);
    }
    while (permitted_ && next_ < plan_.points && time_of(next_) <= now_us()) send_samples();
  }

 private:
  void obey(const LASSO_Scan_Payload_t& order) {
    next_ = plan_.points;  // whatever it says, the scan before it is over
    if (order.order == LASSO_ORDER_PERMIT_LASER) permitted_ = true;
    if (order.order == LASSO_ORDER_INHIBIT_LASER) permitted_ = false;
    if (order.order != LASSO_ORDER_START) return;
    const ScanPlan plan = to_plan(order, aimed_);
    const Status status = permitted_ ? validate(plan) : Status::kMissing;
    if (status != Status::kOk) return refuse(order.scan_id, status);
    plan_ = plan;
    t_start_us_ = order.start_us;
    next_ = 0;
  }

  void refuse(std::uint32_t scan_id, Status status) {
    samples_.payload.scan_id = scan_id;
    samples_.payload.count = 0;
    samples_.payload.complete = 0;
    samples_.payload.status = static_cast<std::uint8_t>(status);
    send(samples_);
  }

  // As many as have been taken by now, and fit.
  void send_samples() {
    LASSO_Samples_Payload_t& payload = samples_.payload;
    payload.scan_id = plan_.scan_id;
    payload.status = 0;
    payload.count = 0;
    const TimeUs until_us = now_us();
    while (next_ < plan_.points && payload.count < LASSO_SAMPLES_PER_MESSAGE && time_of(next_) <= until_us) {
      const RangeSample sample = measure_box(box_pose(), pattern_direction(plan_, next_), time_of(next_));
      payload.samples[payload.count] = to_message(sample);
      ++payload.count;
      ++next_;
    }
    payload.complete = next_ == plan_.points ? 1 : 0;
    send(samples_);
  }

  TimeUs time_of(std::uint16_t ray) const { return t_start_us_ + pattern_time_us(plan_, ray); }

  CFE_SB_PipeId_t pipe_ = CFE_SB_INVALID_PIPE;
  LASSO_Samples_t samples_{};
  bool permitted_ = false;
  ScanPlan plan_;
  AimedRays aimed_;
  TimeUs t_start_us_ = 0;
  std::uint16_t next_ = plan_.points;
};

ScannerApp app;

}  // namespace
}  // namespace lasso::cfs

// The flight code that this app has of the component: patterns.
[[noreturn]] void lasso::on_invariant_failure(const lasso::InvariantFailure& failure) {
  CFE_ES_WriteToSysLog("LASSO_SCANNER: invariant failed: %s\n", failure.what);
  CFE_ES_ResetCFE(CFE_PSP_RST_TYPE_PROCESSOR);
  for (;;) OS_TaskDelay(1000);
}

extern "C" [[gnu::visibility("default")]] void LASSO_SCANNER_Main() {
  uint32 status = lasso::cfs::app.begin() ? CFE_ES_RunStatus_APP_RUN : CFE_ES_RunStatus_APP_ERROR;
  while (CFE_ES_RunLoop(&status)) lasso::cfs::app.wake_up();
  CFE_ES_ExitApp(status);
}
