// Laws of several columns at once: [[campaign.NAME.together]].
#include <Eigen/Eigenvalues>
#include <cmath>

#include "hal_sim/csv_table.hpp"
#include "mdat/missiondb/beside.hpp"
#include "mdat/missiondb/campaign_columns.hpp"
#include "mdat/missiondb/campaign_rows.hpp"
#include "mdat/missiondb/dispersions.hpp"
#include "mdat/missiondb/law_reader.hpp"
#include "mdat/missiondb/rule.hpp"
#include "mdat/source/nearest.hpp"
#include "mdat/source/sha256.hpp"

namespace lasso::mdat {
namespace {

std::string no_such_column(const std::string& name) {
  std::vector<std::string> names;
  for (const CampaignColumn& column : campaign_columns()) names.push_back(column.name);
  const std::string meant = did_you_mean(name, names);
  return "no such column" +
         (meant.empty() ? "; expected names such as truth.range_m, truth.offset_m.x, mission.estimation.surface_sigma_m" : meant);
}

double least_eigenvalue(const Eigen::MatrixXd& symmetric) {
  return Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(symmetric, Eigen::EigenvaluesOnly).eigenvalues()[0];
}

class TogetherReader {
 public:
  TogetherReader(const toml::table& table, const std::string& key, Dispersions& dispersions)
      : table_(table), key_(key), dispersions_(dispersions), problems_(dispersions.problems()) {}

  void read() {
    found_ = read_table(table_, key_ + ".", together_rows(), {"covariance"}, problems_);
    const bool by_table = table_.contains("table");
    const bool by_matrix = table_.contains("keys") && table_.contains("mean") && table_.contains("covariance");
    const bool mixed =
        by_table ? table_.contains("keys") || table_.contains("mean") || table_.contains("covariance") : table_.contains("rows");
    if (by_table == by_matrix || mixed)
      return problems_.add(origin_of(table_.source()), key_, "",
                           "expected keys, mean and covariance (a normal law), or table and rows (of a CSV file)");
    if (by_table) {
      read_file_table();
    } else {
      read_normal();
    }
  }

 private:
  void complain(const std::string& part, const std::string& value, const std::string& why) {
    const auto found = found_.find(part);
    const toml::node* node = table_.get(part);
    problems_.add(found != found_.end() ? found->second.origin : origin_of(node == nullptr ? table_.source() : node->source()),
                  key_ + "." + part, value, why);
  }

  // Pointers into campaign_columns(); empty where a name is wrong.
  std::vector<const CampaignColumn*> columns_named(const std::vector<std::string>& names) {
    std::vector<const CampaignColumn*> columns;
    for (const std::string& name : names) {
      const CampaignColumn* column = find_column(name);
      if (column == nullptr) {
        complain("keys", '"' + name + '"', no_such_column(name));
      } else if (column->row.kind != ValueKind::kReal && column->row.kind != ValueKind::kReals) {
        complain("keys", '"' + name + '"', "has no normal law: " + expectation(column->row));
      } else {
        columns.push_back(column);
      }
    }
    return columns.size() == names.size() ? columns : std::vector<const CampaignColumn*>{};
  }

  void read_normal() {
    const std::vector<std::string> names = texts_of(found_, "keys");
    const std::vector<const CampaignColumn*> columns = columns_named(names);
    if (columns.empty() || found_.count("mean") == 0) return;
    Correlated law{found_["mean"].numbers, {}, {}, {}};
    if (law.mean.size() != names.size())
      return complain("mean", "",
                      "expected as many numbers as keys: " + std::to_string(names.size()) + ", not " + std::to_string(law.mean.size()));
    if (!read_covariance(names.size(), law.covariance) || !is_definite(law) || !fits(law, columns)) return;
    for (const CampaignColumn* column : columns) {
      law.low.push_back(column->row.minimum);
      law.high.push_back(column->row.maximum);
    }
    dispersions_.add({names, law}, key_, origin_of(table_.source()));
  }
  bool read_covariance(std::size_t size, std::vector<double>& matrix) {
    ValueRow line;
    line.kind = ValueKind::kReals;
    line.minimum = -1e12;
    line.maximum = 1e12;
    line.count_min = line.count_max = size;
    const toml::array* lines = table_.get("covariance")->as_array();
    if (lines == nullptr || lines->size() != size) {
      complain("covariance", "",
               "expected a square matrix, " + std::to_string(size) + " lists of " + std::to_string(size) +
                   " numbers, as there are as many keys");
      return false;
    }
    for (std::size_t i = 0; i < size; ++i) {
      const auto numbers = read_value((*lines)[i], line, key_ + ".covariance[" + std::to_string(i) + "]", problems_);
      if (numbers) matrix.insert(matrix.end(), numbers->numbers.begin(), numbers->numbers.end());
    }
    return matrix.size() == size * size && is_symmetric(matrix, size);
  }
  bool is_symmetric(const std::vector<double>& matrix, std::size_t size) {
    for (std::size_t i = 0; i < size; ++i) {
      for (std::size_t j = 0; j < i; ++j) {
        const double a = matrix[i * size + j], b = matrix[j * size + i];
        if (a == b) continue;
        complain("covariance", "",
                 "is not symmetric: row " + std::to_string(i + 1) + ", column " + std::to_string(j + 1) + " is " + number_text(a) +
                     ", row " + std::to_string(j + 1) + ", column " + std::to_string(i + 1) + " is " + number_text(b));
        return false;
      }
    }
    return true;
  }
  // By the correlations, as keys may have units of any size.
  bool is_definite(const Correlated& law) {
    const auto size = static_cast<Eigen::Index>(law.mean.size());
    const Eigen::Map<const Eigen::MatrixXd> covariance(law.covariance.data(), size, size);
    for (Eigen::Index i = 0; i < size; ++i) {
      if (covariance(i, i) > 0) continue;
      complain("covariance", "",
               "the variance of " + texts_of(found_, "keys")[static_cast<std::size_t>(i)] + " is " + number_text(covariance(i, i)) +
                   ": expected more than 0");
      return false;
    }
    const Eigen::VectorXd inverse = covariance.diagonal().cwiseSqrt().cwiseInverse();
    constexpr double kLeastEigenvalue = 1e-10;
    if (least_eigenvalue(inverse.asDiagonal() * covariance * inverse.asDiagonal()) > kLeastEigenvalue) return true;
    complain("covariance", "",
             "is not positive definite: its smallest eigenvalue is " + figure(least_eigenvalue(covariance)) +
                 "; make the covariances smaller, or leave out a key that follows from the others");
    return false;
  }
  bool fits(const Correlated& law, const std::vector<const CampaignColumn*>& columns) {
    bool good = true;
    for (std::size_t i = 0; i < columns.size(); ++i) {
      const double sigma = std::sqrt(law.covariance[i * columns.size() + i]);
      const ValueRow& row = columns[i]->row;
      if (law.mean[i] - kReach * sigma >= row.minimum && law.mean[i] + kReach * sigma <= row.maximum) continue;
      good = false;
      complain("covariance", "",
               columns[i]->name + " is out of range: " + reach_text(law.mean[i], sigma) + ", expected " + range_text(row) +
                   ": make its variance smaller");
    }
    return good;
  }

  void read_file_table() {
    const std::vector<std::string> written = texts_of(found_, "table");
    if (written.empty()) return;
    std::filesystem::path file;
    if (!find_beside(dispersions_.source(), written[0], file))
      return complain(
          "table", '"' + written[0] + '"',
          "no such file in " + std::filesystem::absolute(dispersions_.source().file).parent_path().string() + " or the folder above it");
    try {
      read_rows(file, written[0]);
    } catch (const std::runtime_error& error) {
      complain("table", '"' + written[0] + '"', error.what());
    }
  }
  void read_rows(const std::filesystem::path& file, const std::string& written) {
    const std::string text = read_file(file);
    sim::CsvTable csv(file.string(), text, "truth.range_m,truth.roll_deg");
    Rows law{written, found_.count("rows") == 0 || found_["rows"].numbers[0] == 0, {}};
    std::vector<std::size_t> places;
    const std::vector<const CampaignColumn*> columns = columns_of_file(csv, places);
    if (columns.empty()) return;
    while (csv.next()) {
      for (std::size_t i = 0; i < columns.size(); ++i) law.values.push_back(cell(csv, places[i], columns[i]->row));
    }
    if (law.values.empty())
      return complain("table", '"' + written + '"', file.string() + ": has no row under its header: add at least one");
    Dispersion dispersion{{}, law};
    for (const CampaignColumn* column : columns) dispersion.columns.push_back(column->name);
    dispersions_.add(dispersion, key_, origin_of(table_.source()));
  }
  // `case` and `seed`, which a table of cases has, are of that table alone.
  std::vector<const CampaignColumn*> columns_of_file(const sim::CsvTable& csv, std::vector<std::size_t>& places) {
    std::vector<const CampaignColumn*> columns;
    bool good = true;
    for (std::size_t i = 0; i < csv.size(); ++i) {
      const std::string& name = csv.name(i);
      if (name == "case" || name == "seed") continue;
      const CampaignColumn* column = find_column(name);
      if (column == nullptr) complain("table", '"' + name + '"', csv.place() + ": " + no_such_column(name));
      good = good && column != nullptr;
      columns.push_back(column);
      places.push_back(i);
    }
    if (good && columns.empty()) complain("table", "", csv.place() + ": has no column to vary, such as truth.range_m");
    return good ? columns : std::vector<const CampaignColumn*>{};
  }
  static double cell(const sim::CsvTable& csv, std::size_t place, const ValueRow& row) {
    const double value = csv.number(place);
    const bool whole = row.kind == ValueKind::kReal || row.kind == ValueKind::kReals || value == std::trunc(value);
    if (whole && value >= row.minimum && value <= row.maximum) return value;
    throw std::runtime_error(csv.place(place) + ": " + csv.name(place) + " is " + number_text(value) + ", expected " +
                             (whole ? "" : "a whole number from ") + range_text(row));
  }

  const toml::table& table_;
  const std::string& key_;
  Dispersions& dispersions_;
  ProblemList& problems_;
  FoundValues found_;
};

}  // namespace

void read_together(const toml::table& table, const std::string& key, Dispersions& dispersions) {
  TogetherReader(table, key, dispersions).read();
}

}  // namespace lasso::mdat
