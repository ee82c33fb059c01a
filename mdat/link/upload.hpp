// A mission image on its way into a running component: loaded in parts, those that are missing only, checked there, and made active.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "fsw/link/byte_link.hpp"
#include "mdat/link/signature.hpp"

namespace lasso::mdat {

struct UploadOptions {
  bool activate = false;
  std::optional<Key> key;  // that commands are signed with
  std::uint16_t apid = kApid;
  std::function<bool()> ended;  // has the other end gone for good? Empty: nobody knows
  double answer_s = 5;          // to wait for the answer of a command
  double trial_s = 30;          // to wait until an image that is active is confirmed, or taken back
};

enum class UploadEnd {
  kReady,      // checked, and ready to be made active
  kOnTrial,    // active; it has not had the scans yet that confirm it
  kConfirmed,  // active, and has given valid poses
};

// The checksum by which a component names an image: its last four bytes, before its signature.
std::uint32_t image_crc(const std::vector<std::uint8_t>& image);

// What a component that has `key` takes: an image that is not signed is signed with it, where it is the master. A signed one is sent as it
// is: without a key, too, as the link may be authenticated below the component, and the image is judged all the same.
std::vector<std::uint8_t> image_to_send(const std::vector<std::uint8_t>& image, const std::optional<Key>& key);

// Throws InputError, which names `name`, where a component that has `key` would refuse the image for its signature.
void check_signature(const std::string& name, const std::vector<std::uint8_t>& image, const std::optional<Key>& key);

// What was loaded of the same image before, by whomever, is not sent again. Says on standard error how far it is. Throws RunError, which
// names the link and says what went wrong: nobody answers, a command or the image is refused, or it is taken back. The link is the ground's
// end of it. Throws InputError where a block of the image holds a whole command (docs/decisions/packets.md).
UploadEnd upload(ByteLink& link, const std::string& name, const std::vector<std::uint8_t>& image, const UploadOptions& options);

}  // namespace lasso::mdat
