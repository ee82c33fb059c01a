#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "mdat/serve/answers.hpp"
#include "ut/mdat/serve/small_recording.hpp"
#include "ut/support/verifies.hpp"

namespace lasso::mdat::serve {
namespace {

struct ReadSeries {
  explicit ReadSeries(const std::string& bytes) {
    const auto n = number_at_byte<std::uint32_t>(bytes, 0);
    EXPECT_EQ(bytes.size(), 4 + n * (8 + 3 * 4));
    for (std::uint32_t i = 0; i < n; ++i) {
      time_s.push_back(number_at_byte<double>(bytes, 4 + 8 * i));
      least.push_back(number_at_byte<float>(bytes, 4 + 8 * n + 4 * i));
      most.push_back(number_at_byte<float>(bytes, 4 + 12 * n + 4 * i));
      last.push_back(number_at_byte<float>(bytes, 4 + 16 * n + 4 * i));
    }
  }
  std::vector<double> time_s;
  std::vector<float> least, most, last;
};

class SeriesAnswers : public ::testing::Test {
 protected:
  SeriesAnswers() {
    SmallRecording small;
    small.frames = 60;
    small.with_image = false;
    shown_ = shown_of(small.write(folder_.path() / "a run.mcap"));
  }
  TestFolder folder_;
  Shown shown_;
};

TEST_F(SeriesAnswers, FewRowsAreToldAsTheyAre) {
  VERIFIES("LASSO-WEB-012~1");
  const ReadSeries series(series_answer(shown_, target_of("/?value=pose.inliers&from_s=1.25&to_s=2.15")).body);
  EXPECT_EQ(series.time_s.size(), 5U);  // frames 1 to 5, at 1.3 to 2.1 s
  EXPECT_EQ(series.last, (std::vector<float>{291, 7, 293, 294, 295}));
  EXPECT_EQ(series.least, series.last);
  EXPECT_EQ(series.most, series.last);
}

// Against all rows: each point's bounds hold its rows, every row is in one point, and none is lost.
TEST_F(SeriesAnswers, ManyRowsKeepTheirLeastAndGreatest) {
  VERIFIES("LASSO-WEB-012~1");
  const std::vector<float>& column = shown_.recording->column(*shown_.recording->value("error.position"));
  const std::vector<double>& time_s = shown_.recording->table(*shown_.recording->value("error.position")).time_s;
  for (const std::size_t points : {2U, 3U, 7U, 20U, 59U}) {
    const ReadSeries series(series_answer(shown_, target_of("/?value=error.position&points=" + std::to_string(points))).body);
    ASSERT_LE(series.time_s.size(), points);
    ASSERT_TRUE(std::is_sorted(series.time_s.begin(), series.time_s.end()));
    std::size_t row = 0;
    for (std::size_t i = 0; i < series.time_s.size(); ++i) {
      constexpr float kEndless = std::numeric_limits<float>::infinity();
      float least = kEndless, most = -kEndless, last = 0;
      const double end_s = i + 1 < series.time_s.size() ? series.time_s[i + 1] : 1e9;
      for (; row < time_s.size() && time_s[row] < end_s; ++row) {
        last = column[row];
        if (std::isnan(column[row])) continue;
        least = std::min(least, column[row]);
        most = std::max(most, column[row]);
      }
      if (std::isinf(least)) {
        EXPECT_TRUE(std::isnan(series.least[i]) && std::isnan(series.most[i]));
      } else {
        EXPECT_EQ(series.least[i], least) << points << " " << i;
        EXPECT_EQ(series.most[i], most) << points << " " << i;
      }
      EXPECT_TRUE(series.last[i] == last || (std::isnan(last) && std::isnan(series.last[i])));
    }
    EXPECT_EQ(row, time_s.size());
  }
}

TEST_F(SeriesAnswers, StatisticsAreOfTheRowsThatHaveANumber) {
  VERIFIES("LASSO-WEB-012~1");
  // inliers of frames 1, 2, 3: 291, 7, 293
  const auto json = nlohmann::json::parse(statistics_answer(shown_, target_of("/?value=pose.inliers&from_s=1.3&to_s=1.71")).body);
  EXPECT_EQ(json["count"], 3);
  EXPECT_NEAR(json["mean"], 197, 1e-9);
  EXPECT_EQ(json["min"], 7);
  EXPECT_EQ(json["max"], 293);
  EXPECT_EQ(json["median"], 291);
  EXPECT_EQ(json["p95"], 293);
  EXPECT_NEAR(json["sigma"], std::sqrt((94.0 * 94 + 190.0 * 190 + 96.0 * 96) / 3), 1e-9);
  EXPECT_NEAR(json["rms"], std::sqrt((291.0 * 291 + 49 + 293.0 * 293) / 3), 1e-9);
  const auto lost = nlohmann::json::parse(statistics_answer(shown_, target_of("/?value=error.position&from_s=1.85&to_s=1.95")).body);
  EXPECT_EQ(lost["count"], 0);
  EXPECT_TRUE(lost["mean"].is_null());
}

TEST_F(SeriesAnswers, ATableHasARowForEachTime) {
  VERIFIES("LASSO-WEB-012~1");
  const Response response = csv_answer(shown_, target_of("/?values=pose.inliers,error.x&from_s=1.65&to_s=2"));
  EXPECT_EQ(response.body.substr(0, response.body.find('\n')), "time_s,pose.inliers [1],error.x [mm]");
  EXPECT_NE(response.body.find("\n1.700000,293,"), std::string::npos) << response.body;
  EXPECT_NE(response.body.find("\n1.900000,294,\n"), std::string::npos) << response.body;  // no registration ran
  EXPECT_EQ(std::count(response.body.begin(), response.body.end(), '\n'), 3);
  EXPECT_EQ(response.headers.at(0).second, "attachment; filename=\"a_run.csv\"");
}

TEST_F(SeriesAnswers, WhatIsNotThereIsRefused) {
  VERIFIES("LASSO-WEB-004~1");
  EXPECT_THROW((void)series_answer(shown_, target_of("/?value=pose.nothing")), Refusal);
  EXPECT_THROW((void)series_answer(shown_, target_of("/")), Refusal);
  EXPECT_THROW((void)series_answer(shown_, target_of("/?value=pose.inliers&points=20001")), Refusal);
  EXPECT_THROW((void)csv_answer(shown_, target_of("/")), Refusal);
  std::string many = "/?values=pose.inliers";
  for (std::size_t i = 0; i < kMostColumns; ++i) many += ",pose.inliers";
  EXPECT_THROW((void)csv_answer(shown_, target_of(many)), Refusal);
  EXPECT_EQ(ReadSeries(series_answer(shown_, target_of("/?value=pose.inliers&from_s=5&to_s=4")).body).time_s.size(), 0U);
}

}  // namespace
}  // namespace lasso::mdat::serve
