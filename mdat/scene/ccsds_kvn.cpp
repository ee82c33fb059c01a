#include "mdat/scene/ccsds_kvn.hpp"

#include <algorithm>
#include <cctype>

#include "hal_sim/scan_file.hpp"
#include "hal_sim/scan_text.hpp"
#include "mdat/scene/file_text.hpp"
#include "mdat/source/nearest.hpp"

namespace lasso::mdat::scene {
namespace {

std::string listed(const std::vector<std::string>& words) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : ", ") + word;
  return text;
}

}  // namespace

std::string kvn_word(std::string_view text) {
  std::string word;
  for (const char c : sim::trimmed(text)) {
    const bool blank = c == ' ' || c == '\t' || c == '_';
    if (blank && word.ends_with('_')) continue;
    word += blank ? '_' : static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
  }
  return word;
}

KvnMessage::KvnMessage(std::string_view text, const std::string& file, const std::string& kind, Problems& problems)
    : file_(file), kind_(kind), problems_(problems) {
  text = sim::without_mark(text);
  if (text.starts_with('<')) {
    problems_.add_at(at(1), "", "", "is XML: expected the " + kind + " in key-value notation (KVN)");
    problems_.throw_if_any();
  }
  sim::Lines lines(file, text);
  std::string_view line;
  while (!ended_ && lines.next(line)) {
    const std::string_view words = sim::trimmed(line);
    const int number = static_cast<int>(lines.number());
    if (words.empty() || words.starts_with("COMMENT") || take_mark(words, number) || in_covariance_) continue;
    if (words.find('=') != std::string_view::npos) {
      take_key(words, number);
    } else if (has_data_) {
      lines_.push_back({words, number});
    } else {
      problems_.add_at(at(number), "", sim::shown(words), "stands before META_STOP: expected KEY = VALUE");
    }
  }
  if (!has_data_) problems_.add_at(at(0), "", "", "has no META_STOP: expected a segment of an " + kind);
}

// The marks stand alone on their lines.
bool KvnMessage::take_mark(std::string_view text, int number) {
  if (text == "META_START" && has_data_) {
    problems_.add_at(at(number), "", "META_START", "begins another segment: write each segment to a file of its own");
    ended_ = true;
  }
  has_data_ = has_data_ || text == "META_STOP";
  if (text == "COVARIANCE_START") in_covariance_ = true;
  if (text == "COVARIANCE_STOP") in_covariance_ = false;
  return text == "META_START" || text == "META_STOP" || text == "DATA_START" || text == "DATA_STOP" || text == "COVARIANCE_START" ||
         text == "COVARIANCE_STOP";
}

void KvnMessage::take_key(std::string_view text, int number) {
  const std::size_t equals = text.find('=');
  const std::string key(sim::trimmed(text.substr(0, equals)));
  const auto [found, added] = values_.emplace(key, Value{kvn_word(text.substr(equals + 1)), number});
  if (!added) problems_.add_at(at(number), key, "", "is written in line " + std::to_string(found->second.line) + ", too: remove one");
}

std::string KvnMessage::value(const std::string& key) const {
  const auto found = values_.find(key);
  return found == values_.end() ? "" : found->second.text;
}

Place KvnMessage::place(const std::string& key) const {
  const auto found = values_.find(key);
  return at(found == values_.end() ? 0 : found->second.line);
}

void KvnMessage::complain(const std::string& key, const std::string& expected) { problems_.add_at(place(key), key, value(key), expected); }

std::string KvnMessage::choice(const std::string& key, const std::vector<std::string>& choices, bool needed) {
  std::string found = value(key);
  if (std::find(choices.begin(), choices.end(), found) != choices.end()) return found;
  if (!values_.contains(key)) {
    if (needed) complain(key, "is missing: expected one of " + listed(choices));
  } else {
    complain(key, "expected one of " + listed(choices));
  }
  return "";
}

std::string KvnMessage::known_frame(const std::vector<std::string>& keys, const std::vector<std::string>& frames) {
  std::vector<std::string> known;
  for (const std::string& frame : frames) known.push_back(kvn_word(frame));
  const auto is_known = [&](const std::string& key) { return std::find(known.begin(), known.end(), value(key)) != known.end(); };
  const auto found = std::find_if(keys.begin(), keys.end(), is_known);
  for (const std::string& key : keys) {
    if (value(key).empty()) {
      complain(key, "is missing: expected a frame");
    } else if (found == keys.end()) {
      complain(key, "is no frame that the mission knows: these are " + listed(known) + did_you_mean(value(key), known));
    }
  }
  return found == keys.end() ? "" : value(*found);
}

Ephemeris KvnMessage::header(const std::vector<std::string>& versions) {
  Ephemeris ephemeris;
  choice("CCSDS_" + kind_ + "_VERS", versions, true);
  ephemeris.time_system = choice("TIME_SYSTEM", {"UTC", "TAI", "TT", "GPS"}, true);
  ephemeris.object = value("OBJECT_NAME");
  return ephemeris;
}

std::vector<KvnRow> KvnMessage::rows(const std::vector<std::size_t>& counts, const std::string& columns) {
  std::vector<KvnRow> rows;
  for (const Line& line : lines_) {
    KvnRow row;
    if (take_row(line, counts, columns, row)) rows.push_back(row);
  }
  return rows;
}

// Where no row was understood, that there is none is not told besides.
void KvnMessage::check(const MotionTable& table, const std::string& degree_key) {
  if (!table.times_s.empty() || problems_.empty()) check_table(table, place(degree_key), problems_);
  problems_.throw_if_any();
}

// All problems of the row; false if there are any.
bool KvnMessage::take_row(const Line& line, const std::vector<std::size_t>& counts, const std::string& columns, KvnRow& row) {
  const std::vector<std::string_view> words = sim::words(line.text);
  row.line = line.number;
  const auto epoch = parse_epoch(words[0]);
  row.epoch = epoch.value_or(Epoch{});
  if (!epoch) {
    problems_.add_at(at(line.number), "", sim::shown(words[0]),
                     "is no epoch: expected such as 2026-11-27T08:15:30.25 or 2026-331T08:15:30.25, and no 60th second (use TAI there)");
  }
  if (std::find(counts.begin(), counts.end(), words.size() - 1) == counts.end()) {
    problems_.add_at(at(line.number), "", "", "has " + std::to_string(words.size() - 1) + " numbers: expected " + columns);
    return false;
  }
  for (std::size_t i = 1; i < words.size(); ++i) {
    try {
      row.numbers.push_back(
          sim::number(words[i], "number " + std::to_string(i), sim::at_line(file_, static_cast<std::size_t>(line.number))));
    } catch (const sim::ScanFileError& error) {
      add_error(error, file_, problems_);
    }
  }
  return epoch.has_value() && row.numbers.size() + 1 == words.size();
}

}  // namespace lasso::mdat::scene
