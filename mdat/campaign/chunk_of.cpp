#include "mdat/campaign/chunk_of.hpp"

#include <charconv>
#include <cstdint>
#include <optional>
#include <string_view>

#include "mdat/common/errors.hpp"
#include "mdat/common/text.hpp"

namespace lasso::mdat {
namespace {

// The variables of a scheduler's job array. Its elements are first, first + step, ..., last. nullptr: it does not say.
struct ArrayVariables {
  const char *scheduler, *index, *first, *last, *step, *count;
  std::uint32_t counts_from;  // where `first` does not say
};
constexpr ArrayVariables kArrays[] = {
    {"Slurm", "SLURM_ARRAY_TASK_ID", "SLURM_ARRAY_TASK_MIN", "SLURM_ARRAY_TASK_MAX", "SLURM_ARRAY_TASK_STEP", "SLURM_ARRAY_TASK_COUNT", 1},
    {"PBS", "PBS_ARRAY_INDEX", nullptr, nullptr, nullptr, nullptr, 1},
    {"Torque", "PBS_ARRAYID", nullptr, nullptr, nullptr, nullptr, 1},
    {"LSF", "LSB_JOBINDEX", nullptr, "LSB_JOBINDEX_END", "LSB_JOBINDEX_STEP", nullptr, 1},
    {"Grid Engine", "SGE_TASK_ID", "SGE_TASK_FIRST", "SGE_TASK_LAST", "SGE_TASK_STEPSIZE", nullptr, 1},
    {"Kubernetes", "JOB_COMPLETION_INDEX", nullptr, nullptr, nullptr, nullptr, 0},
};

constexpr std::uint32_t kLargestDivision = 1000000;

std::optional<std::uint32_t> whole_number(std::string_view text) {
  std::uint32_t number = 0;
  const auto [stop, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (text.empty() || error != std::errc{} || stop != text.data() + text.size()) return std::nullopt;
  return number;
}

// Schedulers leave a word ("undefined") where a job is no array.
std::optional<std::uint32_t> number_in(const Environment& environment, const char* name) {
  const char* const value = name == nullptr ? nullptr : environment(name);
  return value == nullptr ? std::nullopt : whole_number(value);
}

[[noreturn]] void refuse_chunk_text(const std::string& text, const std::string& expected) {
  throw InputError("--chunk " + text + ": " + expected);
}

Chunk written_chunk(const std::string& text) {
  const std::size_t slash = text.find('/');
  const auto number = whole_number(std::string_view(text).substr(0, slash));
  const auto of = slash == std::string::npos ? std::nullopt : whole_number(std::string_view(text).substr(slash + 1));
  if (!number || !of || *number < 1 || *number > *of || *of > kLargestDivision)
    refuse_chunk_text(text,
                      format("expected K/N, the K-th of N chunks, K from 1 to N, N at most %u, such as 3/10; or auto, or auto/N, in a "
                             "job array",
                             kLargestDivision));
  return {*number, *of};
}

// LSF sets the index to 0 where a job is no array.
const ArrayVariables* array_in(const Environment& environment) {
  for (const ArrayVariables& array : kArrays) {
    const auto index = number_in(environment, array.index);
    if (index && !(*index == 0 && std::string_view(array.scheduler) == "LSF")) return &array;
  }
  return nullptr;
}

std::string known_indices() {
  std::string names;
  for (const ArrayVariables& array : kArrays) names += std::string(names.empty() ? "" : ", ") + array.index;
  return names;
}

// With N as written, the array is taken to have the elements 1 to N, or 0 to N - 1 where its first is 0.
ChosenChunk chunk_of_written_count(const std::string& text, const ArrayVariables& array, std::uint32_t index, std::uint32_t first,
                                   std::uint32_t of) {
  const std::uint32_t from = first == 0 || array.counts_from == 0 ? 0 : 1;
  ChosenChunk chosen{{index - from + 1, of}, format("%s=%u, which counts from %u, of %u", array.index, index, from, of)};
  if (index >= from && chosen.chunk.number <= of) return chosen;
  refuse_chunk_text(text, format("%s=%u is not from %u to %u: give the array these elements, or write --chunk K/N", array.index, index,
                                 from, of - 1 + from));
}

// The array's elements are divided among themselves, whatever they are. Gaps only Slurm has, and there a count tells.
ChosenChunk chunk_of_array(const std::string& text, const Environment& environment, const ArrayVariables& array, std::uint32_t index,
                           std::uint32_t first) {
  const auto last = number_in(environment, array.last);
  if (!last) refuse_chunk_text(text, std::string(array.scheduler) + " does not say how many elements the array has: write auto/N");
  const std::uint32_t step = number_in(environment, array.step).value_or(1);
  if (index < first || *last < index || step == 0 || (index - first) % step != 0)
    refuse_chunk_text(text, format("%s=%u is not one of %u to %u by %u: write auto/N", array.index, index, first, *last, step));
  const Chunk chunk{(index - first) / step + 1, (*last - first) / step + 1};
  if (const auto count = number_in(environment, array.count); count && *count != chunk.of)
    refuse_chunk_text(text, format("the array has %u elements between %u and %u: write auto/N", *count, first, *last));
  return {chunk, format("%s=%u, which counts from %u, of %u", array.index, index, first, chunk.of)};
}

}  // namespace

ChosenChunk chunk_of(const std::string& text, const Environment& environment) {
  if (text.substr(0, 4) != "auto") return {written_chunk(text), ""};
  const std::uint32_t of = text.size() > 5 && text[4] == '/' ? whole_number(std::string_view(text).substr(5)).value_or(0) : 0;
  if (text.size() > 4 && (of == 0 || of > kLargestDivision))
    refuse_chunk_text(text, format("expected auto or auto/N, N chunks, at most %u", kLargestDivision));
  const ArrayVariables* const array = array_in(environment);
  if (array == nullptr) refuse_chunk_text(text, "none of " + known_indices() + " is set: write --chunk K/N, or start it in a job array");
  const std::uint32_t index = number_in(environment, array->index).value_or(0);  // array_in has read it
  const std::uint32_t first = number_in(environment, array->first).value_or(array->counts_from);
  return of > 0 ? chunk_of_written_count(text, *array, index, first, of) : chunk_of_array(text, environment, *array, index, first);
}

}  // namespace lasso::mdat
