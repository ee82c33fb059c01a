// Mission images and memory as an operator sees them: by the link alone.
#include <set>

#include "fsw/core/crc.hpp"
#include "ut/exec/component_operator.hpp"
#include "ut/exec/memory_scene.hpp"

namespace lasso {
namespace {

using test::crc_of;
using test::Packet;
using test::TestImage;

TestImage coarse_image(double inliers_min) {
  test::BoxModel box;
  box.cell_m = 0.05;
  MissionParameters p = test::MemoryScene::parameters();
  p.inliers_min = inliers_min;
  return test::make_box_image(p, box);
}

class MemoryLink : public ::testing::Test {
 protected:
  void SetUp() override { scene_.begin(first_); }
  Component& component() { return *scene_.component; }

  // A command; the reason of its refusal, once it was answered.
  ServiceRefusal send(const test::Stream& packet) {
    if (++in_frame_ > kMaxCommandsPerFrame) run(1);
    EXPECT_TRUE(component().receive_packet(test::view(packet), component().next_slot_us()));
    return test::answer_in(take());
  }
  ServiceRefusal activate(const TestImage& image) {
    EXPECT_EQ(send(test::arm(CommandKind::kActivateImage, next())), ServiceRefusal::kNone);
    return send(test::activate_image(crc_of(image), next()));
  }
  std::uint16_t next() { return count_++; }
  void run(int frames) {
    for (int i = 0; i < frames; ++i) {
      do {
        component().run_slot(component().next_slot_us());
        component().run_estimation();
      } while (!component().next_slot_is_boundary());
      take();
    }
    in_frame_ = 1;
  }
  std::vector<Packet> take() {
    test::Stream bytes(kTelemetryQueueBytes);
    bytes.resize(component().take_telemetry(Bytes(bytes.data(), bytes.size())));
    std::vector<Packet> packets = test::packets_of(bytes);
    for (const Packet& packet : packets) {
      services_.insert(packet.header.service);
      if (packet.is(3, 25) && packet.data[1] == kImageStructureId) image_ = decoded(packet);
      if (packet.is(3, 25) && packet.data[1] == kPoseStructureId) pose_ = packet;
      if (packet.is(6, 6) || packet.is(6, 10)) memory_ = packet;
    }
    return packets;
  }
  static ImageTelemetry decoded(const Packet& packet) {
    ByteReader in(test::view(packet.data));
    in.u16();
    ImageTelemetry image;
    codec_of(memory_rows::kImage).read(in, image);
    return image;
  }
  ImageTelemetry image() {
    EXPECT_EQ(send(test::of_structure(CommandKind::kReportStructure, kImageStructureId, next())), ServiceRefusal::kNone);
    run(1);
    return image_;
  }
  ServiceRefusal load(TestImage& image, std::size_t block) {
    LoadCommand command;
    command.offset = static_cast<std::uint32_t>(block * kMemoryBlockBytes);
    command.bytes = static_cast<std::uint8_t>(std::min(kMemoryBlockBytes, image.size - command.offset));
    std::copy_n(image.data() + command.offset, command.bytes, command.data);
    return send(test::load_memory(command, next()));
  }
  ServiceRefusal ask(CommandKind kind, MemoryArea area, std::uint32_t offset, std::uint32_t bytes) {
    return send(test::of_memory(kind, {static_cast<std::uint8_t>(area), offset, bytes}, next()));
  }

  test::MemoryScene scene_;
  TestImage first_ = coarse_image(60), second_ = coarse_image(50);
  std::uint16_t count_ = 0;
  std::uint32_t in_frame_ = 0;
  ImageTelemetry image_;
  Packet pose_, memory_;
  std::set<std::uint8_t> services_;  // whose packets came
};

// Backwards, with a break of the link in the middle; made active; taken back.
TEST_F(MemoryLink, AnImageIsLoadedActivatedAndTakenBack) {
  VERIFIES("LASSO-IMG-012~1 LASSO-IMG-013~1 LASSO-IMG-014~2 LASSO-LNK-016~2");
  run(5);
  const std::size_t blocks = (second_.size + kMemoryBlockBytes - 1) / kMemoryBlockBytes;
  const auto size = static_cast<std::uint32_t>(second_.size);
  ASSERT_EQ(send(test::begin_image(size, crc_of(second_), next())), ServiceRefusal::kNone);
  EXPECT_EQ(load(second_, 0), ServiceRefusal::kNotArmed);
  ASSERT_EQ(send(test::arm(CommandKind::kLoadMemory, next())), ServiceRefusal::kNone);
  for (std::size_t i = blocks; i-- > blocks / 3;) ASSERT_EQ(load(second_, i), ServiceRefusal::kNone) << i;
  run(100);  // no contact: what was armed expires
  EXPECT_EQ(load(second_, 0), ServiceRefusal::kNotArmed);
  EXPECT_EQ(send(test::plain_packet(CommandKind::kCheckImage, next())), ServiceRefusal::kIncomplete);
  ImageTelemetry state = image();
  EXPECT_EQ(state.blocks, blocks);
  EXPECT_EQ(state.loaded, blocks - blocks / 3);
  EXPECT_EQ(state.missing_first[0], 0U);
  EXPECT_EQ(state.missing_blocks[0], blocks / 3);
  EXPECT_EQ(state.missing_blocks[1], 0U);
  ASSERT_EQ(send(test::begin_image(size, crc_of(second_), next())), ServiceRefusal::kNone);
  ASSERT_EQ(send(test::arm(CommandKind::kLoadMemory, next())), ServiceRefusal::kNone);
  for (std::size_t i = 0; i < blocks / 3; ++i) ASSERT_EQ(load(second_, i), ServiceRefusal::kNone) << i;
  ASSERT_EQ(send(test::plain_packet(CommandKind::kCheckImage, next())), ServiceRefusal::kNone);
  for (int i = 0; i < 60 && image_.other_state != static_cast<std::uint8_t>(ImageState::kReady); ++i) run(1);
  EXPECT_EQ(image_.other_state, static_cast<std::uint8_t>(ImageState::kReady));
  EXPECT_EQ(image_.other_stored, 1);

  EXPECT_EQ(send(test::activate_image(crc_of(second_), next())), ServiceRefusal::kNotArmed);
  EXPECT_EQ(activate(first_), ServiceRefusal::kOtherImage);
  ASSERT_EQ(activate(second_), ServiceRefusal::kNone);
  run(15);
  EXPECT_EQ(image_.active_crc, crc_of(second_));
  EXPECT_EQ(image_.activations, 1U);
  EXPECT_EQ(image_.confirmed, 1);
  ASSERT_EQ(send(test::arm(CommandKind::kRollBackImage, next())), ServiceRefusal::kNone);
  ASSERT_EQ(send(test::plain_packet(CommandKind::kRollBackImage, next())), ServiceRefusal::kNone);
  run(5);
  EXPECT_EQ(image_.active_crc, crc_of(first_));
  EXPECT_EQ(image_.roll_backs, 1U);
}

TEST_F(MemoryLink, OnlyPermittedAreasAreWrittenTo) {
  VERIFIES("LASSO-LNK-016~2");
  const auto size = static_cast<std::uint32_t>(second_.size);
  LoadCommand command;
  command.bytes = 128;
  ASSERT_EQ(send(test::arm(CommandKind::kLoadMemory, next())), ServiceRefusal::kNone);
  EXPECT_EQ(send(test::load_memory(command, next())), ServiceRefusal::kNotOpen);
  for (const MemoryArea area : {MemoryArea::kActiveImage, MemoryArea::kCode}) {
    command.area = static_cast<std::uint8_t>(area);
    EXPECT_EQ(send(test::load_memory(command, next())), ServiceRefusal::kNotAllowed);
  }
  command.area = 0;
  EXPECT_EQ(send(test::begin_image(64, 1, next())), ServiceRefusal::kTooLong);
  ASSERT_EQ(send(test::begin_image(size, 1, next())), ServiceRefusal::kNone);
  command.offset = size;
  EXPECT_EQ(send(test::load_memory(command, next())), ServiceRefusal::kOutside);
  command.offset = 64;
  EXPECT_EQ(send(test::load_memory(command, next())), ServiceRefusal::kNotWhole);
  EXPECT_EQ(image().loaded, 0U);
}

TEST_F(MemoryLink, MemoryIsDumpedAndCheckedByArea) {
  VERIFIES("LASSO-LNK-016~2");
  const ConstBytes active = component().images().active().sealed_image();
  ASSERT_EQ(ask(CommandKind::kDumpMemory, MemoryArea::kActiveImage, 1000, 100), ServiceRefusal::kNone);
  EXPECT_EQ(memory_.data[5], 100);
  for (std::size_t i = 0; i < 100; ++i) EXPECT_EQ(memory_.data[6 + i], active[1000 + i]);
  EXPECT_EQ(memory_.data[106], 0);
  ASSERT_EQ(ask(CommandKind::kCheckMemory, MemoryArea::kCode, 100, 16384), ServiceRefusal::kNone);
  ByteReader sum(test::view(memory_.data));
  EXPECT_EQ(sum.u8(), static_cast<std::uint8_t>(MemoryArea::kCode));
  EXPECT_EQ(sum.u32(), 100U);
  EXPECT_EQ(sum.u32(), 16384U);
  EXPECT_EQ(sum.u32(), crc32c(ConstBytes(scene_.code.data() + 100, 16384)));
  EXPECT_EQ(ask(CommandKind::kDumpMemory, MemoryArea::kCode, 0, 129), ServiceRefusal::kTooLong);
  EXPECT_EQ(ask(CommandKind::kCheckMemory, MemoryArea::kCode, 0, 16385), ServiceRefusal::kTooLong);
  EXPECT_EQ(ask(CommandKind::kDumpMemory, MemoryArea::kCode, 39900, 101), ServiceRefusal::kOutside);
  EXPECT_EQ(ask(CommandKind::kCheckMemory, MemoryArea::kCode, 40000, 0), ServiceRefusal::kOutside);
  EXPECT_EQ(ask(CommandKind::kDumpMemory, MemoryArea::kOtherImage, 0, 1), ServiceRefusal::kOutside) << "there is none";
}

// One request to each; functions (8) and time (9) have no telemetry of their own, and are answered by service 1.
TEST_F(MemoryLink, EachServiceIsThere) {
  VERIFIES("LASSO-LNK-012~1");
  run(2);
  services_.clear();
  EXPECT_EQ(send(test::of_structure(CommandKind::kReportStructure, kImageStructureId, next())), ServiceRefusal::kNone);
  EXPECT_EQ(send(test::enable_event(static_cast<std::uint16_t>(EventId::kCommandArmed), next())), ServiceRefusal::kNone);
  EXPECT_EQ(ask(CommandKind::kCheckMemory, MemoryArea::kCode, 0, 64), ServiceRefusal::kNone);
  EXPECT_EQ(send(test::arm(CommandKind::kLoadMemory, next())), ServiceRefusal::kNone);
  EXPECT_EQ(send(test::correlate_time(0, 1'000'000, next())), ServiceRefusal::kNone);
  EXPECT_EQ(send(test::ping(next())), ServiceRefusal::kNone);
  EXPECT_EQ(send(test::report_parameter(1, next())), ServiceRefusal::kNone);
  run(2);
  EXPECT_EQ(services_, (std::set<std::uint8_t>{1, 3, 5, 6, 17, 20}));
}

}  // namespace
}  // namespace lasso
