#include "mdat/missiondb/mission_edit.hpp"

#include <algorithm>
#include <sstream>

#include "mdat/missiondb/key_facts.hpp"
#include "mdat/missiondb/settings.hpp"
#include "mdat/missiondb/toml_reader.hpp"

namespace lasso::mdat {
namespace {

using Names = std::vector<std::string>;

// The byte of a line and column, both from 1; columns count characters, not bytes.
std::size_t byte_of(const std::string& text, const toml::source_position& place) {
  std::size_t at = 0;
  for (toml::source_index line = 1; line < place.line; ++line) at = text.find('\n', at) + 1;
  for (toml::source_index column = 1; column < place.column && at < text.size(); ++column) {
    do ++at;
    while (at < text.size() && (static_cast<unsigned char>(text[at]) & 0xC0u) == 0x80u);
  }
  return at;
}

TextSpan span_of_node(const std::string& text, const toml::node& node) {
  return {byte_of(text, node.source().begin), byte_of(text, node.source().end)};
}

const toml::node* node_at(const toml::table& root, const Names& names) {
  const toml::node* node = &root;
  for (const std::string& name : names) {
    const toml::table* table = node == nullptr ? nullptr : node->as_table();
    node = table == nullptr ? nullptr : table->get(name);
  }
  return node;
}

// As a key of TOML has to be written.
std::string key_text(const Names& names) {
  constexpr char kBare[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789_-";
  std::string text;
  for (const std::string& name : names) {
    const bool bare = !name.empty() && name.find_first_not_of(kBare) == std::string::npos;
    text += (text.empty() ? "" : ".") + (bare ? name : '"' + name + '"');
  }
  return text;
}

std::string line_end(const std::string& text) { return text.find("\r\n") == std::string::npos ? "\n" : "\r\n"; }

// What a table's nodes are in the text.
struct Lines {
  std::vector<std::size_t> headers;  // of tables in brackets
  std::size_t last = 0;              // of the values that were asked for
};

void note_headers(const std::string& text, const toml::table& table, Lines& lines) {
  for (const auto& [name, node] : table) {
    const toml::table* inner = node.as_table();
    if (inner == nullptr) continue;
    if (text[byte_of(text, inner->source().begin)] == '[') lines.headers.push_back(inner->source().begin.line);
    note_headers(text, *inner, lines);
  }
}

// The last line of the table's values that stand in lines from `from` to `to`.
void note_last(const toml::table& table, std::size_t from, std::size_t to, Lines& lines) {
  for (const auto& [name, node] : table) {
    const toml::table* inner = node.as_table();
    if (inner != nullptr && !inner->is_inline()) {
      note_last(*inner, from, to, lines);
    } else if (node.source().begin.line >= from && node.source().end.line < to) {
      lines.last = std::max<std::size_t>(lines.last, node.source().end.line);
    }
  }
}

// A line behind the last one that the table has below its own header.
std::string with_line(const std::string& text, const toml::table& root, const toml::table& table, const std::string& line) {
  Lines lines;
  note_headers(text, root, lines);
  const std::size_t header = table.source().begin.line;
  std::size_t next = static_cast<std::size_t>(-1);
  for (const std::size_t other : lines.headers) {
    if (other > header) next = std::min(next, other);
  }
  note_last(table, header, next, lines);
  const std::size_t after = text.find('\n', byte_of(text, {static_cast<toml::source_index>(std::max(lines.last, header)), 1}));
  const std::string end = line_end(text);
  return after == std::string::npos ? text + end + line + end : text.substr(0, after + 1) + line + end + text.substr(after + 1);
}

// { a = 1, KEY = VALUE }
std::string with_member(const std::string& text, const toml::table& table, const std::string& member) {
  std::size_t at = span_of_node(text, table).end - 1;
  while (at > 0 && text[at - 1] == ' ') --at;
  return text.substr(0, at) + (table.empty() ? "" : ", ") + member + text.substr(at);
}

std::string with_table(const std::string& text, const Names& table, const std::string& line) {
  const std::string end = line_end(text);
  const bool closed = text.empty() || text.back() == '\n';
  return text + (closed ? "" : end) + end + "[" + key_text(table) + "]" + end + line + end;
}

// The ways in which a missing value may be written, the one that a person would choose first.
std::vector<std::string> additions(const std::string& text, const toml::table& root, const Names& names, const std::string& value) {
  std::vector<std::string> ways;
  for (std::size_t depth = names.size() - 1; depth > 0; --depth) {
    const auto split = names.begin() + static_cast<std::ptrdiff_t>(depth);
    const toml::node* node = node_at(root, Names(names.begin(), split));
    const toml::table* table = node == nullptr ? nullptr : node->as_table();
    if (table == nullptr) continue;
    const std::string assignment = key_text(Names(split, names.end())) + " = " + value;
    ways.push_back(table->is_inline() ? with_member(text, *table, assignment) : with_line(text, root, *table, assignment));
  }
  ways.push_back(with_table(text, Names(names.begin(), names.end() - 1), key_text({names.back()}) + " = " + value));
  return ways;
}

std::optional<toml::table> read(const std::string& text, const std::filesystem::path& file) {
  try {
    return parse_toml_text(text, file);
  } catch (const MissionError&) {
    return std::nullopt;
  }
}

std::vector<std::string> ways_to_write(const std::string& text, const toml::table& root, const Names& names, const std::string& value) {
  const toml::node* node = node_at(root, names);
  if (node == nullptr) return names.size() < 2 ? std::vector<std::string>{} : additions(text, root, names, value);
  if (node->is_table() && !node->as_table()->is_inline()) return {};
  const TextSpan span = span_of_node(text, *node);
  return {text.substr(0, span.begin) + value + text.substr(span.end)};
}

std::string with_setting(const std::string& text, const std::string& setting, const std::filesystem::path& file) {
  const toml::table before = parse_toml_text(text, file);
  toml::table wanted = before;
  ProblemList problems(file);
  apply_settings({setting}, wanted, problems);
  problems.throw_if_any();
  const Setting parts = parts_of(setting);
  for (const std::string& way : ways_to_write(text, before, parts.names, parts.toml)) {
    const std::optional<toml::table> result = read(way, file);
    if (result && *result == wanted) return way;
  }
  const toml::node* node = node_at(before, parts.names);
  problems.add(node == nullptr ? Origin{} : origin_of(node->source()), key_text(parts.names), "",
               "cannot be set in this text: set single values, or edit the file");
  problems.throw_if_any();
  return text;
}

std::string joined(const std::vector<std::string>& texts) {
  std::string all;
  for (const std::string& text : texts) all += (all.empty() ? "" : ", ") + text;
  return all;
}

// The shortest text of a number that is no integer to TOML.
std::string real_text(double value) {
  const std::string text = number_text(value);
  return text + (text.find_first_not_of("-0123456789") == std::string::npos ? ".0" : "");
}

// A value in one line of TOML. Bound: one call for each value inside of it.
std::string toml_text(const toml::node& node) {
  std::vector<std::string> inner;
  if (const toml::table* table = node.as_table()) {
    for (const auto& [name, value] : *table) inner.push_back(key_text({std::string(name.str())}) + " = " + toml_text(value));
    return "{ " + joined(inner) + " }";
  }
  if (const toml::array* array = node.as_array()) {
    for (const toml::node& value : *array) inner.push_back(toml_text(value));
    return "[" + joined(inner) + "]";
  }
  if (const auto* real = node.as_floating_point()) return real_text(real->get());
  std::ostringstream out;
  node.visit([&out](const auto& value) { out << toml::toml_formatter{value, toml::format_flags::none}; });
  return out.str();
}

// Whether the schema has keys of its own below a key.
bool is_table_of_keys(const Names& names) {
  const std::vector<KeyFacts> facts = facts_of(key_text(names));
  return std::any_of(facts.begin(), facts.end(), [](const KeyFacts& form) { return form.table; });
}

void note_written(const toml::table& table, const Names& path, std::vector<WrittenValueText>& values) {
  for (const auto& [name, node] : table) {
    Names names = path;
    names.emplace_back(name.str());
    const toml::table* inner = node.as_table();
    if (inner != nullptr && (!inner->is_inline() || is_table_of_keys(names)))
      note_written(*inner, names, values);
    else
      values.push_back({key_text(names), toml_text(node), static_cast<int>(node.source().begin.line)});
  }
}

// A text without its quotes where the command line reads it as the same.
std::string setting_text(const Names& names, const toml::node& node) {
  const std::string key = key_text(names) + "=", toml = toml_text(node);
  const auto text = node.value<std::string>();
  const bool same = text && !text->empty() && parts_of(key + *text).toml == parts_of(key + toml).toml;
  return key + (same ? *text : toml);
}

// A new node or further sensor is set as a whole (apply_settings).
bool is_set_whole(const Names& names) { return names.size() == 2 && (names[0] == "node" || names[0] == "further_sensor"); }

void note_settings(const toml::table* before, const toml::table& after, const Names& path, std::vector<std::string>& settings) {
  for (const auto& [name, node] : after) {
    Names names = path;
    names.emplace_back(name.str());
    const toml::node* old = before == nullptr ? nullptr : before->get(name.str());
    const toml::table* inner = node.as_table();
    if (inner != nullptr && !inner->is_inline() && !(old == nullptr && is_set_whole(names)))
      note_settings(old == nullptr ? nullptr : old->as_table(), *inner, names, settings);
    else if (old == nullptr || toml_text(*old) != toml_text(node))
      settings.push_back(setting_text(names, node));
  }
}

std::vector<std::string> lines_of_text(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  return lines;
}

std::string signed_lines(const std::vector<std::string>& lines, std::size_t from, std::size_t to, char sign) {
  std::string text;
  for (std::size_t i = from; i < to; ++i) text += std::to_string(i + 1) + ": " + sign + lines[i] + '\n';
  return text;
}

}  // namespace

std::optional<TextSpan> span_of(const std::string& text, const std::string& key, const std::filesystem::path& file) {
  const toml::table root = parse_toml_text(text, file);
  const toml::node* node = node_at(root, names_of_key(key));
  if (node == nullptr) return std::nullopt;
  return span_of_node(text, *node);
}

std::string edited(const std::string& text, const std::vector<std::string>& settings, const std::filesystem::path& file) {
  std::string result = text;
  for (const std::string& setting : settings) result = with_setting(result, setting, file);
  return result;
}

std::vector<WrittenValueText> written_below(const std::string& text, const std::string& table, const std::filesystem::path& file) {
  const toml::table root = parse_toml_text(text, file);
  const toml::table* found = root.get_as<toml::table>(table);
  std::vector<WrittenValueText> values;
  if (found != nullptr) note_written(*found, {table}, values);
  return values;
}

std::optional<std::vector<std::string>> settings_between(const std::string& before, const std::string& after,
                                                         const std::filesystem::path& file) {
  toml::table mission = parse_toml_text(before, file);
  const toml::table wanted = parse_toml_text(after, file);
  std::vector<std::string> settings;
  note_settings(&mission, wanted, {}, settings);
  if (settings.size() > kMostSettings) return std::nullopt;
  ProblemList problems(file);
  apply_settings(settings, mission, problems);
  if (!problems.empty() || mission != wanted) return std::nullopt;
  return settings;
}

std::string changed_lines(const std::string& before, const std::string& after) {
  const std::vector<std::string> a = lines_of_text(before), b = lines_of_text(after);
  const std::size_t least = std::min(a.size(), b.size());
  std::size_t head = 0, tail = 0;
  while (head < least && a[head] == b[head]) ++head;
  while (tail < least - head && a[a.size() - 1 - tail] == b[b.size() - 1 - tail]) ++tail;
  return signed_lines(a, head, a.size() - tail, '-') + signed_lines(b, head, b.size() - tail, '+');
}

}  // namespace lasso::mdat
