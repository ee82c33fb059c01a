// What a part of which nothing is said is made of, for pictures and lasers.
#pragma once

#include <string>

namespace lasso::mdat {

// Name of the preset (material_source.hpp) by the part's name: "solar array +y" is of solar cells, "bus" of MLI.
const char* likely_material_name(const std::string& part);

}  // namespace lasso::mdat
