#include "mdat/campaign/pictures.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "mdat/common/limits.hpp"
#include "mdat/common/text.hpp"
#include "mdat/report/drawing.hpp"

namespace lasso::mdat {
namespace {

constexpr const char* kWithinColour = "#2563b8";
constexpr const char* kOutsideColour = "#c01028";
constexpr const char* kBoundColour = "#d4571e";
constexpr const char* kKey = "set key at screen 0.99,0.995 right top horizontal maxrows 1 samplen 1 width 1\n";
constexpr std::size_t kMostBins = 8, kLeastInBin = 10, kShownColumns = 3, kCurvePoints = 1000;
constexpr double kWide = 50, kSkewed = 7;  // largest to smallest value, largest to median of a logarithmic axis

bool is_outside(const ResultTable& table, const Finding& finding, std::size_t row) {
  return !is_within(finding.conclusion.criterion, table.rows[row], finding.figure);
}

// Not a number where the case failed to run.
double figure_value(const ResultTable& table, const Finding& finding, std::size_t row) {
  const CaseRow& one = table.rows[row];
  return one.has_run() ? one.figures[finding.figure] : std::nan("");
}

// Rows of one kind, at most kShownPoints, evenly.
template <class Kind>
std::vector<std::size_t> shown_rows(const ResultTable& table, const Kind& kind) {
  std::vector<std::size_t> rows, shown;
  for (std::size_t row = 0; row < table.rows.size(); ++row) {
    if (kind(row)) rows.push_back(row);
  }
  const std::size_t step = rows.size() / kShownPoints + 1;
  for (std::size_t i = 0; i < rows.size(); i += step) shown.push_back(rows[i]);
  return shown;
}

// A line a row: abscissa and ordinate of a case.
template <class X, class Y>
std::string points_of(const std::vector<std::size_t>& rows, const X& x, const Y& y) {
  std::string text;
  for (const std::size_t row : rows) text += format("%.6g %.6g\n", x(row), y(row));
  return text;
}

// What an axis shows of some values: all of them and, of a figure, its bounds.
class Span {
 public:
  void add(double value) {
    if (std::isfinite(value)) values_.push_back(value);
  }
  void sort() { std::sort(values_.begin(), values_.end()); }
  void widen(double bound) {
    if (!std::isfinite(bound)) return;
    below_ = std::min(below_, bound);
    above_ = std::max(above_, bound);
  }
  const std::vector<double>& values() const { return values_; }
  double low() const { return values_.empty() ? below_ : std::min(below_, values_.front()); }
  double high() const { return values_.empty() ? above_ : std::max(above_, values_.back()); }
  // A logarithmic axis: most values are small against the largest one, and against the smallest one large.
  bool is_wide() const {
    return !values_.empty() && low() > 0 && high() >= kWide * low() && values_[values_.size() / 2] < values_.back() / kSkewed;
  }
  // gnuplot's range with a margin; of nothing, or of one value, something around it.
  std::string range() const {
    if (low() > high()) return "[0:1]";
    if (is_wide()) return format("[%.6g:%.6g]", low() / 1.2, high() * 1.2);
    const double margin = high() > low() ? 0.04 * (high() - low()) : std::max(0.5, 0.1 * std::abs(high()));
    return format("[%.6g:%.6g]", low() - margin, high() + margin);
  }

 private:
  std::vector<double> values_;
  double below_ = std::numeric_limits<double>::infinity(), above_ = -below_;
};

Span figure_span(const ResultTable& table, const Finding& finding) {
  Span span;
  for (std::size_t row = 0; row < table.rows.size(); ++row) span.add(figure_value(table, finding, row));
  span.sort();
  span.widen(finding.conclusion.criterion.at_least);
  span.widen(finding.conclusion.criterion.at_most);
  return span;
}

Span column_span(const ResultTable& table, std::size_t column) {
  Span span;
  for (const CaseRow& row : table.rows) span.add(row.drawn[column]);
  span.sort();
  return span;
}

std::string axis(char name, const Span& span, const std::string& label) {
  std::string quoted = label;
  std::replace(quoted.begin(), quoted.end(), '\'', ' ');
  return format("%s logscale %c\nset %crange %s\nset %clabel '%s' noenhanced textcolor '#46505f'\n", span.is_wide() ? "set" : "unset", name,
                name, span.range().c_str(), name, quoted.c_str());
}

// The bounds of the figure as lines across the plot, at right angles to the axis that shows it.
std::string bound_lines(const Criterion& criterion, bool upright) {
  std::string text;
  for (const double bound : {criterion.at_least, criterion.at_most}) {
    if (!std::isfinite(bound)) continue;
    const std::string at = format("first %.9g", bound);
    const std::string from = upright ? at + ", graph 0" : "graph 0, " + at, to = upright ? at + ", graph 1" : "graph 1, " + at;
    text += "set arrow from " + from + " to " + to + " nohead front lw 1.2 dt 2 lc rgb '" + kBoundColour + "'\n";
  }
  return text;
}

// The share of all cases whose figure is not above each value: those without one are never below. kCurvePoints points at most.
std::string distribution_text(const Span& span, std::size_t cases) {
  const std::vector<double>& values = span.values();
  if (values.empty()) return "";
  const double percent = 100.0 / static_cast<double>(cases);
  std::string text = format("%.6g 0\n", values.front());
  const std::size_t step = values.size() / kCurvePoints + 1;
  for (std::size_t i = step - 1; i < values.size(); i += step)
    text += format("%.6g %.6g\n", values[i], percent * static_cast<double>(i + 1));
  const double end = span.is_wide() ? 2 * span.high() : span.high() + std::max(1.0, std::abs(span.high()));
  return text + format("%.6g %.6g\n", end, percent * static_cast<double>(values.size()));
}

// What cases that are not within are: without bounds only those without a value are not.
const char* outside_word(const Criterion& criterion) {
  return std::isfinite(criterion.at_least) || std::isfinite(criterion.at_most) ? "outside" : "no value";
}

Curve dots(const std::string& rows, const char* colour, double size, const char* title) {
  return {rows, 2, format(" with points pt 7 ps %g lc rgb '%s' title '%s'", size, colour, title)};
}

// Cases within and outside over two values of a case; those outside lie on top.
template <class X, class Y>
std::vector<Curve> case_dots(const ResultTable& table, const Finding& finding, const X& x, const Y& y) {
  const auto outside = shown_rows(table, [&](std::size_t row) { return is_outside(table, finding, row); });
  const auto within = shown_rows(table, [&](std::size_t row) { return !is_outside(table, finding, row); });
  return {dots(points_of(within, x, y), kWithinColour, 0.35, "within"),
          dots(points_of(outside, x, y), kOutsideColour, 0.5, outside_word(finding.conclusion.criterion))};
}

std::string outside_rates(const ResultTable& table, const Finding& finding, std::size_t column) {
  std::string text;
  for (const Bin& bin : bins_of(table, finding, column)) {
    const auto cases = static_cast<double>(bin.cases), outside = static_cast<double>(bin.outside);
    const Limits limits = share_limits(outside, cases, 0.95);
    text += format("%.6g %.6g %.6g %.6g %.6g %.6g\n", bin.mean, 100 * outside / cases, bin.low, bin.high, 100 * limits.lower,
                   100 * limits.upper);
  }
  return text;
}

void draw_figure_over(Drawing& drawing, const ResultTable& table, const Finding& finding, std::size_t column) {
  const auto x = [&](std::size_t row) { return table.rows[row].drawn[column]; };
  const auto y = [&](std::size_t row) { return figure_value(table, finding, row); };
  const auto unknown = shown_rows(table, [&](std::size_t row) { return std::isnan(y(row)); });
  const Span span = figure_span(table, finding);
  drawing.set(axis('x', column_span(table, column), table.columns[column]) + axis('y', span, finding.conclusion.criterion.figure) +
              bound_lines(finding.conclusion.criterion, false));
  std::vector<Curve> curves = case_dots(table, finding, x, y);
  curves.push_back({points_of(unknown, x, [](std::size_t) { return 0.985; }), 2,
                    format(" axes x1y2 with points pt 11 ps 0.5 lc rgb '%s' title 'no value'", kBoundColour), true});
  drawing.plot(curves, "no case has this figure", span.is_wide() ? Axis::kLogarithmic : Axis::kLinear);
  drawing.set("unset arrow\nunset key\n");
}

void draw_rates_over(Drawing& drawing, const ResultTable& table, const Finding& finding, std::size_t column) {
  drawing.set(axis('x', column_span(table, column), table.columns[column]) +
              format("set yrange [0:*]\nset ylabel '%s, %%' textcolor '#46505f'\n", outside_word(finding.conclusion.criterion)));
  drawing.plot({{outside_rates(table, finding, column), 2,
                 format(":3:4:5:6 with xyerrorbars pt 7 ps 0.5 lw 1.2 lc rgb '%s' notitle", kOutsideColour)}},
               "no cases");
}

std::size_t shown_columns(const Finding& finding) { return std::min(kShownColumns, finding.correlations.size()); }

// A vector's name, of its components and of its length; another column's own.
std::string vector_name(const std::string& column) {
  if (column.front() == '|') return column.substr(1, column.size() - 2);
  const std::size_t end = column.size() - std::min<std::size_t>(2, column.size());
  return std::string(".x.y.z").find(column.substr(end)) == std::string::npos ? column : column.substr(0, end);
}

// The strongest column, and the strongest of those that are no part of the same vector; nothing where there is none.
std::optional<std::pair<std::size_t, std::size_t>> strongest_pair(const ResultTable& table, const Finding& finding) {
  for (const Correlation& one : finding.correlations) {
    const std::size_t first = finding.correlations[0].column;
    if (vector_name(table.columns[one.column]) != vector_name(table.columns[first])) return std::pair{first, one.column};
  }
  return std::nullopt;
}

}  // namespace

bool has_pair(const ResultTable& table, const Finding& finding) { return strongest_pair(table, finding).has_value(); }

std::vector<Bin> bins_of(const ResultTable& table, const Finding& finding, std::size_t column) {
  std::vector<std::size_t> rows(table.rows.size());
  for (std::size_t i = 0; i < rows.size(); ++i) rows[i] = i;
  const auto value = [&](std::size_t i) { return table.rows[rows[i]].drawn[column]; };
  const auto place = [&](std::size_t row) { return std::pair(table.rows[row].drawn[column], row); };
  std::sort(rows.begin(), rows.end(), [&](std::size_t a, std::size_t b) { return place(a) < place(b); });
  const std::size_t count = std::clamp<std::size_t>(rows.size() / kLeastInBin, 1, kMostBins);
  std::vector<Bin> bins;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const bool is_full = bins.size() * rows.size() <= i * count;  // the next one begins where its share of all cases does
    if (bins.empty() || (is_full && value(i) > bins.back().high)) bins.push_back({value(i), value(i), 0, 0, 0});
    Bin& bin = bins.back();
    bin.high = value(i);
    bin.mean += (value(i) - bin.mean) / static_cast<double>(++bin.cases);
    bin.outside += is_outside(table, finding, rows[i]) ? 1U : 0U;
  }
  return bins;
}

std::string distribution_picture(Plotter& plotter, const ResultTable& table, const Finding& finding) {
  const auto pair = strongest_pair(table, finding);
  const Span span = figure_span(table, finding);
  Drawing drawing(plotter);
  drawing.set(format("set multiplot layout 1,%d margins 0.065,0.985,0.2,0.88 spacing 0.1,0\nset format '%%g'\nunset key\n", pair ? 2 : 1));
  drawing.set(axis('x', span, finding.conclusion.criterion.figure) +
              "set yrange [0:102]\nset ylabel 'cases not above, %' textcolor '#46505f'\n" +
              bound_lines(finding.conclusion.criterion, true));
  drawing.plot({{distribution_text(span, table.rows.size()), 2, format(" with steps lw 1.6 lc rgb '%s' notitle", kWithinColour)}},
               "no case has this figure");
  if (!pair) return drawing.svg(1080, 300);
  const auto [a, b] = *pair;
  const Span vertical = column_span(table, b);
  drawing.set(std::string("unset arrow\n") + kKey + axis('x', column_span(table, a), table.columns[a]) +
              axis('y', vertical, table.columns[b]));
  drawing.plot(case_dots(
                   table, finding, [&, x = a](std::size_t row) { return table.rows[row].drawn[x]; },
                   [&, y = b](std::size_t row) { return table.rows[row].drawn[y]; }),
               "no cases", vertical.is_wide() ? Axis::kLogarithmic : Axis::kLinear);
  return drawing.svg(1080, 340);
}

std::string columns_picture(Plotter& plotter, const ResultTable& table, const Finding& finding) {
  const std::size_t count = shown_columns(finding);
  const bool one = count == 1;
  Drawing drawing(plotter);
  drawing.set("set y2range [0:1]\n" + format("set multiplot layout %d,%zu margins 0.065,0.985,%s spacing 0.09,0.17\n", one ? 1 : 2,
                                             one ? 2 : count, one ? "0.2,0.88" : "0.11,0.93"));
  drawing.set(std::string("set format '%g'\n") + kKey);
  for (std::size_t i = 0; i < count; ++i) draw_figure_over(drawing, table, finding, finding.correlations[i].column);
  for (std::size_t i = 0; i < count; ++i) draw_rates_over(drawing, table, finding, finding.correlations[i].column);
  return drawing.svg(1080, one ? 340 : 600);
}

}  // namespace lasso::mdat
