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
  bool unchecked = false, cached = true, plain = false;
};

// A component with no key takes a signature for bytes too many.
void settle_signature(const UploadArguments& options, std::vector<std::uint8_t>& image) {
  if (!options.key.empty() || !has_signature(image)) return;
  if (options.plain) {
    image = without_signature(image);
    return;
  }
  std::fprintf(stderr, "%s: is signed, and sent with its signature: a component without a key takes it with --unsigned alone\n",
               options.image.c_str());
}

// Read and checked before anybody is called: what the component would refuse at the end of it is not sent.
std::vector<std::uint8_t> image_of_file(const UploadArguments& options, const std::optional<Key>& key) {
  std::vector<std::uint8_t> bytes = read_bytes(options.image);
  settle_signature(options, bytes);
  if (options.unchecked) return image_to_send(bytes, key);
  static_cast<void>(LoadedImage(options.image, bytes));
  check_signature(options.image, bytes, key);
  return image_to_send(bytes, key);
}

std::vector<std::uint8_t> image_of_mission(const UploadArguments& options, const std::optional<Key>& key) {
  const CompiledMission mission = compile_mission(options.image, ModelCache::of_user_if(options.cached));
  return image_to_send(image_bytes(mission, mission.source.parameters), key);
}

void run(const UploadArguments& options) {
  UploadOptions how = options.upload;
  if (!options.key.empty()) how.key = load_key(options.key);
  const bool is_file = is_image_file(options.image);
  std::vector<std::uint8_t> image;
  if (is_file) image = image_of_file(options, how.key);
  const std::unique_ptr<posix::PosixLink> link = posix::connect_link(options.to);
  if (!is_file) image = image_of_mission(options, how.key);
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
      ->add_option(
          "--to", options->to,
          "udp://HOST:PORT, tcp://HOST:PORT, serial:DEVICE or unix:PATH; what was loaded of the same image before is not sent again")
      ->required();
  CLI::Option* key = subcommand->add_option(
      "--key", options->key,
      "file with the key that the component asks commands to be signed with (64 hexadecimal digits); the master key signs an image that "
      "is not signed, too");
  add_apid(*subcommand, options->upload.apid);
  subcommand->add_flag("--activate", options->upload.activate, "arm and activate it, and wait until its first scans confirm it");
  subcommand->add_flag("--unsigned", options->plain, "leave the signature of a flight image behind, for a component without a key")
      ->excludes(key);
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
