#include "mdat/mcap/copy.hpp"

#include "ut/mdat/mcap/mcap_fixture.hpp"
#include "ut/support/verifies.hpp"

namespace lasso::mdat::mcap {
namespace {

using McapCopy = McapFile;

TEST_F(McapCopy, HoldsTheSameMessagesWithTheirTimesAndSchemas) {
  VERIFIES("LASSO-REC-009~1");
  write_three_chunks();
  const Told before = told();
  const std::filesystem::path original = file_.string() + ".from";
  std::filesystem::rename(file_, original);
  {
    Reader reader(original);
    Writer writer(file_, reader.profile(), "test");
    (void)writer.add_schema("another/msg/First", "ros2msg", "");  // so that numbers differ
    Copy copy(reader, writer);
    Visitor visitor;
    visitor.message = [&](const Channel& channel, const Message& message) { copy.message(channel, message); };
    (void)reader.read(visitor);
    writer.close();
  }
  EXPECT_EQ(told().messages, before.messages);
  Reader reader(file_);
  std::uint64_t expected_ns = 0;
  Visitor visitor;
  visitor.message = [&](const Channel& channel, const Message& message) {
    EXPECT_EQ(message.log_ns, expected_ns++);
    EXPECT_EQ(reader.schemas().at(channel.schema).name, "a/msg/B");
  };
  EXPECT_TRUE(reader.read(visitor).empty());
  std::filesystem::remove(original);
}

}  // namespace
}  // namespace lasso::mdat::mcap
