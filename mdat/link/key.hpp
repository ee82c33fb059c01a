// Keys, and the codes that are made with them: HMAC-SHA-256 (RFC 2104), by OpenSSL.
//
// A mission has one master key of 32 bytes. Key 0, which commands are signed with at first, is the master itself. Every other key comes
// from it by NIST SP 800-108 in counter mode, in one block: HMAC(master, 00000001 || label || 00 || number || 00000100), all numbers of 32
// bits and big-endian. Who has a derived key can make neither the master nor another key of it. Commands begin with a bit pattern (0x18 to
// 0x1F) that no such input does.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "fsw/core/span.hpp"

namespace lasso::mdat {

constexpr std::size_t kKeyBytes = 32;
using Digest = std::array<std::uint8_t, kKeyBytes>;

struct Key {
  std::vector<std::uint8_t> bytes;
  std::uint32_t number = 0;  // 0: the master
};
inline bool operator==(const Key& a, const Key& b) { return a.bytes == b.bytes && a.number == b.number; }

// Of a file with 64 hexadecimal digits, and, of a derived key, a blank and its number. Throws InputError, which names the file and what it
// takes.
Key load_key(const std::string& file);
// As load_key(), of what signs images and is in a component. Throws InputError also where the key is a derived one.
Key load_master_key(const std::string& file);
// The content of such a file.
std::string key_text(const Key& key);

// Of a master.
Key derive_command_key(const Key& master, std::uint32_t number);
Key derive_image_key(const Key& master);

// A component takes no key before the one in use, nor one further than this beyond it: what is stepped over is used up for good, and
// whoever stole the key in use may propose a number, too.
constexpr std::uint32_t kLargestKeyStep = 65'536;
bool is_next_key(std::uint32_t in_use, std::uint32_t number);
// Throws InputError, which says which numbers may follow.
void check_next_key(std::uint32_t in_use, std::uint32_t number);

// The code of bytes that come in pieces. Throws RunError where OpenSSL has no HMAC-SHA-256.
class KeyedHash {
 public:
  explicit KeyedHash(const Key& key);
  ~KeyedHash();
  KeyedHash(KeyedHash&&) noexcept;
  KeyedHash& operator=(KeyedHash&&) noexcept;
  void add(ConstBytes piece);
  Digest end();

 private:
  struct Context;
  std::unique_ptr<Context> context_;
};

// In constant time, of as many bytes as the shorter one has. False where it has none.
bool same_code(ConstBytes a, ConstBytes b);

}  // namespace lasso::mdat
