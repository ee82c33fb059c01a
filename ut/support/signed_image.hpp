// Signed images for tests on every processor: the signature is a CRC-32C over a secret and the image, of 8 bytes. It shows what is asked
// for; it stops nobody. ut/mdat/link/signature_test.cpp has one that does.
#pragma once

#include "fsw/core/authenticator.hpp"
#include "fsw/core/byte_codec.hpp"
#include "fsw/core/crc.hpp"
#include "ut/support/box_image.hpp"

namespace lasso::test {

constexpr std::size_t kImageSumBytes = 8;
constexpr std::uint32_t kImageSecret = 0x5AC2E7;

class ImageSum : public Authenticator {
 public:
  virtual ~ImageSum() = default;
  std::size_t trailer_bytes() const override { return 4; }
  bool authentic(ConstBytes, ConstBytes) override { return true; }
  std::size_t image_signature_bytes() const override { return kImageSumBytes; }
  void begin_image() override {
    sum = kImageSecret;
    pieces = 0;
  }
  void take_image(ConstBytes piece) override {
    sum = crc32c(piece, sum);
    longest = piece.size() > longest ? piece.size() : longest;
    ++pieces;
  }
  bool image_authentic(ConstBytes signature) override {
    ByteReader in(signature);
    const std::uint32_t first = in.u32(), second = in.u32();
    return signature.size() == kImageSumBytes && first == sum && second == ~sum;
  }
  std::uint32_t sum = 0;
  std::uint32_t pieces = 0;
  std::size_t longest = 0;
};

inline TestImage signed_image(TestImage image) {
  const std::uint32_t sum = crc32c(ConstBytes(image.data(), image.size), kImageSecret);
  image.storage.resize((image.size + kImageSumBytes + 7) / 8);
  ByteWriter writer{Bytes(image.data() + image.size, kImageSumBytes)};
  writer.u32(sum);
  writer.u32(~sum);
  image.size += kImageSumBytes;
  return image;
}

}  // namespace lasso::test
