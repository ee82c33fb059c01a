// Signed commands, as a board may ask for (fsw/link/authenticator.hpp): HMAC-SHA-256 (RFC 2104), by OpenSSL, over a number that has to
// grow.
//
// The trailer: number (8 bytes, big-endian), then the first 16 bytes of the HMAC over all bytes before them, the packet's and the number's.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "fsw/link/authenticator.hpp"

namespace lasso::mdat {

using Key = std::vector<std::uint8_t>;

// Of a file with 64 hexadecimal digits: 32 bytes. Throws InputError, which names the file and what it takes.
Key load_key(const std::string& file);

// Gives commands the trailer. Numbers are microseconds since 1970, so that they grow from one program to the next.
class Signer {
 public:
  explicit Signer(Key key) : key_(std::move(key)) {}
  // A whole packet without a trailer becomes one with it.
  std::vector<std::uint8_t> sign(const std::vector<std::uint8_t>& packet);

 private:
  Key key_;
  std::uint64_t number_ = 0;
};

// The component's end. It begins with any number: a board that restarts keeps the last one in a store of its own.
class SignatureCheck final : public Authenticator {
 public:
  explicit SignatureCheck(Key key) : key_(std::move(key)) {}
  std::size_t trailer_bytes() const override;
  bool authentic(ConstBytes packet, ConstBytes trailer) override;

 private:
  Key key_;
  std::uint64_t number_ = 0;
};

}  // namespace lasso::mdat
