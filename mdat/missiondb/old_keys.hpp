// Keys of earlier versions. What a person does with a line that has one. Inside of missiondb.
#pragma once

#include <string>

namespace lasso::mdat {

// What has taken the place of the key ("search.hits_min"), as the end of a sentence that begins with it. Empty: no version had it.
std::string remedy_of_old_key(const std::string& key);

}  // namespace lasso::mdat
