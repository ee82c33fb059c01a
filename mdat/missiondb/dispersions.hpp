// What a campaign's tables disperse, gathered while they are read: no column twice. Inside of missiondb.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "mdat/missiondb/toml_reader.hpp"

namespace lasso::mdat {

class Dispersions {
 public:
  Dispersions(MissionSource& source, ProblemList& problems) : source_(source), problems_(problems) {}

  // `key`, at `origin`, says this law.
  void add(Dispersion dispersion, const std::string& key, Origin origin);
  std::vector<Dispersion> take() { return std::move(all_); }

  MissionSource& source() { return source_; }
  ProblemList& problems() { return problems_; }

 private:
  MissionSource& source_;
  ProblemList& problems_;
  std::vector<Dispersion> all_;
  std::map<std::string, std::string> keys_;  // by column
};

// One [[campaign.NAME.together]]: a covariance, or a table of a file. `key` is its own: "campaign.NAME.together[0]".
void read_together(const toml::table& table, const std::string& key, Dispersions& dispersions);

}  // namespace lasso::mdat
