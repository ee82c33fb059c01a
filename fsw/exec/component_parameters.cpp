// Parameters that are changed in flight.
#include "fsw/exec/component.hpp"
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

// Checked with what was changed before it, whether a boundary has come since or not.
ServiceRefusal Component::set_parameter(const ParameterCommand& command) {
  check_area();
  MissionParameters now = images_.active().image_parameters();
  parameter_area_.apply(now);
  const ParameterRefusal refusal = parameter_area_.set(command.parameter, command.value, now);
  if (refusal != ParameterRefusal::kNone) return refusal_of(refusal);
  parameters_due_ = true;
  events_.raise<EventId::kParameterChanged>(command.parameter, command.value);
  return ServiceRefusal::kNone;
}

ServiceRefusal Component::report_parameter(std::uint16_t parameter, TimeUs now_us) {
  if (parameter >= parameter_rows().size()) return ServiceRefusal::kNoSuchParameter;
  check_area();
  const ParameterRow& row = parameter_rows()[parameter];
  MissionParameters now = images_.active().image_parameters();
  parameter_area_.apply(now);
  ParameterTelemetry report;
  report.parameter = parameter;
  report.value = now.*row.member / row.to_si;
  report.image_value = images_.active().image_parameters().*row.member / row.to_si;
  report.changed = parameter_area_.changed(parameter) ? 1 : 0;
  downlink_.send({kServiceParameter, kSubserviceParameterValue}, kParameter, report, now_us);
  return ServiceRefusal::kNone;
}

void Component::revert_parameters() {
  parameter_area_.revert();
  parameters_due_ = true;
  events_.raise<EventId::kParametersReverted>();
}

ServiceRefusal Component::save_parameters() {
  if (store_ == nullptr) return ServiceRefusal::kNoStore;
  check_area();
  std::uint8_t bytes[kSavedParameterBytes] = {};
  parameter_area_.save(Bytes(bytes));
  const Status saved = save_record(*store_, StoreArea::kParameters0, StoreArea::kParameters1, ConstBytes(bytes));
  if (saved != Status::kOk) return ServiceRefusal::kStoreFailed;
  events_.raise<EventId::kParametersSaved>();
  return ServiceRefusal::kNone;
}

// Told where something was saved, whether it holds or not.
ServiceRefusal Component::restore_parameters() {
  if (store_ == nullptr) return ServiceRefusal::kNoStore;
  std::uint8_t bytes[kSavedParameterBytes] = {};
  const Status loaded = load_record(*store_, StoreArea::kParameters0, StoreArea::kParameters1, Bytes(bytes));
  if (loaded != Status::kOk) return ServiceRefusal::kNothingStored;
  const ServiceRefusal refusal = refusal_of(parameter_area_.restore(ConstBytes(bytes), images_.active().image_parameters()));
  if (refusal == ServiceRefusal::kNone) parameters_due_ = true;
  events_.raise<EventId::kParametersRestored>(parameter_area_.changes(), refusal);
  return refusal;
}

// Before anybody uses the area. What was made of a copy that was wrong is made again.
void Component::check_area() {
  const AreaState state = parameter_area_.check();
  if (state == AreaState::kRepaired) events_.raise<EventId::kParametersRepaired>();
  if (state == AreaState::kLost) events_.raise<EventId::kParametersLost>();
  seen_.add(Fault::kParametersCorrupt, state == AreaState::kRepaired);
  seen_.add(Fault::kParametersLost, state == AreaState::kLost);
  parameters_due_ = parameters_due_ || state != AreaState::kRight;
}

// An estimate that is late reads what would be written: the change waits for it.
void Component::apply_parameters() {
  if (!parameters_due_ || !estimation_.idle()) return;
  parameters_due_ = false;
  images_.apply_parameters();
}

}  // namespace lasso
