// Keys of earlier versions, and what a person does who wrote one.
#pragma once

#include <string>

namespace lasso::mdat {

// What has taken the place of the key ("search.hits_min"), as the end of a sentence that begins with it. Empty: no version had it.
std::string remedy_of_old_key(const std::string& key);

}  // namespace lasso::mdat
