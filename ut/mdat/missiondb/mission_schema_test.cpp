#include "mdat/missiondb/mission_schema.hpp"

#include <toml++/toml.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <valijson/adapters/nlohmann_json_adapter.hpp>
#include <valijson/schema.hpp>
#include <valijson/schema_parser.hpp>
#include <valijson/validator.hpp>

#include "mdat/missiondb/mission_source.hpp"
#include "mdat/missiondb/sections.hpp"
#include "mdat/source/sha256.hpp"
#include "ut/mdat/missiondb/support.hpp"
#include "ut/support/verifies.hpp"

namespace lasso::mdat {
namespace {

using Json = nlohmann::json;

Json to_json(const toml::node& node) {
  if (const auto* table = node.as_table()) {
    Json object = Json::object();
    for (const auto& [key, value] : *table) object[std::string(key.str())] = to_json(value);
    return object;
  }
  if (const auto* array = node.as_array()) {
    Json list = Json::array();
    for (const auto& value : *array) list.push_back(to_json(value));
    return list;
  }
  if (const auto value = node.value_exact<bool>()) return *value;
  if (const auto value = node.value_exact<std::int64_t>()) return *value;
  if (const auto value = node.value_exact<double>()) return *value;
  if (const auto value = node.value_exact<std::string>()) return *value;
  return nullptr;
}

bool validates(const std::string& mission) {
  static const valijson::Schema& schema = [&]() -> const valijson::Schema& {
    static valijson::Schema parsed;
    const Json document = Json::parse(mission_schema_text());
    valijson::adapters::NlohmannJsonAdapter adapter(document);
    valijson::SchemaParser(valijson::SchemaParser::kDraft7).populateSchema(adapter, parsed);
    return parsed;
  }();
  const Json document = to_json(toml::parse(mission));
  valijson::Validator validator;
  valijson::adapters::NlohmannJsonAdapter target(document);
  return validator.validate(schema, target, nullptr);
}

TEST(MissionSchema, TheCommittedFileIsTheGeneratedOne) {
  VERIFIES("LASSO-GND-001~1");
  EXPECT_EQ(read_file(kSourceFolder / "cfg/mission.schema.json"), mission_schema_text());
}

TEST(MissionSchema, ShippedMissionsValidate) {
  VERIFIES("LASSO-GND-001~1 LASSO-GND-011~1");
  int missions = 0;
  for (const auto& entry : std::filesystem::directory_iterator(kSourceFolder / "cfg/missions")) {
    if (entry.path().extension() != ".toml") continue;
    ++missions;
    EXPECT_TRUE(validates(read_file(entry.path()))) << entry.path();
    EXPECT_EQ(mission_error_of([&] { static_cast<void>(load_target(load_mission(entry.path()))); }), "");
  }
  EXPECT_GE(missions, 1);
}

// The schema and the loader agree on what single values are good, for each row and values around its limits and of other types.
TEST(MissionSchema, AgreesWithTheLoaderOnEveryFlightParameter) {
  VERIFIES("LASSO-GND-001~1");
  const Folder folder;
  folder.write("box.toml", "[[part]]\nkind = 'box'\nsize = [1, 1, 1]\n");
  const std::string head =
      "[mission]\nid = 7\nversion = 2\nname = 'test'\n[target]\nmodel = 'box.toml'\n[scenario.s]\nvariants = true\nranges_m = [4]\n";
  for (const ValueRow& row : flight_rows()) {
    const double step = row.kind == ValueKind::kInteger ? 1 : 1e-6 * (row.maximum - row.minimum);
    const std::vector<std::string> values{number_text(row.minimum - step),
                                          number_text(row.maximum + step),
                                          "true",
                                          "'rosette'",
                                          "'true'",
                                          "[1]",
                                          "0.25",
                                          "1",
                                          "{}",
                                          "100000000"};
    for (const std::string& value : values) {
      const std::string mission = head + "override." + row.key + " = " + value + "\n";
      const std::string error = mission_error_of([&] { static_cast<void>(load_mission(folder.write("m.toml", mission))); });
      const bool contradiction = error.find("(scenario s)") != std::string::npos || error.find("override: ") != std::string::npos ||
                                 error.find("ranges_m") != std::string::npos;
      EXPECT_EQ(validates(mission), error.empty() || contradiction) << row.key << " = " << value << ": " << error;
    }
  }
}

TEST(MissionSchema, RefusesUnknownKeysAndMissingOnes) {
  VERIFIES("LASSO-GND-001~1");
  const std::string mission = read_file(kShippedMission);
  EXPECT_FALSE(validates(mission + "override.scan.pints = 3\n"));
  EXPECT_FALSE(validates(mission + "fames = 3\n"));
  EXPECT_FALSE(validates(mission + "[extra]\n"));
  EXPECT_FALSE(validates("[mission]\nid = 1\nversion = 1\nname = 'x'\n"));
  EXPECT_FALSE(validates("[mission]\nid = 1\nversion = 1\nname = 'x'\n[target]\nmodel = 'a.toml'\nmesh = 'a.stl'\n"));
}

TEST(MissionSchema, KnowsCampaigns) {
  VERIFIES("LASSO-GND-001~1 LASSO-GND-045~1");
  const std::string mission = read_file(kShippedMission) + "\n[campaign.c]\nscenario = 'spin'\ncases = 10\n";
  const std::string criterion = "criteria.good = { figure = 'wrong', at_most = 0, share_min = 0.9 }\n";
  EXPECT_TRUE(
      validates(mission + criterion +
                "truth = { range_m = { uniform = [2, 7] }, attitude = 'any', spin_degps = { any_direction = 3 }, offset_m = [{ normal = "
                "[0, 1], within = [-1, 1] }, 0], noise = true }\nmission.scan.points = { one_of = [256, 512], weights = [1, 2] }\n"
                "together = [{ keys = ['truth.drift_mps.x'], mean = [0], covariance = [[1]] }, { table = 't.csv', rows = 'drawn' }]\n"));
  for (const char* wrong :
       {"truth.rnage_m = 3", "truth.seed = 3", "truth.range_m = { unifrom = [2, 7] }", "truth.range_m = { uniform = [2] }",
        "truth.range_m = { uniform = [2, 7], normal = [3, 1] }", "truth.range_m = 'far'", "truth.offset_m = [1]", "truth.attitude = 'all'",
        "mission.scan.pints = 3", "sampling = 'lhs'", "seed = -1", "criteria.b.figure = 'wrongs'", "together = [{ tabel = 't.csv' }]"})
    EXPECT_FALSE(validates(mission + wrong + "\n")) << wrong;
}

}  // namespace
}  // namespace lasso::mdat
