#include "mdat/scene/motion_csv.hpp"

#include <algorithm>
#include <array>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "hal_sim/csv_table.hpp"
#include "hal_sim/scan_file.hpp"
#include "mdat/scene/file_text.hpp"
#include "mdat/source/nearest.hpp"

namespace lasso::mdat::scene {
namespace {

constexpr char kHeader[] = "time_s,x_m,y_m,z_m,qx,qy,qz,qw";

using Names = std::span<const std::string_view>;
constexpr std::array<std::string_view, 1> kTime{"time_s"};
constexpr std::array<std::string_view, 3> kPosition{"x_m", "y_m", "z_m"};
constexpr std::array<std::string_view, 3> kVelocity{"vx_mps", "vy_mps", "vz_mps"};
constexpr std::array<std::string_view, 4> kAttitude{"qx", "qy", "qz", "qw"};
constexpr std::array<std::string_view, 3> kOmega{"wx_radps", "wy_radps", "wz_radps"};

std::string_view without_unit(std::string_view name) { return name.substr(0, name.find('_')); }

// The places of a group of columns, all or none.
using Group = std::vector<std::size_t>;

class CsvMotion {
 public:
  CsvMotion(const std::string& text, const std::string& file) : place_{file}, problems_(place_), csv_(file, text, kHeader) {}

  MotionTable read() {
    find_columns();
    problems_.throw_if_any();  // rows mean nothing without their columns
    while (next()) read_row();
    check_table(table_, place_, problems_);
    problems_.throw_if_any();
    return std::move(table_);
  }

 private:
  void find_columns() {
    time_ = group(kTime, true);
    position_ = group(kPosition, has_any(kVelocity));
    velocity_ = group(kVelocity, false);
    attitude_ = group(kAttitude, has_any(kOmega));
    omega_ = group(kOmega, false);
    if (!has_any(kPosition) && !has_any(kAttitude)) complain("", "has neither positions (x_m, y_m, z_m) nor attitudes (qx, qy, qz, qw)");
    for (std::size_t i = 0; i < csv_.size(); ++i) check_name(csv_.name(i));
  }
  bool has(std::string_view name) const { return csv_.find({name}).has_value(); }
  bool has_any(Names names) const {
    return std::any_of(names.begin(), names.end(), [&](std::string_view name) { return has(name); });
  }
  Group group(Names names, bool needed) {
    Group places;
    if (!needed && !has_any(names)) return places;
    for (const std::string_view name : names) {
      if (const auto place = csv_.find({name})) {
        places.push_back(*place);
      } else {
        complain(std::string(name), std::string("is missing: expected a header such as ") + kHeader);
      }
    }
    return places;
  }
  // A name that is none of ours, and one of these that are not there but for its unit or a slip.
  void check_name(const std::string& name) {
    std::vector<std::string> absent;
    std::string meant;
    for (const Names names : {Names(kTime), Names(kPosition), Names(kVelocity), Names(kAttitude), Names(kOmega)}) {
      for (const std::string_view known : names) {
        if (known == name) return;
        if (has(known)) continue;
        absent.emplace_back(known);
        if (without_unit(known) == without_unit(name)) meant = known;
      }
    }
    if (meant.empty()) meant = nearest(name, absent);
    if (!meant.empty()) complain(name, "is no column of a motion; did you mean " + meant + "? Units are s, m, m/s and rad/s");
  }
  void complain(const std::string& column, const std::string& expected) {
    problems_.add_at({place_.file, static_cast<int>(csv_.line()), 1}, column, "", expected);
  }

  bool next() {
    for (;;) {
      try {
        return csv_.next();
      } catch (const sim::ScanFileError& error) {
        add_error(error, place_.file, problems_);
      }
    }
  }
  std::optional<std::vector<double>> numbers(const Group& places) {
    std::vector<double> values;
    for (const std::size_t place : places) {
      try {
        values.push_back(csv_.number(place));
      } catch (const sim::ScanFileError& error) {
        add_error(error, place_.file, problems_);
      }
    }
    return values.size() == places.size() ? std::optional(values) : std::nullopt;
  }
  // A row with a problem is left out, after all its problems were told.
  void read_row() {
    const auto time = numbers(time_), position = numbers(position_), velocity = numbers(velocity_);
    const auto attitude = numbers(attitude_), omega = numbers(omega_);
    if (!time || !position || !velocity || !attitude || !omega) return;
    table_.times_s.push_back(time->front());
    table_.lines.push_back(static_cast<int>(csv_.line()));
    if (!position->empty()) table_.positions_m.emplace_back(position->data());
    if (!velocity->empty()) table_.velocities_mps.emplace_back(velocity->data());
    if (!attitude->empty()) table_.attitudes.emplace_back(attitude->data());  // Eigen's order in memory: scalar last
    if (!omega->empty()) table_.omegas_radps.emplace_back(omega->data());
  }

  Place place_;
  Problems problems_;
  sim::CsvTable csv_;
  MotionTable table_;
  Group time_, position_, velocity_, attitude_, omega_;
};

}  // namespace

MotionTable parse_motion_csv(const std::string& text, const std::string& file) {
  try {
    return CsvMotion(text, file).read();
  } catch (const sim::ScanFileError& error) {  // of the header
    Problems problems({file});
    add_error(error, file, problems);
    problems.throw_if_any();
  }
  return {};
}

MotionTable read_motion_csv(const std::filesystem::path& file) { return parse_motion_csv(text_of_file(file), file.string()); }

}  // namespace lasso::mdat::scene
