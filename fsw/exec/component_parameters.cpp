// Parameters that are changed in flight.
#include "fsw/exec/component.hpp"
#include "fsw/link/link_report_rows.hpp"

namespace lasso {
namespace {

constexpr auto kParameter = codec_of(link_report_rows::kParameter);

ServiceRefusal refusal_of(ParameterRefusal refusal) {
  constexpr ServiceRefusal kRefusals[] = {ServiceRefusal::kNone, ServiceRefusal::kNoSuchParameter, ServiceRefusal::kFixedParameter,
                                          ServiceRefusal::kOutOfLimits, ServiceRefusal::kInconsistent};
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
