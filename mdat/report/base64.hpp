// Base64 (RFC 4648, with padding), for pictures inside of a page.
#pragma once

#include <string>
#include <string_view>

namespace lasso::mdat {

std::string base64(std::string_view bytes);

}  // namespace lasso::mdat
