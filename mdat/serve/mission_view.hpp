// A mission's text as the page shows it beside its form.
#pragma once

#include <filesystem>
#include <string>

namespace lasso::mdat::serve {

// JSON: `problems` (line, column, key, value, expected), those of mdat mission check before the target is read; and where there are none
// `warnings`, `values` (key, value, unit, place, line), those of mdat mission info, and `scenarios` (name, frames, runs, seed). A line
// or column of 0 is that of no place. Values of campaigns and materials are those that are written. `file` is where the text stands, or
// would. With `saved`, the text that mdat mission set would begin with: `settings`, what it would set; null: it cannot (settings_between).
std::string mission_view(const std::string& text, const std::filesystem::path& file, const std::string* saved = nullptr);

}  // namespace lasso::mdat::serve
