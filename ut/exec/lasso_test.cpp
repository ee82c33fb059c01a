#include "fsw/exec/lasso.hpp"

#include <cstring>
#include <functional>
#include <type_traits>

#include "fsw/sense/pixel_sensor.hpp"
#include "ut/exec/component_operator.hpp"
#include "ut/exec/component_scene.hpp"
#include "ut/link/keyed_sum.hpp"

namespace lasso {
namespace {

static_assert(required_memory() > 0 && required_memory() <= 2u << 20 && required_alignment() <= 64, "known before anything runs");

// The rule of docs/conventions.md: nobody deletes an implementation through the interface.
template <class Interface>
constexpr bool is_only_implemented = !std::has_virtual_destructor_v<Interface> && !std::is_destructible_v<Interface>;
static_assert(is_only_implemented<Sensor> && is_only_implemented<PixelSensor> && is_only_implemented<Watchdog>);
static_assert(is_only_implemented<Store> && is_only_implemented<Authenticator>);

struct alignas(64) Memory {
  std::uint8_t bytes[2u << 20];
};

TEST(Lasso, LivesInMemoryOfTheCaller) {
  VERIFIES("LASSO-EXE-010~2");
  const auto memory = std::make_unique<Memory>();
  test::BoxSensor sensor(test::default_scene());
  ASSERT_LE(required_memory(), sizeof(Memory::bytes));
  EXPECT_EQ(create(memory->bytes, required_memory() - 1, sensor), nullptr);
  EXPECT_EQ(create(memory->bytes + 1, required_memory(), sensor), nullptr);
  EXPECT_EQ(create(nullptr, required_memory(), sensor), nullptr);
  EXPECT_EQ(create(memory->bytes, required_memory(), SensorBank{}), nullptr);
  SensorBank bank = only(sensor);
  ASSERT_TRUE(bank.push_back(nullptr));
  EXPECT_EQ(create(memory->bytes, required_memory(), bank), nullptr) << "one of two sensors is null";
  EXPECT_EQ(static_cast<void*>(create(memory->bytes, required_memory(), sensor)), static_cast<void*>(memory->bytes));
}

TEST(Lasso, StepsGiveTheBytesOfTheComponentRunByItsSlots) {
  VERIFIES("LASSO-EXE-012~2 LASSO-EXE-010~2 LASSO-SYS-015~2");
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

// A component in memory of its own, with its image, begun.
class Hosted {
 public:
  explicit Hosted(
      const Identity& identity = {}, const std::function<void(Component&)>& prepare = [](Component&) {})
      : memory_(std::make_unique<Memory>()),
        image_(test::make_box_image(test::box_parameters(test::default_scene()), test::default_scene().box)),
        component(*create(memory_->bytes, sizeof(Memory::bytes), sensor, identity)) {
    prepare(component);
    EXPECT_EQ(load_image(component, Bytes(image_.data(), image_.size)).status, Status::kOk);
    EXPECT_EQ(begin(component, 0), Status::kOk);
  }
  // Until this frame has begun.
  test::Stream run_to(std::uint32_t frame) {
    test::Stream stream;
    while (next_slot_us(component) <= frame * 200000) {
      EXPECT_TRUE(step(component, next_slot_us(component)));
      test::append(stream, test::telemetry_of(component));
    }
    return stream;
  }
  std::vector<test::Packet> answer_to(const test::Stream& packet) {
    EXPECT_TRUE(receive_packet(component, test::view(packet), next_slot_us(component)));
    return test::packets_of(test::telemetry_of(component));
  }

 private:
  std::unique_ptr<Memory> memory_;
  test::TestImage image_;

 public:
  test::BoxSensor sensor{test::default_scene()};
  Component& component;
};

std::vector<test::Stream> split(const test::Stream& stream) {
  std::vector<test::Stream> packets;
  for (std::size_t at = 0; at < stream.size(); at += packets.back().size()) {
    const std::size_t size = packet_size({stream.data() + at, stream.size() - at});
    packets.emplace_back(stream.begin() + static_cast<std::ptrdiff_t>(at), stream.begin() + static_cast<std::ptrdiff_t>(at + size));
  }
  return packets;
}

constexpr std::uint16_t kOtherApid = 0x2A5;
const Identity kOther{kOtherApid, nullptr};

TEST(Lasso, NoComponentHasAnApidOfTimeOrIdlePackets) {
  VERIFIES("LASSO-LNK-043~2");
  const auto memory = std::make_unique<Memory>();
  test::BoxSensor sensor(test::default_scene());
  for (const unsigned apid : {0x000U, 0x7FFU, 0x800U})
    EXPECT_EQ(create(memory->bytes, sizeof(Memory::bytes), sensor, {static_cast<std::uint16_t>(apid), nullptr}), nullptr) << apid;
  EXPECT_EQ(create(memory->bytes, sizeof(Memory::bytes), sensor)->identity().apid, 0x3D1);
  EXPECT_EQ(create(memory->bytes, sizeof(Memory::bytes), sensor, kOther)->identity().apid, kOtherApid);
  EXPECT_DEATH(static_cast<void>(Component(sensor, {0x7FF, nullptr})), "an APID");
}

TEST(Lasso, TelemetryIsTheSameButForTheApid) {
  VERIFIES("LASSO-LNK-043~2");
  Hosted preset, other(kOther);
  const test::Stream expected = preset.run_to(6);
  test::Stream changed;
  for (const test::Stream& packet : split(other.run_to(6))) {
    EXPECT_EQ(read_primary_header(test::view(packet)).apid, kOtherApid);
    PacketHeader header;
    ConstBytes data;
    EXPECT_EQ(parse_packet(test::view(packet), header, data), PacketFault::kOtherApid);
    EXPECT_EQ(parse_packet(test::view(packet), header, data, kOtherApid), PacketFault::kNone);
    EXPECT_EQ(header.apid, kOtherApid);
    test::append(changed, test::for_apid(packet, kApid));
  }
  EXPECT_EQ(changed, expected);
}

TEST(Lasso, OfTwoComponentsEachDoesWhatItIsTold) {
  VERIFIES("LASSO-LNK-043~2");
  Hosted preset, other(kOther);
  const test::Stream to_other = test::for_apid(test::set_mode(static_cast<std::uint8_t>(TrackingMode::kBearing), 1), kOtherApid);
  EXPECT_TRUE(receive_packet(preset.component, test::view(to_other), 0));
  EXPECT_TRUE(receive_packet(other.component, test::view(to_other), 0));
  const std::vector<test::Stream> refusal = split(test::telemetry_of(preset.component)), done = split(test::telemetry_of(other.component));
  ASSERT_EQ(refusal.size(), 1U);
  EXPECT_EQ(refusal[0][8], kSubserviceRefused);
  ASSERT_EQ(done.size(), 2U);
  EXPECT_EQ(done[1][8], kSubserviceCompleted);
  EXPECT_EQ(read_primary_header(test::view(done[1])).apid, kOtherApid);
  // Both on one stream of bytes: each finds its own.
  test::Stream both = test::ping(2);
  test::append(both, test::for_apid(test::ping(2), kOtherApid));
  for (Hosted* each : {&preset, &other}) {
    EXPECT_EQ(receive(each->component, test::view(both), 0), both.size());
    EXPECT_EQ(split(test::telemetry_of(each->component)).size(), 3U) << "accepted, pong, completed";
  }
}

TEST(Lasso, ABoardGivesWhatItHas) {
  VERIFIES("LASSO-EXE-010~2");
  class Counting final : public Watchdog {
   public:
    void feed() override { ++fed; }
    int fed = 0;
  } watchdog;
  test::KeyedSum authenticator;
  Hosted hosted({}, [&](Component& component) {
    static std::uint8_t odd[16];
    EXPECT_EQ(use_memory(component, {{Bytes(odd), Bytes(odd, 8)}, nullptr, {}}), Status::kBadValue) << "buffers of two sizes";
    EXPECT_EQ(load_stored_image(component).status, Status::kNoData);
    set_watchdog(component, watchdog);
    set_reset_cause(component, ResetCause::kWatchdog);
    use_authenticator(component, authenticator);
    authenticate_images(component, authenticator);
    accept_unsigned_images(component);
  });
  hosted.run_to(3);
  EXPECT_GT(watchdog.fed, 0);
  EXPECT_TRUE(hosted.component.faults().active().has(Fault::kWatchdogReset));
  const std::vector<test::Packet> answers = hosted.answer_to(test::ping(1));
  ASSERT_EQ(answers.size(), 1U);
  EXPECT_TRUE(answers[0].is(kServiceVerification, kSubserviceRefused)) << "it has no trailer";
}

TEST(Lasso, AResetIsDueAtTheEndOfItsFrame) {
  VERIFIES("LASSO-EXE-010~2");
  Hosted hosted;
  hosted.answer_to(test::arm(CommandKind::kReset, 1));
  hosted.answer_to(test::plain_packet(CommandKind::kReset, 2));
  EXPECT_FALSE(reset_due(hosted.component));
  hosted.run_to(1);
  EXPECT_TRUE(reset_due(hosted.component));
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

// A host whose loop runs before it has begun: at any time, before and after an image is loaded.
TEST(Lasso, DoesNothingBeforeItBegins) {
  VERIFIES("LASSO-EXE-010~2");
  const auto memory = std::make_unique<Memory>();
  test::BoxSensor sensor(test::default_scene());
  Component& component = *create(memory->bytes, sizeof(Memory::bytes), sensor);
  for (const TimeUs now_us : {TimeUs{0}, TimeUs{-1'000'000'000}, TimeUs{1'000'000'000}}) EXPECT_FALSE(step(component, now_us)) << now_us;
  test::TestImage image = test::make_box_image(test::box_parameters(test::default_scene()), test::default_scene().box);
  ASSERT_EQ(load_image(component, Bytes(image.data(), image.size)).status, Status::kOk);
  EXPECT_FALSE(step(component, 0));
  std::uint8_t out[kMaxPosePacketBytes];
  EXPECT_EQ(take_telemetry(component, Bytes(out)), 0U);
  ASSERT_EQ(begin(component, 0), Status::kOk);
  EXPECT_TRUE(step(component, 0));
}

TEST(Lasso, DoesNothingBeforeItsTime) {
  VERIFIES("LASSO-EXE-010~2");
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
  EXPECT_EQ(offer_start(component, InitialPoseSource::kNone, StartOffer{}), StartRefusal::kNoSuchSource);
  EXPECT_EQ(command_mode(component, TrackingMode::kCoasting), ModeRefusal::kNotByCommand);
  EXPECT_EQ(command_mode(component, TrackingMode::kBearing), ModeRefusal::kNone);
  hold_mode(component, true);
  const TimeUs next_us = next_slot_us(component);
  EXPECT_FALSE(step(component, next_us - 10'000'000));
  EXPECT_TRUE(step(component, next_us - 10'000'001)) << "the clock was set back";
}

}  // namespace
}  // namespace lasso
