// What the words of a table's records are. Inside of fsw/mission.
#pragma once

#include <cstdint>

#include "fsw/mission/image_format.hpp"

namespace lasso {

// Each letter is a word of a record: u plain, L length, S length or none (kNoSide), U unit vector, K curvature; one letter holds for all
// words. Tables that are read through the format, and stay as they were received: nullptr.
constexpr const char* kElementLayout = "UUULuuUUUUUUUUUUUULLLS";
constexpr const char* kCurvatureLayout = "UUULLLKKKKKKKKK";
constexpr const char* kEdgeLayout = "LLLLLLUUULUUULu";
constexpr const char* kLayouts[kTableCount] = {
    nullptr, nullptr, kElementLayout, kCurvatureLayout, "u", "u", "u", "u", "L", kEdgeLayout, "L", nullptr, "u", "UUULLLLLLLL", "UUUULLL"};

// Of word k.
inline char kind_of(const char* layout, std::uint32_t k) { return layout[1] == '\0' ? layout[0] : layout[k]; }

constexpr std::int32_t kNoSide = INT32_MIN;  // a triangle's fourth side

}  // namespace lasso
