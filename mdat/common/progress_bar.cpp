#include "mdat/common/progress_bar.hpp"

#include <unistd.h>

#include <algorithm>
#include <cstdio>

namespace lasso::mdat {
namespace {

constexpr int kBarWidth = 30;
constexpr double kRedrawSeconds = 0.1;

std::string bar(double share) {
  const int filled = static_cast<int>(share * kBarWidth);
  return "[" + std::string(static_cast<std::size_t>(filled), '#') + std::string(static_cast<std::size_t>(kBarWidth - filled), '.') + "]";
}

// Two figures of a slow one: "0.52 cases/s".
std::string rate_text(double rate, const std::string& unit) {
  char text[32];
  std::snprintf(text, sizeof text, rate < 9.95 ? "%.2g" : "%.0f", rate);
  return text + (" " + unit) + "/s";
}

}  // namespace

std::string clock_text(double seconds) {
  const long all = static_cast<long>(seconds + 0.5);
  char text[32];
  if (all >= 3600) {
    std::snprintf(text, sizeof text, "%ld:%02ld:%02ld", all / 3600, all / 60 % 60, all % 60);
  } else {
    std::snprintf(text, sizeof text, "%ld:%02ld", all / 60, all % 60);
  }
  return text;
}

ProgressBar::ProgressBar(std::string label, std::size_t total, std::string unit, double quiet_s)
    : label_(std::move(label)),
      unit_(std::move(unit)),
      total_(std::max<std::size_t>(total, 1)),
      quiet_s_(quiet_s),
      terminal_(isatty(STDERR_FILENO) == 1),
      begin_(std::chrono::steady_clock::now()),
      drawn_(begin_) {}

double ProgressBar::seconds() const { return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin_).count(); }

std::string ProgressBar::figures(std::size_t done) const {
  const double elapsed = seconds();
  const double rate = elapsed > 0 ? static_cast<double>(done) / elapsed : 0;
  char text[160];
  std::snprintf(text, sizeof text, "%3zu %%  %zu/%zu %s  ", 100 * done / total_, done, total_, unit_.c_str());
  std::string result = text + rate_text(rate, unit_);
  if (rate > 0) result += "  " + clock_text(static_cast<double>(total_ - done) / rate) + " left";
  return result;
}

void ProgressBar::draw(std::size_t done) const {
  const double share = static_cast<double>(done) / static_cast<double>(total_);
  if (terminal_) {
    std::fprintf(stderr, "\r%s %s %s\033[K", label_.c_str(), bar(share).c_str(), figures(done).c_str());
  } else {
    std::fprintf(stderr, "%s %s\n", label_.c_str(), figures(done).c_str());
  }
  std::fflush(stderr);
}

void ProgressBar::show(std::size_t done) {
  done = std::min(done, total_);
  if (terminal_) {
    const auto now = std::chrono::steady_clock::now();
    if (std::chrono::duration<double>(now - drawn_).count() < kRedrawSeconds) return;
    drawn_ = now;
    draw(done);
  } else if (const std::size_t tenth = 10 * done / total_; tenth > tenth_ && done < total_ && seconds() >= quiet_s_) {
    tenth_ = tenth;
    draw(done);
  }
}

void ProgressBar::finish() {
  const double elapsed = seconds();
  if (!terminal_ && elapsed < quiet_s_) return;
  std::fprintf(stderr, "%s%s: %zu %s in %s (%s)%s\n", terminal_ ? "\r" : "", label_.c_str(), total_, unit_.c_str(),
               clock_text(elapsed).c_str(), rate_text(elapsed > 0 ? static_cast<double>(total_) / elapsed : 0.0, unit_).c_str(),
               terminal_ ? "\033[K" : "");
}

}  // namespace lasso::mdat
