#include "mdat/link/key.hpp"

#include <openssl/crypto.h>
#include <openssl/evp.h>

#include <algorithm>
#include <charconv>
#include <cstdio>
#include <string_view>

#include "fsw/core/byte_codec.hpp"
#include "mdat/common/errors.hpp"
#include "mdat/common/flight_image.hpp"
#include "mdat/common/text.hpp"

namespace lasso::mdat {
namespace {

constexpr std::string_view kCommandLabel = "3DLASSO command key", kImageLabel = "3DLASSO image key";

std::vector<std::uint8_t> bytes_of(const std::string& digits) {
  long size = 0;
  unsigned char* bytes = OPENSSL_hexstr2buf(digits.c_str(), &size);
  std::vector<std::uint8_t> key(bytes, bytes + (bytes == nullptr ? 0 : size));
  OPENSSL_free(bytes);
  return key;
}

bool read_key_number(std::string_view text, std::uint32_t& number) {
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  return error == std::errc() && end == text.data() + text.size() && number > 0;
}

Key derived(const Key& master, std::string_view label, std::uint32_t number) {
  std::array<std::uint8_t, 64> input{};
  ByteWriter writer{Bytes(input.data(), input.size())};
  writer.u32(1);
  for (const char letter : label) writer.u8(static_cast<std::uint8_t>(letter));
  writer.u8(0);
  writer.u32(number);
  writer.u32(8 * kKeyBytes);
  KeyedHash hash(master);
  hash.add({input.data(), writer.size()});
  const Digest digest = hash.end();
  return {{digest.begin(), digest.end()}, number};
}

}  // namespace

Key load_key(const std::string& file) {
  const std::vector<std::uint8_t> bytes = read_bytes(file);
  std::string text(bytes.begin(), bytes.end());
  while (!text.empty() && (text.back() == '\n' || text.back() == '\r')) text.pop_back();
  const std::string digits = text.substr(0, text.find(' '));
  Key key{bytes_of(digits), 0};
  const bool numbered = digits.size() == text.size() || read_key_number(std::string_view(text).substr(digits.size() + 1), key.number);
  if (numbered && digits.size() == 2 * kKeyBytes && key.bytes.size() == kKeyBytes) return key;
  throw InputError(file + ": is no key: 64 hexadecimal digits are expected (openssl rand -hex 32 > " + file +
                   " makes one), and a blank and a number behind them where mdat key has derived it");
}

Key load_master_key(const std::string& file) {
  Key key = load_key(file);
  if (key.number == 0) return key;
  throw InputError(file + ": is key " + std::to_string(key.number) + ", which signs commands alone: give the master key");
}

std::string key_text(const Key& key) {
  std::string text;
  for (const std::uint8_t byte : key.bytes) {
    char digits[3];
    (void)std::snprintf(digits, sizeof digits, "%02x", byte);
    text += digits;
  }
  return text + (key.number == 0 ? "" : " " + std::to_string(key.number)) + "\n";
}

Key derive_command_key(const Key& master, std::uint32_t number) { return number == 0 ? master : derived(master, kCommandLabel, number); }

Key derive_image_key(const Key& master) { return derived(master, kImageLabel, 0); }

bool is_next_key(std::uint32_t in_use, std::uint32_t number) { return number > in_use && number - in_use <= kLargestKeyStep; }

void check_next_key(std::uint32_t in_use, std::uint32_t number) {
  if (is_next_key(in_use, number)) return;
  const std::string refused = format("change_key: number=%u: ", number);
  if (in_use == UINT32_MAX) throw InputError(refused + format("behind key %u there is none: start with a new master key", in_use));
  const std::uint32_t last = in_use + std::min(kLargestKeyStep, UINT32_MAX - in_use);
  throw InputError(refused + format("behind key %u, which signs the command, come %u to %u: numbers only grow, and what is stepped over is "
                                    "used up",
                                    in_use, in_use + 1, last));
}

struct KeyedHash::Context {
  EVP_MD_CTX* hash = EVP_MD_CTX_new();
  EVP_PKEY* key = nullptr;
  ~Context() {
    EVP_MD_CTX_free(hash);
    EVP_PKEY_free(key);
  }
};

KeyedHash::KeyedHash(const Key& key) : context_(std::make_unique<Context>()) {
  context_->key = EVP_PKEY_new_raw_private_key(EVP_PKEY_HMAC, nullptr, key.bytes.data(), key.bytes.size());
  if (EVP_DigestSignInit(context_->hash, nullptr, EVP_sha256(), nullptr, context_->key) != 1)
    throw RunError("HMAC-SHA-256 is not available in this OpenSSL");
}
KeyedHash::~KeyedHash() = default;
KeyedHash::KeyedHash(KeyedHash&&) noexcept = default;
KeyedHash& KeyedHash::operator=(KeyedHash&&) noexcept = default;

void KeyedHash::add(ConstBytes piece) {
  if (EVP_DigestSignUpdate(context_->hash, piece.data(), piece.size()) != 1) throw RunError("OpenSSL refuses to go on with a code");
}

Digest KeyedHash::end() {
  Digest digest{};
  std::size_t size = digest.size();
  if (EVP_DigestSignFinal(context_->hash, digest.data(), &size) != 1) throw RunError("OpenSSL refuses to end a code");
  return digest;
}

bool same_code(ConstBytes a, ConstBytes b) {
  const std::size_t size = std::min(a.size(), b.size());
  return size > 0 && CRYPTO_memcmp(a.data(), b.data(), size) == 0;
}

}  // namespace lasso::mdat
