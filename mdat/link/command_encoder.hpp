// Commands by the dictionary: from names and text to packets, and from an operator to a component.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "fsw/link/dictionary.hpp"

namespace lasso::mdat {

// Of the dictionary. Throws InputError, which names those that resemble it.
const PacketRow& command_row(const std::string& name);

// "NAME=VALUE"; elements of an item are separated by commas, a choice may be given by its name. Throws InputError where there is no "=".
std::pair<std::string, std::string> split_argument(const std::string& argument);

// A whole command to the component `apid` within bytes: its name, and where it begins; null: there is none. A packet that is damaged on a
// stream of bytes is looked through for packets, and such a command would be carried out (docs/decisions/packets.md).
struct HeldCommand {
  const char* name = nullptr;
  std::size_t offset = 0;
};
HeldCommand held_command(ConstBytes bytes, std::uint16_t apid = kApid);

// A whole packet for the component `apid` that asks for reports of acceptance and completion. Throws InputError: an item that is missing,
// unknown, or not of its type, count or range; or another command would be within it.
std::vector<std::uint8_t> encode_command(const PacketRow& row, const std::map<std::string, std::string>& values, std::uint16_t count,
                                         std::uint16_t apid = kApid);

// The packet that has to go before a hazardous command.
std::vector<std::uint8_t> arm_for(const PacketRow& row, std::uint16_t count, std::uint16_t apid = kApid);

// All commands with a line each; one with its items.
std::string command_list();
std::string command_help(const PacketRow& row);

}  // namespace lasso::mdat
