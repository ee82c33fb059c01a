// Draws by gnuplot, from scripts and data in a temporary folder of its own.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace lasso::mdat {

class Plotter {
 public:
  Plotter();   // throws RunError where no temporary folder can be made
  ~Plotter();  // removes the folder
  Plotter(const Plotter&) = delete;
  Plotter& operator=(const Plotter&) = delete;

  // Puts data into a file and returns its name as a script writes it, in quotes.
  std::string data(std::string_view content);

  // Runs a script and returns what it drew: an inline SVG element, or the bytes of a PNG file, all of it scaled. Width and height in
  // pixels before the scale. Throws RunError.
  std::string svg(int width, int height, const std::string& script);
  std::string png(int width, int height, double scale, const std::string& script);

 private:
  std::string draw(const std::string& terminal, const std::string& script);
  std::filesystem::path folder_;
  int files_ = 0;
};

// Throws RunError naming the package where gnuplot is missing.
void require_plotter();

}  // namespace lasso::mdat
