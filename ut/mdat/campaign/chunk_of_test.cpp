#include "mdat/campaign/chunk_of.hpp"

#include <gtest/gtest.h>

#include <map>

#include "mdat/common/errors.hpp"
#include "ut/mdat/campaign/chunk_folder.hpp"
#include "ut/support/verifies.hpp"

namespace lasso::mdat {
namespace {

using test::message_of;
using Variables = std::map<std::string, std::string>;

ChosenChunk chosen(const std::string& text, const Variables& variables) {
  return chunk_of(text, [&](const char* name) {
    const auto found = variables.find(name);
    return found == variables.end() ? nullptr : found->second.c_str();
  });
}

std::string refused(const std::string& text, const Variables& variables) {
  return message_of<InputError>([&] { (void)chosen(text, variables); });
}

TEST(ChunkOf, ReadsWhatIsWritten) {
  VERIFIES("LASSO-GND-064~1");
  EXPECT_EQ(chunk_name(chosen("3/10", {{"SLURM_ARRAY_TASK_ID", "7"}}).chunk), "3of10");
  EXPECT_EQ(chunk_name(chosen("1/1", {}).chunk), "1of1");
  for (const char* text : {"", "3", "/", "0/10", "11/10", "3/", "/10", "-1/10", "3/10/2", " 3/10", "3/99999999999", "2/4294967295"})
    EXPECT_NE(refused(text, {}).find("expected K/N, the K-th of N chunks, K from 1 to N"), std::string::npos) << text;
  for (const char* text : {"auto/", "auto/0", "auto/x", "auto10", "automatic"})
    EXPECT_NE(refused(text, {{"PBS_ARRAY_INDEX", "1"}}).find("expected auto or auto/N"), std::string::npos) << text;
}

struct ArrayRow {
  Variables variables;
  const char *text, *chunk, *from;
};

TEST(ChunkOf, ReadsTheSchedulersIndex) {
  VERIFIES("LASSO-GND-064~1");
  const Variables slurm{
      {"SLURM_ARRAY_TASK_ID", "3"}, {"SLURM_ARRAY_TASK_MIN", "0"}, {"SLURM_ARRAY_TASK_MAX", "9"}, {"SLURM_ARRAY_TASK_COUNT", "10"}};
  const Variables sge{{"SGE_TASK_ID", "5"}, {"SGE_TASK_FIRST", "1"}, {"SGE_TASK_LAST", "9"}, {"SGE_TASK_STEPSIZE", "2"}};
  const ArrayRow rows[] = {
      {slurm, "auto", "4of10", "SLURM_ARRAY_TASK_ID=3, which counts from 0, of 10"},
      {slurm, "auto/20", "4of20", "SLURM_ARRAY_TASK_ID=3, which counts from 0, of 20"},
      {{{"SLURM_ARRAY_TASK_ID", "3"}}, "auto/10", "3of10", "SLURM_ARRAY_TASK_ID=3, which counts from 1, of 10"},
      {sge, "auto", "3of5", "SGE_TASK_ID=5, which counts from 1, of 5"},
      {{{"SGE_TASK_ID", "undefined"}, {"LSB_JOBINDEX", "2"}, {"LSB_JOBINDEX_END", "4"}},
       "auto",
       "2of4",
       "LSB_JOBINDEX=2, which counts from 1, of 4"},
      {{{"PBS_ARRAY_INDEX", "10"}}, "auto/10", "10of10", "PBS_ARRAY_INDEX=10, which counts from 1, of 10"},
      {{{"PBS_ARRAYID", "1"}}, "auto/10", "1of10", "PBS_ARRAYID=1, which counts from 1, of 10"},
      {{{"LSB_JOBINDEX", "0"}, {"JOB_COMPLETION_INDEX", "0"}}, "auto/4", "1of4", "JOB_COMPLETION_INDEX=0, which counts from 0, of 4"},
  };
  for (const ArrayRow& row : rows) {
    const ChosenChunk chunk = chosen(row.text, row.variables);
    EXPECT_EQ(chunk_name(chunk.chunk), row.chunk);
    EXPECT_EQ(chunk.from, row.from);
  }
}

TEST(ChunkOf, RefusesWhatLeavesCasesOut) {
  VERIFIES("LASSO-GND-064~1");
  EXPECT_EQ(refused("auto", {{"LSB_JOBINDEX", "0"}}),
            "--chunk auto: none of SLURM_ARRAY_TASK_ID, PBS_ARRAY_INDEX, PBS_ARRAYID, LSB_JOBINDEX, SGE_TASK_ID, JOB_COMPLETION_INDEX is "
            "set: write --chunk K/N, or start it in a job array");
  EXPECT_EQ(refused("auto", {{"PBS_ARRAY_INDEX", "1"}}), "--chunk auto: PBS does not say how many elements the array has: write auto/N");
  EXPECT_EQ(refused("auto/10", {{"PBS_ARRAY_INDEX", "0"}}),
            "--chunk auto/10: PBS_ARRAY_INDEX=0 is not from 1 to 10: give the array these elements, or write --chunk K/N");
  EXPECT_NE(refused("auto/4", {{"JOB_COMPLETION_INDEX", "4"}}).find("is not from 0 to 3"), std::string::npos);
  const Variables gaps{
      {"SLURM_ARRAY_TASK_ID", "3"}, {"SLURM_ARRAY_TASK_MIN", "3"}, {"SLURM_ARRAY_TASK_MAX", "7"}, {"SLURM_ARRAY_TASK_COUNT", "2"}};
  EXPECT_EQ(refused("auto", gaps), "--chunk auto: the array has 2 elements between 3 and 7: write auto/N");
}

}  // namespace
}  // namespace lasso::mdat
