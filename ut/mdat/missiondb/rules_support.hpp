// Missions for the tests of rules: a shipped one with some values changed, as a person would write them.
#pragma once

#include <algorithm>
#include <sstream>
#include <string>

#include "mdat/missiondb/mission_source.hpp"
#include "ut/mdat/missiondb/support.hpp"

namespace lasso::mdat {

// A box of 2 m x 1 m x 1 m about its origin, seen by a laser camera at 5 m: nothing is doubtful about it.
class RuleTest : public ::testing::Test {
 protected:
  RuleTest() { folder_.write("box.toml", "[[part]]\nkind = 'box'\nsize = [2, 1, 1]\n"); }

  // What is said of the mission whose flight parameters and target's values are these lines of TOML ("scan.points = 64"), and whose
  // scenario `s`, at 5 m, has those. Errors begin with "error: ", doubts with "warning: ".
  std::string said(const std::string& values, const std::string& scenario = kScenario) {
    return said_of("[mission]\nid = 7\nversion = 2\nname = 'test'\n[target]\nmodel = 'box.toml'\n", values,
                   "[scenario.s]\n" + scenario + "\n");
  }

  void expect_said(const std::string& text, const std::string& key, const std::string& figure) {
    EXPECT_NE(text.find(key), std::string::npos) << "expected " << key << ", got: " << text;
    EXPECT_NE(text.find(figure), std::string::npos) << "expected " << figure << ", got: " << text;
  }

  // Nothing is said of `good`, just inside of the rule, and one thing of `bad`, just outside: of that key, with that figure.
  void expect_edge(const std::string& good, const std::string& bad, const std::string& key, const std::string& figure,
                   const std::string& scenario = kScenario) {
    EXPECT_EQ(said(good, scenario), "") << good;
    const std::string text = said(bad, scenario);
    expect_said(text, key, figure);
    EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 1) << bad << ": " << text;
  }

  // The same of the scenario's values.
  void expect_scenario_edge(const std::string& good, const std::string& bad, const std::string& key, const std::string& figure,
                            const std::string& values = "") {
    EXPECT_EQ(said(values, good), "") << good;
    const std::string text = said(values, bad);
    expect_said(text, key, figure);
    EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 1) << bad << ": " << text;
  }

  static constexpr const char* kScenario = "ranges_m = [5]";
  Folder folder_;

 private:
  // Dotted keys go before all tables, and those of [target] into it.
  std::string said_of(std::string head, const std::string& values, const std::string& tail) {
    std::string others, line;
    for (std::istringstream lines(values); std::getline(lines, line);) {
      constexpr std::size_t kTarget = sizeof("target.") - 1;
      (line.rfind("target.", 0) == 0 ? head : others) += line.substr(line.rfind("target.", 0) == 0 ? kTarget : 0) + "\n";
    }
    try {
      MissionSource source = load_mission(folder_.write("m.toml", others + head + tail));
      check_target(source, load_target(source));
      std::string text;
      for (const std::string& warning : warnings_for(source, "")) text += "warning: " + warning + "\n";
      return text;
    } catch (const MissionError& error) {
      return "error: " + std::string(error.what()) + "\n";
    }
  }
};

}  // namespace lasso::mdat
