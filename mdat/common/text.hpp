// Text for people.
#pragma once

#include <string>
#include <vector>

namespace lasso::mdat {

// printf into a string.
[[gnu::format(printf, 1, 2)]] std::string format(const char* pattern, ...);

// "1 scan", "2 scans".
std::string amount(std::size_t count, const char* name);

// Text as markup shows it: the characters that HTML and XML keep for themselves as their entities.
std::string escape(const std::string& text);

// A table of lines and their cells: columns two spaces apart, as wide as their longest cell.
std::string aligned_text(const std::vector<std::vector<std::string>>& lines);

// A word of a command as a shell reads it: in quotes where it has more than letters of plain paths.
std::string shell_word(const std::string& text);

// A path as a page links to it: what is not plain in an address is in percent.
std::string url(const std::string& path);

// A number of six digits behind a comma; what is not finite is an empty cell.
std::string csv_cell(double value);

// A number with this many decimals, never as -0.
std::string decimals(double value, int count);

// The same, or `unknown` of what is not a number: of no frame nothing is known.
std::string known(double value, int count, const char* unknown);

}  // namespace lasso::mdat
