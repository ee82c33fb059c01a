// VERIFIES("LASSO-ICP-012~2 LASSO-ICP-013~1") inside a test: the items of reqs/, each with its revision, that the test verifies by passing.
// reqs/trace reads them from the test reports. Several uses in one test add up.
#pragma once

#include <gtest/gtest.h>

#include <cstring>
#include <string>

namespace lasso::test {

// RecordProperty overwrites what was recorded under the same key before, and outside of a test it records what no checker would find.
inline void record_verified(const char* ids) {
  const ::testing::TestInfo* test = ::testing::UnitTest::GetInstance()->current_test_info();
  if (test == nullptr) {
    ADD_FAILURE() << "VERIFIES(\"" << ids << "\") outside of a test: move it into the test that verifies";
    return;
  }
  std::string all = ids;
  for (int i = 0; i < test->result()->test_property_count(); ++i) {
    const ::testing::TestProperty& property = test->result()->GetTestProperty(i);
    if (std::strcmp(property.key(), "verifies") == 0) all = std::string(property.value()) + " " + all;
  }
  ::testing::Test::RecordProperty("verifies", all);
}

}  // namespace lasso::test

#define VERIFIES(ids) ::lasso::test::record_verified(ids)
