#include "mdat/link/signature.hpp"

#include <openssl/crypto.h>
#include <openssl/evp.h>
#include <openssl/hmac.h>

#include <algorithm>
#include <array>
#include <chrono>

#include "fsw/link/telecommand.hpp"
#include "mdat/common/errors.hpp"
#include "mdat/common/flight_image.hpp"

namespace lasso::mdat {
namespace {

using Packet = std::vector<std::uint8_t>;

constexpr std::size_t kKeyBytes = 32;
constexpr std::size_t kNumberBytes = 8;
constexpr std::size_t kCodeBytes = 16;
constexpr std::size_t kTrailerBytes = kNumberBytes + kCodeBytes;
static_assert(kTrailerBytes <= kMaxAuthenticationBytes, "flight code has no room for it");
using Code = std::array<std::uint8_t, kCodeBytes>;

Code code_of(const Key& key, const Packet& bytes) {
  std::array<unsigned char, EVP_MAX_MD_SIZE> digest{};
  unsigned int size = 0;
  if (HMAC(EVP_sha256(), key.data(), static_cast<int>(key.size()), bytes.data(), bytes.size(), digest.data(), &size) == nullptr) {
    throw RunError("HMAC-SHA-256 is not available in this OpenSSL");
  }
  Code code{};
  std::copy_n(digest.begin(), kCodeBytes, code.begin());
  return code;
}

std::uint64_t now_us() {
  const auto now = std::chrono::system_clock::now().time_since_epoch();
  return static_cast<std::uint64_t>(std::chrono::duration_cast<std::chrono::microseconds>(now).count());
}

Key bytes_of(const std::string& digits) {
  long size = 0;
  unsigned char* bytes = OPENSSL_hexstr2buf(digits.c_str(), &size);
  Key key(bytes, bytes + (bytes == nullptr ? 0 : size));
  OPENSSL_free(bytes);
  return key;
}

}  // namespace

Key load_key(const std::string& file) {
  const std::vector<std::uint8_t> bytes = read_bytes(file);
  std::string text(bytes.begin(), bytes.end());
  while (!text.empty() && (text.back() == '\n' || text.back() == '\r')) text.pop_back();
  const Key key = bytes_of(text);
  if (text.size() == 2 * kKeyBytes && key.size() == kKeyBytes) return key;
  throw InputError(file + ": is no key: 64 hexadecimal digits are expected (openssl rand -hex 32 > " + file + " makes one)");
}

Packet Signer::sign(const Packet& packet) {
  number_ = std::max(number_ + 1, now_us());
  CommandHeader header;
  ConstBytes data;
  const ConstBytes bytes(packet.data(), packet.size());
  const std::uint16_t apid = bytes.size() < kPrimaryHeaderBytes ? kApid : read_primary_header(bytes).apid;  // whoever it is for
  if (parse_command(bytes, header, data, apid) != PacketFault::kNone) throw RunError("what is no command is not signed");
  // The code covers the length field as it will be: the packet is finished once for that, and once for its check sum.
  Packet out(packet.size() + kTrailerBytes);
  const auto finish = [&](const Code& code) {
    ByteWriter writer{Bytes(out.data(), out.size())};
    begin_command(header, writer);
    writer.bytes(data);
    writer.u64(number_);
    writer.bytes({code.data(), code.size()});
    static_cast<void>(finish_packet(writer, Bytes(out.data(), out.size())));
  };
  finish({});
  const auto covered = out.end() - static_cast<std::ptrdiff_t>(kCodeBytes + kPacketTrailerBytes);
  finish(code_of(key_, Packet(out.begin(), covered)));
  return out;
}

std::size_t SignatureCheck::trailer_bytes() const { return kTrailerBytes; }

bool SignatureCheck::authentic(ConstBytes packet, ConstBytes trailer) {
  const std::uint64_t number = ByteReader(trailer).u64();
  Packet covered(packet.begin(), packet.end());
  covered.insert(covered.end(), trailer.begin(), trailer.begin() + kNumberBytes);
  const bool right = CRYPTO_memcmp(code_of(key_, covered).data(), trailer.data() + kNumberBytes, kCodeBytes) == 0;
  if (!right || number <= number_) return false;
  number_ = number;
  return true;
}

}  // namespace lasso::mdat
