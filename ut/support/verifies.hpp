// VERIFIES("LASSO-ICP-012") inside a test names the requirements that its passing verifies (reqs/), separated by spaces.
#pragma once

#include <gtest/gtest.h>

#define VERIFIES(ids) ::testing::Test::RecordProperty("verifies", ids)
