#include "mdat/serve/watch.hpp"

#include <algorithm>
#include <iterator>
#include <memory>
#include <optional>
#include <string_view>

#include "mdat/common/flight_image.hpp"
#include "mdat/common/text.hpp"
#include "mdat/recording/link_recorder.hpp"

namespace lasso::mdat::serve {
namespace {

constexpr double kLookEach_s = 0.2;
constexpr std::string_view kReached[] = {"udp://", "tcp://", "serial:/dev/"};
constexpr std::size_t kLongestAddress = 200;

}  // namespace

void watch_link(const WatchOrder& order, const std::string& commit, const std::atomic<bool>& ending, CommandDesk& desk,
                const WatchTold& told) {
  std::optional<CompiledMission> mission;
  if (!order.mission.empty()) mission = compile_mission(order.mission);
  LinkRecorderOptions options;
  options.file = order.file;
  options.head = link_recording_head(mission ? &*mission : nullptr, order.address, {{"commit", commit}});
  if (mission) options.target = &mission->mesh;
  std::unique_ptr<LinkRecorder> recorder;
  Connection connection({order.address, false, order.key, order.apid}, [&](const DecodedPacket& packet) {
    told.packet(packet.bytes);
    const std::uint64_t frames = recorder->frames();
    recorder->take(packet);
    if (recorder->frames() > frames) told.written(recorder->files().back(), recorder->flush(), recorder->frames());
  });
  recorder = std::make_unique<LinkRecorder>(std::move(options));
  told.begun();
  while (!ending) {
    connection.listen(kLookEach_s, [&] { return ending || desk.waiting(); });
    if (ending) break;
    if (connection.station() != nullptr)
      desk.work(*connection.station(), told.commanded);
    else
      desk.drop("the link has ended");
    told.looked(connection);
  }
  desk.drop("the connection has ended");
  recorder->close();
}

std::string address_fault(const std::string& address) {
  const auto begins = [&](std::string_view with) { return address.size() > with.size() && address.rfind(with, 0) == 0; };
  const bool reached = std::any_of(std::begin(kReached), std::end(kReached), begins);
  if (reached && address.size() <= kLongestAddress && address.find("..") == std::string::npos) return "";
  return "address: expected udp://HOST:PORT, tcp://HOST:PORT or serial:/dev/NAME";
}

std::string watch_command(const WatchOrder& order) {
  std::string text = "mdat monitor " + shell_word(order.address);
  if (!order.mission.empty()) text += " --mission " + shell_word(order.mission.string());
  if (order.apid != kApid) text += " --apid " + std::to_string(order.apid);
  return text + " --record " + shell_word(order.file.string()) + " --live";
}

}  // namespace lasso::mdat::serve
