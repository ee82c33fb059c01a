// A dissector that is a table of the dictionary and a short program that walks it. It reads one packet a frame: link type USER0 (`mdat
// decode
// --format pcap`), or UDP by "Decode As".
#include "fsw/link/dictionary.hpp"
#include "mdat/common/text.hpp"
#include "mdat/link/dictionary_text.hpp"

namespace lasso::mdat {
namespace {

constexpr char kProgram[] = R"(
local lasso = Proto("lasso", "3DLASSO")
local kinds = {u8 = "uint8", u16 = "uint16", u32 = "uint32", i64 = "int64", f32 = "float", f64 = "double"}
local readers = {u8 = "uint", u16 = "uint", u32 = "uint", i64 = "int64", f32 = "float", f64 = "float"}
local sizes = {u8 = 1, u16 = 2, u32 = 4, i64 = 8, f32 = 4, f64 = 8}
local fields, headers = {}, {}

-- What headers of telemetry and commands have in common is one field.
local function add_header(list)
  for _, f in ipairs(list) do
    if not headers[f.name] then
      headers[f.name] = ProtoField.uint32("lasso." .. f.name, f.name, base.DEC, nil, nil, f.meaning)
      fields[#fields + 1] = headers[f.name]
    end
    f.field = headers[f.name]
  end
end
add_header(primary)
add_header(telemetry)
add_header(command)
for _, packet in ipairs(packets) do
  for _, item in ipairs(packet.items) do
    local abbreviation = "lasso." .. packet.name .. "." .. item.name
    if item.values then
      item.field = ProtoField[kinds[item.type]](abbreviation, item.name, base.DEC, item.values, nil, item.meaning)
    elseif item.type == "f32" or item.type == "f64" then
      item.field = ProtoField[kinds[item.type]](abbreviation, item.name, item.meaning)
    else
      item.field = ProtoField[kinds[item.type]](abbreviation, item.name, base.DEC, nil, nil, item.meaning)
    end
    fields[#fields + 1] = item.field
  end
end
local f_number = ProtoField.uint16("lasso.number", "number", base.DEC)
local f_crc = ProtoField.uint16("lasso.crc", "crc", base.HEX)
local f_crc_right = ProtoField.bool("lasso.crc_right", "crc right")
local f_trailer = ProtoField.bytes("lasso.trailer", "authentication trailer")
fields[#fields + 1] = f_number
fields[#fields + 1] = f_trailer
fields[#fields + 1] = f_crc
fields[#fields + 1] = f_crc_right
lasso.fields = fields

-- CRC-16, polynomial 0x1021, initial 0xFFFF.
local function crc16(buffer)
  local bytes, crc = buffer:bytes(), 0xFFFF
  for i = 0, bytes:len() - 1 do
    crc = bit.bxor(crc, bit.lshift(bytes:get_index(i), 8))
    for _ = 1, 8 do
      if bit.band(crc, 0x8000) ~= 0 then crc = bit.bxor(bit.lshift(crc, 1), 0x1021) else crc = bit.lshift(crc, 1) end
      crc = bit.band(crc, 0xFFFF)
    end
  end
  return crc
end

local function bits_of(buffer, f)
  local first, last = math.floor(f.bit / 8), math.floor((f.bit + f.bits - 1) / 8)
  local range = buffer(first, last - first + 1)
  return range, range:bitfield(f.bit % 8, f.bits)
end

local function show_header(list, buffer, tree)
  local values = {}
  for _, f in ipairs(list) do
    local range, value = bits_of(buffer, f)
    tree:add(f.field, range, value)
    values[f.name] = value
  end
  return values
end

local function show_items(packet, buffer, tree)
  local at = packet.first
  for _, item in ipairs(packet.items) do
    for _ = 1, item.count do
      local range = buffer(at, sizes[item.type])
      tree:add(item.field, range, range[readers[item.type]](range))
      at = at + sizes[item.type]
    end
  end
end

function lasso.dissector(buffer, pinfo, root)
  if buffer:len() < least_bytes[1] then return 0 end
  pinfo.cols.protocol = "3DLASSO"
  local tree = root:add(lasso, buffer())
  local header = show_header(primary, buffer, tree)
  if header.apid ~= apid or buffer:len() < least_bytes[header.type] then return buffer:len() end
  local secondary = show_header(header.type == 0 and telemetry or command, buffer, tree)
  for _, packet in ipairs(packets) do
    local more = buffer:len() - packet.size
    local same = packet.type == header.type and packet.service == secondary.service and packet.subservice == secondary.subservice
    same = same and (more == 0 or (more > 0 and header.type == 1))
    if same and packet.number then
      same = packet.number == buffer(packet.first - 2, 2):uint()
      if same then tree:add(f_number, buffer(packet.first - 2, 2)) end
    end
    if same then
      pinfo.cols.info = packet.name .. " #" .. header.sequence_count
      show_items(packet, buffer, tree)
      if more > 0 then tree:add(f_trailer, buffer(packet.size - 2, more)) end
    end
  end
  tree:add(f_crc, buffer(buffer:len() - 2, 2))
  tree:add(f_crc_right, buffer(buffer:len() - 2, 2), crc16(buffer()) == 0)
  return buffer:len()
end

DissectorTable.get("wtap_encap"):add(wtap.USER0, lasso)
DissectorTable.get("udp.port"):add_for_decode_as(lasso)
)";

std::string lua_quoted(const std::string& text) {
  std::string result = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') result += '\\';
    result += c;
  }
  return result + "\"";
}

std::string header_list(const char* name, Span<const HeaderField> header) {
  std::string text = format("local %s = {\n", name);
  for (const HeaderField& field : header) {
    text += format("  {name = \"%s\", bit = %u, bits = %u, meaning = %s},\n", field.name, field.bit, field.bits,
                   lua_quoted(field.meaning).c_str());
  }
  return text + "}\n";
}

std::string values(const Enumeration& enumeration) {
  std::string text = ", values = {";
  std::size_t value = 0;
  for (const Choice& choice : enumeration.choices) text += format("[%zu] = %s, ", value++, lua_quoted(choice.name).c_str());
  return text + "}";
}

std::string item(const ItemRow& row) {
  const std::string unit = std::string(row.unit) == "1" ? "" : std::string(" [") + row.unit + "]";
  return format("    {name = \"%s\", type = \"%s\", count = %u, meaning = %s", row.name, to_string(row.type), row.count,
                lua_quoted(row.meaning + unit).c_str()) +
         (row.enumeration != nullptr ? values(*row.enumeration) : "") + "},\n";
}

std::string packet_table(const PacketRow& row) {
  const std::string number = row.numbered ? std::to_string(row.number) : "nil";
  std::string text = format("  {name = \"%s\", type = %u, service = %u, subservice = %u, number = %s, first = %zu, size = %zu, items = {\n",
                            row.name, static_cast<unsigned>(row.type), row.service, row.subservice, number.c_str(), data_offset(row),
                            item_offset(row, row.items.size()) + kPacketTrailerBytes);
  for (const ItemRow& each : row.items) text += item(each);
  return text + "  }},\n";
}

}  // namespace

std::string dictionary_lua(std::uint16_t apid) {
  std::string text =
      "-- Wireshark dissector of 3DLASSO's telemetry and commands, written by `mdat dictionary --format lua`.\n"
      "-- tshark -X lua_script:THIS -r FILE.pcap -V, where `mdat decode --format pcap` writes FILE.pcap.\n";
  text += format("local apid, least_bytes = %u, {[0] = %zu, [1] = %zu}\n", apid, kPacketHeaderBytes + kPacketTrailerBytes,
                 kCommandHeaderBytes + kPacketTrailerBytes);
  text += header_list("primary", Span<const HeaderField>(kPrimaryFields));
  text += header_list("telemetry", Span<const HeaderField>(kTelemetryFields));
  text += header_list("command", Span<const HeaderField>(kCommandFields));
  text += "local packets = {\n";
  for (const PacketRow& row : kPackets) text += packet_table(row);
  return text + "}\n" + kProgram;
}

}  // namespace lasso::mdat
