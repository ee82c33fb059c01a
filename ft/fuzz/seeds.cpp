// fuzz_seeds FOLDER MISSIONS: the inputs that the fuzzers start from, FOLDER/HARNESS/NAME: good ones of each kind, since from nothing a
// fuzzer finds no way past magic numbers and checksums. MISSIONS is the folder of the shipped missions.
#include <cstdio>
#include <exception>
#include <filesystem>
#include <fstream>
#include <string>

#include "fsw/link/commands.hpp"
#include "fsw/link/pose_telemetry.hpp"
#include "fsw/mission/mission.hpp"
#include "fsw/pose/estimator/estimator.hpp"
#include "ft/fuzz/request_seeds.hpp"
#include "ft/fuzz/seed_file.hpp"
#include "ft/fuzz/small_image.hpp"
#include "hal_lcs/messages.hpp"
#include "hal_sim/scan_file.hpp"
#include "ut/support/grey_png.hpp"

namespace lasso::fuzz {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kLargestInputBytes = 16384;

// A seed that does not load, gives no pose, or is cut to the fuzzer's largest input leads nowhere.
void check_seed(test::TestImage image) {
  if (image.size >= kLargestInputBytes)
    throw std::runtime_error("the seed image of " + std::to_string(image.size) +
                             " bytes is larger than an input (LARGEST_BYTES in ft/fuzz/run)");
  Mission mission;
  const LoadFailure failure = load_image(Bytes(image.data(), image.size), mission);
  if (failure.status != Status::kOk) throw std::runtime_error(std::string("the seed image is refused: ") + failure.what);
  const Registration result = std::make_unique<Estimator>()->estimate(mission, *small_scan(), {small_start(), Twist{}, false});
  if (!result.valid()) throw std::runtime_error(std::string("the seed image gives no valid pose: ") + to_string(result.reason));
}

void write_images(const fs::path& folder) {
  MissionParameters parameters = preset_parameters();
  parameters.inliers_min = 20;
  parameters.sigma0_m = 0.003;  // the scan's
  for (const bool silhouettes : {false, true}) {
    parameters.silhouettes = silhouettes ? 1 : 0;
    test::TestImage image = small_image(parameters, !silhouettes);
    check_seed(image);
    const std::string name = silhouettes ? "silhouettes" : "hits_and_part";
    for (const char option : {'\0', '\1', '\2', '\4', '\10'})
      write(folder / (name + std::to_string(option)), seed(option, image.data(), image.size));
  }
}

void write_packets(const fs::path& folder) {
  PoseTelemetry pose;
  PacketHeader header;
  std::uint8_t packet[kMaxPosePacketBytes];
  write(folder / "empty", seed(0, packet, encode_pose(pose, header, Bytes(packet))));
  pose.valid = 1;
  pose.p_sensor_target_m[2] = 4;
  pose.inliers = 700;
  header.t_us = 1234567;
  header.sequence_count = header.message_count = 5;
  write(folder / "tracking", seed(1, packet, encode_pose(pose, header, Bytes(packet))));
}

void write_commands(const fs::path& folder) {
  std::uint8_t packet[256];
  CommandHeader header;
  header.service = 17;
  header.subservice = 1;
  const auto put = [&](std::uint16_t function, std::size_t bytes) {
    header.service = kServiceFunction;
    ByteWriter writer{Bytes(packet)};
    begin_command(header, writer);
    writer.u16(function);
    for (std::size_t i = 0; i < bytes; ++i) writer.u8(0);
    write(folder / ("function" + std::to_string(function)), seed(14, packet, finish_packet(writer, Bytes(packet))));
  };
  put(1, 1);
  put(2, 1);
  put(3, 197);
  header.service = kServiceTest;
  for (const std::size_t bytes : {0U, 40U, 243U}) {
    ByteWriter writer{Bytes(packet)};
    begin_command(header, writer);
    for (std::size_t i = 0; i < bytes; ++i) writer.u8(static_cast<std::uint8_t>(i));
    const std::size_t size = finish_packet(writer, Bytes(packet));
    write(folder / ("repaired" + std::to_string(bytes)), seed(14, packet, size));
    write(folder / ("as_it_is" + std::to_string(bytes)), seed(31, packet, size));
  }
}

// One of each message: as bytes, and as a frame that the fuzzer makes.
void write_frames(const fs::path& folder) {
  int number = 0;
  const auto say = [&](const auto&... message) {
    const lcs::FrameBytes bytes = lcs::encode(1, message...);
    const std::string text(reinterpret_cast<const char*>(bytes.bytes), bytes.size);
    const std::string name = std::to_string(number++);
    write(folder / ("bytes" + name), seed(41, text));
    write(folder / ("frame" + name), seed(40, std::string{text[3], text[2]} + text.substr(5, bytes.size - lcs::kFrameOverhead)));
  };
  lcs::AimCommand aim;
  aim.count = lcs::kAimedPerFrame;
  lcs::Samples samples;
  samples.count = lcs::kSamplesPerFrame;
  say(lcs::Type::kAbort);
  say(lcs::LaserCommand::kArm);
  say(aim);
  say(lcs::StartCommand{});
  say(lcs::Answer{});
  say(lcs::CameraStatus{});
  say(samples);
  for (lcs::RawSample& sample : samples.samples) sample.kind = lcs::SampleKind::kEcho;
  say(samples);
  say(lcs::ScanEnd{});
}

// A scan of 64 points as it should come: answer, samples, end.
void write_lines(const fs::path& folder) {
  std::string frames;
  std::string stream;
  const auto say = [&](const auto& message) {
    const lcs::FrameBytes bytes = lcs::encode(static_cast<std::uint8_t>(stream.size()), message);
    const auto* const begin = reinterpret_cast<const char*>(bytes.bytes);
    stream.append(begin, bytes.size);
    frames += begin[3];  // type, length, payload: the fuzzer makes frames of them again
    frames += begin[2];
    frames.append(begin + 5, bytes.size - lcs::kFrameOverhead);
  };
  lcs::CameraStatus status;
  status.serial = 1;
  status.device = lcs::Device::kTridar;
  say(status);
  say(lcs::Answer{lcs::Type::kStart, 5, lcs::Result::kDone, 0});
  for (std::uint16_t first = 0; first < 64; first = static_cast<std::uint16_t>(first + lcs::kSamplesPerFrame)) {
    lcs::Samples samples;
    samples.tag = 0x55;
    samples.first = first;
    samples.count = lcs::kSamplesPerFrame;
    for (std::size_t i = 0; i < samples.count; ++i) {
      samples.samples[i].clock_us = static_cast<std::uint32_t>((first + i) * 2857);
      samples.samples[i].peak = 0.05;
      samples.samples[i].flight_us = 0.5;
      samples.samples[i].kind = first < 32 ? lcs::SampleKind::kReturn : lcs::SampleKind::kEcho;
    }
    say(samples);
  }
  say(lcs::ScanEnd{0x55, 64, true});
  write(folder / "frames", seed(static_cast<char>(0xFE), frames));
  write(folder / "bytes", seed(static_cast<char>(0xFF), stream));
  write(folder / "few_at_a_time", seed(6, frames));
}

std::string csv_text(const fs::path& folder) {
  const fs::path file = folder / "made.csv";
  const auto scan = small_scan();
  RangeImage few;
  for (std::size_t i = 0; i < scan->samples.size(); i += 9) static_cast<void>(few.samples.push_back(scan->samples[i]));
  sim::write_scan_csv(file, few);
  std::ifstream in(file);
  std::string text((std::istreambuf_iterator<char>(in)), {});
  fs::remove(file);
  return text;
}

std::string binary(std::initializer_list<float> values, bool big_endian) {
  std::string bytes;
  for (const float value : values) {
    std::uint32_t word = 0;
    std::memcpy(&word, &value, 4);
    for (int i = 0; i < 4; ++i) bytes += static_cast<char>(word >> (big_endian ? 24 - 8 * i : 8 * i));
  }
  return bytes;
}

std::string ply(const std::string& format) {
  return "ply\nformat " + format +
         " 1.0\ncomment made\nelement vertex 2\nproperty float x\nproperty float y\nproperty float z\nend_header\n";
}

std::string pcd(const std::string& data) {
  return "# .PCD v0.7\nVERSION 0.7\nFIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\nWIDTH 2\nHEIGHT 1\nVIEWPOINT 0 0 0 1 0 0 0\nPOINTS "
         "2\nDATA " +
         data + "\n";
}

// Two points with a descriptor of 33 numbers each, as PCL writes them: most of a point is none of the scan's.
std::string described_pcd() {
  const std::string rest(33 * sizeof(float), '\0');
  return "VERSION 0.7\nFIELDS x y z fpfh\nSIZE 4 4 4 4\nTYPE F F F F\nCOUNT 1 1 1 33\nWIDTH 2\nHEIGHT 1\nPOINTS 2\nDATA binary\n" +
         binary({0.1F, 0.2F, 3}, false) + rest + binary({-0.1F, 0.2F, 3.5F}, false) + rest;
}

void write_scans(const fs::path& folder) {
  const std::string ascii = "0.1 0.2 3\n-0.1 0.2 3.5\n";
  const std::initializer_list<float> points = {0.1F, 0.2F, 3, -0.1F, 0.2F, 3.5F};
  fs::create_directories(folder);
  write(folder / "csv", seed(0, csv_text(folder)));
  write(folder / "ply_ascii", seed(1, ply("ascii") + ascii));
  write(folder / "ply_little", seed(1, ply("binary_little_endian") + binary(points, false)));
  write(folder / "ply_big", seed(1, ply("binary_big_endian") + binary(points, true)));
  write(folder / "pcd_ascii", seed(2, pcd("ascii") + ascii));
  write(folder / "pcd_binary", seed(2, pcd("binary") + binary(points, false)));
  write(folder / "pcd_described", seed(2, described_pcd()));
  const std::string lengths("\x19\0\0\0\x18\0\0\0", 8);
  write(folder / "pcd_compressed", seed(2, pcd("binary_compressed") + lengths + '\x17' + binary(points, false)));
  write(folder / "ply_lists",
        seed(1,
             "ply\nformat ascii 1.0\nelement camera 1\nproperty list uchar int k\nelement vertex 1\nproperty float x\nproperty "
             "list uchar int k\nproperty float y\nproperty float z\nend_header\n2 1 1\n1 1 7 2 nan\n"));
  write(folder / "text", seed(3, "//X;Y;Z\n0,1; 0,2; 3\nnan;nan;nan\n"));
  write(folder / "depth", seed(4, test::grey_png(2, {0, 1000, 65535, 1})));
}

// A tetrahedron in each format.
constexpr float kCorners[4][3] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
constexpr int kFaces[4][3] = {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}};

std::string corner_text(int corner) {
  std::string text;
  for (const float value : kCorners[corner]) text += ' ' + std::to_string(static_cast<int>(value));
  return text + "\n";
}

std::string stl_text() {
  std::string text = "solid seed\n";
  for (const auto& face : kFaces) {
    text += "facet normal 0 0 0\nouter loop\n";
    for (const int corner : face) text += "vertex" + corner_text(corner);
    text += "endloop\nendfacet\n";
  }
  return text + "endsolid seed\n";
}

std::string stl_binary() {
  std::string bytes = std::string(80, ' ') + std::string("\4\0\0\0", 4);
  for (const auto& face : kFaces) {
    bytes += std::string(12, '\0');
    for (const int corner : face) bytes += binary({kCorners[corner][0], kCorners[corner][1], kCorners[corner][2]}, false);
    bytes += std::string(2, '\0');
  }
  return bytes;
}

std::string obj_text() {
  std::string text = "# seed\n";
  for (int corner = 0; corner < 4; ++corner) text += "v" + corner_text(corner);
  return text + "vt 0 0\nf 1/1 3/1 2/1\nf 1//1 2//1 \\\n 4//1\nf -4 -1 -2\nf 2 3 4\nl 1 2\nf 1 2 3 4\n";
}

std::string ply_head(const std::string& format, const std::string& faces) {
  return "ply\nformat " + format + " 1.0\nelement camera 1\nproperty uchar on\nelement vertex 4\nproperty float x\nproperty float y\n" +
         "property float z\n" + faces + "property list uchar uchar vertex_indices\nend_header\n";
}

std::string ply_text() {
  std::string text = ply_head("ascii", "element face 4\n") + "1\n";
  for (int corner = 0; corner < 4; ++corner) text += corner_text(corner).substr(1);
  return text + "3 0 2 1\n3 0 1 3\n3 0 3 2\n3 1 2 3\n";
}

std::string ply_strip(bool big_endian) {
  std::string bytes = ply_head(big_endian ? "binary_big_endian" : "binary_little_endian", "element tristrips 1\n") + '\1';
  for (const auto& corner : kCorners) bytes += binary({corner[0], corner[1], corner[2]}, big_endian);
  return bytes + std::string("\6\0\2\1\3\0\2", 7);
}

// Its buffer: positions, then indices.
std::string gltf_buffer() {
  std::string bytes;
  for (const auto& corner : kCorners) bytes += binary({corner[0], corner[1], corner[2]}, false);
  for (const auto& face : kFaces) {
    for (const int corner : face) bytes += static_cast<char>(corner);
  }
  return bytes;
}

std::string gltf_json(const std::string& uri) {
  return R"({"asset":{"version":"2.0"},"scenes":[{"nodes":[0]}],"nodes":[{"children":[1],"scale":[1,-1,1]},{"mesh":0,"translation":[0,0,1]}],)"
         R"("meshes":[{"primitives":[{"attributes":{"POSITION":0},"indices":1},{"attributes":{"POSITION":0},"mode":5}]}],)"
         R"("buffers":[{"byteLength":60)" +
         uri +
         R"(}],"bufferViews":[{"buffer":0,"byteLength":48,"byteStride":12},{"buffer":0,"byteOffset":48,"byteLength":12}],)"
         R"("accessors":[{"bufferView":0,"componentType":5126,"count":4,"type":"VEC3"},)"
         R"({"bufferView":1,"componentType":5121,"count":12,"type":"SCALAR","sparse":{"count":1,"indices":{"bufferView":1,)"
         R"("componentType":5121},"values":{"bufferView":1}}}]})";
}

std::string glb() {
  const auto word = [](std::size_t value) {
    std::string bytes;
    for (int shift = 0; shift < 32; shift += 8) bytes += static_cast<char>(value >> shift);
    return bytes;
  };
  const std::string json = gltf_json(""), data = gltf_buffer();
  return "glTF" + word(2) + word(28 + json.size() + data.size()) + word(json.size()) + "JSON" + json + word(data.size()) +
         std::string("BIN\0", 4) + data;
}

// The buffer's bytes as a data URI without base64: each as % and two digits.
std::string data_uri() {
  std::string uri = R"(,"uri":"data:,)";
  for (const char byte : gltf_buffer()) {
    constexpr char kDigits[] = "0123456789ABCDEF";
    const auto bits = static_cast<unsigned char>(byte);
    uri += {'%', kDigits[bits >> 4], kDigits[bits & 15]};
  }
  return uri + '"';
}

void write_meshes(const fs::path& folder) {
  write(folder / "stl_text", seed(0, stl_text()));
  write(folder / "stl_binary", seed(0, stl_binary()));
  write(folder / "obj", seed(1, obj_text()));
  write(folder / "ply_text", seed(2, ply_text()));
  write(folder / "ply_little", seed(2, ply_strip(false)));
  write(folder / "ply_big", seed(2, ply_strip(true)));
  write(folder / "gltf", seed(3, gltf_json(data_uri())));
  write(folder / "glb", seed(4, glb()));
}

std::string content_of(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

// The shipped missions, whose target becomes the mesh that the harness has, and a mission of the fewest lines.
void write_missions(const fs::path& folder, const fs::path& missions) {
  const std::string target = "[target]\nmesh = \"target.obj\"\n";
  write(folder / "least", "[mission]\nid = 1\nversion = 1\nname = \"seed\"\n" + target);
  for (const auto& entry : fs::directory_iterator(missions)) {
    std::string text = content_of(entry.path());
    const std::size_t begin = text.find("[target]");
    const std::size_t end =
        text.find("\n[", text.find("[target.parameters]") == std::string::npos ? begin : text.find("[target.parameters]"));
    if (entry.path().extension() != ".toml" || begin == std::string::npos || end == std::string::npos) continue;
    write(folder / entry.path().stem(), text.replace(begin, end - begin, target));
  }
}

}  // namespace
}  // namespace lasso::fuzz

int main(int argc, char** argv) {
  if (argc != 3) {
    (void)std::fprintf(stderr, "usage: fuzz_seeds FOLDER MISSIONS\n");
    return 2;
  }
  try {
    const std::filesystem::path folder = argv[1];
    lasso::fuzz::write_commands(folder / "command");
    lasso::fuzz::write_images(folder / "image");
    lasso::fuzz::write_frames(folder / "frame");
    lasso::fuzz::write_lines(folder / "line");
    lasso::fuzz::write_meshes(folder / "mesh");
    lasso::fuzz::write_missions(folder / "mission", argv[2]);
    lasso::fuzz::write_packets(folder / "packet");
    lasso::fuzz::write_requests(folder / "request");
    lasso::fuzz::write_scans(folder / "scan");
  } catch (const std::exception& error) {
    (void)std::fprintf(stderr, "fuzz_seeds: %s\n", error.what());
    return 1;
  }
  return 0;
}
