// The dictionary as a plug-in of OpenC3 COSMOS.
#pragma once

#include <map>
#include <string>

#include "fsw/core/identity.hpp"

namespace lasso::mdat {

// The files of the plug-in's folder, by their names within it: the target LASSO with its commands, telemetry, a screen, and a protocol that
// counts commands; plugin.txt, which says how it is connected; and what makes a gem of it.
std::map<std::string, std::string> dictionary_cosmos(std::uint16_t apid = kApid);

}  // namespace lasso::mdat
