#include "mdat/scene/file_text.hpp"

#include <charconv>
#include <string_view>

#include "mdat/source/sha256.hpp"

namespace lasso::mdat::scene {
namespace {

// A number and the colon after it, taken from the begin of `text`; 0 where none stands there.
int take_number(std::string_view& text) {
  int number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc() || end == text.data() + text.size() || *end != ':') return 0;
  text.remove_prefix(static_cast<std::size_t>(end - text.data()) + 1);
  return number;
}

}  // namespace

std::string text_of_file(const std::filesystem::path& file) {
  Problems problems({file.string()});
  try {
    return read_file(file);
  } catch (const std::runtime_error& error) {
    problems.add("", "", error.what());
  }
  problems.throw_if_any();
  return {};
}

void add_error(const std::exception& error, const std::string& file, Problems& problems) {
  const std::string whole = error.what();
  std::string_view text = whole;
  Place place{file};
  if (text.starts_with(file + ":")) {
    text.remove_prefix(file.size() + 1);
    place.line = take_number(text);
    place.column = place.line > 0 ? take_number(text) : 0;
    if (place.line > 0 && place.column == 0) place.column = 1;
  }
  while (text.starts_with(' ')) text.remove_prefix(1);
  problems.add_at(place, "", "", std::string(text));
}

}  // namespace lasso::mdat::scene
