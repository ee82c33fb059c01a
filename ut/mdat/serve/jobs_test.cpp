#include "mdat/serve/jobs.hpp"

#include <gtest/gtest.h>

#include <future>
#include <stdexcept>

#include "mdat/serve/http.hpp"
#include "ut/support/verifies.hpp"

namespace lasso::mdat::serve {
namespace {

JobState ended(const Jobs& jobs, const std::string& id) {
  JobState state;
  while (jobs.find(id, state) && !state.over()) std::this_thread::yield();
  return state;
}

TEST(Jobs, TellHowFarTheyAreAndWhatTheyMade) {
  VERIFIES("LASSO-WEB-017~1");
  Jobs jobs;
  std::promise<void> go;
  const std::string id = jobs.begin("first", [&](const Jobs::Tell& tell) {
    tell(0.5, "half");
    go.get_future().wait();
    return std::string("made");
  });
  JobState state;
  while (jobs.find(id, state) && state.done < 0.5) std::this_thread::yield();
  EXPECT_EQ(state.text, "half");
  EXPECT_FALSE(state.over());
  EXPECT_EQ(jobs.begin("first", [](const Jobs::Tell&) { return std::string("twice"); }), id);
  EXPECT_THROW((void)jobs.begin("other", [](const Jobs::Tell&) { return std::string("other"); }), Refusal);
  go.set_value();
  EXPECT_EQ(ended(jobs, id).result, "made");
  EXPECT_EQ(ended(jobs, id).done, 1);
}

TEST(Jobs, AnErrorIsTold) {
  VERIFIES("LASSO-WEB-017~1");
  Jobs jobs;
  const std::string id = jobs.begin("bad", [](const Jobs::Tell&) -> std::string { throw std::runtime_error("the disk is full"); });
  EXPECT_EQ(ended(jobs, id).error, "the disk is full");
  const std::string next = jobs.begin("bad", [](const Jobs::Tell&) { return std::string("good"); });
  EXPECT_NE(next, id);
  EXPECT_EQ(ended(jobs, next).result, "good");
  JobState state;
  EXPECT_FALSE(jobs.find("job99", state));
}

}  // namespace
}  // namespace lasso::mdat::serve
