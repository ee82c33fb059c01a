// Draws by gnuplot, from scripts and data in a folder of its own.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <string_view>

namespace lasso::mdat {

class Plotter {
 public:
  // Makes its folder below `parent`, which exists; where that fails, so does each figure.
  explicit Plotter(const std::filesystem::path& parent);
  ~Plotter();  // removes the folder
  Plotter(const Plotter&) = delete;
  Plotter& operator=(const Plotter&) = delete;

  // Puts data into a file and returns its name as a script writes it, in quotes.
  std::string data(std::string_view content);

  // Runs a script and returns what it drew: an inline SVG element, or the bytes of a PNG file, all of it scaled. Width and height in
  // pixels before the scale. gnuplot reads no settings of the user or of the machine. Throws PictureError with its last line.
  std::string svg(int width, int height, const std::string& script);
  std::string png(int width, int height, double scale, const std::string& script);

  // What `draw` returns, for a page; where it throws PictureError, a line that says why a figure is missing.
  std::string or_missing(const std::function<std::string()>& draw);
  // Why the first figure is missing; empty where none is.
  const std::string& missing() const { return missing_; }

 private:
  std::string draw(const std::string& terminal, const std::string& script);
  std::filesystem::path folder_;  // empty: none could be made
  std::string failure_, missing_;
  int files_ = 0;
};

// Why gnuplot cannot be run, and what to do; empty where it can.
std::string why_no_plotter();

}  // namespace lasso::mdat
