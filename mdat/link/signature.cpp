#include "mdat/link/signature.hpp"

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <sstream>
#include <utility>

#include "fsw/core/byte_codec.hpp"
#include "fsw/link/telecommand.hpp"
#include "mdat/common/errors.hpp"
#include "mdat/common/flight_image.hpp"
#include "mdat/common/output.hpp"
#include "mdat/common/text.hpp"

namespace lasso::mdat {
namespace {

using Packet = std::vector<std::uint8_t>;

constexpr std::size_t kNumberBytes = 8;
constexpr std::size_t kCodeBytes = 16;
constexpr std::size_t kTrailerBytes = kNumberBytes + kCodeBytes;
static_assert(kTrailerBytes <= kMaxAuthenticationBytes && kImageSignatureBytes <= kMaxAuthenticationBytes, "no room for it");
static_assert(kImageSignatureBytes == kKeyBytes, "a whole code");

ConstBytes view(const Packet& bytes) { return {bytes.data(), bytes.size()}; }

std::filesystem::path state_file(const std::string& store) { return std::filesystem::path(store) / "authentication"; }

std::string state_text(const SignatureState& state) {
  return format("key %u\nnumber %llu\n", state.key, static_cast<unsigned long long>(state.number));
}

Digest image_code(ConstBytes body, const Key& master) {
  KeyedHash hash(derive_image_key(master));
  hash.add(body);
  return hash.end();
}

}  // namespace

std::uint64_t number_of_now() {
  const auto now = std::chrono::system_clock::now().time_since_epoch();
  return static_cast<std::uint64_t>(std::chrono::duration_cast<std::chrono::microseconds>(now).count());
}

Packet Signer::sign(const Packet& packet) {
  number_ = std::max(number_ + 1, number_of_now());
  CommandHeader header;
  ConstBytes data;
  const ConstBytes bytes = view(packet);
  const std::uint16_t apid = bytes.size() < kPrimaryHeaderBytes ? kApid : read_primary_header(bytes).apid;  // whoever it is for
  if (parse_command(bytes, header, data, apid) != PacketFault::kNone) throw RunError("what is no command is not signed");
  // The code covers the length field as it will be: the packet is finished once for that, and once for its checksum.
  Packet out(packet.size() + kTrailerBytes);
  const auto finish = [&](const Digest& code) {
    ByteWriter writer{Bytes(out.data(), out.size())};
    begin_command(header, writer);
    writer.bytes(data);
    writer.u64(number_);
    writer.bytes({code.data(), kCodeBytes});
    static_cast<void>(finish_packet(writer, Bytes(out.data(), out.size())));
  };
  finish({});
  KeyedHash hash(key_);
  hash.add({out.data(), out.size() - kCodeBytes - kPacketTrailerBytes});
  finish(hash.end());
  return out;
}

std::vector<std::uint8_t> sign_image(const std::vector<std::uint8_t>& image, const Key& master) {
  if (master.number != 0) throw InputError(format("key %u signs commands alone: images are signed with the master key", master.number));
  std::vector<std::uint8_t> out = without_signature(image);
  const Digest code = image_code(view(out), master);
  out.insert(out.end(), code.begin(), code.end());
  return out;
}

bool is_signed_by(const std::vector<std::uint8_t>& image, const Key& master) {
  const std::vector<std::uint8_t> body = without_signature(image);
  const Digest code = image_code(view(body), master);
  return body.size() < image.size() && same_code({code.data(), code.size()}, view(image).subspan(body.size(), kImageSignatureBytes));
}

SignatureCheck::SignatureCheck(Key master, const SignatureState& state, Keep keep)
    : master_(std::move(master)), key_(derive_command_key(master_, state.key)), number_(state.number), keep_(std::move(keep)) {
  if (master_.number != 0) throw InputError(format("key %u is a derived one: a component has the master key", master_.number));
}

std::size_t SignatureCheck::trailer_bytes() const { return kTrailerBytes; }

bool SignatureCheck::is_by(const Key& key, ConstBytes packet, ConstBytes trailer) const {
  KeyedHash hash(key);
  hash.add(packet);
  hash.add(trailer.first(kNumberBytes));
  const Digest code = hash.end();
  return same_code({code.data(), kCodeBytes}, trailer.subspan(kNumberBytes, kCodeBytes));
}

bool SignatureCheck::authentic(ConstBytes packet, ConstBytes trailer) {
  const std::uint64_t number = ByteReader(trailer).u64();
  const bool by_key = is_by(key_, packet, trailer), by_trial = trial_ && is_by(*trial_, packet, trailer);
  if ((!by_key && !by_trial) || number <= number_) return false;
  number_ = number;
  by_trial_ = by_trial;
  static_cast<void>(keep(key_.number));
  return true;
}

std::size_t SignatureCheck::image_signature_bytes() const { return kImageSignatureBytes; }

void SignatureCheck::begin_image() { image_.emplace(derive_image_key(master_)); }

void SignatureCheck::take_image(ConstBytes piece) {
  if (image_) image_->add(piece);
}

bool SignatureCheck::image_authentic(ConstBytes signature) {
  if (!image_) return false;
  const Digest code = image_->end();
  return signature.size() == code.size() && same_code({code.data(), code.size()}, signature);
}

bool SignatureCheck::try_key(std::uint32_t number) {
  if (!is_next_key(key_.number, number)) return false;
  trial_ = derive_command_key(master_, number);
  by_trial_ = false;
  return true;
}

bool SignatureCheck::end_key_trial(bool kept) {
  if (!trial_) return false;
  if (kept && !keep(trial_->number)) return false;
  if (kept) key_ = *trial_;
  trial_.reset();
  by_trial_ = false;
  return true;
}

bool SignatureCheck::keep(std::uint32_t key) const { return !keep_ || keep_({key, number_}); }

SignatureState load_signature_state(const std::string& store) {
  const std::filesystem::path file = state_file(store);
  SignatureState state;
  if (!std::filesystem::exists(file)) return state;
  const std::string content = file_content(file);
  std::istringstream in(content);
  std::string key, number;
  if (in >> key >> state.key >> number >> state.number && content == state_text(state)) return state;
  throw InputError(file.string() +
                   ": expected 'key N' and 'number N', as a run with --key and --store leaves them there; without this file a run begins "
                   "with the master key and the time");
}

SignatureState state_at_start(const std::string& store, const std::string& link) {
  if (!store.empty() && std::filesystem::exists(state_file(store))) return load_signature_state(store);
  return {0, link.rfind("file://", 0) == 0 ? 0 : number_of_now()};
}

SignatureCheck::Keep keep_in(const std::string& store) {
  if (store.empty()) return {};
  check_writable(state_file(store));
  return [store, told = false](const SignatureState& now) mutable {
    try {
      save_signature_state(store, now);
      return true;
    } catch (const InputError& error) {
      if (!std::exchange(told, true))
        std::fprintf(stderr, "warning: %s; the next run with this store takes what was signed in this one again\n", error.what());
      return false;
    }
  };
}

void save_signature_state(const std::string& store, const SignatureState& state) { write_file(state_file(store), state_text(state)); }

}  // namespace lasso::mdat
