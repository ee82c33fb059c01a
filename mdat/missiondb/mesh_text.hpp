// Words and numbers of mesh files that are text, with the line of what is wrong. Inside of missiondb.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace lasso::mdat {

std::string lower_case(std::string_view text);

// What a file says, for a message: in quotes, at most 40 characters, without line ends and other characters that a terminal obeys.
std::string excerpt(std::string_view text);

// "1 edge", "2 edges".
std::string count_text(std::size_t count, const std::string& name);

// Without the mark that Windows programs put before UTF-8 text. Throws MeshError where the text is UTF-16.
std::string_view plain_text(std::string_view bytes);

// The words of a text, one after the other. Lines end with LF, CR or both; NUL bytes are blanks, as some programs fill up a block with
// them.
class Words {
 public:
  explicit Words(std::string_view text, std::size_t first_line = 1) : text_(text), line_(first_line) {}

  // Empty at the end.
  std::string_view next();
  // The rest of the line, without its end. The next word is one of the next line.
  std::string_view rest_of_line();
  // Infinities and NaN in any spelling are numbers. Throws MeshError: no number, or the end.
  double number();
  bool at_end() const { return position_ >= text_.size(); }
  std::size_t line() const { return line_; }  // of the last word
  [[noreturn]] void refuse(const std::string& reason) const;

 private:
  void skip_line_end();
  std::string_view text_;
  std::size_t line_;
  std::size_t position_ = 0;
};

}  // namespace lasso::mdat
