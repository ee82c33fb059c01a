#include "mdat/campaign/records.hpp"

#include <algorithm>
#include <charconv>
#include <cstdio>

#include "mdat/campaign/chunk_file.hpp"
#include "mdat/common/errors.hpp"
#include "mdat/common/output.hpp"
#include "mdat/common/text.hpp"

namespace lasso::mdat {
namespace {

namespace fs = std::filesystem;

// By the name alone: chunks of the same number of chunks have no case in common.
bool can_have_cases_of(const Chunk& chunk, const fs::path& file) {
  const std::string name = file.stem().string();
  const char* const end = name.data() + name.size();
  Chunk named;
  const std::from_chars_result number = std::from_chars(name.data(), end, named.number);
  if (number.ec != std::errc{} || !std::string_view(number.ptr, end).starts_with("of")) return true;
  if (std::from_chars(number.ptr + 2, end, named.of).ec != std::errc{}) return true;
  return named.of != chunk.of || named.number == chunk.number;
}

std::optional<std::string> text_if_there(const fs::path& file) {
  try {
    return file_content(file);
  } catch (const InputError&) {
    if (fs::exists(file)) throw;
    return std::nullopt;
  }
}

// Between the listing and the reading a runner may have completed the file, or removed it as it has no record.
std::string text_of(fs::path& file) {
  if (std::optional<std::string> text = text_if_there(file)) return *std::move(text);
  file.replace_extension(".done");
  return text_if_there(file).value_or("");
}

}  // namespace

Records::Records(const fs::path& folder, const std::string& plan_digest, std::uint32_t cases, std::optional<Chunk> of) : places_(cases) {
  for (const fs::path& file : chunk_files(folder))
    if (!of || can_have_cases_of(*of, file)) read(file, plan_digest);
}

void Records::read(const fs::path& file, const std::string& plan_digest) {
  files_.push_back(file);
  texts_.push_back(text_of(files_.back()));
  const ChunkText chunk = parse_chunk(files_.back().string(), texts_.back(), plan_digest);
  for (const CaseRecord& record : chunk.records) add(record);
  for (const ChunkText::Line& line : chunk.damaged) damaged_.push_back(files_.back().string() + ":" + std::to_string(line.number));
  if (!chunk.damaged.empty()) damaged_files_.push_back(files_.back());
}

void Records::add(const CaseRecord& record) {
  if (record.number >= cases())
    throw InputError(format("%s:%zu: case %u: the plan's last case is %u; move the file away", files_.back().c_str(), record.line,
                            record.number, cases() - 1));
  Place& place = places_[record.number];
  if (place.line != 0 && place.fields != record.fields) refuse_two(place, record);
  if (place.line != 0) return;
  place = {record.fields, static_cast<std::uint32_t>(files_.size() - 1), static_cast<std::uint32_t>(record.line)};
  ++done_;
  if (is_failed(record.fields)) ++failed_;
}

void Records::refuse_two(const Place& place, const CaseRecord& record) const {
  const bool one_failed = is_failed(place.fields) || is_failed(record.fields);
  throw InputError(format("%s:%zu: case %u has another result here than in %s:%u; %s", files_.back().c_str(), record.line, record.number,
                          files_[place.file].c_str(), place.line,
                          one_failed ? "mdat campaign retry DIR --failed takes the failed one out"
                                     : "two machines or programs do not compute alike: move one of the files away"));
}

std::optional<std::string_view> Records::of(std::uint32_t number) const {
  const Place& place = places_.at(number);
  return place.line == 0 ? std::nullopt : std::optional(place.fields);
}

std::string status_text(const fs::path& folder, const Records& records) {
  const std::vector<fs::path> files = chunk_files(folder);
  const auto flown = std::count_if(files.begin(), files.end(), in_flight);
  std::string text = format("%u of %u cases are done, %u of them failed, %u are missing\n", records.done(), records.cases(),
                            records.failed(), records.missing());
  if (flown > 0) text += amount(static_cast<std::size_t>(flown), "runner") + (flown == 1 ? " is" : " are") + " at work\n";
  for (const std::string& place : records.damaged()) text += place + ": a damaged record: its case is flown again\n";
  if (records.missing() > 0 && flown == 0) text += "mdat campaign run " + shell_word(folder.string()) + " flies what is missing\n";
  if (records.failed() > 0)
    text += "mdat campaign retry " + shell_word(folder.string()) + " --failed lets the failed ones be flown again\n";
  return text;
}

std::size_t retry_failed(const fs::path& folder, const std::string& plan_digest) {
  std::size_t count = 0;
  for (const fs::path& file : chunk_files(folder))
    count += repair_chunk(
                 file, plan_digest, [](const CaseRecord& record) { return is_failed(record.fields); }, ".failed")
                 .records;
  return count;
}

}  // namespace lasso::mdat
