// Requests to mdat serve that its fuzzer starts from (request.cpp).
#pragma once

#include <filesystem>

namespace lasso::fuzz {

void write_requests(const std::filesystem::path& folder);

}  // namespace lasso::fuzz
