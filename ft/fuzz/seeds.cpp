// fuzz_seeds FOLDER: the inputs that the fuzzers start from, FOLDER/HARNESS/NAME: good ones of each kind, since from nothing a fuzzer finds
// no way past magic numbers and check sums.
#include <cstdio>
#include <exception>
#include <filesystem>
#include <fstream>
#include <string>

#include "fsw/link/commands.hpp"
#include "fsw/link/pose_telemetry.hpp"
#include "fsw/mission/mission.hpp"
#include "fsw/pose/estimator.hpp"
#include "ft/fuzz/small_image.hpp"
#include "hal_lcs/messages.hpp"
#include "hal_sim/scan_file.hpp"

namespace lasso::fuzz {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kLargestInputBytes = 16384;

void write(const fs::path& file, const std::string& bytes) {
  fs::create_directories(file.parent_path());
  std::ofstream out(file, std::ios::binary);
  out << bytes;
  if (!out.flush()) throw std::runtime_error("cannot write " + file.string());
}

// The option byte, then what it speaks of.
std::string seed(char option, const void* bytes, std::size_t size) {
  return std::string(1, option) + std::string(static_cast<const char*>(bytes), size);
}
std::string seed(char option, const std::string& text) { return seed(option, text.data(), text.size()); }

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
}

}  // namespace
}  // namespace lasso::fuzz

int main(int argc, char** argv) {
  if (argc != 2) {
    (void)std::fprintf(stderr, "usage: fuzz_seeds FOLDER\n");
    return 2;
  }
  try {
    const std::filesystem::path folder = argv[1];
    lasso::fuzz::write_commands(folder / "command");
    lasso::fuzz::write_images(folder / "image");
    lasso::fuzz::write_frames(folder / "frame");
    lasso::fuzz::write_lines(folder / "line");
    lasso::fuzz::write_packets(folder / "packet");
    lasso::fuzz::write_scans(folder / "scan");
  } catch (const std::exception& error) {
    (void)std::fprintf(stderr, "fuzz_seeds: %s\n", error.what());
    return 1;
  }
  return 0;
}
