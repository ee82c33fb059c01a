// Grey pictures of 8 and 16 bits as PNG files.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace lasso::mdat {

// Row by row from the top.
template <class Code>
struct GreyPicture {
  int width = 0, height = 0;
  std::vector<Code> codes;
};

// The picture's bytes: the same for the same codes, of one version of libpng and zlib. Throws std::runtime_error.
std::string grey_png(const GreyPicture<std::uint8_t>& picture);
std::string grey_png(const GreyPicture<std::uint16_t>& picture);

// Of 8 bits: grey, or colours, which become grey as the eye sees them (BT.709). Throws std::runtime_error that names the file, what is
// wrong and what is expected: not a PNG, damaged, 16 bits, more than 8192 pixels along a side.
GreyPicture<std::uint8_t> read_grey_png(const std::filesystem::path& file);
// Of 16 bits, grey.
GreyPicture<std::uint16_t> read_grey16_png(const std::filesystem::path& file);

}  // namespace lasso::mdat
