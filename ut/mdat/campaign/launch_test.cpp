#include "mdat/campaign/launch.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>

#include "mdat/common/errors.hpp"
#include "ut/mdat/campaign/chunk_folder.hpp"
#include "ut/support/verifies.hpp"

namespace lasso::mdat {
namespace {

using test::ChunkFolder;
using test::message_of;

std::string output_of(const std::string& command) {
  FILE* const pipe = popen(command.c_str(), "r");
  std::string text;
  for (int letter = std::fgetc(pipe); letter != EOF; letter = std::fgetc(pipe)) text += static_cast<char>(letter);
  EXPECT_EQ(pclose(pipe), 0) << command;
  return text;
}

// What the file starts where the program is `echo`.
std::string started(const std::string& engine, const LaunchOptions& options) {
  const ChunkFolder folder;
  folder.write("job", launch_text(engine, options));
  return output_of("sh '" + folder.chunk("job").string() + "'");
}

TEST(Launch, JobsOfSchedulersFlyTheirChunk) {
  VERIFIES("LASSO-GND-065~1");
  for (const char* engine : {"slurm", "pbs", "lsf", "sge"}) {
    EXPECT_EQ(started(engine, {"/bin/echo", "/c/rough", 40, 900}), "campaign run /c/rough --chunk auto/40 --jobs 1 --time-limit 3540\n");
    EXPECT_EQ(started(engine, {"/bin/echo", "/c/rough", 1, 1}), "campaign run /c/rough --chunk 1/1 --jobs 1 --time-limit 540\n");
  }
}

TEST(Launch, FilesAreShortAndSayTheArray) {
  VERIFIES("LASSO-GND-065~1");
  const std::pair<const char*, const char*> arrays[] = {{"slurm", "#SBATCH --array=1-40\n"},           {"pbs", "#PBS -J 1-40\n"},
                                                        {"lsf", "#BSUB -J campaign[1-40]\n"},          {"sge", "#$ -t 1-40\n"},
                                                        {"htcondor", "--chunk $INT(chunk)/40 --jobs"}, {"k8s", "  completions: 40\n"}};
  for (const auto& [engine, array] : arrays) {
    const std::string text = launch_text(engine, {"mdat", "/c/rough", 40, 900});
    EXPECT_NE(text.find(array), std::string::npos) << text;
    EXPECT_LT(std::count(text.begin(), text.end(), '\n'), 20) << text;
    const std::string one = launch_text(engine, {"mdat", "/c/rough", 1, 900});
    EXPECT_EQ(one.find("1-1"), std::string::npos) << one;  // PBS refuses it
  }
}

TEST(Launch, CommandsTakeAnyFolder) {
  VERIFIES("LASSO-GND-065~1");
  const std::string folder = "/c/it's $HOME `here`";
  EXPECT_EQ(started("parallel", {"/bin/echo", folder, 2, 900}),
            "campaign run " + folder + " --chunk 1/2 --jobs 1\ncampaign run " + folder + " --chunk 2/2 --jobs 1\n");
  EXPECT_EQ(started("local", {"/bin/echo", folder, 2, 900}), "campaign run " + folder + "\n");
  for (const char* engine : {"slurm", "pbs", "lsf", "sge", "htcondor", "k8s"})
    EXPECT_NE(message_of<InputError>([&] {
                (void)launch_text(engine, {"mdat", folder, 2, 900});
              }).find("move it, or link to it"),
              std::string::npos);
}

TEST(Launch, AnUnknownEngineIsNamed) {
  VERIFIES("LASSO-GND-065~1");
  const std::string message = message_of<InputError>([] { (void)launch_text("slrum", {"mdat", "/c", 2, 900}); });
  EXPECT_NE(message.find("--engine slrum: not known"), std::string::npos) << message;
  EXPECT_NE(message.find("did you mean slurm"), std::string::npos) << message;
}

TEST(Launch, ChunksTakeAQuarterOfAnHour) {
  VERIFIES("LASSO-GND-065~1");
  EXPECT_EQ(chunks_for(1800, 1), 2U);
  EXPECT_EQ(chunks_for(1801, 1), 3U);
  EXPECT_EQ(chunks_for(500, 0.01), 1U);
  EXPECT_EQ(chunks_for(1000000, 10), 1000U);
  EXPECT_EQ(chunks_for(3, 10000), 3U);
}

}  // namespace
}  // namespace lasso::mdat
