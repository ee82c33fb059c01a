// What a person meant who wrote a name that there is not.
#pragma once

#include <string>
#include <vector>

namespace lasso::mdat {

// The candidate that is probably meant, or "".
std::string nearest(const std::string& written, const std::vector<std::string>& candidates);

// "; did you mean NAME?", or "".
std::string did_you_mean(const std::string& written, const std::vector<std::string>& candidates);

}  // namespace lasso::mdat
