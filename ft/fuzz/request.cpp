// Text that claims to be a request of a browser, to the handlers of mdat serve, which have a small recording and a mission. The first byte
// says whether the asker has the token; ID in the target stands for that of the recording. Each request is answered, none with an error of
// the server's own, and nobody without the token gets anything. One recording alone is served: nothing is flown, connected or copied.
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "fsw/link/pose_telemetry.hpp"
#include "ft/fuzz/exact.hpp"
#include "mdat/mcap/writer.hpp"
#include "mdat/recording/recording_head.hpp"
#include "mdat/recording/ros_messages.hpp"
#include "mdat/serve/json_body.hpp"
#include "mdat/serve/live_answers.hpp"
#include "mdat/serve/service.hpp"
#include "mdat/serve/target.hpp"

namespace lasso::fuzz {
namespace {

namespace fs = std::filesystem;
namespace serve = mdat::serve;
namespace ros = mdat::ros;
namespace mcap = mdat::mcap;

constexpr char kToken[] = "00112233445566778899aabbccddeeff";
constexpr std::size_t kFrames = 5;

std::string packet_of(std::size_t frame) {
  PoseTelemetry pose;
  pose.scan_id = static_cast<std::uint32_t>(frame);
  pose.t_measurement_us = static_cast<TimeUs>(1000 + 100 * frame);
  pose.p_sensor_target_m[2] = 4;
  pose.valid = frame % 2;
  std::uint8_t bytes[kMaxPosePacketBytes];
  const std::size_t size = encode_pose(pose, PacketHeader{}, Bytes(bytes));
  return {reinterpret_cast<const char*>(bytes), size};
}

// Three points of x, y, z, and nothing else that a cloud may say.
std::string cloud_of() {
  ros::PointCloud cloud;
  cloud.fields = {{"x", 0, ros::FieldType::kFloat32}, {"y", 4, ros::FieldType::kFloat32}, {"z", 8, ros::FieldType::kFloat32}};
  cloud.step = 12;
  for (int i = 0; i < 9; ++i) mcap::put(static_cast<float>(i), cloud.data);
  return ros::point_cloud_bytes({0, "sensor"}, cloud);
}

void write_recording(const fs::path& file) {
  mcap::Writer writer(file, "ros2", "fuzz");
  const std::uint16_t cloud_schema = writer.add_schema("sensor_msgs/msg/PointCloud2", "ros2msg", "");
  const std::uint16_t packets = writer.add_channel("/packets", cloud_schema, "cdr"),
                      truth = writer.add_channel("/truth", cloud_schema, "cdr");
  const std::uint16_t events = writer.add_channel("/events", cloud_schema, "cdr"), scan = writer.add_channel("/scan", cloud_schema, "cdr");
  const std::uint16_t scene = writer.add_channel("/scene", cloud_schema, "cdr");
  writer.add_metadata(mdat::kRecordingMetadata, {{"seed", "1"}});
  const std::vector<Vec3> points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  const std::vector<std::array<std::uint32_t, 3>> triangles = {{0, 1, 2}};
  writer.write(scene, 0, ros::scene_bytes(0, {{"target", "target", &points, &triangles, Vec3::Ones(), 1}}));
  for (std::size_t frame = 0; frame < kFrames; ++frame) {
    const auto time_ns = std::uint64_t{1000} * (1000 + 100 * frame);
    writer.write(packets, time_ns, ros::packet_bytes({}, packet_of(frame)));
    writer.write(truth, time_ns, ros::pose_bytes({}, Pose{Quat::Identity(), Vec3(0, 0, 4)}));
    writer.write(events, time_ns, ros::log_bytes(0, ros::LogLevel::kWarn, "scan_lost", "sensor 0"));
    writer.write(scan, time_ns, cloud_of());
  }
  writer.close();
}

void write_mission(const fs::path& folder) {
  std::ofstream(folder / "target.obj") << "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n";
  std::ofstream(folder / "m.toml") << "[mission]\nid = 1\nversion = 1\nname = \"m\"\n[target]\nmesh = \"target.obj\"\n";
}

// A folder of this process, and who serves a recording of it.
class Place {
 public:
  Place() : path_(fs::temp_directory_path() / ("lasso_fuzz_request_" + std::to_string(getpid()))) {
    fs::create_directories(path_);
    write_recording(path_ / "a.mcap");
    write_mission(path_);
    folder_ = std::make_unique<serve::Folder>(path_ / "a.mcap");
    live_ = std::make_unique<serve::Live>(*folder_, "fuzz");
    service_ = std::make_unique<serve::Service>(gate_, *folder_, serve::ServiceOptions{"fuzz", {}, live_.get()});
    id_ = folder_->list().at(0).id;
  }
  ~Place() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
  }
  Place(const Place&) = delete;
  Place& operator=(const Place&) = delete;
  serve::Service& service() { return *service_; }
  const std::string& id() const { return id_; }

 private:
  fs::path path_;
  serve::Gate gate_{"127.0.0.1", 8080, kToken};
  std::unique_ptr<serve::Folder> folder_;
  std::unique_ptr<serve::Live> live_;
  std::unique_ptr<serve::Service> service_;
  std::string id_;
};

std::string_view take_line(std::string_view& text) {
  const std::string_view line = text.substr(0, text.find('\n'));
  text.remove_prefix(std::min(line.size() + 1, text.size()));
  return line;
}

// Method and target in the first line, then headers, an empty line, and the body. Host and token are there without being said.
serve::Request request_of(std::string_view text, bool known, const std::string& id) {
  serve::Request request;
  request.headers["host"] = "127.0.0.1:8080";
  if (known) request.headers["cookie"] = std::string("lasso8080=") + kToken;
  std::string_view first = take_line(text);
  if (first.substr(0, 5) == "HEAD ") request.method = serve::Method::kHead;
  if (first.substr(0, 5) == "POST ") request.method = serve::Method::kPost;
  first.remove_prefix(std::min(first.find(' ') + 1, first.size()));
  request.target = std::string(first);
  for (std::size_t at = request.target.find("ID"); at != std::string::npos; at = request.target.find("ID", at + id.size()))
    request.target.replace(at, 2, id);
  for (std::string_view line = take_line(text); !line.empty(); line = take_line(text)) {
    const std::size_t colon = std::min(line.find(": "), line.size());
    request.headers[std::string(line.substr(0, colon))] = std::string(line.substr(std::min(colon + 2, line.size())));
  }
  request.body = std::string(text);
  return request;
}

// Only the first look is flown into the folder of a recording that is served alone.
bool is_harmless(const std::string& target) {
  const std::optional<serve::Target> parsed = serve::parse_target(target);
  return !parsed || parsed->path.find("first") == std::string::npos;
}

// What is asked of a component: nobody is connected, so the service itself would not look at its values.
void order_command(const serve::Request& request) {
  serve::CommandDesk desk;
  try {
    (void)desk.order(serve::command_order(serve::json_body(request)));
    expect(desk.waiting(), "a command that is taken waits");
  } catch (const serve::Refusal& refusal) {
    expect(refusal.status == 400 || refusal.status == 415, "what is no command is refused");
    expect(!desk.waiting(), "what is refused does not wait");
  }
}

void answer(ConstBytes input) {
  static Place place;
  if (input.empty()) return;
  const std::string_view text(reinterpret_cast<const char*>(input.data()) + 1, input.size() - 1);
  const bool known = input[0] % 2 != 0;
  serve::Request request = request_of(text, known, place.id());
  const bool posts = request.method == serve::Method::kPost;
  if (posts && request.target == "/api/live/command") order_command(request);
  if (posts && !is_harmless(request.target)) request.target = "/";
  const bool told = known || request.header("cookie").find(kToken) != std::string_view::npos ||
                    request.header("authorization").find(kToken) != std::string_view::npos ||
                    request.target.find(kToken) != std::string::npos;
  const serve::Response response = place.service().answer(request);
  expect(response.status != 500, "no error of the server's own");
  expect(told || response.status >= 400, "who has no token gets nothing");
  const serve::SocketOpening opening = place.service().open(request);
  expect(opening.begin != nullptr || opening.refusal.has_value(), "a socket is opened or refused");
}

}  // namespace
}  // namespace lasso::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  lasso::fuzz::answer({data, size});
  return 0;
}
