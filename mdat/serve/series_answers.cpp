// Values over time: decimated, as figures, as a table.
#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "mdat/common/text.hpp"
#include "mdat/serve/answers.hpp"
#include "mdat/serve/bits.hpp"

namespace lasso::mdat::serve {
namespace {

using Json = nlohmann::ordered_json;

constexpr float kNone = std::numeric_limits<float>::quiet_NaN();

struct Series {
  std::vector<double> time_s;
  std::vector<float> least, most, last;
};

// The rows [begin, end) as one point at the first one's time. Values that are absent do not count.
void add_point(const std::vector<double>& time_s, const std::vector<float>& column, RowSpan rows, Series& series) {
  float least = kNone, most = kNone;
  for (std::size_t i = rows.begin; i < rows.end; ++i) {
    if (std::isnan(column[i])) continue;
    least = std::isnan(least) ? column[i] : std::min(least, column[i]);
    most = std::isnan(most) ? column[i] : std::max(most, column[i]);
  }
  series.time_s.push_back(time_s[rows.begin]);
  series.least.push_back(least);
  series.most.push_back(most);
  series.last.push_back(column[rows.end - 1]);
}

// At most `points` of them: every row, or the least, the greatest and the last of each of `points` equal times.
Series decimated(const std::vector<double>& time_s, const std::vector<float>& column, RowSpan rows, std::size_t points) {
  Series series;
  if (rows.end - rows.begin <= points) {
    for (std::size_t i = rows.begin; i < rows.end; ++i) add_point(time_s, column, {i, i + 1}, series);
    return series;
  }
  const double begin_s = time_s[rows.begin], step_s = (time_s[rows.end - 1] - begin_s) / static_cast<double>(points);
  std::size_t at = rows.begin;
  for (std::size_t point = 1; point <= points && at < rows.end; ++point) {
    const auto last = time_s.begin() + static_cast<std::ptrdiff_t>(rows.end);
    const auto bound =
        std::upper_bound(time_s.begin() + static_cast<std::ptrdiff_t>(at), last, begin_s + step_s * static_cast<double>(point));
    const std::size_t end = point == points ? rows.end : static_cast<std::size_t>(bound - time_s.begin());
    if (end > at) add_point(time_s, column, {at, end}, series);
    at = end;
  }
  return series;
}

// By nearest rank. `values` ascending, at least one.
double quantile(const std::vector<double>& values, double share) {
  const auto rank = static_cast<std::size_t>(std::ceil(share * static_cast<double>(values.size())));
  return values[std::max<std::size_t>(rank, 1) - 1];
}

Json statistics_json(std::vector<double> values) {
  Json json = {{"count", values.size()}};
  if (values.empty()) {
    for (const char* key : {"mean", "sigma", "min", "max", "rms", "median", "p95"}) json[key] = nullptr;
    return json;
  }
  double sum = 0, squares = 0, deviations = 0;
  for (const double value : values) sum += value;
  const double count = static_cast<double>(values.size()), mean = sum / count;
  for (const double value : values) {
    squares += value * value;
    deviations += (value - mean) * (value - mean);
  }
  std::sort(values.begin(), values.end());
  json["mean"] = mean;
  json["sigma"] = std::sqrt(deviations / count);
  json["min"] = values.front();
  json["max"] = values.back();
  json["rms"] = std::sqrt(squares / count);
  json["median"] = quantile(values, 0.5);
  json["p95"] = quantile(values, 0.95);
  return json;
}

// A column of a table, and how far its rows have been written.
struct Cursor {
  const std::vector<double>* time_s;
  const std::vector<float>* column;
  RowSpan rows;
};

std::string cell(float value) {
  const auto wide = static_cast<double>(value);
  return std::isfinite(wide) ? format(",%.9g", wide) : std::string(",");
}

// A row for each time at which any of them has one; cells of the others are empty.
std::string rows_text(std::vector<Cursor> cursors) {
  std::string text;
  while (true) {
    double now_s = std::numeric_limits<double>::infinity();
    for (const Cursor& cursor : cursors) {
      if (cursor.rows.begin < cursor.rows.end) now_s = std::min(now_s, (*cursor.time_s)[cursor.rows.begin]);
    }
    if (std::isinf(now_s)) return text;
    text += format("%.6f", now_s);
    for (Cursor& cursor : cursors) {
      const bool has = cursor.rows.begin < cursor.rows.end && (*cursor.time_s)[cursor.rows.begin] <= now_s;
      text += has ? cell((*cursor.column)[cursor.rows.begin++]) : ",";
    }
    text += "\n";
  }
}

// A file's name that needs no quotes: letters, digits, dots, dashes; others as an underscore.
std::string plain_name(std::string name) {
  name = name.substr(name.find_last_of('/') + 1);
  for (char& c : name) c = std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '.' || c == '-' ? c : '_';
  return name.substr(0, name.rfind(".mcap"));
}

}  // namespace

const Value& value_in(const Shown& shown, const std::string& id) {
  if (id.empty()) throw Refusal{400, "no value is named", "add value=ID, of the recording's values"};
  const Value* value = shown.recording->value(id);
  if (value == nullptr) throw Refusal{404, "there is no value " + id.substr(0, 80), "choose one of the recording's values"};
  return *value;
}

RowSpan rows_in(const std::vector<double>& time_s, const Target& target) {
  constexpr double kEnds = std::numeric_limits<double>::max();
  const double from_s = number_in(target, "from_s", -kEnds), to_s = number_in(target, "to_s", kEnds);
  const auto begin = std::lower_bound(time_s.begin(), time_s.end(), from_s);
  const auto end = std::upper_bound(begin, time_s.end(), std::max(from_s, to_s));
  return {static_cast<std::size_t>(begin - time_s.begin()), static_cast<std::size_t>(end - time_s.begin())};
}

Response series_answer(const Shown& shown, const Target& target) {
  const Value& value = value_in(shown, text_in(target, "value"));
  const std::size_t points = std::max<std::size_t>(count_in(target, "points", 1000, kMostPoints), 2);
  const std::vector<double>& time_s = shown.recording->table(value).time_s;
  const Series series = decimated(time_s, shown.recording->column(value), rows_in(time_s, target), points);
  std::string bytes;
  mcap::put(static_cast<std::uint32_t>(series.time_s.size()), bytes);
  put_all(series.time_s, bytes);
  put_all(series.least, bytes);
  put_all(series.most, bytes);
  put_all(series.last, bytes);
  return binary_response(std::move(bytes));
}

Response statistics_answer(const Shown& shown, const Target& target) {
  const Value& value = value_in(shown, text_in(target, "value"));
  const std::vector<float>& column = shown.recording->column(value);
  const RowSpan rows = rows_in(shown.recording->table(value).time_s, target);
  std::vector<double> values;
  for (std::size_t i = rows.begin; i < rows.end; ++i) {
    if (std::isfinite(column[i])) values.push_back(static_cast<double>(column[i]));
  }
  return json_response(statistics_json(std::move(values)).dump());
}

Response csv_answer(const Shown& shown, const Target& target) {
  const std::vector<std::string> ids = list_in(target, "values");
  if (ids.empty() || ids.size() > kMostColumns)
    throw Refusal{400, format("%zu values are named", ids.size()), format("name 1 to %zu: values=ID,ID", kMostColumns)};
  Response response;
  response.type = "text/csv; charset=utf-8";
  response.body = "time_s";
  std::vector<Cursor> cursors;
  for (const std::string& id : ids) {
    const Value& value = value_in(shown, id);
    const std::vector<double>& time_s = shown.recording->table(value).time_s;
    response.body += "," + value.id + " [" + value.unit + "]";
    cursors.push_back({&time_s, &shown.recording->column(value), rows_in(time_s, target)});
  }
  response.body += "\n" + rows_text(std::move(cursors));
  response.headers = {{"Content-Disposition", "attachment; filename=\"" + plain_name(shown.name) + ".csv\""}};
  return response;
}

}  // namespace lasso::mdat::serve
