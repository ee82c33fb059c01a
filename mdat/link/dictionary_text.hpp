// The dictionary of the component `apid` as documents for people (the interface document) and for programs.
#pragma once

#include <string>

#include "fsw/core/identity.hpp"

namespace lasso::mdat {

std::string dictionary_markdown(std::uint16_t apid = kApid);  // docs/icd/link.md is this, written down
std::string dictionary_html(std::uint16_t apid = kApid);      // the same page, one file that opens offline
std::string dictionary_json(std::uint16_t apid = kApid);

// XTCE 1.2 (OMG formal/18-10-04, CCSDS 660.0-B-2). Some readers know no arrays: for them each element is an item, NAME_0, NAME_1, ...
enum class XtceArrays { kAsArrays, kWrittenOut };
std::string dictionary_xtce(XtceArrays arrays = XtceArrays::kAsArrays, std::uint16_t apid = kApid);
std::string dictionary_lua(std::uint16_t apid = kApid);  // a dissector for Wireshark and tshark

}  // namespace lasso::mdat
