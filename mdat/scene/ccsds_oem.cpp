#include <charconv>

#include "mdat/scene/ccsds.hpp"
#include "mdat/scene/ccsds_kvn.hpp"
#include "mdat/scene/file_text.hpp"

namespace lasso::mdat::scene {
namespace {

constexpr double kMetresPerKilometre = 1000;

void read_interpolation(KvnMessage& message, MotionTable& table) {
  const std::string method = message.choice("INTERPOLATION", {"HERMITE", "LAGRANGE", "LINEAR"}, false);
  if (method == "LAGRANGE" || method == "LINEAR") table.interpolation = Interpolation::kLagrange;
  if (method == "LINEAR") table.degree = 1;
  const std::string degree = message.value("INTERPOLATION_DEGREE");
  if (degree.empty()) {
    if (method == "HERMITE" || method == "LAGRANGE")
      message.complain("INTERPOLATION_DEGREE", "is missing: expected it beside INTERPOLATION");
    return;
  }
  int found = 0;
  const auto [end, error] = std::from_chars(degree.data(), degree.data() + degree.size(), found);
  if (error != std::errc() || end != degree.data() + degree.size()) {
    message.complain("INTERPOLATION_DEGREE", "expected a whole number");
  } else if (method == "LINEAR" && found != 1) {
    message.complain("INTERPOLATION_DEGREE", "expected 1 beside LINEAR");
  } else {
    table.degree = found;
  }
}

}  // namespace

Ephemeris parse_oem(const std::string& text, const std::string& file, const std::vector<std::string>& frames) {
  Problems problems({file});
  KvnMessage message(text, file, "OEM", problems);
  Ephemeris ephemeris = message.header({"1.0", "2.0", "3.0"});
  ephemeris.frame = message.known_frame({"REF_FRAME"}, frames);
  MotionTable& table = ephemeris.table;
  read_interpolation(message, table);
  for (const KvnRow& row : message.rows({6, 9}, "X Y Z X_DOT Y_DOT Z_DOT, in km and km/s, and perhaps accelerations")) {
    if (table.times_s.empty()) ephemeris.first = row.epoch;
    table.times_s.push_back(seconds_between(ephemeris.first, row.epoch));
    table.lines.push_back(row.line);
    table.positions_m.emplace_back(kMetresPerKilometre * Vec3(row.numbers.data()));
    table.velocities_mps.emplace_back(kMetresPerKilometre * Vec3(row.numbers.data() + 3));
  }
  message.check(table, "INTERPOLATION_DEGREE");
  return ephemeris;
}

Ephemeris read_oem(const std::filesystem::path& file, const std::vector<std::string>& frames) {
  return parse_oem(text_of_file(file), file.string(), frames);
}

}  // namespace lasso::mdat::scene
