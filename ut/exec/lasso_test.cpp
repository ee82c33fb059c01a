#include "fsw/exec/lasso.hpp"

#include <cstring>

#include "ut/exec/component_scene.hpp"
#include "ut/link/command_packets.hpp"

namespace lasso {
namespace {

struct alignas(64) Memory {
  std::uint8_t bytes[2u << 20];
};

TEST(Lasso, LivesInMemoryOfTheCaller) {
  VERIFIES("LASSO-EXE-010~1");
  const auto memory = std::make_unique<Memory>();
  test::BoxSensor sensor(test::default_scene());
  ASSERT_LE(required_memory(), sizeof(Memory::bytes));
  EXPECT_EQ(create(memory->bytes, required_memory() - 1, sensor), nullptr);
  EXPECT_EQ(create(memory->bytes + 1, required_memory(), sensor), nullptr);
  EXPECT_EQ(create(nullptr, required_memory(), sensor), nullptr);
  EXPECT_EQ(create(memory->bytes, required_memory(), SensorBank{}), nullptr);
  EXPECT_EQ(static_cast<void*>(create(memory->bytes, required_memory(), sensor)), static_cast<void*>(memory->bytes));
}

TEST(Lasso, StepsGiveTheBytesOfTheComponentRunByItsSlots) {
  VERIFIES("LASSO-EXE-012~1 LASSO-EXE-010~1 LASSO-SYS-015~2");
  const MissionParameters parameters = test::box_parameters(test::default_scene());
  test::ComponentScene reference(parameters);
  reference.begin();
  for (int frame = 0; frame < 20; ++frame) reference.run_frame();

  const auto memory = std::make_unique<Memory>();
  std::memset(memory->bytes, 0xA5, sizeof(Memory::bytes));  // nothing depends on what was there
  test::BoxSensor sensor(test::default_scene());
  Component& component = *create(memory->bytes, sizeof(Memory::bytes), sensor);
  test::TestImage image = test::make_box_image(parameters, test::default_scene().box);
  ASSERT_EQ(load_image(component, Bytes(image.data(), image.size)).status, Status::kOk);
  ASSERT_EQ(begin(component, 0), Status::kOk);
  std::vector<std::uint8_t> stream;
  std::uint8_t out[1000];
  for (TimeUs now_us = 0; now_us < 20 * 200000; now_us += 5000) {  // half of the calls come too early
    while (step(component, now_us)) {
    }
    const std::size_t size = take_telemetry(component, Bytes(out));
    stream.insert(stream.end(), out, out + size);
  }
  EXPECT_EQ(stream, reference.stream);
  EXPECT_EQ(test::decode_all(ConstBytes(stream.data(), stream.size())).size(), 18u);
}

TEST(Lasso, AnswersCommands) {
  VERIFIES("LASSO-LNK-011~2 LASSO-SYS-015~2");
  const auto memory = std::make_unique<Memory>();
  test::BoxSensor sensor(test::default_scene());
  Component& component = *create(memory->bytes, sizeof(Memory::bytes), sensor);
  std::uint8_t out[200];
  EXPECT_EQ(receive(component, test::view(test::ping(1)), 0), test::ping(1).size());
  EXPECT_EQ(take_telemetry(component, Bytes(out)), 26u + 22u + 26u);
  EXPECT_TRUE(receive_packet(component, test::view(test::ping(2)), 0));
  EXPECT_EQ(take_telemetry(component, Bytes(out)), 26u + 22u + 26u);
}

TEST(Lasso, DoesNothingBeforeItsTime) {
  VERIFIES("LASSO-EXE-010~1");
  const auto memory = std::make_unique<Memory>();
  test::BoxSensor sensor(test::default_scene());
  Component& component = *create(memory->bytes, sizeof(Memory::bytes), sensor);
  test::TestImage image = test::make_box_image(test::box_parameters(test::default_scene()), test::default_scene().box);
  ASSERT_EQ(load_image(component, Bytes(image.data(), image.size)).status, Status::kOk);
  ASSERT_EQ(begin(component, 1000), Status::kOk);
  EXPECT_FALSE(step(component, 999));
  EXPECT_TRUE(step(component, 1000));
  EXPECT_FALSE(step(component, 1000));
  EXPECT_EQ(stop_tracking(component), Status::kOk);
  EXPECT_EQ(start_tracking(component, Pose{Quat(2, 0, 0, 0), Vec3::Zero()}, Twist{}, 0), Status::kBadValue);
  EXPECT_EQ(offer_start(component, StartWay::kNone, StartOffer{}), StartRefusal::kNoSuchWay);
  EXPECT_EQ(command_mode(component, TrackingMode::kCoasting), ModeRefusal::kNotByCommand);
  EXPECT_EQ(command_mode(component, TrackingMode::kBearing), ModeRefusal::kNone);
  hold_mode(component, true);
}

}  // namespace
}  // namespace lasso
