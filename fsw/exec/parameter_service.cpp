#include "fsw/exec/parameter_service.hpp"

#include "fsw/link/link_report.hpp"
#include "fsw/link/link_report_rows.hpp"
#include "fsw/mission/stored_record.hpp"

namespace lasso {
namespace {

constexpr auto kParameter = codec_of(link_report_rows::kParameter);

ServiceRefusal refusal_of(ParameterRefusal refusal) {
  constexpr ServiceRefusal kRefusals[] = {ServiceRefusal::kNone,        ServiceRefusal::kNoSuchParameter, ServiceRefusal::kFixedParameter,
                                          ServiceRefusal::kOutOfLimits, ServiceRefusal::kInconsistent,    ServiceRefusal::kOtherTable};
  return Span<const ServiceRefusal>(kRefusals)[static_cast<std::size_t>(refusal)];
}

}  // namespace

ParameterService::ParameterService(ImageKeeper& images, Telemetry& telemetry, HealthMonitor& health)
    : images_(images), telemetry_(telemetry), health_(health) {
  images_.use_parameters(area_);
}

// With what was changed before, whether a boundary has come since or not.
MissionParameters ParameterService::parameters_now() const {
  MissionParameters now = images_.active().image_parameters();
  area_.apply(now);
  return now;
}

ServiceRefusal ParameterService::set(const ParameterCommand& command) {
  check();
  const ParameterRefusal refusal = area_.set(index_of_id(parameter_rows(), command.parameter), command.value, parameters_now());
  if (refusal != ParameterRefusal::kNone) return refusal_of(refusal);
  due_ = true;
  telemetry_.raise<EventId::kParameterChanged>(command.parameter, command.value);
  return ServiceRefusal::kNone;
}

ServiceRefusal ParameterService::report(std::uint16_t parameter, TimeUs now_us) {
  const std::size_t index = index_of_id(parameter_rows(), parameter);
  if (index == parameter_rows().size()) return ServiceRefusal::kNoSuchParameter;
  check();
  const ParameterRow& row = parameter_rows()[index];
  ParameterTelemetry report;
  report.parameter = row.id;
  report.value = parameters_now().*row.member / row.to_si;
  report.image_value = images_.active().image_parameters().*row.member / row.to_si;
  report.changed = area_.changed(index) ? 1 : 0;
  telemetry_.downlink().send({kServiceParameter, kSubserviceParameterValue}, kParameter, report, now_us);
  return ServiceRefusal::kNone;
}

void ParameterService::revert() {
  area_.revert();
  due_ = true;
  telemetry_.raise<EventId::kParametersReverted>();
}

ServiceRefusal ParameterService::save() {
  if (store_ == nullptr) return ServiceRefusal::kNoStore;
  check();
  std::uint8_t bytes[kSavedParameterBytes] = {};
  area_.save(Bytes(bytes));
  const Status saved = save_record(*store_, StoreArea::kParameters0, StoreArea::kParameters1, ConstBytes(bytes));
  if (saved != Status::kOk) return ServiceRefusal::kStoreFailed;
  telemetry_.raise<EventId::kParametersSaved>();
  return ServiceRefusal::kNone;
}

ServiceRefusal ParameterService::restore() {
  if (store_ == nullptr) return ServiceRefusal::kNoStore;
  std::uint8_t bytes[kSavedParameterBytes] = {};
  const Status loaded = load_record(*store_, StoreArea::kParameters0, StoreArea::kParameters1, Bytes(bytes));
  if (loaded != Status::kOk) return ServiceRefusal::kNothingStored;
  const ServiceRefusal refusal = refusal_of(area_.restore(ConstBytes(bytes), images_.active().image_parameters()));
  if (refusal == ServiceRefusal::kNone) due_ = true;
  telemetry_.raise<EventId::kParametersRestored>(area_.changes(), refusal);
  return refusal;
}

void ParameterService::check() {
  const AreaState state = area_.check();
  if (state == AreaState::kRepaired) telemetry_.raise<EventId::kParametersRepaired>();
  if (state == AreaState::kLost) telemetry_.raise<EventId::kParametersLost>();
  health_.see(Fault::kParametersCorrupt, state == AreaState::kRepaired);
  health_.see(Fault::kParametersLost, state == AreaState::kLost);
  due_ = due_ || state != AreaState::kRight;
}

void ParameterService::apply(bool estimation_idle) {
  if (!due_ || !estimation_idle) return;
  due_ = false;
  images_.apply_parameters();
}

}  // namespace lasso
