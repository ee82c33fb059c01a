#include "mdat/link/upload.hpp"

#include <cstdio>
#include <memory>

#include "bsp/posix/links.hpp"
#include "mdat/cli/commands.hpp"
#include "mdat/common/errors.hpp"
#include "mdat/common/flight_image.hpp"

namespace lasso::mdat {
namespace {

struct UploadArguments {
  std::string image, to, key;
  UploadOptions upload;
  bool unchecked = false, cached = true;
};

// A flight image, or a mission that is compiled to one.
std::vector<std::uint8_t> image_of(const UploadArguments& options) {
  if (!is_image_file(options.image)) {
    const CompiledMission mission = compile_mission(options.image, ModelCache::of_user_if(options.cached));
    return image_bytes(mission, mission.source.parameters);
  }
  std::vector<std::uint8_t> bytes = read_bytes(options.image);
  if (!options.unchecked) static_cast<void>(LoadedImage(options.image, bytes));
  return bytes;
}

void run(const UploadArguments& options) {
  UploadOptions how = options.upload;
  if (!options.key.empty()) how.key = load_key(options.key);
  const std::vector<std::uint8_t> given = image_of(options);
  if (!options.unchecked) check_signature(options.image, given, how.key);
  const std::vector<std::uint8_t> image = image_to_send(given, how.key);
  const std::unique_ptr<posix::PosixLink> link = posix::connect_link(options.to);
  how.ended = [&link] { return link->ended(); };
  const UploadEnd end = upload(*link, options.to, image, how);
  const unsigned crc = image_crc(image);
  if (end == UploadEnd::kReady)
    std::printf("%s: image %08x is ready: mdat command activate_image crc=%u --arm --to %s\n", options.to.c_str(), crc, crc,
                options.to.c_str());
  if (end == UploadEnd::kOnTrial)
    std::printf("%s: image %08x is active, and not confirmed yet: it has had too few scans\n", options.to.c_str(), crc);
  if (end == UploadEnd::kConfirmed) std::printf("%s: image %08x is active and confirmed\n", options.to.c_str(), crc);
}

}  // namespace

void add_upload_command(CLI::App& app) {
  const auto options = std::make_shared<UploadArguments>();
  CLI::App* subcommand = app.add_subcommand("upload", "load a mission image into a running component, check it there, and make it active");
  subcommand->add_option("IMAGE", options->image, "flight image (mdat mission compile), or a mission file")->required();
  subcommand
      ->add_option("--to", options->to, "udp://HOST:PORT or tcp://HOST:PORT; what was loaded of the same image before is not sent again")
      ->required();
  subcommand->add_option(
      "--key", options->key,
      "file with the key that the component asks commands to be signed with (64 hexadecimal digits); the master key signs an image that "
      "is not signed, too");
  add_apid(*subcommand, options->upload.apid);
  subcommand->add_flag("--activate", options->upload.activate, "arm and activate it, and wait until its first scans confirm it");
  subcommand->add_flag("--unchecked", options->unchecked, "send a flight image even if it is wrong: the component refuses it");
  add_no_cache(*subcommand, options->cached);
  subcommand->add_option("--wait", options->upload.answer_s, "seconds to wait for an answer")
      ->capture_default_str()
      ->check(number_between(0.1, 3600.0));
  subcommand->add_option("--trial-wait", options->upload.trial_s, "seconds to wait for its first scans")
      ->capture_default_str()
      ->check(number_between(0.0, 3600.0));
  subcommand->callback([options] {
    try {
      run(*options);
    } catch (const posix::NobodyThere& error) {
      throw RunError(error.what());
    } catch (const posix::LinkError& error) {
      throw InputError(error.what());
    }
  });
}

}  // namespace lasso::mdat
