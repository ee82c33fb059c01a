// How far a long command is: a bar with rate and time left on a terminal, a plain line now and then elsewhere. On standard error.
#pragma once

#include <chrono>
#include <cstddef>
#include <string>

namespace lasso::mdat {

// "1:05", "2:00:00"
std::string clock_text(double seconds);

class ProgressBar {
 public:
  // `total` steps of `unit` ("frames") are to come. Off a terminal nothing is said of what takes less than `quiet_s`.
  ProgressBar(std::string label, std::size_t total, std::string unit, double quiet_s = 0);
  // Shows `done` steps, at most ten times a second (terminal) or at each tenth of the whole (no terminal).
  void show(std::size_t done);
  // No more steps come than `done`, though more were to.
  void end_at(std::size_t done) { total_ = done; }
  // The last line, with the time taken.
  void finish();

 private:
  double seconds() const;
  std::string figures(std::size_t done) const;
  void draw(std::size_t done) const;
  std::string label_, unit_;
  std::size_t total_;
  double quiet_s_;
  bool terminal_;
  std::chrono::steady_clock::time_point begin_, drawn_;
  std::size_t tenth_ = 0;
};

}  // namespace lasso::mdat
