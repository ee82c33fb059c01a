#include "mdat/report/plotter.hpp"

#include <cstdlib>
#include <fstream>
#include <system_error>

#include "mdat/common/errors.hpp"
#include "mdat/common/output.hpp"
#include "mdat/common/text.hpp"

namespace lasso::mdat {
namespace {

std::string quoted(const std::string& text) { return "'" + text + "'"; }

// Of an SVG file only the element: it stands inside of an HTML page.
std::string element_of(const std::string& svg) {
  const std::size_t begin = svg.find("<svg");
  return begin == std::string::npos ? svg : svg.substr(begin);
}

std::string size_text(int width, int height) { return " size " + std::to_string(width) + "," + std::to_string(height); }

}  // namespace

Plotter::Plotter() {
  std::error_code error;
  std::string name = (std::filesystem::temp_directory_path(error) / "mdat-plot-XXXXXX").string();
  if (error || mkdtemp(name.data()) == nullptr) throw RunError(name + ": no temporary folder can be made for the figures");
  folder_ = name;
}

Plotter::~Plotter() {
  std::error_code ignored;
  std::filesystem::remove_all(folder_, ignored);
}

std::string Plotter::data(std::string_view content) {
  const std::string name = "data" + std::to_string(files_++);
  std::ofstream(folder_ / name, std::ios::binary).write(content.data(), static_cast<std::streamsize>(content.size()));
  return quoted(name);
}

std::string Plotter::svg(int width, int height, const std::string& script) {
  return element_of(
      draw("svg" + size_text(width, height) + " dynamic enhanced font 'Arial,13' linewidth 1.2 background '#ffffff'", script));
}

std::string Plotter::png(int width, int height, double scale, const std::string& script) {
  const std::string size = size_text(static_cast<int>(scale * width), static_cast<int>(scale * height));
  return draw(
      "pngcairo" + size +
          format(" enhanced font 'Sans,14' fontscale %g pointscale %g linewidth %g background '#ffffff'", scale, scale, 1.5 * scale),
      script);
}

std::string Plotter::draw(const std::string& terminal, const std::string& script) {
  const std::filesystem::path output = folder_ / "figure", messages = folder_ / "messages";
  std::ofstream(folder_ / "script") << "set encoding utf8\nset terminal " << terminal << "\nset output 'figure'\n"
                                    << script << "\nunset output\n";
  const std::string command = "cd " + quoted(folder_.string()) + " && gnuplot script >messages 2>&1";
  const int code = std::system(command.c_str());  // NOLINT(bugprone-command-processor): the folder, all that varies in it, is quoted
  if (code != 0) throw RunError("gnuplot failed (code " + std::to_string(code) + "): " + file_content(messages));
  return file_content(output);
}

void require_plotter() {
  // NOLINTNEXTLINE(bugprone-command-processor): nothing varies in it
  if (std::system("gnuplot --version >/dev/null 2>&1") != 0) {
    throw RunError("gnuplot cannot be run; the report needs the package gnuplot-nox (or run with --no-report)");
  }
}

}  // namespace lasso::mdat
