// Listed headers as text for people and programs.
#pragma once

#include <string>

#include "mdat/link/headers.hpp"

namespace lasso::mdat {

std::string headers_table(const HeaderList& list);
std::string headers_csv(const HeaderList& list);
std::string headers_json(const HeaderList& list);
// One line.
std::string headers_summary(const HeaderList& list);

}  // namespace lasso::mdat
