#include "fsw/link/commands.hpp"

#include "fsw/link/command_rows.hpp"

namespace lasso {
namespace {

template <class Arguments, std::size_t kRows>
PacketFault read_arguments(ByteReader& in, const Codec<Arguments, kRows>& codec, const Limits<Arguments, kRows>& limits, Arguments& out) {
  if (in.remaining() != codec.bytes) return PacketFault::kBadLength;
  codec.read(in, out);
  return limits.hold(out) ? PacketFault::kNone : PacketFault::kBadArgument;
}

// The member of Command that has these rows.
template <auto kMember, const auto& kRows>
PacketFault read(ByteReader& in, Command& command) {
  static constexpr auto kCodec = codec_of(kRows);
  static constexpr auto kLimits = limits_of(kRows);
  return read_arguments(in, kCodec, kLimits, command.*kMember);
}

PacketFault read_nothing(ByteReader& in, Command&) { return in.remaining() == 0 ? PacketFault::kNone : PacketFault::kBadLength; }

// What flight code keeps of a command's row.
struct CommandForm {
  CommandKind kind;
  PacketFault (*read)(ByteReader&, Command&);
  std::uint8_t service, subservice;
  bool numbered;
  std::uint16_t number;
  Hazard hazard;
};
constexpr CommandForm form(CommandKind kind, PacketFault (*read)(ByteReader&, Command&)) {
  const PacketRow& row = command_rows::row_of(kind);
  return {kind, read, row.service, row.subservice, row.numbered, row.number, row.hazard};
}
constexpr CommandForm kForms[] = {
    form(CommandKind::kPing, read_nothing),
    form(CommandKind::kMode, read<&Command::mode, command_rows::kMode>),
    form(CommandKind::kHold, read<&Command::hold, command_rows::kHold>),
    form(CommandKind::kStart, read<&Command::start, command_rows::kStart>),
    form(CommandKind::kEnableEvent, read<&Command::event, command_rows::kEvent>),
    form(CommandKind::kDisableEvent, read<&Command::event, command_rows::kEvent>),
    form(CommandKind::kReportDisabled, read_nothing),
    form(CommandKind::kArm, read<&Command::armed, command_rows::kArm>),
    form(CommandKind::kEnableLaser, read_nothing),
    form(CommandKind::kInhibitLaser, read_nothing),
    form(CommandKind::kEnableStructure, read<&Command::structure, command_rows::kStructure>),
    form(CommandKind::kDisableStructure, read<&Command::structure, command_rows::kStructure>),
    form(CommandKind::kReportStructure, read<&Command::structure, command_rows::kStructure>),
    form(CommandKind::kStructurePeriod, read<&Command::structure, command_rows::kPeriod>),
    form(CommandKind::kCorrelateTime, read<&Command::time, command_rows::kTime>),
    form(CommandKind::kReportParameter, read<&Command::parameter, command_rows::kParameter>),
    form(CommandKind::kSetParameter, read<&Command::parameter, command_rows::kSetParameter>),
    form(CommandKind::kRevertParameters, read_nothing),
    form(CommandKind::kBeginImage, read<&Command::image, memory_rows::kBegin>),
    form(CommandKind::kCheckImage, read_nothing),
    form(CommandKind::kActivateImage, read<&Command::image, memory_rows::kActivate>),
    form(CommandKind::kRollBackImage, read_nothing),
    form(CommandKind::kLoadMemory, read<&Command::load, memory_rows::kLoad>),
    form(CommandKind::kDumpMemory, read<&Command::memory, memory_rows::kRange>),
    form(CommandKind::kCheckMemory, read<&Command::memory, memory_rows::kRange>),
    form(CommandKind::kReset, read_nothing),
    form(CommandKind::kSaveParameters, read_nothing),
    form(CommandKind::kRestoreParameters, read_nothing),
    form(CommandKind::kReportStored, read<&Command::stored, command_rows::kStored>),
    form(CommandKind::kSelectCalibration, read<&Command::calibration, command_rows::kCalibration>),
    form(CommandKind::kChangeKey, read<&Command::key, command_rows::kKey>),
    form(CommandKind::kConfirmKey, read<&Command::key, command_rows::kKey>),
};
static_assert(sizeof(kForms) / sizeof(kForms[0]) == sizeof(command_rows::kCommands) / sizeof(PacketRow), "a form for each command");

const CommandForm& form_of(CommandKind kind) { return Span<const CommandForm>(kForms)[static_cast<std::size_t>(kind)]; }

bool is_of(const CommandForm& form, const CommandHeader& header, ConstBytes data) {
  if (form.service != header.service || form.subservice != header.subservice) return false;
  return !form.numbered || form.number == ByteReader(data).u16();
}

PacketFault decode_data(ConstBytes data, Command& command) {
  for (const CommandForm& form : kForms) {
    if (!is_of(form, command.header, data)) continue;
    command.kind = form.kind;
    command.name = {form.service, form.subservice, form.number};
    command.hazard = form.hazard;
    ByteReader in(data);
    if (form.numbered) static_cast<void>(in.u16());
    return form.read(in, command);
  }
  return PacketFault::kUnknown;
}

}  // namespace

PacketFault decode_command(ConstBytes packet, Command& command, Authenticator* authenticator, std::uint16_t apid) {
  bool authentic = false;
  return decode_command(packet, command, authenticator, apid, authentic);
}

PacketFault decode_command(ConstBytes packet, Command& command, Authenticator* authenticator, std::uint16_t apid, bool& authentic) {
  authentic = false;
  Command decoded;
  ConstBytes data;
  PacketFault fault = parse_command(packet, decoded.header, data, apid);
  if (fault == PacketFault::kNone && authenticator != nullptr) {
    fault = authenticate(packet, *authenticator, data);
    authentic = fault == PacketFault::kNone;
  }
  if (fault == PacketFault::kNone) fault = decode_data(data, decoded);
  if (fault == PacketFault::kNone) command = decoded;
  return fault;
}

bool is_urgent(ConstBytes packet, std::uint16_t apid) {
  CommandHeader header;
  ConstBytes data;
  if (parse_command(packet, header, data, apid) != PacketFault::kNone) return false;
  if (is_of(form_of(CommandKind::kInhibitLaser), header, data)) return true;
  if (!is_of(form_of(CommandKind::kMode), header, data)) return false;
  ByteReader in(data);
  static_cast<void>(in.u16());
  return in.u8() == kSafeMode;
}

bool is_hazardous(const CommandName& name) {
  bool hazardous = false;
  for (const CommandForm& form : kForms) {
    hazardous = hazardous || (form.hazard != Hazard::kNone && name == CommandName{form.service, form.subservice, form.number});
  }
  return hazardous;
}

}  // namespace lasso
