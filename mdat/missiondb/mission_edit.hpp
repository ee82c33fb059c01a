// Changes of single values in a mission's text: comments, order and all other characters stay as a person wrote them.
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace lasso::mdat {

// Where a value stands in a text: from the byte `begin` up to the byte `end`.
struct TextSpan {
  std::size_t begin = 0, end = 0;
};

// The value of a dotted key; none where the text does not write it. Throws MissionError that names `file` where the text is no TOML.
std::optional<TextSpan> span_of(const std::string& text, const std::string& key, const std::filesystem::path& file);

// The text in which each KEY=VALUE of `settings` holds, by the rules of --set: VALUE is TOML, or a text without its quotes. A value that is
// written is replaced where it stands. Another one becomes a line behind the last one of its table, or a table at the end. The result is
// read again, and is what the settings make of the mission: nothing else has changed. Throws MissionError: a setting is none, the text is
// no TOML, or it is written in a way in which the value has no place. The values themselves are not checked.
std::string edited(const std::string& text, const std::vector<std::string>& settings, const std::filesystem::path& file);

// A value as a text writes it: its dotted key, its TOML, and the line where it begins, from 1.
struct WrittenValueText {
  std::string key, toml;
  int line = 0;
};

// The values that the text writes below [TABLE], in the order of their keys. What the schema has as a table is taken apart also where it is
// written in braces; a law of a campaign is one value. Throws MissionError: the text is no TOML.
std::vector<WrittenValueText> written_below(const std::string& text, const std::string& table, const std::filesystem::path& file);

// The settings (KEY=VALUE) that make of one text's mission the other's, as `edited` does it, in the order of their keys; none needed:
// empty. nullopt: there are none, as a value is gone, or as many as kMostSettings are not enough. Throws MissionError: one of the two is no
// TOML.
constexpr std::size_t kMostSettings = 100;
std::optional<std::vector<std::string>> settings_between(const std::string& before, const std::string& after,
                                                         const std::filesystem::path& file);

// The lines between the first and the last one that differ, with their numbers in their text, as `12: -points = 1024` and
// `12: +points = 512`, each with a line feed. Of one setting these are the lines that it changes. Bound: one pass.
std::string changed_lines(const std::string& before, const std::string& after);

}  // namespace lasso::mdat
